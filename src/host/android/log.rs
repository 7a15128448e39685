//! Logcat: what is logged, what goes to standard error, and panics.
//!
//! android-activity forwards standard output and error by a thread of its own, under the tag `RustStdoutStderr`. A panic is
//! written at once, since that thread may not live to do it.

use log::LevelFilter;
use std::backtrace::Backtrace;
use std::panic;
use std::sync::Once;
use std::thread;

/// What `adb logcat -s` is told to show.
const TAG: &str = "swell";

/// Begins to log, once in the life of the process, which may see several activities.
pub fn begin() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let config = android_logger::Config::default().with_tag(TAG).with_max_level(LevelFilter::Info);
        android_logger::init_once(config);
        panic::set_hook(Box::new(|panicked| {
            let thread = thread::current();
            log::error!("thread {}: {panicked}", thread.name().unwrap_or("without a name"));
            // A line each: logcat cuts what is longer than some four thousand bytes.
            for line in Backtrace::force_capture().to_string().lines() {
                log::error!("{line}");
            }
            // Where panics do not unwind, nobody gets to end in order: the process ends here, without a crash report.
            #[cfg(panic = "abort")]
            std::process::exit(101);
        }));
    });
}
