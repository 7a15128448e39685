//! What can go wrong between Swell and a Vulkan device, in words that say what to do next.

use ash::vk;

/// A failure of the GPU layer.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// No Vulkan loader on this machine.
    #[error(
        "no Vulkan loader: {0}; install it (Debian: apt-get install libvulkan1 mesa-vulkan-drivers) or use ./x, which brings its own"
    )]
    NoLoader(#[from] ash::LoadingError),
    /// The loader found no driver, or no device offers what Swell needs.
    #[error("no usable Vulkan device: {0}")]
    NoDevice(String),
    /// `--device` names nothing.
    #[error("no Vulkan device matches --device {wanted:?}; there are: {present}")]
    UnknownDevice {
        /// What was asked for.
        wanted: String,
        /// What there is.
        present: String,
    },
    /// The chosen device lacks a feature.
    #[error("Vulkan device {device:?} lacks {feature}")]
    Missing {
        /// Name of the device.
        device: String,
        /// What it lacks.
        feature: String,
    },
    /// The window has no handle to give.
    #[error("nothing can be shown on this window: {0}")]
    NoWindow(String),
    /// Validation was asked for and is not installed.
    #[error(
        "the Vulkan validation layer VK_LAYER_KHRONOS_validation is not installed (Debian: apt-get install vulkan-validationlayers)"
    )]
    NoValidation,
    /// An OpenXR runtime, which opens Vulkan in its own way, refused.
    #[error("{doing}: the OpenXR runtime says {reason}")]
    Runtime {
        /// What was being done.
        doing: &'static str,
        /// The runtime's answer.
        reason: String,
        /// Whether it is there no more.
        gone: bool,
    },
    /// A Vulkan call failed.
    #[error("{doing}: Vulkan says {result:?}")]
    Vulkan {
        /// What was being done.
        doing: &'static str,
        /// Vulkan's answer.
        result: vk::Result,
    },
    /// Device memory could not be had.
    #[error("no device memory for {what}: {source}")]
    Memory {
        /// The resource.
        what: String,
        /// The allocator's reason.
        source: gpu_allocator::AllocationError,
    },
    /// A region of the upload ring was too small for a frame's data.
    #[error("the upload ring is full: {wanted} bytes wanted, {left} left of a frame's share")]
    RingFull {
        /// Bytes asked for.
        wanted: u64,
        /// Bytes left.
        left: u64,
    },
    /// A size exceeds the device's limit.
    #[error("{what} of {value} is beyond this device's limit of {limit}")]
    Limit {
        /// Which quantity.
        what: &'static str,
        /// The value asked for.
        value: u64,
        /// The most there can be.
        limit: u64,
    },
}

impl GpuError {
    /// The loader is there and no driver is.
    pub(super) fn no_driver() -> Self {
        Self::NoDevice("the loader found no driver (Debian: apt-get install mesa-vulkan-drivers)".to_owned())
    }

    /// Whether a surface has to be made anew, its swapchain with it.
    pub const fn is_lost_surface(&self) -> bool {
        matches!(self, Self::Vulkan { result: vk::Result::ERROR_SURFACE_LOST_KHR, .. })
    }
}

/// Names what was being done when a Vulkan call failed.
pub trait Doing<T> {
    /// Turns a `vk::Result` into a [`GpuError`] that says what was being done.
    ///
    /// # Errors
    /// The failed call, named.
    fn doing(self, what: &'static str) -> Result<T, GpuError>;
}

impl<T> Doing<T> for Result<T, vk::Result> {
    fn doing(self, doing: &'static str) -> Result<T, GpuError> {
        self.map_err(|result| GpuError::Vulkan { doing, result })
    }
}
