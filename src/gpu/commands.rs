//! Command buffers: one for each frame in flight, and one-shot ones for set-up.

use super::buffer::Buffer;
use super::device::Device;
use super::error::{Doing, GpuError};
use super::image::Image;
use super::recorder::Recorder;
use ash::vk;
use gpu_allocator::MemoryLocation;
use std::cell::Cell;
use std::sync::Arc;

/// Frames recorded while earlier ones are still drawn.
pub const FRAMES_IN_FLIGHT: usize = 2;

/// A pool, a buffer and the fence that tells when the buffer's work is done.
///
/// Dropping it waits for that work: owners declare it before the resources its work uses, so that it goes first.
pub struct Commands {
    raw: vk::CommandBuffer,
    pool: vk::CommandPool,
    fence: vk::Fence,
    /// Whether work was submitted that nobody has waited for; only then will the fence be signalled.
    /// A cell also keeps the pool to one thread at a time, as Vulkan demands.
    submitted: Cell<bool>,
    device: Arc<Device>,
}

impl Commands {
    /// Makes all three, with nothing to wait for.
    ///
    /// # Errors
    /// Out of memory.
    pub fn new(device: &Arc<Device>, name: &str) -> Result<Self, GpuError> {
        let info = vk::CommandPoolCreateInfo::default()
            .queue_family_index(device.queue_family)
            .flags(vk::CommandPoolCreateFlags::TRANSIENT);
        // SAFETY: the family is the device's own.
        let pool = unsafe { device.raw.create_command_pool(&info, None) }.doing("creating a command pool")?;
        let mut commands = Self {
            raw: vk::CommandBuffer::null(),
            pool,
            fence: vk::Fence::null(),
            submitted: Cell::new(false),
            device: Arc::clone(device),
        };
        let allocate = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
        // SAFETY: the pool is ours.
        let buffers = unsafe { device.raw.allocate_command_buffers(&allocate) };
        let buffers = buffers.doing("making a command buffer")?;
        commands.raw = buffers[0];
        let info = vk::FenceCreateInfo::default();
        // SAFETY: the device lives.
        commands.fence = unsafe { device.raw.create_fence(&info, None) }.doing("creating a fence")?;
        device.name(commands.raw, name);
        Ok(commands)
    }

    /// Waits until the device has finished what was last submitted from here.
    ///
    /// # Errors
    /// The device was lost.
    pub fn wait(&self) -> Result<(), GpuError> {
        if !self.submitted.get() {
            return Ok(());
        }
        let fences = [self.fence];
        // SAFETY: the fence is ours and was handed to the queue; once it is signalled nothing uses it.
        unsafe {
            self.device.raw.wait_for_fences(&fences, true, u64::MAX).doing("waiting for a frame")?;
            self.submitted.set(false);
            self.device.raw.reset_fences(&fences).doing("resetting a fence")
        }
    }

    /// Whether the device has finished what was last submitted from here; asks, and does not wait.
    pub fn is_done(&self) -> bool {
        // SAFETY: the fence is ours.
        !self.submitted.get() || unsafe { self.device.raw.get_fence_status(self.fence) }.unwrap_or(true)
    }

    /// Waits as [`Self::wait`] does, then starts recording anew.
    ///
    /// # Errors
    /// The device was lost.
    pub fn begin(&self) -> Result<Recorder<'_>, GpuError> {
        self.wait()?;
        let info = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the work of this pool has ended, as just waited for.
        unsafe {
            self.device
                .raw
                .reset_command_pool(self.pool, vk::CommandPoolResetFlags::empty())
                .doing("resetting a command pool")?;
            self.device.raw.begin_command_buffer(self.raw, &info).doing("recording")?;
        }
        Ok(Recorder { raw: self.raw, device: &self.device })
    }

    /// Ends the recording and hands it to the device.
    ///
    /// # Errors
    /// The device was lost.
    pub fn submit(&self) -> Result<(), GpuError> {
        self.submit_signalling(None)
    }

    /// As [`Self::submit`]; `done` is signalled too, for whoever presents the result.
    ///
    /// # Errors
    /// The device was lost.
    pub(super) fn submit_signalling(&self, done: Option<vk::Semaphore>) -> Result<(), GpuError> {
        // SAFETY: recording was begun.
        unsafe { self.device.raw.end_command_buffer(self.raw) }.doing("ending a recording")?;
        self.device.submit(self.raw, self.fence, done)?;
        self.submitted.set(true);
        Ok(())
    }
}

impl Drop for Commands {
    fn drop(&mut self) {
        // A lost device has ended its work too.
        let _lost = self.wait();
        // SAFETY: as just waited for, nothing uses pool or fence; a null fence is ignored.
        unsafe {
            self.device.raw.destroy_fence(self.fence, None);
            self.device.raw.destroy_command_pool(self.pool, None);
        }
    }
}

/// Moves every mip of each image between layouts in one barrier.
#[derive(Clone, Copy, Debug)]
pub struct Transition {
    /// Layout before, `UNDEFINED` to drop the content.
    pub from: vk::ImageLayout,
    /// Layout after.
    pub to: vk::ImageLayout,
    /// What must have finished.
    pub after: (vk::PipelineStageFlags, vk::AccessFlags),
    /// What waits for it.
    pub before: (vk::PipelineStageFlags, vk::AccessFlags),
}

