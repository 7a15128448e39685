//! Waiting for a runtime and a headset that are not there yet, or not any more.

use super::{Guest, HeadsetSettings, REST};
use crate::gpu::GpuError;
use crate::host::HostError;
use crate::xr::{Runtime, XrError};
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

/// How long between two looks for a runtime that is not there: twice as long each time, since a runtime's client library may
/// complain of each look at length.
const PAUSES: [Duration; 2] = [Duration::from_millis(250), Duration::from_secs(2)];

/// Looks for something that is not there yet.
pub struct Patience {
    pause: Duration,
    told: String,
}

impl Default for Patience {
    fn default() -> Self {
        Self { pause: PAUSES[0], told: String::new() }
    }
}

impl Patience {
    /// Says what is waited for, once for each reason, and waits before the next look; `false` where `guest` would not wait
    /// longer.
    pub fn wait(&mut self, reason: &XrError, guest: &mut dyn Guest) -> bool {
        let what = reason.what();
        if self.told != what {
            eprintln!("{what}; waiting");
            self.told = what;
        }
        let begun = Instant::now();
        while begun.elapsed() < self.pause {
            if !guest.goes_on() {
                return false;
            }
            thread::sleep(REST);
        }
        self.pause = PAUSES[1].min(2 * self.pause);
        true
    }
}

/// A runtime with a headset; nothing where the guest would not wait longer.
///
/// # Errors
/// There is none, and that is not to be waited for.
pub fn find_runtime(
    settings: &HeadsetSettings,
    guest: &mut dyn Guest,
    patience: &mut Patience,
) -> Result<Option<Arc<Runtime>>, HostError> {
    loop {
        match Runtime::new(settings.platform, settings.validation) {
            Err(error) if settings.wait && error.may_pass() => {
                if !patience.wait(&error, guest) {
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
