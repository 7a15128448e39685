//! Vulkan as the runtime wants it: `XR_KHR_vulkan_enable2` creates instance and device and names the physical device.

use super::error::is_gone;
use super::runtime::Runtime;
use crate::gpu::{API_VERSION, GpuError, Instance, Opener, PhysicalDevice, version};
use ash::vk::{self, Handle};
use openxr::{self as xr, sys};
use std::ffi::c_void;
use std::mem::transmute;

/// The loader's function in OpenXR's words: the same function, its handle an untyped pointer.
fn get_instance_proc_addr(entry: &ash::Entry) -> xr::sys::platform::VkGetInstanceProcAddr {
    // SAFETY: both are `vkGetInstanceProcAddr`'s signature; a dispatchable handle is a pointer in one and wrapped in the other.
    unsafe { transmute(entry.static_fn().get_instance_proc_addr) }
}

fn pointer<T: Handle>(handle: T) -> *const c_void {
    handle.as_raw() as usize as *const c_void
}

/// The runtime's `error` for the layer below, which knows no OpenXR.
fn refused(doing: &'static str, error: sys::Result) -> GpuError {
    GpuError::Runtime { doing, reason: error.to_string(), gone: is_gone(error) }
}

fn says<T>(doing: &'static str, answer: xr::Result<Result<T, i32>>) -> Result<T, GpuError> {
    match answer {
        Ok(Ok(value)) => Ok(value),
        Ok(Err(result)) => Err(GpuError::Vulkan { doing, result: vk::Result::from_raw(result) }),
        Err(error) => Err(refused(doing, error)),
    }
}

impl Opener for Runtime {
    fn create_instance(
        &self,
        entry: &ash::Entry,
        info: &vk::InstanceCreateInfo<'_>,
    ) -> Result<ash::Instance, GpuError> {
        let doing = "asking which Vulkan is wanted";
        let needs = self.instance.graphics_requirements::<xr::Vulkan>(self.system);
        let needs = needs.map_err(|error| refused(doing, error))?;
        let least = needs.min_api_version_supported;
        let least = vk::make_api_version(0, least.major().into(), least.minor().into(), 0);
        if least > API_VERSION {
            let reason =
                format!("it needs Vulkan {}, Swell asks for {}", version(least), version(API_VERSION));
            return Err(GpuError::Runtime { doing, reason, gone: false });
        }
        let get = get_instance_proc_addr(entry);
        // SAFETY: `info` and what it points to live past the call; the function is the loader's.
        let made = unsafe {
            self.instance.create_vulkan_instance(self.system, get, std::ptr::from_ref(info).cast())
        };
        let raw = says("creating the Vulkan instance", made)?;
        // SAFETY: the runtime made this instance with the same loader.
        Ok(unsafe { ash::Instance::load(entry.static_fn(), vk::Instance::from_raw(raw as usize as u64)) })
    }

    fn choose(&self, instance: &Instance, _wanted: Option<&str>) -> Result<PhysicalDevice, GpuError> {
        let handle = pointer(instance.raw.handle());
        // SAFETY: the instance was made by `create_instance` above and lives.
        let device = unsafe { self.instance.vulkan_graphics_device(self.system, handle) };
        let doing = "asking for the headset's Vulkan device";
        let device = device.map_err(|error| refused(doing, error))?;
        PhysicalDevice::given(instance, vk::PhysicalDevice::from_raw(device as usize as u64))
    }

    fn create_device(
        &self,
        instance: &Instance,
        physical: vk::PhysicalDevice,
        info: &vk::DeviceCreateInfo<'_>,
    ) -> Result<ash::Device, GpuError> {
        let get = get_instance_proc_addr(&instance.entry);
        // SAFETY: `info` and what it points to live past the call; the physical device is the one the runtime named.
        let made = unsafe {
            self.instance.create_vulkan_device(
                self.system,
                get,
                pointer(physical),
                std::ptr::from_ref(info).cast(),
            )
        };
        let raw = says("creating the device", made)?;
        // SAFETY: the runtime made this device from this instance.
        Ok(unsafe { ash::Device::load(instance.raw.fp_v1_0(), vk::Device::from_raw(raw as usize as u64)) })
    }
}
