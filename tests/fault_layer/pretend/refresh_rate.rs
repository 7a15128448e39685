//! `XR_FB_display_refresh_rate`: a display of four rates, at the lowest until it is told otherwise.
use super::{say, state};
use crate::events;
use crate::runtime::real;
use openxr::sys::{self, Result as Xr, pfn};
use std::ptr;

const RATES: [f32; 4] = [72.0, 80.0, 90.0, 120.0];

pub unsafe extern "system" fn enumerate(
    _session: sys::Session,
    capacity: u32,
    count: *mut u32,
    rates: *mut f32,
) -> Xr {
    // SAFETY: the caller's array has space for the capacity.
    unsafe {
        *count = RATES.len() as u32;
        if capacity == 0 {
            return Xr::SUCCESS;
        }
        if capacity < *count {
            return Xr::ERROR_SIZE_INSUFFICIENT;
        }
        ptr::copy_nonoverlapping(RATES.as_ptr(), rates, RATES.len());
    }
    Xr::SUCCESS
}

pub unsafe extern "system" fn get(_session: sys::Session, rate: *mut f32) -> Xr {
    // SAFETY: the caller's space for a number.
    unsafe { *rate = state(|pretended| pretended.rate).unwrap_or(RATES[0]) };
    Xr::SUCCESS
}

pub unsafe extern "system" fn request(_session: sys::Session, rate: f32) -> Xr {
    say(&format!("request_refresh_rate {rate}"));
    if !RATES.contains(&rate) {
        return Xr::ERROR_DISPLAY_REFRESH_RATE_UNSUPPORTED_FB;
    }
    state(|pretended| {
        let before = pretended.rate.replace(rate).unwrap_or(RATES[0]);
        if before != rate {
            pretended.rates.push_back([before, rate]);
        }
    });
    Xr::SUCCESS
}

pub unsafe extern "system" fn poll_event(instance: sys::Instance, buffer: *mut sys::EventDataBuffer) -> Xr {
    let Some([from, to]) = state(|pretended| pretended.rates.pop_front()) else {
        // SAFETY: the caller's arguments.
        return unsafe { real::<pfn::PollEvent>(c"xrPollEvent")(instance, buffer) };
    };
    say(&format!("refresh_rate_changed {from} {to}"));
    let event = sys::EventDataDisplayRefreshRateChangedFB {
        ty: sys::EventDataDisplayRefreshRateChangedFB::TYPE,
        next: ptr::null(),
        from_display_refresh_rate: from,
        to_display_refresh_rate: to,
    };
    // SAFETY: the caller's buffer has space for any event.
    unsafe { events::write(buffer, event) };
    Xr::SUCCESS
}
