//! The images a window shows, taken in turns with whoever composes the screen.
//!
//! An image is acquired with a fence and never with a semaphore: whether it is there is known on the CPU before anything is
//! submitted, so the queue that a headset's frames wait in never waits for a window.

use super::device::Device;
use super::error::{Doing, GpuError};
use super::surface::Surface;
use ash::{khr, vk};
use std::rc::Rc;
use std::sync::Arc;
use std::time::Duration;

/// What a window's pictures must not wait for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// Each picture is shown, one every refresh.
    Window,
    /// A picture is shown if that costs its maker nothing: another screen, a headset's, sets the pace.
    Mirror,
}

impl Pace {
    const fn modes(self) -> &'static [vk::PresentModeKHR] {
        match self {
            Self::Window => &[vk::PresentModeKHR::FIFO],
            Self::Mirror => &[vk::PresentModeKHR::MAILBOX, vk::PresentModeKHR::IMMEDIATE],
        }
    }
}

/// An image to be filled and presented.
#[derive(Clone, Copy)]
pub(super) struct Acquired {
    pub index: u32,
    pub image: vk::Image,
    /// To be signalled by what fills the image.
    pub filled: vk::Semaphore,
}

/// How far an image has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Turn {
    /// None is ours.
    None,
    /// Promised; the fence tells when whoever shows it has done with it.
    Promised(u32),
    /// Ours.
    Ready(u32),
}

/// Why there is no image.
pub(super) enum NotAcquired {
    /// None came in time.
    Late,
    /// The window has changed: the swapchain has to be made anew.
    OutOfDate,
    /// Something is wrong.
    Failed(GpuError),
}

/// Images of one size.
pub(super) struct Swapchain {
    pub extent: vk::Extent2D,
    /// The window has changed, though pictures are still shown.
    pub suboptimal: bool,
    raw: vk::SwapchainKHR,
    images: Vec<vk::Image>,
    /// One for each image: free again when the image is.
    filled: Vec<vk::Semaphore>,
    turn: Turn,
    acquired: vk::Fence,
    functions: khr::swapchain::Device,
    device: Arc<Device>,
    /// Outlives the swapchain.
    _surface: Rc<Surface>,
}

impl Swapchain {
    /// Images as large as the window, or as `wanted` (pixels) where the system leaves that to us. None while the window
    /// has no size. `old` is retired.
    pub fn new(
        surface: &Rc<Surface>,
        device: &Arc<Device>,
        wanted: [u32; 2],
        pace: Pace,
        old: Option<Self>,
    ) -> Result<Option<Self>, GpuError> {
        let capabilities = surface.capabilities()?;
        let extent = extent(&capabilities, wanted);
        if extent.width == 0 || extent.height == 0 {
            return Ok(None);
        }
        if !capabilities.supported_usage_flags.contains(vk::ImageUsageFlags::TRANSFER_DST) {
            return Err(GpuError::Missing {
                device: device.physical.name.clone(),
                feature: "copies into a window's images".to_owned(),
            });
        }
        let format = surface.format()?;
        let info = vk::SwapchainCreateInfoKHR::default()
            .surface(surface.raw)
            .min_image_count(image_count(&capabilities))
            .image_format(format.format)
            .image_color_space(format.color_space)
            .image_extent(extent)
            .image_array_layers(1)
            .image_usage(vk::ImageUsageFlags::TRANSFER_DST)
            .image_sharing_mode(vk::SharingMode::EXCLUSIVE)
            .pre_transform(capabilities.current_transform)
            .composite_alpha(composite_alpha(capabilities.supported_composite_alpha))
            .present_mode(surface.present_mode(pace.modes())?)
            .clipped(true)
            .old_swapchain(old.as_ref().map_or(vk::SwapchainKHR::null(), |old| old.raw));
        let functions = khr::swapchain::Device::new(&device.instance().raw, &device.raw);
        // SAFETY: the surface is alive and kept; `old` is of the same surface, and is not used afterwards.
        let raw = unsafe { functions.create_swapchain(&info, None) }.doing("making a window's images")?;
        drop(old);
        let mut swapchain = Self {
            extent,
            suboptimal: false,
            raw,
            images: Vec::new(),
            filled: Vec::new(),
            turn: Turn::None,
            acquired: vk::Fence::null(),
            functions,
            device: Arc::clone(device),
            _surface: Rc::clone(surface),
        };
        // SAFETY: the swapchain is ours.
        let images = unsafe { swapchain.functions.get_swapchain_images(raw) };
        swapchain.images = images.doing("listing a window's images")?;
        // SAFETY: the device lives.
        swapchain.acquired = unsafe { device.raw.create_fence(&vk::FenceCreateInfo::default(), None) }
            .doing("creating a fence")?;
        for (index, &image) in swapchain.images.iter().enumerate() {
            device.name(image, &format!("window {index}"));
            let info = vk::SemaphoreCreateInfo::default();
            // SAFETY: the device lives.
            let semaphore = unsafe { device.raw.create_semaphore(&info, None) };
            let semaphore = semaphore.doing("creating a semaphore")?;
            device.name(semaphore, &format!("window {index} filled"));
            swapchain.filled.push(semaphore);
        }
        device.name(swapchain.acquired, "window acquired");
        Ok(Some(swapchain))
    }

