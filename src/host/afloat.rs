//! What floats on a frame's sea, as things to draw.

use crate::draw::{self, Buoy, MOST_SOLIDS, Pose, Solid};
use crate::raft::{BuoySettings, RaftSettings};
use crate::sea::SeaMaps;
use crate::xr::HANDS;
use glam::DVec3;

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

    /// Adds the raft, its deck's middle at `pose`, for a viewer whose head is at `head`.
    pub fn raft(&mut self, settings: &RaftSettings, pose: crate::raft::Pose, head: DVec3) {
        #[expect(clippy::cast_possible_truncation, reason = "metres of a raft")]
        let [length, width, freeboard] =
            [settings.length, settings.width, settings.freeboard].map(|side| side as f32);
        let pose = Pose { position: pose.position, axes: pose.axes };
        self.solids.extend(draw::Raft { pose, length, width, freeboard }.solids(head));
    }

    /// Adds what the hands hold: `grips` are poses in the world, left and right, where they are tracked.
    pub fn hands(&mut self, grips: [Option<Pose>; HANDS]) {
        for (grip, hand) in grips.into_iter().zip([draw::Hand::Left, draw::Hand::Right]) {
            if let Some(grip) = grip {
                self.solids.extend(draw::hand(grip, hand));
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
