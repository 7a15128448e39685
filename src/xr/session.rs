//! A session: its life, its spaces, where the eyes are.

use super::error::{Doing, XrError, check};
use super::lifecycle::{Demand, Lifecycle};
use super::runtime::{CONFIGURATION, Runtime, VIEWS};
use crate::gpu::Device;
use ash::vk::{self, Handle};
use openxr::{self as xr, sys};
use std::ffi::c_void;
use std::sync::Arc;

/// How high above its origin a space's floor is taken to be where the runtime knows no floor, metres.
const SEATED_EYES: f32 = 1.6;

/// A position and a rotation in the base space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Metres.
    pub position: [f32; 3],
    /// Quaternion x, y, z, w, of unit length.
    pub orientation: [f32; 4],
}

impl Pose {
    /// At the origin, not turned.
    pub const IDENTITY: Self = Self { position: [0.0; 3], orientation: [0.0, 0.0, 0.0, 1.0] };

    pub(super) fn of(pose: xr::Posef) -> Self {
        let (p, q) = (pose.position, pose.orientation);
        Self { position: [p.x, p.y, p.z], orientation: [q.x, q.y, q.z, q.w] }
    }

    pub(super) const fn raw(&self) -> xr::Posef {
        let Self { position: [x, y, z], orientation: [i, j, k, w] } = *self;
        xr::Posef { orientation: xr::Quaternionf { x: i, y: j, z: k, w }, position: xr::Vector3f { x, y, z } }
    }
}

/// One view of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Where the eye is.
    pub pose: Pose,
    /// Angles from its axis to the sides: left, right, up, down; radians; left and down are negative in most headsets.
    pub angles: [f32; 4],
}

/// Triangles of a view that nobody sees.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mask {
    /// Tangents (x, y) at z = -1.
    pub vertices: Vec<[f32; 2]>,
    /// Three for each triangle.
    pub indices: Vec<u32>,
}

/// When a frame will be seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameTime {
    pub(super) raw: xr::Time,
    /// Seconds on the runtime's clock.
    pub seconds: f64,
    /// Seconds until the next one.
    pub period: f64,
    /// Whether it will be seen at all.
    pub should_render: bool,
}

impl FrameTime {
    /// Whether the frame is seen at or after `at`.
    pub fn is_from(self, at: xr::Time) -> bool {
        self.raw.as_nanos() >= at.as_nanos()
    }
}

/// A session with a headset.
pub struct Session {
    /// Spaces go before the session.
    base: xr::Space,
    /// What kind of space `base` is.
    pub space: xr::ReferenceSpaceType,
    waiter: xr::FrameWaiter,
    pub(super) stream: xr::FrameStream<xr::Vulkan>,
    lifecycle: Lifecycle,
    views: [sys::View; VIEWS],
    pub(super) raw: xr::Session<xr::Vulkan>,
    pub(super) device: Arc<Device>,
    /// The runtime.
    pub runtime: Arc<Runtime>,
}

impl Session {
    /// Begins to talk; frames come once the runtime is ready.
    ///
    /// # Errors
    /// The runtime refuses, or has gone.
    pub fn new(runtime: &Arc<Runtime>, device: &Arc<Device>) -> Result<Self, XrError> {
        let pointer = |handle: u64| handle as usize as *const c_void;
        let info = xr::vulkan::SessionCreateInfo {
            instance: pointer(device.instance().raw.handle().as_raw()),
            physical_device: pointer(device.physical.raw.as_raw()),
            device: pointer(device.raw.handle().as_raw()),
            queue_family_index: device.queue_family,
            queue_index: 0,
        };
        let (mut raw, waiter, stream) = {
            let _queue = device.queue();
            // SAFETY: the handles belong to one another and to this runtime; the device outlives the session, which keeps
            // an `Arc` of it and is dropped first; the queue is locked wherever the runtime may use it.
            unsafe { runtime.instance.create_session::<xr::Vulkan>(runtime.system, &info) }
                .doing("creating the session")?
        };
        // Names are for captures and messages: one that is refused is missed by nobody.
        let _unnamed = raw.set_name("ocean");
        let (mut base, space) = floor(&raw)?;
        let _unnamed = base.set_name("play space");
        let empty = sys::View {
            ty: sys::View::TYPE,
            next: std::ptr::null_mut(),
            pose: xr::Posef::IDENTITY,
            fov: xr::Fovf::default(),
        };
        Ok(Self {
            base,
            space,
            waiter,
            stream,
            lifecycle: Lifecycle::default(),
            views: [empty; VIEWS],
            raw,
            device: Arc::clone(device),
            runtime: Arc::clone(runtime),
        })
    }

    /// Follows the runtime into `state`, beginning or ending the session as it asks.
    ///
    /// # Errors
    /// The runtime refuses, or has gone.
    pub fn enter(&mut self, state: xr::SessionState) -> Result<Demand, XrError> {
        let demand = self.lifecycle.enter(state);
        match demand {
            Demand::Begin => drop(self.raw.begin(CONFIGURATION).doing("beginning the session")?),
            Demand::End => drop(self.raw.end().doing("ending the session")?),
            _ => {}
        }
        Ok(demand)
    }

