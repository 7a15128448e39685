//! How much of the processor this process has used.

use std::time::Duration;

/// User and system time of all threads since the process began; `None` where the system does not tell.
#[cfg(unix)]
pub fn cpu_time() -> Option<[Duration; 2]> {
    use nix::sys::resource::{UsageWho, getrusage};
    let usage = getrusage(UsageWho::RUSAGE_SELF).ok()?;
    Some([usage.user_time(), usage.system_time()].map(|time| {
        let whole = Duration::from_secs(u64::try_from(time.tv_sec()).unwrap_or(0));
        whole + Duration::from_micros(u64::try_from(time.tv_usec()).unwrap_or(0))
    }))
}

/// User and system time of all threads since the process began; `None` where the system does not tell.
#[cfg(not(unix))]
pub fn cpu_time() -> Option<[Duration; 2]> {
    None
}
