//! A window as Vulkan sees it: what can be shown on it, and how.

use super::device::Device;
use super::error::{Doing, GpuError};
use super::instance::Instance;
use ash::{khr, vk};
use raw_window_handle::{HandleError, HasDisplayHandle, HasWindowHandle};
use std::ffi::CStr;
use std::sync::Arc;

/// A window of the system's, kept as long as anything is shown on it.
pub trait Shown: HasDisplayHandle + HasWindowHandle {}
impl<T: HasDisplayHandle + HasWindowHandle> Shown for T {}

/// Vulkan's surface on a window.
pub struct Surface {
    pub(super) raw: vk::SurfaceKHR,
    functions: khr::surface::Instance,
    device: Arc<Device>,
    /// Outlives the surface.
    _window: Arc<dyn Shown>,
}

impl Surface {
    /// Extensions that an instance needs to show anything on `display`.
    ///
    /// # Errors
    /// Vulkan has no surfaces of this kind.
    pub fn extensions(display: &dyn HasDisplayHandle) -> Result<Vec<&'static CStr>, GpuError> {
        let display = display.display_handle().map_err(no_handle)?;
        let names = ash_window::enumerate_required_extensions(display.as_raw())
            .doing("looking for a kind of surface that fits this display")?;
        // SAFETY: these are ash's constants: static, and null-terminated.
        Ok(names.iter().map(|&name| unsafe { CStr::from_ptr(name) }).collect())
    }

    /// A surface on `window`, whose display's [`Self::extensions`] the device's instance has.
    ///
    /// # Errors
    /// The window is gone, or the device cannot show anything on it.
    pub fn new(device: &Arc<Device>, window: &Arc<dyn Shown>) -> Result<Self, GpuError> {
        let instance: &Instance = device.instance();
        let display = window.display_handle().map_err(no_handle)?.as_raw();
        let handle = window.window_handle().map_err(no_handle)?.as_raw();
        let Instance { entry, raw, .. } = instance;
        // SAFETY: the surface keeps the device, which keeps the instance, and the window, which keeps its display.
        let made = unsafe { ash_window::create_surface(entry, raw, display, handle, None) };
        let raw = made.doing("making a surface on the window")?;
        let functions = khr::surface::Instance::new(&instance.entry, &instance.raw);
        let surface = Self { raw, functions, device: Arc::clone(device), _window: Arc::clone(window) };
        let physical = &device.physical;
        // SAFETY: all handles are alive.
        let supported = unsafe {
            surface.functions.get_physical_device_surface_support(physical.raw, device.queue_family, raw)
        }
        .doing("asking whether the device can show pictures on the window")?;
        if supported {
            return Ok(surface);
        }
        Err(GpuError::Missing {
            device: physical.name.clone(),
            feature: "a way to show pictures on this window; choose another with --device".to_owned(),
        })
    }

    /// Sizes and numbers of images that can be had now.
    pub(super) fn capabilities(&self) -> Result<vk::SurfaceCapabilitiesKHR, GpuError> {
        // SAFETY: both handles are alive.
        unsafe { self.functions.get_physical_device_surface_capabilities(self.device.physical.raw, self.raw) }
            .doing("asking for the window's size")
    }

    /// The format to show pictures in: 8 bits a channel, encoded as sRGB by the device. A blit into any other would
    /// leave the pictures too dark.
    pub(super) fn format(&self) -> Result<vk::SurfaceFormatKHR, GpuError> {
        let physical = self.device.physical.raw;
        // SAFETY: both handles are alive.
        let formats = unsafe { self.functions.get_physical_device_surface_formats(physical, self.raw) };
        let formats = formats.doing("asking for the window's formats")?;
        choose_format(&formats).ok_or_else(|| {
            let names: Vec<String> = formats.iter().map(|f| format!("{:?}", f.format)).collect();
            GpuError::Missing {
                device: self.device.physical.name.clone(),
                feature: format!("sRGB pictures on this window (it has {})", names.join(", ")),
            }
        })
    }

    /// The first of `wanted` that there is; FIFO there is always.
    pub(super) fn present_mode(&self, wanted: &[vk::PresentModeKHR]) -> Result<vk::PresentModeKHR, GpuError> {
        // SAFETY: both handles are alive.
        let modes = unsafe {
            self.functions.get_physical_device_surface_present_modes(self.device.physical.raw, self.raw)
        }
        .doing("asking how the window takes pictures")?;
        Ok(wanted.iter().copied().find(|mode| modes.contains(mode)).unwrap_or(vk::PresentModeKHR::FIFO))
    }
}

impl Drop for Surface {
    fn drop(&mut self) {
        // SAFETY: a swapchain keeps its surface, so none is left.
        unsafe { self.functions.destroy_surface(self.raw, None) };
    }
}

fn no_handle(error: HandleError) -> GpuError {
    GpuError::NoWindow(error.to_string())
}

fn choose_format(formats: &[vk::SurfaceFormatKHR]) -> Option<vk::SurfaceFormatKHR> {
    let wanted = [vk::Format::B8G8R8A8_SRGB, vk::Format::R8G8B8A8_SRGB, vk::Format::A8B8G8R8_SRGB_PACK32];
    wanted.iter().find_map(|&format| {
        let fits = |have: &&vk::SurfaceFormatKHR| {
            have.format == format && have.color_space == vk::ColorSpaceKHR::SRGB_NONLINEAR
        };
        formats.iter().find(fits).copied()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_formats_that_encode_srgb_are_taken() {
        let format = |format, color_space| vk::SurfaceFormatKHR { format, color_space };
        let plain = vk::ColorSpaceKHR::SRGB_NONLINEAR;
        let wide = vk::ColorSpaceKHR::DISPLAY_P3_NONLINEAR_EXT;
        let (unorm, srgb) = (vk::Format::B8G8R8A8_UNORM, vk::Format::R8G8B8A8_SRGB);
        assert_eq!(choose_format(&[format(unorm, plain), format(srgb, wide)]), None);
        let chosen = choose_format(&[format(unorm, plain), format(srgb, plain)]);
        assert_eq!(chosen, Some(format(srgb, plain)));
    }
}
