//! `XR_EXT_performance_settings`.
use super::say;
use openxr::sys::{self, Result as Xr};

pub unsafe extern "system" fn set_level(
    _session: sys::Session,
    domain: sys::PerfSettingsDomainEXT,
    level: sys::PerfSettingsLevelEXT,
) -> Xr {
    say(&format!("performance {domain:?} {level:?}"));
    Xr::SUCCESS
}
