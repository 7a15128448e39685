//! Markers for the hands, from the poses that OpenXR gives them: controllers, or joints.

use super::raft::LEAD;
use super::solids::{Pose, Shape, Solid};
use glam::{Mat3, Vec3};

/// Solids of one hand: handle, head and trigger.
pub const HAND_SOLIDS: usize = 3;

/// Which hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hand {
    /// The left one, blue.
    Left,
    /// The right one, orange.
    Right,
}

impl Hand {
    const fn color(self) -> [f32; 3] {
        match self {
            Self::Left => [0.03, 0.16, 0.55],
            Self::Right => [0.60, 0.17, 0.02],
        }
    }
}

const DARK: [f32; 3] = [0.05, 0.05, 0.055];

/// A pose whose y is the other's -z: cylinders lie along what is pointed at.
fn forward(pose: Pose) -> Pose {
    let Mat3 { x_axis, y_axis, z_axis } = pose.axes;
    Pose { axes: Mat3::from_cols(x_axis, -z_axis, y_axis), ..pose }
}

/// A controller held at `grip`: OpenXR's grip pose, whose -z runs through the fist towards the thumb.
pub fn hand(grip: Pose, hand: Hand) -> [Solid; HAND_SOLIDS] {
    let color = hand.color();
    let along = forward(grip);
    let parts = [
        along.solid(Shape::Cylinder, Vec3::Y * -0.01, Vec3::new(0.034, 0.11, 0.034), DARK),
        along.solid(Shape::Cylinder, Vec3::Y * 0.055, Vec3::new(0.06, 0.022, 0.06), color),
        grip.solid(Shape::Sphere, Vec3::new(0.0, -0.018, -0.03), Vec3::splat(0.026), color),
    ];
    // Seen together with the deck: what is nearer has to stay nearer.
    parts.map(|part| Solid { lead: LEAD, ..part })
}

/// A joint of a hand without a controller: a ball of `radius` metres, within what a hand may have.
pub fn joint(pose: Pose, radius: f32, hand: Hand) -> Solid {
    // What is no number is a small joint too.
    let radius = if radius > 0.0 { radius.clamp(0.002, 0.03) } else { 0.002 };
    Solid { lead: LEAD, ..pose.solid(Shape::Sphere, Vec3::ZERO, Vec3::splat(2.0 * radius), hand.color()) }
}

/// A ray of `length` metres from `aim`: OpenXR's aim pose, which points along -z.
pub fn ray(aim: Pose, length: f32, hand: Hand) -> Solid {
    let color = match hand {
        Hand::Left => [0.10, 0.45, 0.95],
        Hand::Right => [0.95, 0.45, 0.08],
    };
    let size = Vec3::new(0.005, length, 0.005);
    Solid { lead: LEAD, ..forward(aim).solid(Shape::Cylinder, Vec3::Y * (0.5 * length), size, color) }
}
