//! A direction of view that never rolls.

use glam::{DVec3, Mat3};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Straight up and straight down have no right and left.
const STEEPEST: f64 = FRAC_PI_2 - 0.01;

/// Which way a level head looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heading {
    /// Radians, counter-clockwise from above; 0 looks along -Z.
    pub yaw: f64,
    /// Radians, upwards.
    pub pitch: f64,
}

impl Heading {
    /// Along `direction`; along -Z for none.
    pub fn towards(direction: DVec3) -> Self {
        let level = direction.x.hypot(direction.z);
        let yaw = if level > 0.0 { (-direction.x).atan2(-direction.z) } else { 0.0 };
        Self { yaw, pitch: direction.y.atan2(level).clamp(-STEEPEST, STEEPEST) }
    }

    /// Turned by radians to the left and upwards, as far as up goes.
    pub fn turn(&mut self, left: f64, up: f64) {
        self.yaw = (self.yaw + left).rem_euclid(TAU);
        self.pitch = (self.pitch + up).clamp(-STEEPEST, STEEPEST);
    }

    /// Where it looks, a unit vector.
    pub fn forward(self) -> DVec3 {
        let (sin, cos) = self.yaw.sin_cos();
        let (up, level) = self.pitch.sin_cos();
        DVec3::new(-sin * level, up, -cos * level)
    }

    /// What is to its right, a level unit vector.
    pub fn right(self) -> DVec3 {
        let (sin, cos) = self.yaw.sin_cos();
        DVec3::new(cos, 0.0, -sin)
    }

    /// Right, up and backwards, as [`crate::draw::Eye`] wants them.
    pub fn axes(self) -> Mat3 {
        let (right, back) = (self.right(), -self.forward());
        Mat3::from_cols(right.as_vec3(), back.cross(right).as_vec3(), back.as_vec3())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_looks_where_it_was_told() {
        for direction in [DVec3::new(1.0, 0.2, -3.0), DVec3::new(-2.0, -1.0, 0.5), DVec3::NEG_Z] {
            let forward = Heading::towards(direction).forward();
            assert!((forward - direction.normalize()).length() < 1e-12, "{direction}");
        }
        assert_eq!(Heading::towards(DVec3::ZERO), Heading { yaw: 0.0, pitch: 0.0 });
    }

    #[test]
    fn a_turn_to_the_left_from_minus_z_looks_along_minus_x() {
        let mut heading = Heading { yaw: 0.0, pitch: 0.0 };
        heading.turn(FRAC_PI_2, 0.0);
        assert!((heading.forward() - DVec3::NEG_X).length() < 1e-12);
        assert!((heading.right() - DVec3::NEG_Z).length() < 1e-12);
    }

    #[test]
    fn pitch_ends_short_of_the_zenith() {
        let mut heading = Heading::towards(DVec3::Y);
        heading.turn(0.0, 10.0);
        assert_eq!(heading.pitch, STEEPEST);
        heading.turn(0.0, -20.0);
        assert_eq!(heading.pitch, -STEEPEST);
    }
}
