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
    /// Of the body, metres.
    pub diameter: f32,
    /// Height of the mast's top, and of the ball around it, above the water, metres; 0 has neither.
    pub mast: f32,
    /// Of body and top, linear.
    pub color: [f32; 3],
}

impl Buoy {
    /// Diameter of the ball on top, in diameters of the body.
    pub const TOP_SIZE: f32 = 0.28;

    /// Its solids; the last is the ball on top, within the body where there is no mast.
    pub fn solids(&self) -> [Solid; BUOY_SOLIDS] {
        let d = self.diameter;
        let part = |shape, up: f32, size: [f32; 3], color| {
            self.pose.solid(shape, Vec3::Y * up, Vec3::from(size), color)
        };
        let foot = 0.4 * d;
        let mast = (self.mast - foot).max(0.01 * d);
        let top = Self::TOP_SIZE * d;
        [
            part(Shape::Sphere, 0.0, [d; 3], self.color),
            part(Shape::Cylinder, 0.30 * d, [0.86 * d, 0.12 * d, 0.86 * d], WHITE),
            part(Shape::Cylinder, foot + 0.5 * mast, [0.06 * d, mast, 0.06 * d], MAST),
            part(Shape::Sphere, self.mast, [top; 3], self.color),
        ]
    }

    /// World position of the ball on top.
    pub fn top(&self) -> DVec3 {
        self.pose.at(Vec3::Y * self.mast)
    }
}
