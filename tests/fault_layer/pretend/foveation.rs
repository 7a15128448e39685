//! `XR_FB_foveation`, `XR_FB_foveation_configuration`, `XR_FB_swapchain_update_state`: profiles that nothing comes of.
use super::{say, state, wrong};
use openxr::sys::{self, Handle as _, Result as Xr};

pub unsafe extern "system" fn create_profile(
    _session: sys::Session,
    info: *const sys::FoveationProfileCreateInfoFB,
    profile: *mut sys::FoveationProfileFB,
) -> Xr {
    // SAFETY: the caller's structures; the type of what is chained says what it is.
    unsafe {
        let level = (*info).next.cast::<sys::FoveationLevelProfileCreateInfoFB>();
        if level.is_null() || (*level).ty != sys::FoveationLevelProfileCreateInfoFB::TYPE {
            return wrong("foveation profile: no level");
        }
        let sys::FoveationLevelProfileCreateInfoFB { level, vertical_offset, dynamic, .. } = *level;
        say(&format!("create_foveation_profile {level:?} offset={vertical_offset} dynamic={dynamic:?}"));
        *profile = sys::FoveationProfileFB::from_raw(state(|pretended| {
            let handle = pretended.handle();
            pretended.profiles.push(handle);
            handle
        }));
    }
    Xr::SUCCESS
}

pub unsafe extern "system" fn destroy_profile(profile: sys::FoveationProfileFB) -> Xr {
    say("destroy_foveation_profile");
    state(|pretended| pretended.profiles.retain(|&known| known != profile.into_raw()));
    Xr::SUCCESS
}

pub unsafe extern "system" fn update_swapchain(
    swapchain: sys::Swapchain,
    new: *const sys::SwapchainStateBaseHeaderFB,
) -> Xr {
    // SAFETY: the caller's structure, whose type says what it is.
    let profile = unsafe {
        if (*new).ty != sys::SwapchainStateFoveationFB::TYPE {
            return wrong("swapchain state: not foveation's");
        }
        let new = &*new.cast::<sys::SwapchainStateFoveationFB>();
        if new.flags != sys::SwapchainStateFoveationFlagsFB::EMPTY {
            return wrong("swapchain state: flags that nobody has defined");
        }
        new.profile
    };
    if swapchain == sys::Swapchain::NULL
        || !state(|pretended| pretended.profiles.contains(&profile.into_raw()))
    {
        return wrong("swapchain state: no swapchain or no profile");
    }
    say("update_swapchain foveation");
    Xr::SUCCESS
}

pub unsafe extern "system" fn get_swapchain_state(
    _swapchain: sys::Swapchain,
    _state: *mut sys::SwapchainStateBaseHeaderFB,
) -> Xr {
    Xr::ERROR_FEATURE_UNSUPPORTED
}
