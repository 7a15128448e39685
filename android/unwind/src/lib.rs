//! `libunwind.a` for links without an NDK: the functions `_Unwind_*` that Rust's std calls, by the crate `unwinding`.
#![no_std]

extern crate unwinding;

/// Wanted by the compiler and never linked: in `libmain.so` there is std's.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
