//! Images that the runtime lends: one at a time is acquired, waited for, drawn into and released.

use super::error::{Doing, XrError, check};
use super::session::Session;
use crate::gpu::Device;
use ash::vk::{self, Handle as _};
use openxr as xr;
use openxr::sys::{self, Handle as _};
use std::ffi::c_void;
use std::sync::Arc;
use std::time::Duration;

/// What a swapchain is to be.
#[derive(Clone, Copy, Debug)]
pub struct SwapchainInfo {
    /// Pixels of one view.
    pub size: [u32; 2],
    /// Texel format, one of [`Session::formats`].
    pub format: vk::Format,
    /// What it is used for.
    pub usage: Usage,
    /// Drawn with a fragment density map that the runtime makes.
    pub foveated: bool,
    /// Stored smaller than it looks, as foveation leaves it. Wants `XR_META_vulkan_swapchain_create_info`.
    pub subsampled: bool,
}

/// What a swapchain's images are used for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Usage {
    /// Colour, drawn and, where `copied`, read by copies.
    Color {
        /// A mirror or a screenshot reads it.
        copied: bool,
    },
    /// Depth.
    Depth,
    /// Motion vectors for space warp.
    Motion,
    /// Depth for space warp.
    MotionDepth,
    /// Colour of a panel: one layer that both eyes see, drawn as it is encoded.
    Panel,
}

impl Usage {
    /// Layers of an image.
    const fn layers(self) -> u32 {
        match self {
            Self::Panel => 1,
            Self::Color { .. } | Self::Depth | Self::Motion | Self::MotionDepth => super::VIEWS as u32,
        }
    }
}

/// `XrVulkanSwapchainCreateInfoMETA` as the header has it: Vulkan's flags have 32 bits, and `openxr-sys` 0.14 gives them 64.
#[repr(C)]
struct VulkanSwapchainCreateInfo {
    ty: sys::StructureType,
    next: *const c_void,
    additional_create_flags: u32,
    additional_usage_flags: u32,
}

/// A swapchain of array images, one layer a view (a panel has one).
///
/// Made with the raw functions where the `openxr` crate's safe ones cannot chain structures, or take an expired wait for a
/// finished one.
pub struct Swapchain {
    raw: xr::Swapchain<xr::Vulkan>,
    /// What it was made as.
    pub info: SwapchainInfo,
    images: Vec<vk::Image>,
    density_maps: Vec<vk::Image>,
    /// Index of the image that was acquired and not yet released.
    acquired: Option<u32>,
    /// Whether that one may be drawn into.
    ready: bool,
    device: Arc<Device>,
}

impl Swapchain {
    /// Makes a swapchain in `session`.
    ///
    /// # Errors
    /// The runtime refuses, or has gone.
    pub fn new(session: &Session, info: SwapchainInfo) -> Result<Self, XrError> {
        let usage = match info.usage {
            Usage::Color { copied } => {
                let copied = if copied { xr::SwapchainUsageFlags::TRANSFER_SRC } else { Default::default() };
                xr::SwapchainUsageFlags::COLOR_ATTACHMENT | copied
            }
            Usage::Depth => xr::SwapchainUsageFlags::DEPTH_STENCIL_ATTACHMENT,
            // The extension asks for `SAMPLED` with the depth, and its sample has it with both.
            Usage::Motion => xr::SwapchainUsageFlags::COLOR_ATTACHMENT | xr::SwapchainUsageFlags::SAMPLED,
            Usage::MotionDepth => {
                xr::SwapchainUsageFlags::DEPTH_STENCIL_ATTACHMENT | xr::SwapchainUsageFlags::SAMPLED
            }
            Usage::Panel => {
                xr::SwapchainUsageFlags::COLOR_ATTACHMENT | xr::SwapchainUsageFlags::MUTABLE_FORMAT
            }
        };
        let meta = VulkanSwapchainCreateInfo {
            ty: sys::VulkanSwapchainCreateInfoMETA::TYPE,
            next: std::ptr::null(),
            additional_create_flags: vk::ImageCreateFlags::SUBSAMPLED_EXT.as_raw(),
            additional_usage_flags: 0,
        };
        let foveation = sys::SwapchainCreateInfoFoveationFB {
            ty: sys::SwapchainCreateInfoFoveationFB::TYPE,
            next: if info.subsampled {
                std::ptr::from_ref(&meta).cast_mut().cast()
            } else {
                std::ptr::null_mut()
            },
            flags: sys::SwapchainCreateFoveationFlagsFB::FRAGMENT_DENSITY_MAP,
        };
        let create = sys::SwapchainCreateInfo {
            ty: sys::SwapchainCreateInfo::TYPE,
            next: if info.foveated { std::ptr::from_ref(&foveation).cast() } else { std::ptr::null() },
            create_flags: sys::SwapchainCreateFlags::EMPTY,
            usage_flags: usage,
            format: i64::from(info.format.as_raw()),
            sample_count: 1,
            width: info.size[0],
            height: info.size[1],
            face_count: 1,
            array_size: info.usage.layers(),
            mip_count: 1,
        };
        let instance = session.runtime.instance.clone();
        let mut handle = sys::Swapchain::NULL;
        let raw = {
            let _queue = session.device.queue();
            // SAFETY: the session lives; every structure chained is a local that lives past the call.
            check(unsafe { (instance.fp().create_swapchain)(session.raw.as_raw(), &create, &mut handle) })
                .doing("creating a swapchain")?;
            // SAFETY: the handle was made just now from this session and is given away here.
            unsafe { xr::Swapchain::from_raw(session.raw.clone(), handle) }
        };
        let mut swapchain = Self {
            raw,
            info,
            images: Vec::new(),
            density_maps: Vec::new(),
            acquired: None,
            ready: false,
            device: Arc::clone(&session.device),
        };
        let name = match info.usage {
            Usage::Color { .. } => "colour",
            Usage::Depth => "depth",
            Usage::Motion => "motion",
            Usage::MotionDepth => "motion's depth",
            Usage::Panel => "panel",
        };
        let _unnamed = swapchain.raw.set_name(name);
        swapchain.list_images(&instance)?;
        Ok(swapchain)
    }

