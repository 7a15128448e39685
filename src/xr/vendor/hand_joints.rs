//! `XR_EXT_hand_tracking`.

use crate::xr::XrError;
use crate::xr::error::Doing;
use crate::xr::input::HANDS;
use crate::xr::session::{FrameTime, Pose, Session};
use openxr as xr;

/// Joints of a hand: palm, wrist, four of the thumb, five of each finger.
pub const JOINTS: usize = xr::HAND_JOINT_COUNT;

/// A hand: each joint with its radius in metres.
pub type Joints = [(Pose, f32); JOINTS];

/// Trackers of both hands.
pub struct HandJoints([xr::HandTracker; HANDS]);

impl HandJoints {
    /// Begins to track, where the headset can.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn new(session: &Session) -> Result<Option<Self>, XrError> {
        let runtime = &session.runtime;
        if !runtime.extensions.ext_hand_tracking {
            return Ok(None);
        }
        if !runtime.instance.supports_hand_tracking(runtime.system).doing("asking about hands")? {
            return Ok(None);
        }
        let tracker = |hand| session.raw.create_hand_tracker(hand).doing("tracking a hand");
        Ok(Some(Self([tracker(xr::Hand::LEFT)?, tracker(xr::Hand::RIGHT)?])))
    }

    /// Joints of one hand at `time`; nothing while it is not seen. Allocates nothing.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn locate(&self, session: &Session, time: FrameTime, hand: usize) -> Result<Option<Joints>, XrError> {
        let found =
            session.base().locate_hand_joints(&self.0[hand], time.raw).doing("locating a hand's joints")?;
        Ok(found.map(|joints| joints.map(|joint| (Pose::of(joint.pose), joint.radius))))
    }
}
