//! What stands behind each binding of the shaders: which of them all frames share, and which belong to one in flight.

use super::foam_pattern;
use super::motion;
use super::sea_textures::SeaTextures;
use super::shadow::Shadow;
use super::sky_map::{self, SkyMap};
use super::uniforms::Frame;
use super::waves::Waves;
use crate::gpu::{Bindings, Device, GpuError, Image, ImageInfo, Resource, Sampler, UploadRing, upload_image};
use ash::vk;
use std::sync::Arc;

/// The sky's cube, the foam's pattern, and the samplers: tiling, clamping, and tiling at grazing angles.
pub struct Shared {
    sky: Image,
    foam: Image,
    samplers: [Sampler; 3],
}

impl Shared {
    /// Makes and fills them.
    ///
    /// # Errors
    /// Out of device memory.
    pub fn new(device: &Arc<Device>, sky_map: &SkyMap) -> Result<Self, GpuError> {
        let cube = ImageInfo {
            layers: 6,
            view: vk::ImageViewType::CUBE,
            ..ImageInfo::texture(sky_map::FACE as u32, sky_map::MIPS as u32, vk::Format::R16G16B16A16_SFLOAT)
        };
        let sky = Image::new(device, "sky", cube)?;
        upload_image(device, &sky, bytemuck::cast_slice(&sky_map.texels), 8)?;
        let pattern =
            ImageInfo::texture(foam_pattern::SIZE as u32, foam_pattern::MIPS as u32, vk::Format::R8_UNORM);
        let foam = Image::new(device, "foam pattern", pattern)?;
        upload_image(device, &foam, &foam_pattern::texels(), 1)?;
        let tiling = Sampler::new(device, "tiling", vk::SamplerAddressMode::REPEAT, 1.0)?;
        let clamped = Sampler::new(device, "clamped", vk::SamplerAddressMode::CLAMP_TO_EDGE, 1.0)?;
        let oblique = Sampler::new(device, "oblique", vk::SamplerAddressMode::REPEAT, 4.0)?;
        Ok(Self { sky, foam, samplers: [tiling, clamped, oblique] })
    }

    /// Writes the descriptor sets of all frames in flight, of which `textures` has one each.
    pub fn bind(
        &self,
        bindings: &Bindings,
        ring: &UploadRing,
        textures: &[SeaTextures],
        shadow: Option<&Shadow>,
    ) {
        for (slot, now) in textures.iter().enumerate() {
            let before = &textures[motion::slot_before(slot)];
            bindings.write(slot, |binding| match binding {
                0 => Resource::Uniform(ring.buffer(), size_of::<Frame>() as u64),
                1..=4 => of_cascade(&now.displacement, binding - 1, &self.foam),
                5..=8 => of_cascade(&now.gradient, binding - 5, &self.foam),
                9 => Resource::Texture(&self.sky),
                10 => Resource::Texture(&self.foam),
                11 => Resource::Sampler(&self.samplers[0]),
                12 => Resource::Sampler(&self.samplers[1]),
                13 => Resource::Sampler(&self.samplers[2]),
                14..=17 => of_cascade(&before.displacement, binding - 14, &self.foam),
                // Shaders without shadows never look: any image and any sampler will do there.
                20 => Resource::Texture(shadow.map_or(&self.foam, |shadow| &shadow.map.image)),
                21 => Resource::Sampler(shadow.map_or(&self.samplers[1], |shadow| &shadow.sampler)),
                _ => Resource::Uniform(ring.buffer(), size_of::<Waves>() as u64),
            });
        }
    }
}

/// The image of a cascade. Shaders for fewer cascades never look at those of the others: `any` will do there.
fn of_cascade<'a>(images: &'a [Image], cascade: u32, any: &'a Image) -> Resource<'a> {
    Resource::Texture(images.get(cascade as usize).unwrap_or(any))
}
