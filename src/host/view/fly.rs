//! Flying: anywhere above the water.

use super::{Controls, Heading};
use glam::DVec3;

/// Metres a second at first.
const SPEED: f64 = 6.0;
/// Slowest and fastest, metres a second.
const SPEEDS: (f64, f64) = (0.2, 400.0);
/// A notch of the wheel multiplies the speed by this.
const NOTCH: f64 = 1.25;
/// In a hurry it goes this many times as fast.
const HURRY: f64 = 5.0;
/// A frame that took longer moves no further, seconds: after a pause nobody is thrown across the sea.
pub(super) const LONGEST_STEP: f64 = 0.25;

/// A free eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fly {
    /// World metres.
    pub position: DVec3,
    /// Where it looks.
    pub heading: Heading,
    /// Metres a second.
    pub speed: f64,
}

impl Fly {
    /// At `position`, at the usual speed.
    pub const fn new(position: DVec3, heading: Heading) -> Self {
        Self { position, heading, speed: SPEED }
    }

    /// Turns by `turn`, radians to the right and down, and moves for `dt` seconds: forward is where it looks, up is up.
    pub fn update(&mut self, controls: &Controls, turn: [f64; 2], dt: f64) {
        self.heading.turn(-turn[0], -turn[1]);
        self.speed = (self.speed * NOTCH.powf(controls.wheel)).clamp(SPEEDS.0, SPEEDS.1);
        let motion = controls.motion;
        let direction =
            self.heading.right() * motion.x + DVec3::Y * motion.y + self.heading.forward() * motion.z;
        let speed = if controls.fast { self.speed * HURRY } else { self.speed };
        // Two keys at once are not faster than one.
        self.position += direction.clamp_length_max(1.0) * speed * dt.clamp(0.0, LONGEST_STEP);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flown(controls: Controls, dt: f64) -> DVec3 {
        let mut fly = Fly::new(DVec3::ZERO, Heading { yaw: 0.0, pitch: 0.0 });
        fly.update(&controls, [0.0; 2], dt);
        fly.position
    }

    #[test]
    fn keys_move_along_the_axes_of_the_view() {
        let motion = |motion| Controls { motion, ..Controls::default() };
        assert_eq!(flown(motion(DVec3::Z), 0.1), DVec3::NEG_Z * (0.1 * SPEED), "forward is -Z");
        assert_eq!(flown(motion(DVec3::X), 0.1), DVec3::X * (0.1 * SPEED));
        assert_eq!(flown(motion(DVec3::NEG_Y), 0.1), DVec3::NEG_Y * (0.1 * SPEED));
        let both = flown(motion(DVec3::new(1.0, 0.0, 1.0)), 0.1);
        assert!((both.length() - 0.1 * SPEED).abs() < 1e-12, "{both}");
    }

    #[test]
    fn hurry_wheel_and_pauses_do_what_they_should() {
        let forward = Controls { motion: DVec3::Z, ..Controls::default() };
        let length = |controls, dt| flown(controls, dt).length();
        assert!((length(Controls { fast: true, ..forward }, 0.1) - 0.1 * SPEED * HURRY).abs() < 1e-9);
        assert!((length(Controls { wheel: 2.0, ..forward }, 0.1) - 0.1 * SPEED * NOTCH * NOTCH).abs() < 1e-9);
        assert!(length(Controls { wheel: 1e6, ..forward }, 0.1) <= 0.1 * SPEEDS.1 + 1e-9);
        assert_eq!(length(forward, 100.0), length(forward, LONGEST_STEP));
    }

    #[test]
    fn dragging_to_the_right_looks_to_the_right() {
        let mut fly = Fly::new(DVec3::ZERO, Heading { yaw: 0.0, pitch: 0.0 });
        fly.update(&Controls::default(), [0.3, 0.2], 0.1);
        let forward = fly.heading.forward();
        assert!(forward.x > 0.0 && forward.y < 0.0, "{forward}");
    }
}
