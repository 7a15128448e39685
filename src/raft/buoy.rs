//! A floating marker.
use super::tilt_to;
use crate::sea::{SeaMaps, Surface};
use glam::{DVec3, Mat3};

/// Most buoys in a scene: each asks the sea once a frame.
pub const MAX_BUOYS: usize = 64;

/// A ball with a mast, moored over one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BuoySettings {
    /// Where it is moored, world (x, z), metres.
    pub at: [f64; 2],
    /// Radius of the ball, metres, 0.05..=5.
    pub radius: f64,
    /// Diffuse reflectance, linear Rec. 709, 0..=1.
    pub color: [f32; 3],
    /// Height of the mast above the water, metres, 0..=10; 0 has none.
    pub height: f64,
}

impl BuoySettings {
    /// Its point on the waterline, world metres, and its axes: columns right, up and back, up along the surface's normal.
    ///
    /// It has no inertia: it is where the drawn surface is, in any frame, whatever was drawn before.
    pub fn float(&self, maps: &SeaMaps) -> (DVec3, Mat3) {
        let [x, z] = self.at;
        let surface = Surface::above(maps, x, z);
        let tilt = tilt_to(DVec3::from(surface.normal).normalize_or(DVec3::Y));
        (DVec3::new(x, surface.height(), z), Mat3::from_quat(tilt.as_quat()))
    }
}
