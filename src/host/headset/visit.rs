//! Who else takes part in a headset's frames.

use crate::draw::{DrawCounts, Eye, Solid};
use crate::gpu::{Device, GpuError, Image};
use crate::host::HostError;
use crate::xr::{HANDS, Hand, VIEWS};
use std::ffi::CStr;
use std::sync::Arc;
use std::time::Duration;

/// A frame that was just ended.
pub struct HeadsetFrame<'a> {
    /// Seconds of the sea.
    pub time: f64,
    /// The session's state, as OpenXR names it.
    pub state: &'static str,
    /// What was drawn, if anything was.
    pub drawn: Option<Drawn<'a>>,
}

/// What a frame showed.
pub struct Drawn<'a> {
    /// Where it was seen from: left, right.
    pub eyes: &'a [Eye; VIEWS],
    /// What the hands did.
    pub hands: &'a [Hand; HANDS],
    /// What floated on the sea.
    pub solids: &'a [Solid],
    /// How far the vignette was closed, 0 to 1.
    pub vignette: f32,
    /// What it took to draw.
    pub counts: DrawCounts,
    /// Bytes uploaded for it.
    pub uploaded: u64,
    /// What the sea's step took, on other threads.
    pub sea: Duration,
    /// A copy of both views, one a layer, in `TRANSFER_SRC_OPTIMAL`, for guests who [look](Guest::looks).
    pub picture: Option<&'a Image>,
}

/// Somebody who looks on. None of this may wait for anything.
pub trait Guest {
    /// Called in every turn of the loop; `false` ends the session in order.
    fn goes_on(&mut self) -> bool;

    /// Whether each frame is copied for this guest.
    fn looks(&self) -> bool {
        false
    }

    /// Vulkan instance extensions that a guest's own window needs.
    fn instance_extensions(&self) -> &[&'static CStr] {
        &[]
    }

    /// Vulkan device extensions that it needs.
    fn device_extensions(&self) -> &[&'static CStr] {
        &[]
    }

    /// The guest's own window cannot be shown on, for this reason: nothing more is asked for it.
    fn refused(&mut self, _why: &GpuError) {}

    /// A device was opened. It may be another one than before.
    ///
    /// # Errors
    /// What the guest needs of it cannot be had.
    fn opened(&mut self, _device: &Arc<Device>) -> Result<(), HostError> {
        Ok(())
    }

    /// The session is over, and this is its last frame's picture, as in [`Drawn::picture`]. It goes when this returns: whoever
    /// still reads it waits for that.
    ///
    /// # Errors
    /// It cannot be kept.
    fn last(&mut self, _picture: &Image) -> Result<(), HostError> {
        Ok(())
    }

    /// The device is about to go: whatever was made on it goes first.
    fn closing(&mut self) {}

    /// Whether the panel is to be shown, or hidden, since the last call.
    fn asks_for_panel(&mut self) -> bool {
        false
    }

    /// The session entered a state.
    fn state(&mut self, _name: &'static str) {}

    /// Frames are made on the level of this number from now on: [`crate::host::fallback`].
    fn level(&mut self, _number: usize) {}

    /// A frame was ended.
    ///
    /// # Errors
    /// Whatever should end the run.
    fn frame(&mut self, _frame: &HeadsetFrame<'_>) -> Result<(), HostError> {
        Ok(())
    }
}