    /// An image to fill, if one comes within `patience`; what was promised stays promised.
    pub fn acquire(&mut self, patience: Duration) -> Result<Acquired, NotAcquired> {
        let timeout = u64::try_from(patience.as_nanos()).unwrap_or(u64::MAX - 1).min(u64::MAX - 1);
        if self.turn == Turn::None {
            // SAFETY: the swapchain is ours, the fence is unsignalled and nobody else's.
            let answer = unsafe {
                self.functions.acquire_next_image(self.raw, timeout, vk::Semaphore::null(), self.acquired)
            };
            let (index, suboptimal) = answer.map_err(not_acquired)?;
            self.suboptimal |= suboptimal;
            self.turn = Turn::Promised(index);
        }
        if let Turn::Promised(index) = self.turn {
            let fences = [self.acquired];
            // SAFETY: the fence is ours; once signalled nothing uses it.
            unsafe {
                self.device.raw.wait_for_fences(&fences, true, timeout).map_err(not_acquired)?;
                self.device.raw.reset_fences(&fences).map_err(not_acquired)?;
            }
            self.turn = Turn::Ready(index);
        }
        match self.turn {
            Turn::Ready(index) => {
                let at = index as usize;
                Ok(Acquired { index, image: self.images[at], filled: self.filled[at] })
            }
            _ => Err(NotAcquired::Late),
        }
    }

    /// Shows `image` once its semaphore is signalled, which a submission has been told to do.
    pub fn present(&mut self, image: Acquired) -> Result<(), NotAcquired> {
        self.turn = Turn::None;
        let (wait, swapchains, indices) = ([image.filled], [self.raw], [image.index]);
        let info = vk::PresentInfoKHR::default()
            .wait_semaphores(&wait)
            .swapchains(&swapchains)
            .image_indices(&indices);
        let queue = self.device.queue();
        // SAFETY: the lock keeps other threads from the queue; the image was acquired and left ready to be presented.
        let suboptimal = unsafe { self.functions.queue_present(*queue, &info) }.map_err(not_acquired)?;
        self.suboptimal |= suboptimal;
        Ok(())
    }
}

impl Drop for Swapchain {
    fn drop(&mut self) {
        // A window that is gone may never keep its promise.
        const LONGEST_NS: u64 = 1_000_000_000;
        // SAFETY: once the queue is idle nothing uses images and semaphores. Presenting is in the queue as well, for all
        // that Vulkan 1.1 lets an application know. Null handles are ignored.
        unsafe {
            if matches!(self.turn, Turn::Promised(_)) {
                let _late = self.device.raw.wait_for_fences(&[self.acquired], true, LONGEST_NS);
            }
            let queue = self.device.queue();
            let _lost = self.device.raw.queue_wait_idle(*queue);
            drop(queue);
            for &semaphore in &self.filled {
                self.device.raw.destroy_semaphore(semaphore, None);
            }
            self.device.raw.destroy_fence(self.acquired, None);
            self.functions.destroy_swapchain(self.raw, None);
        }
    }
}

fn not_acquired(result: vk::Result) -> NotAcquired {
    match result {
        vk::Result::NOT_READY | vk::Result::TIMEOUT => NotAcquired::Late,
        vk::Result::ERROR_OUT_OF_DATE_KHR => NotAcquired::OutOfDate,
        result => NotAcquired::Failed(GpuError::Vulkan { doing: "showing a picture on the window", result }),
    }
}

/// The system's own size, or the one we want within its bounds.
pub(super) fn extent(capabilities: &vk::SurfaceCapabilitiesKHR, wanted: [u32; 2]) -> vk::Extent2D {
    let (least, most) = (capabilities.min_image_extent, capabilities.max_image_extent);
    match capabilities.current_extent {
        vk::Extent2D { width: u32::MAX, height: u32::MAX } if !wanted.contains(&0) => vk::Extent2D {
            width: wanted[0].max(least.width).min(most.width),
            height: wanted[1].max(least.height).min(most.height),
        },
        vk::Extent2D { width: u32::MAX, height: u32::MAX } => vk::Extent2D::default(),
        current => current,
    }
}

/// One more than the least, so that one can be filled while the others are shown.
fn image_count(capabilities: &vk::SurfaceCapabilitiesKHR) -> u32 {
    let most = if capabilities.max_image_count == 0 { u32::MAX } else { capabilities.max_image_count };
    capabilities.min_image_count.saturating_add(1).min(most)
}

/// Opaque where that is to be had; the pictures' alpha is 1.
fn composite_alpha(supported: vk::CompositeAlphaFlagsKHR) -> vk::CompositeAlphaFlagsKHR {
    use vk::CompositeAlphaFlagsKHR as A;
    [A::OPAQUE, A::INHERIT, A::PRE_MULTIPLIED, A::POST_MULTIPLIED]
        .into_iter()
        .find(|&kind| supported.contains(kind))
        .unwrap_or(A::OPAQUE)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn size(width: u32, height: u32) -> vk::Extent2D {
        vk::Extent2D { width, height }
    }

    #[test]
    fn the_systems_size_goes_first_and_ours_keeps_to_its_bounds() {
        let mut capabilities = vk::SurfaceCapabilitiesKHR {
            current_extent: size(300, 200),
            min_image_extent: size(16, 16),
            max_image_extent: size(4096, 4096),
            ..Default::default()
        };
        assert_eq!(extent(&capabilities, [640, 480]), size(300, 200));
        capabilities.current_extent = size(u32::MAX, u32::MAX);
        assert_eq!(extent(&capabilities, [640, 480]), size(640, 480));
        assert_eq!(extent(&capabilities, [9999, 2]), size(4096, 16));
        assert_eq!(extent(&capabilities, [0, 0]), size(0, 0), "a window without a size");
    }

    #[test]
    fn a_count_of_zero_means_no_bound() {
        let count = |min_image_count, max_image_count| {
            image_count(&vk::SurfaceCapabilitiesKHR {
                min_image_count,
                max_image_count,
                ..Default::default()
            })
        };
        assert_eq!((count(2, 0), count(2, 8), count(2, 2)), (3, 3, 2));
    }
}
