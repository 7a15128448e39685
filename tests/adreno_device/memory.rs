//! The device's memory: one file of 16 GiB in memory, of which what is never written takes none.
use std::ffi::{CStr, CString};
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};
use std::sync::{Mutex, OnceLock, PoisonError};

const BYTES: u64 = 1 << 34;
/// More than a page of any machine.
const ALIGNMENT: u64 = 1 << 16;
/// Of the GPU.
const FIRST_ADDRESS: u64 = 1 << 33;

/// Where the next buffer begins, and where each one does; the handle is its number, from 1 on.
static TAKEN: Mutex<(u64, Vec<u64>)> = Mutex::new((ALIGNMENT, Vec::new()));

/// The device node's name.
pub fn node() -> Option<&'static CStr> {
    static NODE: OnceLock<Option<CString>> = OnceLock::new();
    let make = || {
        // SAFETY: the name is a string; a file that cannot be made is told by a number below 0.
        let file = unsafe { libc::memfd_create(c"msm".as_ptr(), libc::MFD_CLOEXEC) };
        // SAFETY: the file is ours.
        (file >= 0 && unsafe { libc::ftruncate(file, BYTES.cast_signed()) } == 0)
            .then(|| CString::new(format!("/proc/self/fd/{file}")).ok())?
    };
    NODE.get_or_init(make).as_deref()
}

/// A buffer's handle, or none where there is no more room.
pub fn take(size: u64) -> Option<u32> {
    let mut taken = TAKEN.lock().unwrap_or_else(PoisonError::into_inner);
    let begin = taken.0;
    let end = begin.checked_add(size)?.checked_next_multiple_of(ALIGNMENT)?;
    if end > BYTES {
        return None;
    }
    taken.0 = end;
    taken.1.push(begin);
    u32::try_from(taken.1.len()).ok()
}

/// Where buffer `handle` is in the file.
pub fn offset(handle: u32) -> u64 {
    let taken = TAKEN.lock().unwrap_or_else(PoisonError::into_inner);
    (handle as usize).checked_sub(1).and_then(|index| taken.1.get(index)).copied().unwrap_or(0)
}

/// Where the GPU would see it.
pub fn address(handle: u32) -> u64 {
    FIRST_ADDRESS + offset(handle)
}

/// A number that was not given before: fences, queues, synchronization objects.
pub fn number() -> u32 {
    static LAST: AtomicU32 = AtomicU32::new(0);
    LAST.fetch_add(1, Relaxed) + 1
}
