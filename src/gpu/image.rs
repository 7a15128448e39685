//! Images with their one view, and samplers.

use super::device::Device;
use super::error::{Doing, GpuError};
use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::Allocation;
use std::sync::Arc;

/// What an image is to be.
#[derive(Clone, Copy, Debug)]
pub struct ImageInfo {
    /// Width and height of mip 0, texels.
    pub extent: [u32; 2],
    /// Layers; 6 for a cube.
    pub layers: u32,
    /// Mip levels.
    pub mips: u32,
    /// Texel format.
    pub format: vk::Format,
    /// Samples a pixel.
    pub samples: vk::SampleCountFlags,
    /// What it is used for.
    pub usage: vk::ImageUsageFlags,
    /// How shaders and attachments see it.
    pub view: vk::ImageViewType,
    /// Drawn with a fragment density map into storage that is smaller than it looks.
    pub subsampled: bool,
    /// Seen in other formats of the same size too.
    pub recast: bool,
}

impl ImageInfo {
    /// A sampled texture of one layer that is filled by copies.
    pub const fn texture(size: u32, mips: u32, format: vk::Format) -> Self {
        Self {
            extent: [size, size],
            layers: 1,
            mips,
            format,
            samples: vk::SampleCountFlags::TYPE_1,
            usage: vk::ImageUsageFlags::from_raw(
                vk::ImageUsageFlags::SAMPLED.as_raw() | vk::ImageUsageFlags::TRANSFER_DST.as_raw(),
            ),
            view: vk::ImageViewType::TYPE_2D,
            subsampled: false,
            recast: false,
        }
    }
}

/// An image, its memory and a view of all of it.
pub struct Image {
    /// Vulkan's handle.
    pub raw: vk::Image,
    /// A view of all mips and layers.
    pub view: vk::ImageView,
    /// What it was made as.
    pub info: ImageInfo,
    memory: Memory,
    device: Arc<Device>,
}

/// Where an image's texels are.
enum Memory {
    None,
    /// A part of the allocator's.
    Shared(Allocation),
    /// Of its own: given only if the image leaves a tiled GPU's tile, which a transient one does not.
    Lazy(vk::DeviceMemory),
}

impl Image {
    /// Makes an image in device memory.
    ///
    /// # Errors
    /// Out of memory, or the size is beyond the device.
    pub fn new(device: &Arc<Device>, name: &str, info: ImageInfo) -> Result<Self, GpuError> {
        let mut flags = vk::ImageCreateFlags::empty();
        if info.view == vk::ImageViewType::CUBE {
            flags |= vk::ImageCreateFlags::CUBE_COMPATIBLE;
        }
        if info.subsampled {
            flags |= vk::ImageCreateFlags::SUBSAMPLED_EXT;
        }
        if info.recast {
            flags |= vk::ImageCreateFlags::MUTABLE_FORMAT;
        }
        let create = vk::ImageCreateInfo::default()
            .flags(flags)
            .image_type(vk::ImageType::TYPE_2D)
            .format(info.format)
            .extent(vk::Extent3D { width: info.extent[0], height: info.extent[1], depth: 1 })
            .mip_levels(info.mips)
            .array_layers(info.layers)
            .samples(info.samples)
            .tiling(vk::ImageTiling::OPTIMAL)
            .usage(info.usage);
        // SAFETY: the device lives; `create` is complete.
        let raw = unsafe { device.raw.create_image(&create, None) }.doing("creating an image")?;
        let mut image =
            Self { raw, view: vk::ImageView::null(), info, memory: Memory::None, device: Arc::clone(device) };
        // SAFETY: the image is ours.
        let requirements = unsafe { device.raw.get_image_memory_requirements(raw) };
        let lazy = device.physical.lazy_memory.filter(|index| {
            info.usage.contains(vk::ImageUsageFlags::TRANSIENT_ATTACHMENT)
                && requirements.memory_type_bits & (1 << index) != 0
        });
        // Kept before it is bound, so that a failure frees it.
        let (memory, offset) = match lazy {
            Some(index) => {
                let info = vk::MemoryAllocateInfo::default()
                    .allocation_size(requirements.size)
                    .memory_type_index(index);
                // SAFETY: the device lives, and its memory has this type.
                let memory = unsafe { device.raw.allocate_memory(&info, None) }
                    .doing("allocating transient memory")?;
                image.memory = Memory::Lazy(memory);
                (memory, 0)
            }
            None => {
                let allocation = device.allocate(name, requirements, MemoryLocation::GpuOnly, false)?;
                // SAFETY: the handle is used only while `image` keeps the allocation.
                let place = (unsafe { allocation.memory() }, allocation.offset());
                image.memory = Memory::Shared(allocation);
                place
            }
        };
        // SAFETY: the memory is fresh, fits the requirements and is bound once.
        unsafe { device.raw.bind_image_memory(raw, memory, offset) }.doing("binding an image's memory")?;
        let view = vk::ImageViewCreateInfo::default()
            .image(raw)
            .view_type(info.view)
            .format(info.format)
            .subresource_range(image.everything());
        // SAFETY: the image is bound and the range is its own.
        image.view = unsafe { device.raw.create_image_view(&view, None) }.doing("creating an image view")?;
        device.name(raw, name);
        device.name(image.view, name);
        Ok(image)
    }

