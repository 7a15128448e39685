//! What floats on a frame's sea, as things to draw.

use crate::draw::{self, Buoy, MOST_SOLIDS, Pose, Solid};
use crate::raft::{BuoySettings, RaftSettings};
use crate::sea::SeaMaps;
use crate::xr::vendor::Joints;
use crate::xr::{self, HANDS, Hand};
use glam::DVec3;

/// Of the hands, in their order.
const SIDES: [draw::Hand; HANDS] = [draw::Hand::Left, draw::Hand::Right];

/// A frame's solids; its memory is used again by the next.
pub struct Afloat {
    solids: Vec<Solid>,
}

impl Default for Afloat {
    fn default() -> Self {
        Self { solids: Vec::with_capacity(MOST_SOLIDS) }
    }
}

impl Afloat {
    /// Begins a frame with `buoys` where the water of `maps` is.
    pub fn begin(&mut self, buoys: &[BuoySettings], maps: &SeaMaps) {
        self.solids.clear();
        for buoy in buoys {
            self.solids.extend(marker(buoy, maps).solids());
        }
    }

    /// Adds what somebody else has placed.
    pub fn add(&mut self, solids: &[Solid]) {
        self.solids.extend_from_slice(solids);
    }

    /// Adds the raft, its deck's middle at `pose`, for a viewer whose head is at `head`.
    pub fn raft(&mut self, settings: &RaftSettings, pose: crate::raft::Pose, head: DVec3) {
        #[expect(clippy::cast_possible_truncation, reason = "metres of a raft")]
        let [length, width, freeboard] =
            [settings.length, settings.width, settings.freeboard].map(|side| side as f32);
        let pose = Pose { position: pose.position, axes: pose.axes };
        self.solids.extend(draw::Raft { pose, length, width, freeboard }.solids(head));
    }

    /// Adds what the hands hold, left and right, or the hands themselves where they hold nothing and are seen; `placed`
    /// takes poses to the world.
    pub fn hands(
        &mut self,
        hands: &[Hand; HANDS],
        joints: &[Option<Joints>; HANDS],
        placed: impl Fn(xr::Pose) -> Pose,
    ) {
        for (side, which) in SIDES.into_iter().enumerate() {
            if let Some(grip) = hands[side].grip {
                self.solids.extend(draw::hand(placed(grip), which));
            } else if let Some(joints) = &joints[side] {
                let balls = joints.iter().map(|&(pose, radius)| draw::joint(placed(pose), radius, which));
                self.solids.extend(balls);
            }
        }
    }

    /// Adds rays of these lengths, metres, from where the hands point, left and right.
    pub fn rays(
        &mut self,
        hands: &[Hand; HANDS],
        lengths: &[Option<f32>; HANDS],
        placed: impl Fn(xr::Pose) -> Pose,
    ) {
        for (side, which) in SIDES.into_iter().enumerate() {
            if let (Some(aim), Some(length)) = (hands[side].aim, lengths[side]) {
                self.solids.push(draw::ray(placed(aim), length, which));
            }
        }
    }

    /// All of it.
    pub fn solids(&self) -> &[Solid] {
        &self.solids
    }
}

/// A buoy as it is drawn on the water of `maps`.
pub fn marker(buoy: &BuoySettings, maps: &SeaMaps) -> Buoy {
    let (position, axes) = buoy.float(maps);
    #[expect(clippy::cast_possible_truncation, reason = "metres of a buoy")]
    let [diameter, mast] = [2.0 * buoy.radius, buoy.height].map(|side| side as f32);
    Buoy { pose: Pose { position, axes }, diameter, mast, color: buoy.color }
}
