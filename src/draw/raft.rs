//! A small raft: planks across two pontoons.

use super::solids::{Pose, Shape, Solid};
use glam::{DVec3, Mat3, Vec3};

/// Solids of one raft: planks, two pontoons and two boards along the sides.
pub const RAFT_SOLIDS: usize = PLANKS + 4;

/// Share of their distance by which depth brings the deck, and hands over it, forward while the viewer is aboard.
///
/// Between the eye and a deck that one stands on there is never any water, but the sea is drawn without knowing of the
/// raft: a short steep wave passes through it. So depth takes the deck for nearer than it is, by a share of the
/// distance. That is as if the deck were scaled about the eye: the picture stays the same, and where the eye is at
/// height H above the deck, water up to `LEAD / (1 + LEAD)` H above it is hidden, at every angle alike (32 cm for
/// 1.6 m). From elsewhere there may well be water in front of a raft, and depth is told as it is.
pub const LEAD: f32 = 0.25;

const PLANKS: usize = 14;
/// Of a plank, metres.
const THICKNESS: f32 = 0.035;
/// Between planks, metres.
const GAP: f32 = 0.012;
/// Share of a pontoon that is above the water.
const AFLOAT: f32 = 0.6;
/// Wood in the sun and rain: each plank is a little darker or lighter.
const WOOD: Vec3 = Vec3::new(0.30, 0.19, 0.105);
const SIDE: [f32; 3] = [0.20, 0.115, 0.055];
const PONTOON: [f32; 3] = [0.55, 0.20, 0.03];

/// What a raft looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Raft {
    /// Its origin is the middle of the deck's top; y up, -z forward.
    pub pose: Pose,
    /// Of the deck along z, metres.
    pub length: f32,
    /// Of the deck along x, metres.
    pub width: f32,
    /// Of the deck's top above the water at rest, metres, more than a plank's 3.5 cm.
    pub freeboard: f32,
}

impl Raft {
    /// The raft as seen from `head` (world metres).
    pub fn solids(&self, head: DVec3) -> [Solid; RAFT_SOLIDS] {
        let lead = self.lead(head);
        std::array::from_fn(|i| match i.checked_sub(PLANKS) {
            None => Solid { lead, ..self.plank(i) },
            // The pontoons are under the deck, for who is aboard.
            Some(part @ 0..=1) => self.pontoon([-1.0, 1.0][part]),
            Some(part) => Solid { lead, ..self.side(if part == 2 { -1.0 } else { 1.0 }) },
        })
    }

    /// [`LEAD`] aboard, less on the way out, nothing from a length and a metre away on.
    fn lead(&self, head: DVec3) -> f32 {
        let out = self.pose.axes.transpose() * (head - self.pose.position).as_vec3();
        let beyond = (out.x.abs() - 0.5 * self.width).max(out.z.abs() - 0.5 * self.length).max(0.0);
        LEAD * (1.0 - (beyond - 0.5) / (self.length + 0.5)).clamp(0.0, 1.0)
    }

    fn plank(&self, i: usize) -> Solid {
        #[expect(clippy::cast_precision_loss, reason = "a few planks")]
        let (i, planks) = (i as f32, PLANKS as f32);
        let pitch = self.length / planks;
        let place = Vec3::new(0.0, -0.5 * THICKNESS, (i + 0.5) * pitch - 0.5 * self.length);
        // The golden section spreads the shades, so that no two neighbours are alike.
        let shade = 0.78 + 0.44 * (i * 0.618_034).fract();
        let size = Vec3::new(self.width, THICKNESS, pitch - GAP);
        self.pose.solid(Shape::Box, place, size, (WOOD * shade).into())
    }

    fn pontoon(&self, side: f32) -> Solid {
        let diameter = (self.freeboard - THICKNESS) / AFLOAT;
        let place = Vec3::new(side * (0.5 * self.width - 0.6 * diameter), -THICKNESS - 0.5 * diameter, 0.0);
        let size = Vec3::new(diameter, self.length, diameter);
        let Mat3 { x_axis, y_axis, z_axis } = self.pose.axes;
        // Its y lies along the raft.
        let axes = Mat3::from_cols(x_axis, -z_axis, y_axis);
        Solid { axes, ..self.pose.solid(Shape::Cylinder, place, size, PONTOON) }
    }

    fn side(&self, side: f32) -> Solid {
        let size = Vec3::new(0.07, 0.045, self.length);
        let place = Vec3::new(side * 0.5 * (self.width - size.x), 0.5 * size.y, 0.0);
        self.pose.solid(Shape::Box, place, size, SIDE)
    }
}