    /// Colour or depth.
    pub const fn aspect(&self) -> vk::ImageAspectFlags {
        match self.info.format {
            vk::Format::D32_SFLOAT | vk::Format::D16_UNORM => vk::ImageAspectFlags::DEPTH,
            _ => vk::ImageAspectFlags::COLOR,
        }
    }

    /// All mips and layers.
    pub fn everything(&self) -> vk::ImageSubresourceRange {
        vk::ImageSubresourceRange::default()
            .aspect_mask(self.aspect())
            .level_count(self.info.mips)
            .layer_count(self.info.layers)
    }

    /// A copy of all mips and layers from tightly packed bytes at `offset`, mip after mip, within a mip layer after
    /// layer, `texel` bytes a texel. One region for each mip is appended to `regions`.
    pub fn copy_regions(&self, offset: u64, texel: u64, regions: &mut Vec<vk::BufferImageCopy>) {
        let mut at = offset;
        for mip in 0..self.info.mips {
            let region = self.copy_region(mip, at);
            let vk::Extent3D { width, height, .. } = region.image_extent;
            at += texel * u64::from(width) * u64::from(height) * u64::from(self.info.layers);
            regions.push(region);
        }
    }

    /// A copy of all layers of one mip, to or from tightly packed bytes at `offset`.
    pub(super) fn copy_region(&self, mip: u32, offset: u64) -> vk::BufferImageCopy {
        let [width, height] = self.info.extent.map(|side| (side >> mip).max(1));
        let layers = vk::ImageSubresourceLayers::default()
            .aspect_mask(self.aspect())
            .mip_level(mip)
            .layer_count(self.info.layers);
        vk::BufferImageCopy::default()
            .buffer_offset(offset)
            .image_subresource(layers)
            .image_extent(vk::Extent3D { width, height, depth: 1 })
    }
}

impl Drop for Image {
    fn drop(&mut self) {
        // SAFETY: owners drop resources only after the frames that use them have ended; null views are ignored.
        unsafe {
            self.device.raw.destroy_image_view(self.view, None);
            self.device.raw.destroy_image(self.raw, None);
        }
        match std::mem::replace(&mut self.memory, Memory::None) {
            Memory::None => {}
            Memory::Shared(allocation) => self.device.free(allocation),
            // SAFETY: the image that used it is gone.
            Memory::Lazy(memory) => unsafe { self.device.raw.free_memory(memory, None) },
        }
    }
}

/// A trilinear sampler, or one that compares depths.
pub struct Sampler {
    /// Vulkan's handle.
    pub raw: vk::Sampler,
    device: Arc<Device>,
}

impl Sampler {
    /// Linear in and between mips, with up to `anisotropy` samples where the device can (1 for none).
    ///
    /// # Errors
    /// Out of memory.
    pub fn new(
        device: &Arc<Device>,
        name: &str,
        address: vk::SamplerAddressMode,
        anisotropy: f32,
    ) -> Result<Self, GpuError> {
        let most = device.physical.limits.max_sampler_anisotropy;
        let info = linear(address)
            .anisotropy_enable(device.physical.anisotropy && anisotropy > 1.0)
            .max_anisotropy(anisotropy.clamp(1.0, most.max(1.0)));
        Self::create(device, name, &info)
    }

    /// Of a [`super::DepthMap`]: 1 where a depth is at least the map's, mixed over the four texels around; 1 beyond it.
    ///
    /// # Errors
    /// Out of memory.
    pub fn comparing(device: &Arc<Device>, name: &str) -> Result<Self, GpuError> {
        let info = linear(vk::SamplerAddressMode::CLAMP_TO_BORDER)
            // Nothing is lower than depth 0.
            .border_color(vk::BorderColor::FLOAT_OPAQUE_BLACK)
            .compare_enable(true)
            .compare_op(vk::CompareOp::GREATER_OR_EQUAL);
        Self::create(device, name, &info)
    }

    fn create(device: &Arc<Device>, name: &str, info: &vk::SamplerCreateInfo<'_>) -> Result<Self, GpuError> {
        // SAFETY: the device lives; `info` keeps to its features and limits.
        let raw = unsafe { device.raw.create_sampler(info, None) }.doing("creating a sampler")?;
        device.name(raw, name);
        Ok(Self { raw, device: Arc::clone(device) })
    }
}

fn linear(address: vk::SamplerAddressMode) -> vk::SamplerCreateInfo<'static> {
    vk::SamplerCreateInfo::default()
        .mag_filter(vk::Filter::LINEAR)
        .min_filter(vk::Filter::LINEAR)
        .mipmap_mode(vk::SamplerMipmapMode::LINEAR)
        .address_mode_u(address)
        .address_mode_v(address)
        .address_mode_w(address)
        .max_lod(vk::LOD_CLAMP_NONE)
}

impl Drop for Sampler {
    fn drop(&mut self) {
        // SAFETY: owners drop samplers only after the frames that use them have ended.
        unsafe { self.device.raw.destroy_sampler(self.raw, None) };
    }
}
