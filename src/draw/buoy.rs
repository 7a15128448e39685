//! A buoy: a ball in a saturated colour, half under water, with a mast and a smaller ball on top.

use super::solids::{Pose, Shape, Solid};
use glam::{DVec3, Vec3};

/// Solids of one buoy: body, band, mast and top.
pub const BUOY_SOLIDS: usize = 4;

const WHITE: [f32; 3] = [0.75, 0.75, 0.72];
const MAST: [f32; 3] = [0.10, 0.10, 0.11];

/// What a buoy looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Buoy {
    /// Its origin is the body's centre, which floats at the water's surface; y along the mast.
    pub pose: Pose,
    /// Of the body, metres; everything else is in proportion.
    pub diameter: f32,
    /// Of body and top, linear.
    pub color: [f32; 3],
}

impl Buoy {
    /// Height of the top's centre above the body's, in diameters of the body.
    pub const TOP: f32 = 2.0;
    /// Diameter of the top, in diameters of the body.
    pub const TOP_SIZE: f32 = 0.28;

    /// Its solids; the last is the ball on top.
    pub fn solids(&self) -> [Solid; BUOY_SOLIDS] {
        let part = |shape, up: f32, size: [f32; 3], color| {
            self.pose.solid(shape, Vec3::Y * (up * self.diameter), Vec3::from(size) * self.diameter, color)
        };
        [
            part(Shape::Sphere, 0.0, [1.0; 3], self.color),
            part(Shape::Cylinder, 0.30, [0.86, 0.12, 0.86], WHITE),
            part(Shape::Cylinder, 0.5 * Self::TOP + 0.2, [0.06, Self::TOP - 0.4, 0.06], MAST),
            part(Shape::Sphere, Self::TOP, [Self::TOP_SIZE; 3], self.color),
        ]
    }

    /// World position of the ball on top.
    pub fn top(&self) -> DVec3 {
        self.pose.at(Vec3::Y * (Self::TOP * self.diameter))
    }
}
