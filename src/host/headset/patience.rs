//! Waiting for a runtime and a headset that are not there yet, or not any more.

use super::{Guest, HeadsetSettings, REST};
use crate::gpu::GpuError;
use crate::host::HostError;
use crate::xr::{Runtime, XrError};
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

/// How long between two looks for a runtime that is not there.
pub const RETRY: Duration = Duration::from_millis(500);

/// Waits before the next look for what is not there; `false` where `guest` would not wait longer.
pub fn rest(guest: &mut dyn Guest) -> bool {
    let begun = Instant::now();
    while begun.elapsed() < RETRY {
        if !guest.goes_on() {
            return false;
        }
        thread::sleep(REST);
    }
    true
}

/// A runtime with a headset; nothing where the guest would not wait longer.
///
/// # Errors
/// There is none, and that is not to be waited for.
pub fn find_runtime(
    settings: &HeadsetSettings,
    guest: &mut dyn Guest,
) -> Result<Option<Arc<Runtime>>, HostError> {
    let mut told = None;
    loop {
        match Runtime::new(settings.validation) {
            Err(error) if settings.wait && error.may_pass() => {
                // Once, and again where it is another reason: the runtime came, and the headset is not there.
                let what = error.what();
                if told.as_ref() != Some(&what) {
                    eprintln!("{what}; waiting");
                    told = Some(what);
                }
                if !rest(guest) {
                    return Ok(None);
                }
            }
            other => return Ok(Some(other?)),
        }
    }
}

/// A runtime that goes while it opens Vulkan is one that has gone.
pub fn gone(error: GpuError) -> HostError {
    match error {
        GpuError::Runtime { doing, gone: true, .. } => XrError::InstanceLost { doing }.into(),
        error => error.into(),
    }
}
