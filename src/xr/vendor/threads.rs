//! `XR_KHR_android_thread_settings`: Android's scheduler is told which threads make the frame.

use crate::xr::XrError;
use crate::xr::session::Session;

/// What a thread does for the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ThreadRole {
    /// Steps the sea.
    Worker,
    /// Records and submits.
    Renderer,
}

/// Tells the runtime what the thread with the kernel's number `thread` does. Returns whether it listens.
///
/// # Errors
/// The session or the runtime has gone.
#[cfg(target_os = "android")]
pub fn hint(session: &Session, role: ThreadRole, thread: u32) -> Result<bool, XrError> {
    use crate::xr::error::{Doing, check};
    use openxr::sys::AndroidThreadTypeKHR as Kind;

    let Some(settings) = &session.runtime.instance.exts().khr_android_thread_settings else {
        return Ok(false);
    };
    let kind = match role {
        ThreadRole::Worker => Kind::APPLICATION_WORKER,
        ThreadRole::Renderer => Kind::RENDERER_MAIN,
    };
    // SAFETY: the session lives and the extension is enabled.
    check(unsafe { (settings.set_android_application_thread)(session.raw.as_raw(), kind, thread) })
        .doing("naming a thread's work")?;
    Ok(true)
}

/// Tells the runtime what a thread does. Nobody listens here: the extension exists on Android alone.
///
/// # Errors
/// None.
#[cfg(not(target_os = "android"))]
pub fn hint(_session: &Session, _role: ThreadRole, _thread: u32) -> Result<bool, XrError> {
    Ok(false)
}
