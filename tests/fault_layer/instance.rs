//! How the loader finds the layer and makes an instance through it.
use crate::calls;
use crate::next::{self, Next};
use crate::state::with;
use openxr::sys::{self, pfn};
use std::ffi::{CStr, c_char, c_void};
use std::mem::{MaybeUninit, transmute};

/// The loader's first call: both sides say which version of their interface they speak.
///
/// # Safety
///
/// Called by an OpenXR loader, whose structures are valid.
#[unsafe(no_mangle)]
unsafe extern "system" fn xrNegotiateLoaderApiLayerInterface(
    loader: *const sys::NegotiateLoaderInfo,
    _name: *const c_char,
    request: *mut sys::NegotiateApiLayerRequest,
) -> sys::Result {
    stay_loaded();
    // SAFETY: the loader passes structures that live for the call.
    let (loader, request) = unsafe { (&*loader, &mut *request) };
    if loader.min_interface_version > 1 || loader.max_interface_version < 1 {
        return sys::Result::ERROR_INITIALIZATION_FAILED;
    }
    request.layer_interface_version = 1;
    request.layer_api_version = sys::Version::new(1, 0, 0);
    request.get_instance_proc_addr = Some(get_instance_proc_addr);
    request.create_api_layer_instance = Some(create_api_layer_instance);
    sys::Result::SUCCESS
}

/// A loader closes its layers with the instance, and the counters would begin anew with the next one.
pub fn stay_loaded() {
    let function = xrNegotiateLoaderApiLayerInterface as *const c_void;
    let mut place = MaybeUninit::<libc::Dl_info>::zeroed();
    // SAFETY: dladdr writes where it found the function; its file is loaded already, and is opened once more.
    let kept = unsafe {
        assert_ne!(libc::dladdr(function, place.as_mut_ptr()), 0, "this library has no file");
        libc::dlopen(place.assume_init().dli_fname, libc::RTLD_NOW | libc::RTLD_NODELETE)
    };
    assert!(!kept.is_null(), "this library cannot be kept loaded");
}

unsafe extern "system" fn create_api_layer_instance(
    info: *const sys::InstanceCreateInfo,
    layer: *const sys::ApiLayerCreateInfo,
    instance: *mut sys::Instance,
) -> sys::Result {
    // SAFETY: the loader passes a list of at least this layer, and space for the handle; the list without its first
    // element is what the next one is to get.
    let result = unsafe {
        let own = &*(*layer).next_info;
        let mut rest = *layer;
        rest.next_info = own.next;
        match (own.next_create_api_layer_instance, own.next_get_instance_proc_addr) {
            (Some(create), Some(get)) => match create(info, &rest, instance) {
                sys::Result::SUCCESS => Next::load(get, *instance).map(|next| (*instance, next)),
                error => Err(error),
            },
            _ => Err(sys::Result::ERROR_INITIALIZATION_FAILED),
        }
    };
    with(|layer| {
        let call = layer.count("create_instance");
        let (result, made) = match result {
            Ok(made) => (sys::Result::SUCCESS, Some(made)),
            Err(error) => (error, None),
        };
        layer.say_call(&format!("create_instance {call}"), result);
        if let Some((instance, next)) = made {
            layer.instance_made(instance, next);
        }
        result
    })
}

unsafe extern "system" fn get_instance_proc_addr(
    instance: sys::Instance,
    name: *const c_char,
    function: *mut Option<pfn::VoidFunction>,
) -> sys::Result {
    // SAFETY: a name is a C string, and there is space for the pointer; a function found under a name has its type.
    unsafe {
        if let Some(own) = next::own(CStr::from_ptr(name)) {
            *function = Some(own);
            return sys::Result::SUCCESS;
        }
        let get = with(|layer| layer.next()).get_instance_proc_addr;
        let result = get(instance, name, function);
        // Of an extension: only where it is there.
        if result == sys::Result::SUCCESS && CStr::from_ptr(name) == c"xrGetVisibilityMaskKHR" {
            let below = transmute::<Option<pfn::VoidFunction>, Option<pfn::GetVisibilityMaskKHR>>(*function);
            with(|layer| layer.visibility_mask = below);
            let own: pfn::GetVisibilityMaskKHR = calls::get_visibility_mask;
            *function = Some(transmute::<pfn::GetVisibilityMaskKHR, pfn::VoidFunction>(own));
        }
        result
    }
}
