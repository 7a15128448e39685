//! Where a person at a desktop looks from: flying freely, or circling about a point of the sea.
//!
//! Pure: controls and time in, an eye out.

mod fly;
mod heading;
mod orbit;

pub use fly::Fly;
pub use heading::Heading;
pub use orbit::Orbit;

use crate::draw::{Eye, Fov};
use crate::scene::CameraSettings;
use glam::DVec3;

/// The eye stays this far above the surface, metres: what the sea looks like from below is not modelled.
pub const CLEARANCE: f64 = 0.3;

/// What hands on keyboard and mouse ask for, since the frame before.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Controls {
    /// Right, up, forward; -1 to 1 each.
    pub motion: DVec3,
    /// Faster.
    pub fast: bool,
    /// How far the mouse was dragged to the right and down, as a share of the window's height.
    pub drag: [f64; 2],
    /// How far the wheel was turned away from the person, in notches.
    pub wheel: f64,
}

/// A viewer that follows controls.
#[derive(Clone, Copy, Debug)]
pub struct Viewer {
    fly: Fly,
    orbit: Option<Orbit>,
    start: Fly,
    fov_y: f64,
}

impl Viewer {
    /// Flying, from the scene's camera.
    pub fn new(camera: &CameraSettings) -> Self {
        let (position, look) = (DVec3::from(camera.eye), DVec3::from(camera.look));
        let start = Fly::new(position, Heading::towards(look - position));
        Self { fly: start, orbit: None, start, fov_y: camera.fov_y }
    }

    /// Back to the scene's camera.
    pub fn reset(&mut self) {
        (self.fly, self.orbit) = (self.start, None);
    }

    /// From flying to circling about what is in the middle of the view, and back.
    pub fn toggle_orbit(&mut self) {
        self.orbit = match self.orbit {
            None => Some(Orbit::seen_from(self.fly.position, self.fly.heading)),
            Some(_) => None,
        };
    }

    /// Moves for `dt` seconds. `surface` is the height of the sea at world (x, z), metres; the eye stays above.
    pub fn update(&mut self, controls: &Controls, dt: f64, surface: impl FnOnce(f64, f64) -> f64) {
        // A pull across the window's height turns by what the window shows.
        let turn = controls.drag.map(|share| share * self.fov_y);
        match &mut self.orbit {
            None => self.fly.update(controls, turn, dt),
            Some(orbit) => {
                orbit.update(controls, turn, dt);
                self.fly.position = orbit.position();
            }
        }
        let position = &mut self.fly.position;
        position.y = position.y.max(surface(position.x, position.z) + CLEARANCE);
        if let Some(orbit) = &self.orbit {
            self.fly.heading = Heading::towards(orbit.centre - *position);
        }
    }

    /// The eye, for a picture that is `aspect` times as wide as high.
    #[expect(clippy::cast_possible_truncation, reason = "an angle")]
    pub fn eye(&self, aspect: f32) -> Eye {
        let fov = Fov::symmetric(self.fov_y as f32, aspect);
        Eye { position: self.fly.position, axes: self.fly.heading.axes(), fov }
    }

    /// Metres a second that flying goes.
    pub const fn speed(&self) -> f64 {
        self.fly.speed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw;

    fn camera() -> CameraSettings {
        CameraSettings { eye: [3.0, 4.0, 5.0], look: [40.0, 1.0, -60.0], fov_y: 1.0, eye_separation: 0.064 }
    }

    fn viewer() -> Viewer {
        Viewer::new(&camera())
    }

    #[test]
    fn it_begins_as_the_scenes_camera() {
        let (eye, scene) = (viewer().eye(1.5), draw::eyes(&camera(), 1.5, false)[0]);
        assert_eq!((eye.position, eye.fov), (scene.position, scene.fov));
        assert!(eye.axes.abs_diff_eq(scene.axes, 1e-6), "{:?} {:?}", eye.axes, scene.axes);
    }

    #[test]
    fn no_way_leads_under_water_and_none_rolls() {
        let mut viewer = viewer();
        let mut random = 1_u32;
        let mut number = || {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            2.0 * f64::from(random >> 8) / f64::from(1 << 24) - 1.0
        };
        for step in 0..4000 {
            if step % 97 == 0 {
                viewer.toggle_orbit();
            }
            let motion = DVec3::new(number(), number() - 0.5, number());
            let controls =
                Controls { motion, fast: number() > 0.0, drag: [number(), number()], wheel: 2.0 * number() };
            let height = 3.0 * number();
            viewer.update(&controls, 0.05, |_, _| height);
            let eye = viewer.eye(1.0);
            assert!(eye.position.is_finite() && eye.position.y >= height + CLEARANCE - 1e-12);
            assert_eq!(eye.axes.x_axis.y, 0.0, "right is level");
            assert!(eye.axes.y_axis.y > 0.0, "up is up");
            assert!((eye.axes.determinant() - 1.0).abs() < 1e-5);
        }
        viewer.reset();
        assert_eq!(viewer.eye(1.5), self::viewer().eye(1.5));
    }

    #[test]
    fn circling_begins_and_ends_without_a_jump() {
        let mut viewer = viewer();
        let before = viewer.eye(1.0);
        for _ in 0..2 {
            viewer.toggle_orbit();
            viewer.update(&Controls::default(), 0.01, |_, _| 0.0);
            let after = viewer.eye(1.0);
            assert!((after.position - before.position).length() < 1e-9);
            assert!(after.axes.abs_diff_eq(before.axes, 1e-5));
        }
    }
}
