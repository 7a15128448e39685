//! What OpenXR's validation layer said.

use super::error::check;
use crate::gpu::Messages;
use openxr as xr;
use openxr::sys::{self, Handle as _};
use std::ffi::{CStr, c_void};
use std::sync::Arc;

/// Listens as long as it lives; it is dropped before the instance.
pub(super) struct Messenger {
    raw: sys::DebugUtilsMessengerEXT,
    instance: xr::Instance,
    messages: Arc<Messages>,
}

impl Messenger {
    /// Nothing where the extension is not enabled.
    pub fn new(instance: &xr::Instance) -> Option<Self> {
        let debug = instance.exts().ext_debug_utils.as_ref()?;
        let messages = Arc::<Messages>::default();
        use sys::{DebugUtilsMessageSeverityFlagsEXT as Severity, DebugUtilsMessageTypeFlagsEXT as Kind};
        let info = sys::DebugUtilsMessengerCreateInfoEXT {
            ty: sys::DebugUtilsMessengerCreateInfoEXT::TYPE,
            next: std::ptr::null(),
            message_severities: Severity::ERROR | Severity::WARNING,
            message_types: Kind::GENERAL | Kind::VALIDATION | Kind::PERFORMANCE | Kind::CONFORMANCE,
            user_callback: Some(receive),
            user_data: Arc::as_ptr(&messages).cast_mut().cast(),
        };
        let mut raw = sys::DebugUtilsMessengerEXT::NULL;
        // SAFETY: the instance lives; `messages` is kept until the messenger is destroyed.
        check(unsafe { (debug.create_debug_utils_messenger)(instance.as_raw(), &info, &mut raw) }).ok()?;
        Some(Self { raw, instance: instance.clone(), messages })
    }

    pub fn messages(&self) -> Arc<Messages> {
        Arc::clone(&self.messages)
    }
}

impl Drop for Messenger {
    fn drop(&mut self) {
        if let Some(debug) = &self.instance.exts().ext_debug_utils {
            // SAFETY: the messenger is ours and its instance lives.
            let _gone = unsafe { (debug.destroy_debug_utils_messenger)(self.raw) };
        }
    }
}

unsafe extern "system" fn receive(
    _severity: sys::DebugUtilsMessageSeverityFlagsEXT,
    _kind: sys::DebugUtilsMessageTypeFlagsEXT,
    data: *const sys::DebugUtilsMessengerCallbackDataEXT,
    user: *mut c_void,
) -> sys::Bool32 {
    // SAFETY: OpenXR passes valid callback data with a null-terminated message for the length of this call, and the user
    // pointer is the `Messages` given at creation, which outlives the messenger and is only ever shared.
    unsafe {
        let message = (*data).message;
        if !message.is_null() {
            (*user.cast::<Messages>()).hear(&CStr::from_ptr(message).to_string_lossy());
        }
    }
    false.into()
}