/// Shaders of both stages sample the image.
const SAMPLED: (vk::PipelineStageFlags, vk::AccessFlags) = (
    vk::PipelineStageFlags::from_raw(
        vk::PipelineStageFlags::VERTEX_SHADER.as_raw() | vk::PipelineStageFlags::FRAGMENT_SHADER.as_raw(),
    ),
    vk::AccessFlags::SHADER_READ,
);
/// A copy writes the image.
const COPIED: (vk::PipelineStageFlags, vk::AccessFlags) =
    (vk::PipelineStageFlags::TRANSFER, vk::AccessFlags::TRANSFER_WRITE);

impl Transition {
    /// The old content is dropped and copies fill the image; earlier draws may still have been reading it.
    pub const FILL: Self = Self {
        from: vk::ImageLayout::UNDEFINED,
        to: vk::ImageLayout::TRANSFER_DST_OPTIMAL,
        after: (SAMPLED.0, vk::AccessFlags::empty()),
        before: COPIED,
    };
    /// Copies are done and shaders sample.
    pub const SAMPLE: Self = Self {
        from: vk::ImageLayout::TRANSFER_DST_OPTIMAL,
        to: vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL,
        after: COPIED,
        before: SAMPLED,
    };

    /// Records the barrier.
    pub fn record<'a>(
        self,
        commands: Recorder<'_>,
        images: impl Iterator<Item = &'a Image>,
        scratch: &mut Vec<vk::ImageMemoryBarrier<'static>>,
    ) {
        scratch.clear();
        scratch.extend(images.map(|image| {
            vk::ImageMemoryBarrier::default()
                .src_access_mask(self.after.1)
                .dst_access_mask(self.before.1)
                .old_layout(self.from)
                .new_layout(self.to)
                .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                .image(image.raw)
                .subresource_range(image.everything())
        }));
        // SAFETY: `commands` is recording outside a pass; the images are alive.
        unsafe {
            commands.device.raw.cmd_pipeline_barrier(
                commands.raw,
                self.after.0,
                self.before.0,
                vk::DependencyFlags::empty(),
                &[],
                &[],
                scratch,
            );
        }
    }
}

/// Makes a device-local buffer holding `data`. For set-up only: it waits for the copy.
///
/// # Errors
/// Out of memory, or the device was lost.
pub fn upload_buffer(
    device: &Arc<Device>,
    name: &str,
    data: &[u8],
    usage: vk::BufferUsageFlags,
) -> Result<Buffer, GpuError> {
    let size = data.len() as u64;
    let usage = usage | vk::BufferUsageFlags::TRANSFER_DST;
    let buffer = Buffer::new(device, name, size, usage, MemoryLocation::GpuOnly)?;
    let staging = stage(device, data)?;
    let commands = Commands::new(device, "set-up")?;
    let recording = commands.begin()?;
    let region = [vk::BufferCopy::default().size(size)];
    let barrier = vk::MemoryBarrier::default()
        .src_access_mask(vk::AccessFlags::TRANSFER_WRITE)
        .dst_access_mask(vk::AccessFlags::VERTEX_ATTRIBUTE_READ | vk::AccessFlags::INDEX_READ);
    // SAFETY: recording; both buffers are alive until the wait below and hold `size` bytes.
    unsafe {
        device.raw.cmd_copy_buffer(recording.raw, staging.raw, buffer.raw, &region);
        device.raw.cmd_pipeline_barrier(
            recording.raw,
            vk::PipelineStageFlags::TRANSFER,
            vk::PipelineStageFlags::VERTEX_INPUT,
            vk::DependencyFlags::empty(),
            &[barrier],
            &[],
            &[],
        );
    }
    commands.submit()?;
    commands.wait()?;
    Ok(buffer)
}

/// Fills all mips and layers of `image` from packed bytes (see [`Image::copy_regions`]) and leaves it ready to be
/// sampled. For set-up only: it waits for the copy.
///
/// # Errors
/// Out of memory, or the device was lost.
pub fn upload_image(device: &Arc<Device>, image: &Image, data: &[u8], texel: u64) -> Result<(), GpuError> {
    let staging = stage(device, data)?;
    let commands = Commands::new(device, "set-up")?;
    let recording = commands.begin()?;
    let (mut regions, mut scratch) = (Vec::new(), Vec::new());
    image.copy_regions(0, texel, &mut regions);
    Transition::FILL.record(recording, std::iter::once(image), &mut scratch);
    recording.copy_to_image(staging.raw, image, &regions);
    Transition::SAMPLE.record(recording, std::iter::once(image), &mut scratch);
    commands.submit()?;
    commands.wait()
}

fn stage(device: &Arc<Device>, data: &[u8]) -> Result<Buffer, GpuError> {
    let size = data.len() as u64;
    let usage = vk::BufferUsageFlags::TRANSFER_SRC;
    let mut staging = Buffer::new(device, "staging", size, usage, MemoryLocation::CpuToGpu)?;
    match staging.bytes_mut().get_mut(..data.len()) {
        Some(place) => place.copy_from_slice(data),
        None => return Err(GpuError::RingFull { wanted: size, left: 0 }),
    }
    Ok(staging)
}
