//! The water under a deck, as the plane that fits it best.
use super::about_y;
use crate::sea::{Query, SeaMaps};
use glam::{DVec2, DVec3, Vec3Swizzles};

/// Points along each side of the deck, in the middles of equal cells. A wave as long as the deck then averages to nothing,
/// as it does over the whole deck; points on the deck's edges would all stand on crests together.
pub const PROBES: usize = 4;

/// A plane through a point: height above the sea at rest there, and slopes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Plane {
    /// Height, metres.
    pub height: f64,
    /// Rise along world x and z, metres a metre.
    pub slope: DVec2,
}

impl Plane {
    /// The least-squares plane of the surface under a deck of `[length, width]` metres whose centre is at world (x, z)
    /// `at` and whose front looks along `heading`.
    ///
    /// The points are symmetric about the centre, so the three unknowns do not mix: the height is the mean, and the slope
    /// along an axis is sum(x h) / sum(x^2).
    pub fn under(maps: &SeaMaps, at: DVec2, heading: f64, [length, width]: [f64; 2]) -> Self {
        let turn = about_y(heading);
        let place = |index: usize, side: f64| side * ((index as f64 + 0.5) / PROBES as f64 - 0.5);
        let mut locals = [DVec2::ZERO; PROBES * PROBES];
        for (index, local) in locals.iter_mut().enumerate() {
            *local = DVec2::new(place(index % PROBES, width), place(index / PROBES, length));
        }
        let probes = locals.map(|local| (at + (turn * DVec3::new(local.x, 0.0, local.y)).xz()).to_array());
        let mut heights = [0.0; PROBES * PROBES];
        Query::new(maps).heights(&probes, &mut heights);
        let (mut sum, mut moment, mut square) = (0.0, DVec2::ZERO, DVec2::ZERO);
        for (local, height) in locals.into_iter().zip(heights) {
            sum += height;
            moment += local * height;
            square += local * local;
        }
        let slope = moment / square;
        Self { height: sum / heights.len() as f64, slope: (turn * DVec3::new(slope.x, 0.0, slope.y)).xz() }
    }

    /// Whether every part is a number.
    pub fn is_finite(&self) -> bool {
        self.height.is_finite() && self.slope.is_finite()
    }

    /// Unit normal, upwards.
    pub fn normal(&self) -> DVec3 {
        DVec3::new(-self.slope.x, 1.0, -self.slope.y).normalize_or(DVec3::Y)
    }
}
