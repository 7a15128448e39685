//! The upload ring: one mapped buffer with a share for each frame in flight, written every frame and never reallocated.

use super::buffer::Buffer;
use super::device::Device;
use super::error::GpuError;
use ash::vk;
use gpu_allocator::MemoryLocation;
use std::sync::Arc;

/// A persistently mapped buffer from which frames take uniforms, instances and texture data.
pub struct UploadRing {
    buffer: Buffer,
    share: u64,
    start: u64,
    cursor: u64,
}

impl UploadRing {
    /// A ring of `frames` shares of at least `share` bytes each.
    ///
    /// # Errors
    /// Out of memory.
    pub fn new(device: &Arc<Device>, frames: u64, share: u64) -> Result<Self, GpuError> {
        let share = share.next_multiple_of(4096);
        let usage = vk::BufferUsageFlags::TRANSFER_SRC
            | vk::BufferUsageFlags::UNIFORM_BUFFER
            | vk::BufferUsageFlags::VERTEX_BUFFER
            | vk::BufferUsageFlags::INDEX_BUFFER;
        let buffer = Buffer::new(device, "upload ring", share * frames, usage, MemoryLocation::CpuToGpu)?;
        Ok(Self { buffer, share, start: 0, cursor: 0 })
    }

    /// The buffer that offsets count in.
    pub const fn buffer(&self) -> vk::Buffer {
        self.buffer.raw
    }

    /// Starts over in the share of frame slot `slot`, whose last use has ended on the device.
    pub const fn begin(&mut self, slot: u64) {
        self.start = slot * self.share;
        self.cursor = self.start;
    }

    /// Copies `data` in at a multiple of `align` bytes and returns its offset in the buffer.
    ///
    /// # Errors
    /// [`GpuError::RingFull`] where the share was made too small.
    pub fn push(&mut self, data: &[u8], align: u64) -> Result<u64, GpuError> {
        let offset = self.cursor.next_multiple_of(align);
        let wanted = data.len() as u64;
        let left = (self.start + self.share).saturating_sub(offset);
        let place =
            usize::try_from(offset).ok().and_then(|at| self.buffer.bytes_mut().get_mut(at..at + data.len()));
        match place {
            Some(place) if wanted <= left => place.copy_from_slice(data),
            _ => return Err(GpuError::RingFull { wanted, left }),
        }
        self.cursor = offset + wanted;
        Ok(offset)
    }

    /// Bytes of a share.
    pub const fn share(&self) -> u64 {
        self.share
    }

    /// Bytes taken from the current share.
    pub const fn used(&self) -> u64 {
        self.cursor - self.start
    }
}
