//! The driver's commands, as `msm_drm.h` has them.
use crate::memory;
use libc::{c_int, c_ulong, c_void};

const GET_PARAM: c_ulong = 0;
const SET_PARAM: c_ulong = 1;
const GEM_NEW: c_ulong = 2;
const GEM_INFO: c_ulong = 3;
const GEM_SUBMIT: c_ulong = 6;
const GEM_MADVISE: c_ulong = 8;
const SUBMITQUEUE_NEW: c_ulong = 10;

#[repr(C)]
struct Param {
    pipe: u32,
    param: u32,
    value: u64,
}

#[repr(C)]
struct New {
    size: u64,
    flags: u32,
    handle: u32,
}

#[repr(C)]
struct Info {
    handle: u32,
    info: u32,
    value: u64,
}

#[repr(C)]
struct Submit {
    flags: u32,
    fence: u32,
}

/// Of `MADVISE` and `SUBMITQUEUE_NEW`: the third word is the answer.
#[repr(C)]
struct Third {
    given: [u32; 2],
    answer: u32,
}

/// Carries out `command`: 0, or an error's number below it.
///
/// # Safety
/// `data` is the command's own structure, or what it may be where the command is not known here.
pub unsafe fn answer(command: c_ulong, data: *mut c_void) -> c_int {
    // SAFETY: the caller's promise: each structure is the head of the command's own.
    unsafe {
        match command {
            GET_PARAM => {
                let asked = &mut *data.cast::<Param>();
                let Some(value) = parameter(asked.param) else { return -libc::EINVAL };
                asked.value = value;
            }
            // Among what could be set is that the program binds addresses itself, which is not offered.
            SET_PARAM => return -libc::EINVAL,
            GEM_NEW => {
                let asked = &mut *data.cast::<New>();
                let Some(handle) = memory::take(asked.size) else { return -libc::ENOMEM };
                asked.handle = handle;
            }
            GEM_INFO => {
                let asked = &mut *data.cast::<Info>();
                match asked.info {
                    0 => asked.value = memory::offset(asked.handle),
                    1 => asked.value = memory::address(asked.handle),
                    _ => {}
                }
            }
            GEM_SUBMIT => (*data.cast::<Submit>()).fence = memory::number(),
            GEM_MADVISE => (*data.cast::<Third>()).answer = 1,
            SUBMITQUEUE_NEW => (*data.cast::<Third>()).answer = memory::number(),
            _ => {}
        }
    }
    0
}

/// What the chip is said to be. Adreno 6xx and later give their chip's number; its first byte is the generation, 6 in the
/// 650's, and 0x43 in the 740's.
fn parameter(number: u32) -> Option<u64> {
    let chip = std::env::var("SWELL_ADRENO_CHIP").ok()?;
    let chip = u64::from_str_radix(chip.strip_prefix("0x")?, 16).ok()?;
    let old = chip >> 24 == 6;
    Some(match number {
        // The name as a number, of those that still had one.
        0x01 => {
            if old {
                650
            } else {
                0
            }
        }
        // Memory for tiles, bytes: 1.125 MiB and 3 MiB.
        0x02 => {
            if old {
                9 << 17
            } else {
                3 << 20
            }
        }
        0x03 => chip,
        // Hertz.
        0x04 => 600_000_000,
        // Time stamp; where memory for tiles begins; faults; suspensions.
        0x05 | 0x06 | 0x09 | 0x0a => 0,
        // Priorities.
        0x07 => 3,
        // Addresses: where they begin, and how many.
        0x0e => 1 << 32,
        0x0f => 1 << 38,
        // How memory is laid out: highest bank bit, swizzle of compressed images, kind of macrotile.
        0x10 => 16,
        0x12 => 6,
        0x13 => 1,
        // Whether rays are traced in hardware.
        0x11 => u64::from(!old),
        _ => return None,
    })
}
