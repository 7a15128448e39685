//! `XR_FB_foveation`, `_configuration` and `_vulkan`: the runtime makes fragment density maps, coarse at the rim of the view.

use crate::gpu::Device;
use crate::xr::XrError;
use crate::xr::error::{Doing, check};
use crate::xr::runtime::Runtime;
use crate::xr::session::Session;
use crate::xr::swapchain::Swapchain;
use openxr::{self as xr, sys};

/// How coarse the rim may be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FoveationLevel {
    /// As fine as the middle.
    Off,
    /// A little.
    Low,
    /// More.
    Medium,
    /// Most; lower levels while the GPU has time.
    #[default]
    High,
}

/// A profile, applied to swapchains.
pub struct Foveation(xr::FoveationProfileFB);

impl Foveation {
    /// Whether runtime and device can: all four extensions, and `VK_EXT_fragment_density_map`.
    pub fn is_offered(runtime: &Runtime, device: &Device) -> bool {
        let found = &runtime.extensions;
        found.fb_swapchain_update_state
            && found.fb_foveation
            && found.fb_foveation_configuration
            && found.fb_foveation_vulkan
            && device.density_maps
    }

    /// Makes the profile of `level`.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn new(session: &Session, level: FoveationLevel) -> Result<Self, XrError> {
        let (level, dynamic) = match level {
            FoveationLevel::Off => (xr::FoveationLevelFB::NONE, xr::FoveationDynamicFB::DISABLED),
            FoveationLevel::Low => (xr::FoveationLevelFB::LOW, xr::FoveationDynamicFB::DISABLED),
            FoveationLevel::Medium => (xr::FoveationLevelFB::MEDIUM, xr::FoveationDynamicFB::DISABLED),
            FoveationLevel::High => (xr::FoveationLevelFB::HIGH, xr::FoveationDynamicFB::LEVEL_ENABLED),
        };
        let profile = xr::FoveationLevelProfile { level, vertical_offset: 0.0, dynamic };
        let profile =
            session.raw.create_foveation_profile(Some(profile)).doing("making a foveation profile")?;
        Ok(Self(profile))
    }

    /// Draws `swapchain`'s images so from now on.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn apply(&self, session: &Session, swapchain: &Swapchain) -> Result<(), XrError> {
        let Some(update) = &session.runtime.instance.exts().fb_swapchain_update_state else { return Ok(()) };
        let state = sys::SwapchainStateFoveationFB {
            ty: sys::SwapchainStateFoveationFB::TYPE,
            next: std::ptr::null_mut(),
            flags: sys::SwapchainStateFoveationFlagsFB::EMPTY,
            profile: self.0.as_raw(),
        };
        // SAFETY: the swapchain and the profile live, and the extension is enabled; the state is one of the structures that
        // the function takes by their common header.
        check(unsafe { (update.update_swapchain)(swapchain.handle(), std::ptr::from_ref(&state).cast()) })
            .doing("applying a foveation profile")
            .map(|_| ())
    }
}
