//! Buffers.
//!
//! The allocator maps only memory that is host-coherent, so bytes written here need no flush and bytes read no
//! invalidation: a submission, or a barrier to the host and a fence, is enough.

use super::device::Device;
use super::error::{Doing, GpuError};
use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::Allocation;
use std::sync::Arc;

/// A buffer with memory of its own.
pub struct Buffer {
    /// Vulkan's handle.
    pub raw: vk::Buffer,
    /// Bytes.
    pub size: u64,
    allocation: Option<Allocation>,
    device: Arc<Device>,
}

impl Buffer {
    /// Makes a buffer of `size` bytes in `location`.
    ///
    /// # Errors
    /// Out of memory.
    pub fn new(
        device: &Arc<Device>,
        name: &str,
        size: u64,
        usage: vk::BufferUsageFlags,
        location: MemoryLocation,
    ) -> Result<Self, GpuError> {
        let info = vk::BufferCreateInfo::default().size(size.max(4)).usage(usage);
        // SAFETY: the device lives; `info` is complete.
        let raw = unsafe { device.raw.create_buffer(&info, None) }.doing("creating a buffer")?;
        let mut buffer = Self { raw, size, allocation: None, device: Arc::clone(device) };
        // SAFETY: the buffer is ours.
        let requirements = unsafe { device.raw.get_buffer_memory_requirements(raw) };
        let allocation = device.allocate(name, requirements, location, true)?;
        // Kept before it is bound, so that a failure frees it.
        let allocation = buffer.allocation.insert(allocation);
        // SAFETY: the memory is fresh, fits the requirements and is bound once.
        unsafe { device.raw.bind_buffer_memory(raw, allocation.memory(), allocation.offset()) }
            .doing("binding a buffer's memory")?;
        device.name(raw, name);
        Ok(buffer)
    }

    /// The buffer's bytes, where it is mapped (empty where it is not).
    pub fn bytes(&self) -> &[u8] {
        self.allocation.as_ref().and_then(Allocation::mapped_slice).unwrap_or_default()
    }

    /// The buffer's bytes for writing, where it is mapped (empty where it is not).
    pub fn bytes_mut(&mut self) -> &mut [u8] {
        self.allocation.as_mut().and_then(Allocation::mapped_slice_mut).unwrap_or_default()
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        // SAFETY: owners drop resources only after the frames that use them have ended.
        unsafe { self.device.raw.destroy_buffer(self.raw, None) };
        if let Some(allocation) = self.allocation.take() {
            self.device.free(allocation);
        }
    }
}
