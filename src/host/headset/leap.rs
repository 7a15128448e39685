//! How play space moves in the world from frame to frame, and whether that, or the head in it, was a leap.

use super::eyes;
use crate::raft::Pose;
use crate::xr::{self, SpaceStep, VIEWS, View};
use glam::{Quat, Vec3};

/// Farther than a head moves within a frame, metres: the runtime has put its origin somewhere else.
const FAR: f32 = 0.5;
/// Cosine of half an angle that no head turns by within a frame, 45 degrees: the same.
const WIDE: f32 = 0.924;

/// The frame before.
#[derive(Clone, Copy, Debug, Default)]
pub struct Leap {
    before: Option<(Pose, Vec3, Quat)>,
}

impl Leap {
    /// The step to `space`, which is play space in the world, seen by `views`. `leapt` where the rider did on purpose.
    pub fn step(&mut self, space: Pose, views: &[View; VIEWS], leapt: bool) -> SpaceStep {
        let (place, turn) = eyes::parts(views[0].pose);
        let place = place.as_vec3();
        let Some((before, place_before, turn_before)) = self.before.replace((space, place, turn)) else {
            return SpaceStep { pose: xr::Pose::IDENTITY, jumped: true };
        };
        let away = place.distance(place_before) > FAR || turn.dot(turn_before).abs() < WIDE;
        SpaceStep { pose: between(before, space), jumped: leapt || away }
    }
}

/// `now` as seen from `before`: its inverse times `now`, which takes a point of the space now to the point of the space
/// before that was at the same place in the world.
fn between(before: Pose, now: Pose) -> xr::Pose {
    let back = before.axes.transpose();
    // Places in the world are large numbers, their difference is not.
    let position = back * (now.position - before.position).as_vec3();
    let orientation = Quat::from_mat3(&(back * now.axes)).normalize();
    xr::Pose { position: position.into(), orientation: orientation.into() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec3, Mat3};

    fn view(position: Vec3, orientation: Quat) -> [View; VIEWS] {
        let pose = xr::Pose { position: position.into(), orientation: orientation.into() };
        [View { pose, angles: [-0.7, 0.7, 0.7, -0.7] }; VIEWS]
    }

    fn space(position: DVec3, yaw: f32) -> Pose {
        Pose { position, axes: Mat3::from_rotation_y(yaw) }
    }

    #[test]
    fn a_point_of_the_world_is_the_same_in_both_spaces() {
        let still = view(Vec3::Y, Quat::IDENTITY);
        let far = DVec3::new(1e6, 0.5, -2e6);
        let tilt = Mat3::from_rotation_y(2.0) * Mat3::from_rotation_x(0.05);
        let before = Pose { position: far, axes: tilt };
        let now = Pose {
            position: far + DVec3::new(0.1, 0.02, -0.05),
            axes: tilt * Mat3::from_rotation_z(0.01) * Mat3::from_rotation_y(0.02),
        };
        let mut leap = Leap::default();
        leap.step(before, &still, false);
        let step = leap.step(now, &still, false);
        let point = Vec3::new(0.3, 1.5, -2.0);
        let (place, turn) = (Vec3::from(step.pose.position), Quat::from_array(step.pose.orientation));
        let in_world = |space: Pose, point: Vec3| space.position - far + (space.axes * point).as_dvec3();
        let apart = in_world(now, point) - in_world(before, place + turn * point);
        assert!(!step.jumped && apart.length() < 1e-5, "{apart}");
    }

    #[test]
    fn ahead_is_ahead_and_a_left_turn_a_left_turn() {
        let still = view(Vec3::Y, Quat::IDENTITY);
        let mut leap = Leap::default();
        let first = leap.step(space(DVec3::ZERO, 1.0), &still, false);
        assert!(first.jumped && first.pose == xr::Pose::IDENTITY);
        // Where a space that is turned by 1 looks: (-sin 1, -cos 1).
        let ahead = DVec3::new(-0.1 * 1f64.sin(), 0.0, -0.1 * 1f64.cos());
        let glide = leap.step(space(ahead, 1.0), &still, false).pose;
        let [x, y, z] = glide.position;
        assert!(x.abs() < 1e-6 && y == 0.0 && (z + 0.1).abs() < 1e-6, "{glide:?}");
        assert!(glide.orientation[3] > 0.999_999, "{glide:?}");
        let turn = leap.step(space(ahead, 1.04), &still, false).pose;
        assert!((turn.orientation[1] - 0.02f32.sin()).abs() < 1e-6, "{turn:?}");
    }

    #[test]
    fn leaps_are_told() {
        let here = space(DVec3::ZERO, 0.0);
        let mut leap = Leap::default();
        let mut jumped =
            |place, turn, leapt| leap.step(here, &view(place, Quat::from_rotation_y(turn)), leapt).jumped;
        assert!(jumped(Vec3::Y, 0.0, false), "nothing came before");
        assert!(!jumped(Vec3::Y * 1.1, 0.3, false), "a quick head");
        assert!(jumped(Vec3::Y * 1.1, 0.3, true), "a snap turn");
        assert!(jumped(Vec3::new(1.0, 1.1, 0.0), 0.3, false), "another origin");
        assert!(jumped(Vec3::new(1.0, 1.1, 0.0), 1.8, false), "turned about");
        assert!(!jumped(Vec3::new(1.0, 1.1, 0.0), 1.8, false));
    }
}