    fn list_images(&mut self, instance: &xr::Instance) -> Result<(), XrError> {
        let handle = self.raw.as_raw();
        let mut count = 0;
        let doing = "listing a swapchain's images";
        // SAFETY: the swapchain lives; a capacity of 0 asks for the count alone.
        check(unsafe {
            (instance.fp().enumerate_swapchain_images)(handle, 0, &mut count, std::ptr::null_mut())
        })
        .doing(doing)?;
        let density = sys::SwapchainImageFoveationVulkanFB {
            ty: sys::SwapchainImageFoveationVulkanFB::TYPE,
            next: std::ptr::null_mut(),
            image: 0,
            width: 0,
            height: 0,
        };
        let mut densities = vec![density; count as usize];
        let mut images: Vec<_> = densities
            .iter_mut()
            .map(|density| sys::SwapchainImageVulkanKHR {
                ty: sys::SwapchainImageVulkanKHR::TYPE,
                next: if self.info.foveated {
                    std::ptr::from_mut(density).cast()
                } else {
                    std::ptr::null_mut()
                },
                image: 0,
            })
            .collect();
        // SAFETY: `images` has room for `count` structures of the type that Vulkan sessions return, each chained to one
        // in `densities`, which does not move before the call has ended.
        check(unsafe {
            (instance.fp().enumerate_swapchain_images)(handle, count, &mut count, images.as_mut_ptr().cast())
        })
        .doing(doing)?;
        self.images = images.iter().map(|image| vk::Image::from_raw(image.image)).collect();
        if self.info.foveated {
            self.density_maps = densities.iter().map(|density| vk::Image::from_raw(density.image)).collect();
        }
        Ok(())
    }

    /// All images.
    pub fn images(&self) -> &[vk::Image] {
        &self.images
    }

    /// Their fragment density maps; none where it is not foveated.
    pub fn density_maps(&self) -> &[vk::Image] {
        &self.density_maps
    }

    /// The image to draw into next, or nothing where the compositor did not give it free in time. It stays acquired then,
    /// and the next call goes on waiting for it.
    ///
    /// # Errors
    /// The session or the runtime has gone, or the runtime failed.
    pub fn acquire(&mut self, timeout: Duration) -> Result<Option<usize>, XrError> {
        let index = match self.acquired {
            Some(index) => index,
            None => {
                let _queue = self.device.queue();
                let index = self.raw.acquire_image().doing("acquiring an image")?;
                self.acquired = Some(index);
                index
            }
        };
        if !self.ready {
            let info = sys::SwapchainImageWaitInfo {
                ty: sys::SwapchainImageWaitInfo::TYPE,
                next: std::ptr::null(),
                timeout: xr::Duration::from_nanos(i64::try_from(timeout.as_nanos()).unwrap_or(i64::MAX)),
            };
            // SAFETY: the swapchain lives and has an acquired image.
            let waited = unsafe { (self.raw.instance().fp().wait_swapchain_image)(self.raw.as_raw(), &info) };
            self.ready = check(waited).doing("waiting for an image")? != sys::Result::TIMEOUT_EXPIRED;
        }
        Ok(self.ready.then_some(index as usize))
    }

    /// Gives the image back. Its drawing was submitted.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn release(&mut self) -> Result<(), XrError> {
        if !self.ready {
            return Ok(());
        }
        (self.acquired, self.ready) = (None, false);
        let _queue = self.device.queue();
        // SAFETY: the swapchain lives and its image was waited for.
        let released = unsafe {
            (self.raw.instance().fp().release_swapchain_image)(self.raw.as_raw(), std::ptr::null())
        };
        check(released).doing("releasing an image").map(|_| ())
    }

    /// The layer of view `view`, all of it.
    pub(super) fn sub_image(&self, view: usize) -> sys::SwapchainSubImage {
        let [width, height] = self.info.size.map(|side| i32::try_from(side).unwrap_or(i32::MAX));
        sys::SwapchainSubImage {
            swapchain: self.raw.as_raw(),
            image_rect: xr::Rect2Di {
                offset: xr::Offset2Di { x: 0, y: 0 },
                extent: xr::Extent2Di { width, height },
            },
            image_array_index: view as u32,
        }
    }

    pub(super) fn handle(&self) -> sys::Swapchain {
        self.raw.as_raw()
    }
}
