//! The sea's maps on the GPU: a displacement and a gradient texture for each cascade.

use crate::gpu::{Device, GpuError, Image, ImageInfo, Recorder, Transition, UploadRing};
use crate::sea::{CascadeSettings, SeaMaps};
use ash::vk;
use std::sync::Arc;

/// Bytes of a displacement texel (four halves) and of a gradient texel.
const DISPLACEMENT: u64 = 8;
const GRADIENT: u64 = 4;

/// One set of textures; there is one for each frame in flight, so that a frame's upload never waits for the frame before.
pub struct SeaTextures {
    /// By cascade.
    pub displacement: Vec<Image>,
    /// By cascade.
    pub gradient: Vec<Image>,
    regions: Vec<vk::BufferImageCopy>,
    barriers: Vec<vk::ImageMemoryBarrier<'static>>,
}

impl SeaTextures {
    /// Empty textures for the maps of `cascades`.
    ///
    /// # Errors
    /// Out of device memory.
    pub fn new(device: &Arc<Device>, cascades: &[CascadeSettings]) -> Result<Self, GpuError> {
        let mut textures = Self {
            displacement: Vec::new(),
            gradient: Vec::new(),
            regions: Vec::with_capacity(16),
            barriers: Vec::with_capacity(2 * cascades.len()),
        };
        for (i, cascade) in cascades.iter().enumerate() {
            let size = u32::try_from(cascade.resolution).unwrap_or(u32::MAX);
            let texture = |format| ImageInfo::texture(size, size.ilog2() + 1, format);
            let halves = texture(vk::Format::R16G16B16A16_SFLOAT);
            textures.displacement.push(Image::new(device, &format!("displacement {i}"), halves)?);
            let bytes = texture(vk::Format::R8G8B8A8_UNORM);
            textures.gradient.push(Image::new(device, &format!("gradient {i}"), bytes)?);
        }
        Ok(textures)
    }

    /// Bytes that one frame's maps take in the upload ring.
    pub fn bytes(cascades: &[CascadeSettings]) -> u64 {
        let texels = |n: usize| (4 * n * n - 1) as u64 / 3;
        cascades.iter().map(|c| texels(c.resolution) * (DISPLACEMENT + GRADIENT) + 32).sum()
    }

    /// Records the upload of `maps` through `ring`, outside a pass; of those that there are textures for.
    ///
    /// # Errors
    /// The ring is too small for maps of another size.
    pub fn upload(
        &mut self,
        commands: Recorder<'_>,
        ring: &mut UploadRing,
        maps: &SeaMaps,
    ) -> Result<(), GpuError> {
        if self.displacement.is_empty() {
            return Ok(());
        }
        commands.begin_label(c"sea maps");
        let images = || self.displacement.iter().chain(&self.gradient);
        Transition::FILL.record(commands, images(), &mut self.barriers);
        for ((cascade, displaced), graded) in maps.cascades.iter().zip(&self.displacement).zip(&self.gradient)
        {
            let displacement = ring.push(bytemuck::cast_slice(&cascade.displacement), DISPLACEMENT)?;
            let gradient = ring.push(bytemuck::cast_slice(&cascade.gradient), GRADIENT)?;
            let both = [(displaced, displacement, DISPLACEMENT), (graded, gradient, GRADIENT)];
            for (image, offset, texel) in both {
                self.regions.clear();
                image.copy_regions(offset, texel, &mut self.regions);
                commands.copy_to_image(ring.buffer(), image, &self.regions);
            }
        }
        Transition::SAMPLE.record(commands, images(), &mut self.barriers);
        commands.end_label();
        Ok(())
    }
}