    /// The device it draws with.
    pub const fn device(&self) -> &Arc<Device> {
        &self.device
    }

    /// Where the session is.
    pub const fn lifecycle(&self) -> Lifecycle {
        self.lifecycle
    }

    /// Asks the runtime to end the session in order.
    ///
    /// # Errors
    /// The runtime has gone.
    pub fn request_exit(&self) -> Result<(), XrError> {
        self.raw.request_exit().doing("asking for the end")
    }

    /// Formats of swapchains, the runtime's favourites first.
    ///
    /// # Errors
    /// The runtime has gone.
    pub fn formats(&self) -> Result<Vec<vk::Format>, XrError> {
        let formats = self.raw.enumerate_swapchain_formats().doing("listing swapchain formats")?;
        Ok(formats
            .into_iter()
            .map(|format| i32::try_from(format).map_or(vk::Format::UNDEFINED, vk::Format::from_raw))
            .collect())
    }

    /// Waits until it is time for the next frame.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn wait(&mut self) -> Result<FrameTime, XrError> {
        let state = self.waiter.wait().doing("waiting for a frame")?;
        #[expect(
            clippy::cast_precision_loss,
            reason = "a nanosecond clock keeps its microseconds for centuries"
        )]
        let seconds = |nanoseconds: i64| nanoseconds as f64 * 1e-9;
        Ok(FrameTime {
            raw: state.predicted_display_time,
            seconds: seconds(state.predicted_display_time.as_nanos()),
            period: seconds(state.predicted_display_period.as_nanos()),
            should_render: state.should_render,
        })
    }

    /// Tells the runtime that drawing begins.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn begin(&mut self) -> Result<(), XrError> {
        let _queue = self.device.queue();
        self.stream.begin().doing("beginning a frame")
    }

    /// Where the eyes will be at `time`; nothing while the headset is not tracked. Allocates nothing.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn locate(&mut self, time: FrameTime) -> Result<Option<[View; VIEWS]>, XrError> {
        let info = sys::ViewLocateInfo {
            ty: sys::ViewLocateInfo::TYPE,
            next: std::ptr::null(),
            view_configuration_type: CONFIGURATION,
            display_time: time.raw,
            space: self.base.as_raw(),
        };
        let mut state = sys::ViewState {
            ty: sys::ViewState::TYPE,
            next: std::ptr::null_mut(),
            view_state_flags: sys::ViewStateFlags::EMPTY,
        };
        let mut count = 0;
        // SAFETY: session and space live; `views` has room for the two that a stereo configuration has.
        check(unsafe {
            (self.runtime.instance.fp().locate_views)(
                self.raw.as_raw(),
                &info,
                &mut state,
                VIEWS as u32,
                &mut count,
                self.views.as_mut_ptr(),
            )
        })
        .doing("locating the eyes")?;
        let valid = sys::ViewStateFlags::ORIENTATION_VALID | sys::ViewStateFlags::POSITION_VALID;
        if !state.view_state_flags.contains(valid) {
            return Ok(None);
        }
        Ok(Some(self.views.map(|view| View {
            pose: Pose::of(view.pose),
            angles: [view.fov.angle_left, view.fov.angle_right, view.fov.angle_up, view.fov.angle_down],
        })))
    }

    /// The views located last, as the runtime gave them.
    pub(super) const fn located(&self) -> &[sys::View; VIEWS] {
        &self.views
    }

    /// The space that poses are in.
    pub(super) const fn base(&self) -> &xr::Space {
        &self.base
    }

    /// What a lens hides in view `view`; empty where the runtime does not tell.
    ///
    /// # Errors
    /// The runtime has gone.
    pub fn hidden_area(&self, view: usize) -> Result<Mask, XrError> {
        if !self.runtime.extensions.khr_visibility_mask {
            return Ok(Mask::default());
        }
        let kind = xr::VisibilityMaskTypeKHR::HIDDEN_TRIANGLE_MESH;
        let mask = self
            .raw
            .get_visibility_mask_khr(CONFIGURATION, view as u32, kind)
            .doing("asking what the lenses hide")?;
        Ok(Mask { vertices: mask.vertices.iter().map(|v| [v.x, v.y]).collect(), indices: mask.indices })
    }
}

/// A space whose origin is on the floor: where one stands (`LOCAL_FLOOR`), the middle of the play area (`STAGE`), or a
/// guess below where the head began.
fn floor(session: &xr::Session<xr::Vulkan>) -> Result<(xr::Space, xr::ReferenceSpaceType), XrError> {
    let offered = session.enumerate_reference_spaces().doing("listing spaces")?;
    let favourites = [xr::ReferenceSpaceType::LOCAL_FLOOR, xr::ReferenceSpaceType::STAGE];
    let found = favourites.into_iter().find(|kind| offered.contains(kind));
    let kind = found.unwrap_or(xr::ReferenceSpaceType::LOCAL);
    let mut pose = xr::Posef::IDENTITY;
    if found.is_none() {
        pose.position.y = -SEATED_EYES;
    }
    Ok((session.create_reference_space(kind, pose).doing("creating the floor's space")?, kind))
}
