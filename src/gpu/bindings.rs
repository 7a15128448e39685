//! What shaders see: one descriptor set for each frame in flight, laid out as the shaders themselves declare it.

use super::device::Device;
use super::error::{Doing, GpuError};
use super::image::{Image, Sampler};
use super::recorder::Recorder;
use ash::vk;
use std::sync::Arc;

/// What a binding holds. The list of bindings is reflected from the WGSL when Swell is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BindingKind {
    /// A uniform block at a dynamic offset.
    Uniform,
    /// A sampled texture of any shape.
    Texture,
    /// A sampler.
    Sampler,
}

impl BindingKind {
    const fn descriptor(self) -> vk::DescriptorType {
        match self {
            Self::Uniform => vk::DescriptorType::UNIFORM_BUFFER_DYNAMIC,
            Self::Texture => vk::DescriptorType::SAMPLED_IMAGE,
            Self::Sampler => vk::DescriptorType::SAMPLER,
        }
    }
}

/// What to put into a binding.
pub enum Resource<'a> {
    /// The first `u64` bytes from a dynamic offset in a buffer.
    Uniform(vk::Buffer, u64),
    /// An image in `SHADER_READ_ONLY_OPTIMAL`.
    Texture(&'a Image),
    /// A sampler.
    Sampler(&'a Sampler),
}

/// The set layout, the pipeline layout and the sets.
pub struct Bindings {
    /// Layout of every pipeline: the one set.
    pub pipeline_layout: vk::PipelineLayout,
    set_layout: vk::DescriptorSetLayout,
    pool: vk::DescriptorPool,
    sets: Vec<vk::DescriptorSet>,
    kinds: &'static [(u32, BindingKind)],
    device: Arc<Device>,
}

impl Bindings {
    /// Makes `count` empty sets of the bindings in `kinds`.
    ///
    /// # Errors
    /// Out of memory.
    pub fn new(
        device: &Arc<Device>,
        kinds: &'static [(u32, BindingKind)],
        count: usize,
    ) -> Result<Self, GpuError> {
        let stages = vk::ShaderStageFlags::VERTEX | vk::ShaderStageFlags::FRAGMENT;
        let listed: Vec<_> = kinds
            .iter()
            .map(|&(binding, kind)| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(binding)
                    .descriptor_type(kind.descriptor())
                    .descriptor_count(1)
                    .stage_flags(stages)
            })
            .collect();
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&listed);
        let mut bindings = Self {
            pipeline_layout: vk::PipelineLayout::null(),
            set_layout: vk::DescriptorSetLayout::null(),
            pool: vk::DescriptorPool::null(),
            sets: Vec::new(),
            kinds,
            device: Arc::clone(device),
        };
        // SAFETY: the device lives; each structure refers to locals that live past the call.
        let made = unsafe { device.raw.create_descriptor_set_layout(&info, None) };
        bindings.set_layout = made.doing("creating a set layout")?;
        let layouts = [bindings.set_layout];
        let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&layouts);
        // SAFETY: as above.
        let made = unsafe { device.raw.create_pipeline_layout(&info, None) };
        bindings.pipeline_layout = made.doing("creating a pipeline layout")?;
        let count = u32::try_from(count).unwrap_or(u32::MAX);
        let sizes: Vec<_> = kinds
            .iter()
            .map(|&(_, kind)| vk::DescriptorPoolSize { ty: kind.descriptor(), descriptor_count: count })
            .collect();
        let info = vk::DescriptorPoolCreateInfo::default().max_sets(count).pool_sizes(&sizes);
        // SAFETY: as above.
        let made = unsafe { device.raw.create_descriptor_pool(&info, None) };
        bindings.pool = made.doing("creating a descriptor pool")?;
        let layouts = vec![bindings.set_layout; count as usize];
        let info =
            vk::DescriptorSetAllocateInfo::default().descriptor_pool(bindings.pool).set_layouts(&layouts);
        // SAFETY: as above; the pool has room for exactly these.
        let made = unsafe { device.raw.allocate_descriptor_sets(&info) };
        bindings.sets = made.doing("allocating descriptor sets")?;
        device.name(bindings.pipeline_layout, "ocean layout");
        Ok(bindings)
    }

    /// Fills set `index`: `find` answers for every binding number. Not while a frame that uses the set is drawn.
    pub fn write<'a>(&self, index: usize, find: impl Fn(u32) -> Resource<'a>) {
        for &(binding, kind) in self.kinds {
            let (mut buffers, mut images) =
                ([vk::DescriptorBufferInfo::default()], [vk::DescriptorImageInfo::default()]);
            let write = vk::WriteDescriptorSet::default()
                .dst_set(self.sets[index])
                .dst_binding(binding)
                .descriptor_type(kind.descriptor());
            let write = match find(binding) {
                Resource::Uniform(buffer, size) => {
                    buffers[0] = vk::DescriptorBufferInfo::default().buffer(buffer).range(size);
                    write.buffer_info(&buffers)
                }
                Resource::Texture(image) => {
                    images[0] = vk::DescriptorImageInfo::default()
                        .image_view(image.view)
                        .image_layout(vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL);
                    write.image_info(&images)
                }
                Resource::Sampler(sampler) => {
                    images[0] = vk::DescriptorImageInfo::default().sampler(sampler.raw);
                    write.image_info(&images)
                }
            };
            // SAFETY: set, views and buffers are alive; the caller promises that no frame uses the set now.
            unsafe { self.device.raw.update_descriptor_sets(&[write], &[]) };
        }
    }

    /// Binds set `index` with its uniform blocks at `offsets`, one for each, by the numbers of their bindings.
    pub fn bind(&self, commands: Recorder<'_>, index: usize, offsets: &[u32]) {
        // SAFETY: `commands` is recording; the set is whole, with as many dynamic offsets as it has uniform blocks.
        unsafe {
            self.device.raw.cmd_bind_descriptor_sets(
                commands.raw,
                vk::PipelineBindPoint::GRAPHICS,
                self.pipeline_layout,
                0,
                &[self.sets[index]],
                offsets,
            );
        }
    }
}

impl Drop for Bindings {
    fn drop(&mut self) {
        // SAFETY: owners drop bindings only after the frames that use them have ended.
        unsafe {
            self.device.raw.destroy_descriptor_pool(self.pool, None);
            self.device.raw.destroy_pipeline_layout(self.pipeline_layout, None);
            self.device.raw.destroy_descriptor_set_layout(self.set_layout, None);
        }
    }
}
