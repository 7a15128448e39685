//! Extensions that the runtime behind `runtime` lacks: `SWELL_PRETENDED` names them, commas between. Their functions
//! answer as the specification says, look closely at what they are given, and write it down in the layer's log. What is
//! wrong is written down as `wrong ...` and refused.
mod foveation;
mod hands;
mod performance;
mod refresh_rate;
mod space_warp;

use crate::runtime::real;
use crate::state::with;
use openxr::sys::{self, Handle as _, Result as Xr, pfn};
use std::collections::{BTreeMap, VecDeque};
use std::ffi::CStr;
use std::mem::transmute;
use std::sync::Mutex;

/// All that can be pretended.
const KNOWN: [&CStr; 8] = [
    c"XR_FB_space_warp",
    c"XR_EXT_performance_settings",
    c"XR_FB_foveation",
    c"XR_FB_foveation_configuration",
    c"XR_FB_foveation_vulkan",
    c"XR_FB_swapchain_update_state",
    c"XR_FB_display_refresh_rate",
    c"XR_EXT_hand_tracking",
];

/// What the extensions remember.
#[derive(Default)]
pub struct Pretended {
    /// What each swapchain was made as.
    swapchains: BTreeMap<u64, Made>,
    /// Frames that showed something.
    shown: u32,
    /// Changes of the refresh rate that the program does not know of, from and to.
    rates: VecDeque<[f32; 2]>,
    /// Hertz, once it was chosen.
    rate: Option<f32>,
    /// Handles given away.
    handles: u64,
    /// Foveation profiles that live.
    profiles: Vec<u64>,
    /// Hand trackers that live, and whether each is of the right hand.
    trackers: BTreeMap<u64, bool>,
}

#[derive(Clone, Copy)]
struct Made {
    size: [u32; 2],
    layers: u32,
    format: i64,
    usage: sys::SwapchainUsageFlags,
    /// An image was released since one was last shown.
    fresh: bool,
}

impl Pretended {
    /// A handle that nobody else has.
    fn handle(&mut self) -> u64 {
        self.handles += 1;
        0x5e11_0000 + self.handles
    }
}

static PRETENDED: Mutex<Option<Pretended>> = Mutex::new(None);

fn state<R>(use_it: impl FnOnce(&mut Pretended) -> R) -> R {
    use_it(PRETENDED.lock().expect("a call panicked before").get_or_insert_default())
}

fn say(line: &str) {
    with(|layer| layer.say(line));
}

/// Refuses what is not as it should be.
fn wrong(what: &str) -> Xr {
    say(&format!("wrong {what}"));
    Xr::ERROR_VALIDATION_FAILURE
}

/// The extensions asked for. A name that cannot be pretended ends the process.
pub fn names() -> impl Iterator<Item = &'static CStr> {
    let asked = std::env::var("SWELL_PRETENDED").unwrap_or_default();
    for name in asked.split(',').filter(|name| !name.is_empty()) {
        assert!(
            KNOWN.iter().any(|known| known.to_bytes() == name.as_bytes()),
            "SWELL_PRETENDED: {name} is none of {KNOWN:?}"
        );
    }
    KNOWN.into_iter().filter(move |known| asked.split(',').any(|name| name.as_bytes() == known.to_bytes()))
}

pub fn is_pretended(extension: &CStr) -> bool {
    names().any(|name| name == extension)
}

macro_rules! functions {
    ($name:ident: $($extension:literal { $($function:literal $type:ident $own:path,)* })*) => {
        $($(if $name == $function {
            let own: pfn::$type = $own;
            // SAFETY: whoever asks for this name calls it with this name's type.
            return is_pretended($extension).then(|| unsafe { transmute::<pfn::$type, pfn::VoidFunction>(own) });
        })*)*
    };
}

