//! The images of the views: made together, of one size, and made anew where that changes.

use super::HeadsetSettings;
use super::stage::{IMAGE_PATIENCE, optional};
use crate::gpu::{Device, GpuError, Image, ImageInfo, Lent, Recorder, Target, TargetInfo, Turn};
use crate::host::HostError;
use crate::xr::vendor::{Foveation, FoveationLevel};
use crate::xr::{Runtime, Session, Swapchain, SwapchainInfo, Usage, VIEWS, XrError};
use ash::vk;
use std::sync::Arc;

/// Formats that views are drawn in: what a shader writes is linear, and what is stored is sRGB.
const COLORS: [vk::Format; 2] = [vk::Format::R8G8B8A8_SRGB, vk::Format::B8G8R8A8_SRGB];

/// In the order they are dropped: views of images before the images.
pub struct Views {
    pub target: Target,
    pub picture: Option<Image>,
    pub color: Swapchain,
    pub depth: Option<Swapchain>,
    pub foveation: Option<Foveation>,
}

impl Views {
    /// Images in `session`, of which `formats` are offered; frames are copied where somebody `looks`. They are `scale` times
    /// as large as `settings` say.
    ///
    /// # Errors
    /// The runtime has gone, refuses, or has no format that can be drawn.
    pub fn new(
        session: &Session,
        device: &Arc<Device>,
        formats: &[vk::Format],
        settings: &HeadsetSettings,
        looks: bool,
        scale: f32,
    ) -> Result<Self, HostError> {
        let runtime = &session.runtime;
        let format =
            COLORS.into_iter().find(|format| formats.contains(format)).ok_or_else(|| XrError::Missing {
                runtime: runtime.name.clone(),
                what: "images of 8-bit sRGB colours".to_owned(),
            })?;
        let size = scaled(runtime, settings.scale * scale);
        let wished = settings.foveation != FoveationLevel::Off && Foveation::is_offered(runtime, device);
        // Subsampled images cannot be copied from. Whole ones want a feature of the device, the depth that is kept too.
        let whole = device.physical.density_maps_on_whole_images;
        let subsampled = wished && !looks && runtime.extensions.meta_vulkan_swapchain_create_info;
        let foveated = wished && (subsampled || whole);
        let usage = Usage::Color { copied: looks };
        let info = SwapchainInfo { size, format, usage, foveated, subsampled };
        let color = Swapchain::new(session, info)?;
        let takes_depth = runtime.extensions.khr_composition_layer_depth
            && formats.contains(&crate::gpu::DEPTH_FORMAT)
            && device.physical.depth_resolve
            && (!foveated || whole);
        let depth = takes_depth
            .then(|| {
                let info = SwapchainInfo {
                    format: crate::gpu::DEPTH_FORMAT,
                    usage: Usage::Depth,
                    foveated: false,
                    subsampled: false,
                    ..info
                };
                Swapchain::new(session, info)
            })
            .transpose()?;
        let foveation = if foveated {
            let profile = Foveation::new(session, settings.foveation)
                .and_then(|profile| profile.apply(session, &color).map(|()| Some(profile)));
            optional("foveation", profile, None)?
        } else {
            None
        };
        let target = Target::over(
            device,
            TargetInfo {
                extent: vk::Extent2D { width: size[0], height: size[1] },
                views: VIEWS as u32,
                format,
                samples: vk::SampleCountFlags::TYPE_4,
            },
            &Lent {
                colors: color.images(),
                depths: depth.as_ref().map(Swapchain::images).unwrap_or_default(),
                density_maps: color.density_maps(),
                subsampled,
            },
        )?;
        let picture = if looks { Some(copy_of(device, &info)?) } else { None };
        Ok(Self { target, picture, color, depth, foveation })
    }

    /// The images whose turn it is, or nothing where they did not come in time.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn acquire(&mut self) -> Result<Option<Turn>, XrError> {
        let Some(color) = self.color.acquire(IMAGE_PATIENCE)? else { return Ok(None) };
        let depth = match &mut self.depth {
            Some(depth) => depth.acquire(IMAGE_PATIENCE)?,
            None => Some(0),
        };
        Ok(depth.map(|depth| Turn { color, depth }))
    }

    /// Gives the images back, drawn.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn release(&mut self) -> Result<(), XrError> {
        self.color.release()?;
        self.depth.as_mut().map_or(Ok(()), Swapchain::release)
    }

    /// Records a copy of what was drawn, where somebody looks.
    pub fn copy(&self, commands: Recorder<'_>, turn: Turn) {
        if let Some(picture) = &self.picture {
            commands.copy_lent(self.color.images()[turn.color], picture);
        }
    }
}

/// The recommended size times `scale`, within what the runtime allows.
fn scaled(runtime: &Runtime, scale: f32) -> [u32; 2] {
    let size = runtime.size;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to what is allowed")]
    #[expect(clippy::cast_precision_loss, reason = "sizes of images")]
    let side = |i: usize| ((size.recommended[i] as f32 * scale).round() as u32).clamp(1, size.most[i]);
    [side(0), side(1)]
}

fn copy_of(device: &Arc<Device>, info: &SwapchainInfo) -> Result<Image, GpuError> {
    let usage = vk::ImageUsageFlags::TRANSFER_SRC | vk::ImageUsageFlags::TRANSFER_DST;
    let copy = ImageInfo {
        extent: info.size,
        layers: VIEWS as u32,
        mips: 1,
        format: info.format,
        samples: vk::SampleCountFlags::TYPE_1,
        // A copy is never drawn into or sampled, but every image has a view, which wants one such use.
        usage: usage | vk::ImageUsageFlags::SAMPLED,
        view: vk::ImageViewType::TYPE_2D_ARRAY,
        subsampled: false,
        recast: false,
    };
    Image::new(device, "copy of both eyes", copy)
}
