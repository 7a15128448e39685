//! The functions below this layer, and which of them it stands before.
use crate::calls;
use openxr::sys::{self, pfn};
use std::ffi::CStr;
use std::mem::transmute;

macro_rules! functions {
    (before { $($field:ident: $type:ident = $name:literal,)* } only { $($plain:ident: $plain_type:ident = $plain_name:literal,)* }) => {
        /// What the next layer, or the runtime, offers.
        #[derive(Clone, Copy)]
        pub struct Next {
            pub get_instance_proc_addr: pfn::GetInstanceProcAddr,
            $(pub $field: pfn::$type,)*
            $(pub $plain: pfn::$plain_type,)*
        }

        impl Next {
            /// Looks every function up.
            ///
            /// # Safety
            ///
            /// `get` is a conforming `xrGetInstanceProcAddr`, `instance` lives.
            pub unsafe fn load(get: pfn::GetInstanceProcAddr, instance: sys::Instance) -> Result<Self, sys::Result> {
                // SAFETY: the caller's promise; a function found under a name has this name's type.
                unsafe {
                    Ok(Self {
                        get_instance_proc_addr: get,
                        $($field: transmute::<pfn::VoidFunction, pfn::$type>(look_up(get, instance, $name)?),)*
                        $($plain: transmute::<pfn::VoidFunction, pfn::$plain_type>(look_up(get, instance, $plain_name)?),)*
                    })
                }
            }
        }

        /// This layer's function of that name.
        pub fn own(name: &CStr) -> Option<pfn::VoidFunction> {
            $(if name == $name {
                // SAFETY: whoever asks for this name calls it with this name's type.
                return Some(unsafe { transmute::<pfn::$type, pfn::VoidFunction>(calls::$field) });
            })*
            None
        }
    };
}

functions! {
    before {
        destroy_instance: DestroyInstance = c"xrDestroyInstance",
        get_system: GetSystem = c"xrGetSystem",
        poll_event: PollEvent = c"xrPollEvent",
        create_session: CreateSession = c"xrCreateSession",
        destroy_session: DestroySession = c"xrDestroySession",
        begin_session: BeginSession = c"xrBeginSession",
        end_session: EndSession = c"xrEndSession",
        request_exit_session: RequestExitSession = c"xrRequestExitSession",
        create_swapchain: CreateSwapchain = c"xrCreateSwapchain",
        destroy_swapchain: DestroySwapchain = c"xrDestroySwapchain",
        acquire_swapchain_image: AcquireSwapchainImage = c"xrAcquireSwapchainImage",
        wait_swapchain_image: WaitSwapchainImage = c"xrWaitSwapchainImage",
        release_swapchain_image: ReleaseSwapchainImage = c"xrReleaseSwapchainImage",
        wait_frame: WaitFrame = c"xrWaitFrame",
        begin_frame: BeginFrame = c"xrBeginFrame",
        end_frame: EndFrame = c"xrEndFrame",
        locate_views: LocateViews = c"xrLocateViews",
        sync_actions: SyncActions = c"xrSyncActions",
        apply_haptic_feedback: ApplyHapticFeedback = c"xrApplyHapticFeedback",
    }
    only {
        path_to_string: PathToString = c"xrPathToString",
    }
}

unsafe fn look_up(
    get: pfn::GetInstanceProcAddr,
    instance: sys::Instance,
    name: &CStr,
) -> Result<pfn::VoidFunction, sys::Result> {
    let mut function = None;
    // SAFETY: the caller's promise.
    let result = unsafe { get(instance, name.as_ptr(), &mut function) };
    function.ok_or(if result == sys::Result::SUCCESS { sys::Result::ERROR_RUNTIME_FAILURE } else { result })
}
