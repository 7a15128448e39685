//! `XR_EXT_performance_settings`.

use crate::xr::XrError;
use crate::xr::error::{Doing, check};
use crate::xr::session::Session;
use openxr::sys;

/// Asks for clocks that can be held for hours, for the processor (the sea) and for the GPU. Returns whether the runtime listens.
///
/// # Errors
/// The session or the runtime has gone.
pub fn sustain(session: &Session) -> Result<bool, XrError> {
    let Some(settings) = &session.runtime.instance.exts().ext_performance_settings else { return Ok(false) };
    let level = sys::PerfSettingsLevelEXT::SUSTAINED_HIGH;
    for domain in [sys::PerfSettingsDomainEXT::CPU, sys::PerfSettingsDomainEXT::GPU] {
        // SAFETY: the session lives and the extension is enabled.
        check(unsafe { (settings.perf_settings_set_performance_level)(session.raw.as_raw(), domain, level) })
            .doing("asking for sustained clocks")?;
    }
    Ok(true)
}
