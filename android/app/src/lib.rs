//! The shared library that Android's `NativeActivity` loads. All it does is in `swell::host::android`.
#![cfg(target_os = "android")]

use android_activity::AndroidApp;

/// Called by android-activity on a thread of its own, once for each life of the activity.
// SAFETY: nothing else in the library has this name, and the signature is the one that android-activity calls.
#[unsafe(no_mangle)]
fn android_main(app: AndroidApp) {
    swell::host::android::main(&app);
}
