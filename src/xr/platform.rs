//! What the OpenXR loader has to know before anything else: on Android the Java machine and the activity.

use openxr as xr;

/// Where a runtime is looked for.
#[cfg(not(target_os = "android"))]
#[derive(Clone, Copy, Debug, Default)]
pub struct Platform;

#[cfg(not(target_os = "android"))]
impl Platform {
    pub(super) fn info(self) -> impl xr::PlatformInfo {}
}

/// Where a runtime is looked for: the activity whose life the session follows.
#[cfg(target_os = "android")]
#[derive(Clone, Copy, Debug)]
pub struct Platform {
    vm: *mut std::ffi::c_void,
    activity: *mut std::ffi::c_void,
}

#[cfg(target_os = "android")]
impl Platform {
    /// The platform of an activity.
    ///
    /// # Safety
    /// `vm` is the `JavaVM` and `activity` a global reference to the `android.app.Activity` (not to the application, which
    /// `ndk_context` has); both are valid for as long as this and every runtime found with it.
    pub const unsafe fn new(vm: *mut std::ffi::c_void, activity: *mut std::ffi::c_void) -> Self {
        Self { vm, activity }
    }

    pub(super) fn info(self) -> impl xr::PlatformInfo {
        // SAFETY: whoever made this promised both.
        unsafe { xr::AndroidPlatformInfo::new(self.vm, self.activity) }
    }
}
