//! Circling about a point of the sea.

use super::fly::LONGEST_STEP;
use super::{Controls, Heading};
use glam::DVec3;

/// Nearest and farthest the eye comes to the point, metres.
const DISTANCES: (f64, f64) = (1.0, 2000.0);
/// How far ahead the point is where the view meets no water within reach, metres.
const AHEAD: f64 = 30.0;
/// A notch of the wheel divides the distance by this.
const NOTCH: f64 = 1.15;
/// The point moves this share of the distance in a second.
const PAN: f64 = 0.5;

/// An eye that looks at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// What it looks at, world metres.
    pub centre: DVec3,
    heading: Heading,
    distance: f64,
}

impl Orbit {
    /// About the point where the view meets the sea at rest, or one straight ahead.
    pub fn seen_from(position: DVec3, heading: Heading) -> Self {
        let forward = heading.forward();
        let to_sea = -position.y / forward.y;
        let within = to_sea.is_finite() && (DISTANCES.0..=DISTANCES.1).contains(&to_sea);
        let distance = if within { to_sea } else { AHEAD };
        Self { centre: position + forward * distance, heading, distance }
    }

    /// Turns by `turn`, radians to the right and down as the mouse drags the scene, goes nearer with the wheel, and moves
    /// the point over the sea for `dt` seconds.
    pub fn update(&mut self, controls: &Controls, turn: [f64; 2], dt: f64) {
        // The hand holds the sea, so the eye goes the other way. Nobody drags it below its point.
        let highest = self.heading.pitch.max(0.0);
        self.heading.turn(-turn[0], -turn[1]);
        self.heading.pitch = self.heading.pitch.min(highest);
        self.distance = (self.distance * NOTCH.powf(-controls.wheel)).clamp(DISTANCES.0, DISTANCES.1);
        let forward = Heading { pitch: 0.0, ..self.heading }.forward();
        let pan = self.heading.right() * controls.motion.x + forward * controls.motion.z;
        self.centre += pan.clamp_length_max(1.0) * self.distance * PAN * dt.clamp(0.0, LONGEST_STEP);
    }

    /// Where the eye is, world metres.
    pub fn position(&self) -> DVec3 {
        self.centre - self.heading.forward() * self.distance
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn orbit() -> Orbit {
        Orbit::seen_from(DVec3::new(5.0, 3.0, 20.0), Heading { yaw: 0.4, pitch: -0.3 })
    }

    #[test]
    fn the_point_is_on_the_sea_where_the_view_meets_it() {
        let orbit = orbit();
        assert!(orbit.centre.y.abs() < 1e-12);
        assert!((orbit.position() - DVec3::new(5.0, 3.0, 20.0)).length() < 1e-9);
        let up = Orbit::seen_from(DVec3::Y, Heading { yaw: 0.0, pitch: 0.5 });
        assert!((up.distance - AHEAD).abs() < 1e-12);
    }

    #[test]
    fn dragging_circles_at_one_distance() {
        let mut orbit = orbit();
        let distance = (orbit.position() - orbit.centre).length();
        for _ in 0..50 {
            orbit.update(&Controls::default(), [0.1, 0.05], 0.1);
            assert!(((orbit.position() - orbit.centre).length() - distance).abs() < 1e-9);
        }
        assert!(orbit.position().y > 0.0, "from above");
    }

    #[test]
    fn the_wheel_goes_nearer_within_bounds() {
        let mut orbit = orbit();
        let before = orbit.distance;
        orbit.update(&Controls { wheel: 1.0, ..Controls::default() }, [0.0; 2], 0.1);
        assert!((orbit.distance - before / NOTCH).abs() < 1e-9);
        orbit.update(&Controls { wheel: 1e5, ..Controls::default() }, [0.0; 2], 0.1);
        assert_eq!(orbit.distance, DISTANCES.0);
        orbit.update(&Controls { wheel: -1e5, ..Controls::default() }, [0.0; 2], 0.1);
        assert_eq!(orbit.distance, DISTANCES.1);
    }
}
