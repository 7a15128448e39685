//! What the validation layers said, kept for whoever must fail because of it.

use ash::{ext, vk};
use std::ffi::{CStr, c_void};
use std::io::Write as _;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Messages of the validation layers, in order of arrival.
#[derive(Default)]
pub struct Messages(Mutex<Vec<String>>);

impl Messages {
    fn list(&self) -> MutexGuard<'_, Vec<String>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// One message more. A closed standard error must not end in a panic: the caller is a driver.
    pub(crate) fn hear(&self, text: &str) {
        let _closed = writeln!(std::io::stderr(), "validation: {text}");
        self.list().push(text.to_owned());
    }

    /// All messages so far.
    pub fn all(&self) -> Vec<String> {
        self.list().clone()
    }
}

/// The one message that is about how the loader was set up and not about Swell: the scripts switch implicit layers off.
const ABOUT_THE_LOADER: &str = "VK_LOADER_LAYERS_DISABLE";

/// Severities and kinds that count.
pub(super) fn messenger_info(messages: &Messages) -> vk::DebugUtilsMessengerCreateInfoEXT<'static> {
    vk::DebugUtilsMessengerCreateInfoEXT::default()
        .message_severity(
            vk::DebugUtilsMessageSeverityFlagsEXT::ERROR | vk::DebugUtilsMessageSeverityFlagsEXT::WARNING,
        )
        .message_type(
            vk::DebugUtilsMessageTypeFlagsEXT::GENERAL
                | vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION
                | vk::DebugUtilsMessageTypeFlagsEXT::PERFORMANCE,
        )
        .pfn_user_callback(Some(receive))
        .user_data(std::ptr::from_ref(messages).cast_mut().cast())
}

/// Creates the messenger on a finished instance.
pub(super) fn listen(
    debug: &ext::debug_utils::Instance,
    messages: &Messages,
) -> Result<vk::DebugUtilsMessengerEXT, vk::Result> {
    // SAFETY: the instance lives; the instance's owner shares `messages`, which so outlives the messenger.
    unsafe { debug.create_debug_utils_messenger(&messenger_info(messages), None) }
}

unsafe extern "system" fn receive(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kind: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: Vulkan passes valid callback data with a null-terminated message for the length of this call, and the
    // user pointer is the `Messages` given at creation, which outlives the messenger and is only ever shared.
    let (text, messages) = unsafe {
        let message = (*data).p_message;
        if message.is_null() {
            return vk::FALSE;
        }
        (CStr::from_ptr(message).to_string_lossy(), &*user.cast::<Messages>())
    };
    if !text.contains(ABOUT_THE_LOADER) {
        messages.hear(&text);
    }
    vk::FALSE
}
