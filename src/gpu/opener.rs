//! Who calls `vkCreateInstance` and `vkCreateDevice`: Swell itself, or an OpenXR runtime that adds what it needs.

use super::error::{Doing, GpuError};
use super::instance::Instance;
use super::physical::PhysicalDevice;
use ash::vk;

/// Creates Vulkan's instance and device, and may insist on a physical device.
pub trait Opener {
    /// Creates an instance as `info` says, or with more.
    ///
    /// # Errors
    /// Vulkan or a runtime refuses.
    fn create_instance(
        &self,
        entry: &ash::Entry,
        info: &vk::InstanceCreateInfo<'_>,
    ) -> Result<ash::Instance, GpuError>;

    /// The physical device to draw on; `wanted` is a part of its name that a person gave.
    ///
    /// # Errors
    /// There is none that will do.
    fn choose(&self, instance: &Instance, wanted: Option<&str>) -> Result<PhysicalDevice, GpuError>;

    /// Creates a device as `info` says, or with more.
    ///
    /// # Errors
    /// Vulkan or a runtime refuses.
    fn create_device(
        &self,
        instance: &Instance,
        physical: vk::PhysicalDevice,
        info: &vk::DeviceCreateInfo<'_>,
    ) -> Result<ash::Device, GpuError>;
}

/// Nobody else has a say.
#[derive(Clone, Copy, Debug, Default)]
pub struct Directly;

impl Opener for Directly {
    fn create_instance(
        &self,
        entry: &ash::Entry,
        info: &vk::InstanceCreateInfo<'_>,
    ) -> Result<ash::Instance, GpuError> {
        // SAFETY: every pointer in `info` refers to something that the caller keeps past the call.
        match unsafe { entry.create_instance(info, None) } {
            Err(vk::Result::ERROR_INCOMPATIBLE_DRIVER) => Err(GpuError::no_driver()),
            other => other.doing("creating the Vulkan instance"),
        }
    }

    fn choose(&self, instance: &Instance, wanted: Option<&str>) -> Result<PhysicalDevice, GpuError> {
        PhysicalDevice::choose(instance, wanted)
    }

    fn create_device(
        &self,
        instance: &Instance,
        physical: vk::PhysicalDevice,
        info: &vk::DeviceCreateInfo<'_>,
    ) -> Result<ash::Device, GpuError> {
        // SAFETY: the handle belongs to this instance; `info`'s pointers are the caller's, kept past the call.
        unsafe { instance.raw.create_device(physical, info, None) }.doing("creating the device")
    }
}
