//! The same library as a runtime: another one, named by `SWELL_RUNTIME`, without the extensions that `SWELL_HIDDEN` names
//! (commas between), and with those of `pretend`. A layer cannot do this: loaders ask runtimes for extensions past all
//! layers.
use crate::instance::stay_loaded;
use crate::pretend;
use openxr::sys::{self, Handle as _, Result as Xr, pfn};
use std::ffi::{CStr, CString, c_char, c_void};
use std::mem::transmute;
use std::ptr;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

/// The other runtime's.
static REAL: OnceLock<pfn::GetInstanceProcAddr> = OnceLock::new();
/// The instance made last, or 0.
static INSTANCE: AtomicU64 = AtomicU64::new(0);

/// # Safety
///
/// Called by an OpenXR loader, whose structures are valid.
#[unsafe(no_mangle)]
unsafe extern "system" fn xrNegotiateLoaderRuntimeInterface(
    loader: *const sys::NegotiateLoaderInfo,
    request: *mut sys::NegotiateRuntimeRequest,
) -> Xr {
    stay_loaded();
    let name = CString::new(std::env::var("SWELL_RUNTIME").expect("SWELL_RUNTIME")).expect("SWELL_RUNTIME");
    // SAFETY: the library is a runtime, whose function of this name has this type; it is passed what the loader passed.
    unsafe {
        let library = libc::dlopen(name.as_ptr(), libc::RTLD_NOW);
        assert!(!library.is_null(), "no library {name:?}");
        let negotiate = libc::dlsym(library, c"xrNegotiateLoaderRuntimeInterface".as_ptr());
        assert!(!negotiate.is_null(), "{name:?} is no runtime");
        let negotiate = transmute::<*mut c_void, pfn::NegotiateLoaderRuntimeInterface>(negotiate);
        let result = negotiate(loader, request);
        if let (Xr::SUCCESS, Some(get)) = (result, (*request).get_instance_proc_addr) {
            REAL.get_or_init(|| get);
            (*request).get_instance_proc_addr = Some(get_instance_proc_addr);
        }
        result
    }
}

fn is_hidden(extension: &CStr) -> bool {
    let hidden = std::env::var("SWELL_HIDDEN").unwrap_or_default();
    hidden.split(',').any(|name| name.as_bytes() == extension.to_bytes())
}

unsafe extern "system" fn get_instance_proc_addr(
    instance: sys::Instance,
    name: *const c_char,
    function: *mut Option<pfn::VoidFunction>,
) -> Xr {
    let real = REAL.get().expect("the loader did not negotiate");
    // SAFETY: the caller's arguments, passed on; ours have the types their names promise.
    unsafe {
        if let Some(own) = pretend::function(CStr::from_ptr(name)) {
            *function = Some(own);
            return Xr::SUCCESS;
        }
        let result = real(instance, name, function);
        if result == Xr::SUCCESS {
            let name = CStr::from_ptr(name);
            if name == c"xrEnumerateInstanceExtensionProperties" {
                let own: pfn::EnumerateInstanceExtensionProperties = enumerate_extensions;
                *function =
                    Some(transmute::<pfn::EnumerateInstanceExtensionProperties, pfn::VoidFunction>(own));
            } else if name == c"xrCreateInstance" {
                let own: pfn::CreateInstance = create_instance;
                *function = Some(transmute::<pfn::CreateInstance, pfn::VoidFunction>(own));
            }
        }
        result
    }
}

/// The other runtime's function.
///
/// # Safety
///
/// `F` is the type of the function `name`.
pub unsafe fn real<F: Copy>(name: &CStr) -> F {
    let mut function: Option<pfn::VoidFunction> = None;
    let get = REAL.get().expect("the loader did not negotiate");
    let global = name == c"xrEnumerateInstanceExtensionProperties" || name == c"xrCreateInstance";
    let instance = sys::Instance::from_raw(if global { 0 } else { INSTANCE.load(Ordering::Acquire) });
    // SAFETY: the function is there without an instance, or is asked for with one; the caller's promise.
    unsafe {
        get(instance, name.as_ptr(), &mut function);
        std::mem::transmute_copy::<pfn::VoidFunction, F>(
            &function.expect("a function that every runtime has"),
        )
    }
}

unsafe extern "system" fn enumerate_extensions(
    layer: *const c_char,
    capacity: u32,
    count: *mut u32,
    properties: *mut sys::ExtensionProperties,
) -> Xr {
    // SAFETY: the other runtime is asked twice, as is usual; no more than the capacity is written to the caller.
    unsafe {
        let ask =
            real::<pfn::EnumerateInstanceExtensionProperties>(c"xrEnumerateInstanceExtensionProperties");
        let mut all = 0;
        let result = ask(layer, 0, &mut all, ptr::null_mut());
        if result != Xr::SUCCESS {
            return result;
        }
        let blank = sys::ExtensionProperties {
            ty: sys::ExtensionProperties::TYPE,
            next: ptr::null_mut(),
            extension_name: [0; sys::MAX_EXTENSION_NAME_SIZE],
            extension_version: 0,
        };
        let mut known = vec![blank; all as usize];
        let result = ask(layer, all, &mut all, known.as_mut_ptr());
        if result != Xr::SUCCESS {
            return result;
        }
        known.retain(|known| !is_hidden(CStr::from_ptr(known.extension_name.as_ptr())));
        for own in pretend::names() {
            if known.iter().all(|known| CStr::from_ptr(known.extension_name.as_ptr()) != own) {
                let mut told = sys::ExtensionProperties { extension_version: 1, ..blank };
                for (letter, own) in told.extension_name.iter_mut().zip(own.to_bytes()) {
                    *letter = *own as c_char;
                }
                known.push(told);
            }
        }
        *count = known.len() as u32;
        if capacity == 0 {
            return Xr::SUCCESS;
        }
        if capacity < *count {
            return Xr::ERROR_SIZE_INSUFFICIENT;
        }
        for (index, known) in known.iter().enumerate() {
            let told = &mut *properties.add(index);
            told.extension_name = known.extension_name;
            told.extension_version = known.extension_version;
        }
        Xr::SUCCESS
    }
}

unsafe extern "system" fn create_instance(
    info: *const sys::InstanceCreateInfo,
    instance: *mut sys::Instance,
) -> Xr {
    // SAFETY: the caller's structure holds an array of C strings.
    unsafe {
        let mut passed = Vec::new();
        for index in 0..(*info).enabled_extension_count as usize {
            let name = *(*info).enabled_extension_names.add(index);
            if is_hidden(CStr::from_ptr(name)) {
                return Xr::ERROR_EXTENSION_NOT_PRESENT;
            }
            if !pretend::is_pretended(CStr::from_ptr(name)) {
                passed.push(name);
            }
        }
        let mut info = *info;
        info.enabled_extension_count = passed.len() as u32;
        info.enabled_extension_names = passed.as_ptr();
        let result = real::<pfn::CreateInstance>(c"xrCreateInstance")(&info, instance);
        if result == Xr::SUCCESS {
            INSTANCE.store((*instance).into_raw(), Ordering::Release);
        }
        result
    }
}
