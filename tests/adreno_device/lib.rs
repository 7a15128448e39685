//! A pretended "msm" device, Adreno's driver in Linux: enough of libdrm for Turnip to start, take memory and compile
//! pipelines. Nothing it is given to execute is executed, and every wait ends at once.
//!
//! Preloaded (`scripts/adreno`), so that its functions come before libdrm's in symbol lookup; what is not here stays
//! libdrm's. The calls are those of libdrm's public interface, the commands those of the kernel's `msm_drm.h`. A Rust
//! library, for then tests need no compiler and no header besides what builds Swell.
//!
//! The "device node" is a file in memory, named through /proc: opening it and mapping its memory need no pretence.
//! `SWELL_ADRENO_CHIP` is the chip's number, in hexadecimal.
#![allow(non_snake_case, missing_docs, reason = "libdrm's own names")]
mod commands;
mod memory;

use libc::{c_char, c_int, c_ulong, c_void};
use std::ptr;

/// `drmVersion`.
#[repr(C)]
pub struct Version {
    numbers: [c_int; 3],
    name_len: c_int,
    name: *const c_char,
    date_len: c_int,
    date: *const c_char,
    desc_len: c_int,
    desc: *const c_char,
}

/// `drmDevice`.
#[repr(C)]
pub struct Device {
    /// Names of the primary, control and render nodes.
    nodes: *const *const c_char,
    available: c_int,
    bus_type: c_int,
    bus: *const c_void,
    info: *const c_void,
}

/// Shared, and never changed once it is made.
struct Still<T>(T);
// SAFETY: see above.
unsafe impl<T> Sync for Still<T> {}

const RENDER_NODE: c_int = 1 << 2;
const PLATFORM_BUS: c_int = 2;
/// The platform bus's description: an empty name.
static BUS: [u8; 1024] = [0; 1024];
static VERSION: Still<Version> = Still(Version {
    numbers: [1, 12, 0],
    name_len: 3,
    name: c"msm".as_ptr(),
    date_len: 0,
    date: c"".as_ptr(),
    desc_len: 0,
    desc: c"".as_ptr(),
});

/// # Safety
/// `out` has room for `room` pointers, or is null: then only the number of devices is asked for.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn drmGetDevices2(_flags: u32, out: *mut *const Device, room: c_int) -> c_int {
    if out.is_null() || room < 1 {
        return c_int::from(out.is_null());
    }
    let Some(node) = memory::node() else { return -libc::ENODEV };
    // The names and the device live as long as the process, as few as there are.
    let nodes = Box::leak(Box::new([c"/none".as_ptr(), c"/none".as_ptr(), node.as_ptr()]));
    let bus = ptr::from_ref(&BUS).cast();
    let device =
        Device { nodes: nodes.as_ptr(), available: RENDER_NODE, bus_type: PLATFORM_BUS, bus, info: bus };
    // SAFETY: the caller's promise.
    unsafe { *out = Box::leak(Box::new(device)) };
    1
}

/// # Safety
/// `out` is where a pointer goes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn drmGetDevice2(_fd: c_int, flags: u32, out: *mut *const Device) -> c_int {
    // SAFETY: the caller's promise: room for one.
    if unsafe { drmGetDevices2(flags, out, 1) } == 1 { 0 } else { -libc::ENODEV }
}

#[unsafe(no_mangle)]
pub extern "C" fn drmFreeDevices(_devices: *mut *mut Device, _count: c_int) {}

#[unsafe(no_mangle)]
pub extern "C" fn drmFreeDevice(_device: *mut *mut Device) {}

#[unsafe(no_mangle)]
pub extern "C" fn drmDevicesEqual(_one: *const Device, _other: *const Device) -> c_int {
    1
}

#[unsafe(no_mangle)]
pub extern "C" fn drmGetVersion(_fd: c_int) -> *const Version {
    &VERSION.0
}

#[unsafe(no_mangle)]
pub extern "C" fn drmFreeVersion(_version: *mut Version) {}

/// # Safety
/// `value` is where a number goes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn drmGetCap(_fd: c_int, capability: u64, value: *mut u64) -> c_int {
    const SYNCOBJ: u64 = 0x13;
    const SYNCOBJ_TIMELINE: u64 = 0x14;
    // SAFETY: the caller's promise.
    unsafe { *value = u64::from(matches!(capability, SYNCOBJ | SYNCOBJ_TIMELINE)) };
    0
}

/// # Safety
/// `data` is what `command` takes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn drmCommandWriteRead(
    _fd: c_int,
    command: c_ulong,
    data: *mut c_void,
    _size: c_ulong,
) -> c_int {
    // SAFETY: the caller's promise.
    unsafe { commands::answer(command, data) }
}

/// # Safety
/// As [`drmCommandWriteRead`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn drmCommandWrite(
    _fd: c_int,
    command: c_ulong,
    data: *mut c_void,
    _size: c_ulong,
) -> c_int {
    // SAFETY: the caller's promise.
    unsafe { commands::answer(command, data) }
}

/// # Safety
/// `data` is what `request` takes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn drmIoctl(_fd: c_int, request: c_ulong, data: *mut c_void) -> c_int {
    /// Commands of a driver have numbers from here on; those below are for all drivers: handles closed, say.
    const OWN: c_ulong = 0x40;
    let Some(command) = (request & 0xff).checked_sub(OWN) else { return 0 };
    // SAFETY: the caller's promise.
    match unsafe { commands::answer(command, data) } {
        0 => 0,
        error => {
            // SAFETY: every thread has its own errno.
            unsafe { *libc::__errno_location() = -error };
            -1
        }
    }
}

/// # Safety
/// `handle` is where a number goes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn drmSyncobjCreate(_fd: c_int, _flags: u32, handle: *mut u32) -> c_int {
    // SAFETY: the caller's promise.
    unsafe { *handle = memory::number() };
    0
}

/// Functions that do nothing: whatever they are called with, registers hold it.
macro_rules! nothing {
    ($answer:expr => $($name:ident)*) => {
        $(#[unsafe(no_mangle)]
        pub extern "C" fn $name() -> c_int {
            $answer
        })*
    };
}
nothing!(0 => drmSyncobjDestroy drmSyncobjWait drmSyncobjReset drmSyncobjSignal drmSyncobjTimelineSignal
    drmSyncobjTimelineWait drmSyncobjTransfer drmSyncobjQuery2 drmSyncobjImportSyncFile drmSetMaster drmDropMaster);
nothing!(-libc::ENOSYS => drmSyncobjExportSyncFile drmSyncobjFDToHandle drmSyncobjHandleToFD drmPrimeFDToHandle
    drmPrimeHandleToFD);