/// The function `name` of a pretended extension, or one that every runtime has and that they see first.
pub fn function(name: &CStr) -> Option<pfn::VoidFunction> {
    names().next()?;
    functions! { name:
        c"XR_FB_space_warp" {
            c"xrEndFrame" EndFrame space_warp::end_frame,
            c"xrCreateSwapchain" CreateSwapchain create_swapchain,
            c"xrReleaseSwapchainImage" ReleaseSwapchainImage release_swapchain_image,
        }
        c"XR_EXT_performance_settings" {
            c"xrPerfSettingsSetPerformanceLevelEXT" PerfSettingsSetPerformanceLevelEXT performance::set_level,
        }
        c"XR_FB_foveation" {
            c"xrCreateFoveationProfileFB" CreateFoveationProfileFB foveation::create_profile,
            c"xrDestroyFoveationProfileFB" DestroyFoveationProfileFB foveation::destroy_profile,
        }
        c"XR_FB_swapchain_update_state" {
            c"xrUpdateSwapchainFB" UpdateSwapchainFB foveation::update_swapchain,
            c"xrGetSwapchainStateFB" GetSwapchainStateFB foveation::get_swapchain_state,
        }
        c"XR_FB_display_refresh_rate" {
            c"xrEnumerateDisplayRefreshRatesFB" EnumerateDisplayRefreshRatesFB refresh_rate::enumerate,
            c"xrGetDisplayRefreshRateFB" GetDisplayRefreshRateFB refresh_rate::get,
            c"xrRequestDisplayRefreshRateFB" RequestDisplayRefreshRateFB refresh_rate::request,
            c"xrPollEvent" PollEvent refresh_rate::poll_event,
        }
        c"XR_EXT_hand_tracking" {
            c"xrCreateHandTrackerEXT" CreateHandTrackerEXT hands::create,
            c"xrDestroyHandTrackerEXT" DestroyHandTrackerEXT hands::destroy,
            c"xrLocateHandJointsEXT" LocateHandJointsEXT hands::locate,
        }
    }
    (name == c"xrGetSystemProperties").then(|| {
        let own: pfn::GetSystemProperties = get_system_properties;
        // SAFETY: as above.
        unsafe { transmute::<pfn::GetSystemProperties, pfn::VoidFunction>(own) }
    })
}

unsafe extern "system" fn get_system_properties(
    instance: sys::Instance,
    system: sys::SystemId,
    properties: *mut sys::SystemProperties,
) -> Xr {
    // SAFETY: the caller's arguments; whatever is chained begins with a type that says what it is.
    unsafe {
        let result = real::<pfn::GetSystemProperties>(c"xrGetSystemProperties")(instance, system, properties);
        let mut next = (*properties).next.cast::<sys::BaseOutStructure>();
        while !next.is_null() {
            if is_pretended(c"XR_FB_space_warp") {
                space_warp::tell(next);
            }
            if is_pretended(c"XR_EXT_hand_tracking") {
                hands::tell(next);
            }
            next = (*next).next;
        }
        result
    }
}

unsafe extern "system" fn create_swapchain(
    session: sys::Session,
    info: *const sys::SwapchainCreateInfo,
    swapchain: *mut sys::Swapchain,
) -> Xr {
    // SAFETY: the caller's arguments; on success there is a handle.
    unsafe {
        let result = real::<pfn::CreateSwapchain>(c"xrCreateSwapchain")(session, info, swapchain);
        if result == Xr::SUCCESS {
            let info = &*info;
            let made = Made {
                size: [info.width, info.height],
                layers: info.array_size,
                format: info.format,
                usage: info.usage_flags,
                fresh: false,
            };
            state(|pretended| pretended.swapchains.insert((*swapchain).into_raw(), made));
        }
        result
    }
}

unsafe extern "system" fn release_swapchain_image(
    swapchain: sys::Swapchain,
    info: *const sys::SwapchainImageReleaseInfo,
) -> Xr {
    // SAFETY: the caller's arguments.
    let result = unsafe { real::<pfn::ReleaseSwapchainImage>(c"xrReleaseSwapchainImage")(swapchain, info) };
    state(|pretended| {
        if let Some(made) = pretended.swapchains.get_mut(&swapchain.into_raw()) {
            made.fresh |= result == Xr::SUCCESS;
        }
    });
    result
}
