//! What a frame is drawn into: colour and depth attachments, their render pass and framebuffers.
//!
//! One pass with one subpass. With more than one sample the colour is resolved inside the pass, so that on a tiled GPU
//! neither the samples nor the depth ever leave the tile, unless somebody asks for the depth.

use super::buffer::Buffer;
use super::device::Device;
use super::error::{Doing, GpuError};
use super::image::{Image, ImageInfo};
use super::recorder::Recorder;
use super::render_pass::{Pass, PassInfo};
use ash::vk;
use std::sync::Arc;

/// Depth everywhere: 32-bit float, reversed.
pub const DEPTH_FORMAT: vk::Format = vk::Format::D32_SFLOAT;

/// Size and kind of a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TargetInfo {
    /// Pixels.
    pub extent: vk::Extent2D,
    /// Views drawn at once (multiview), one layer each.
    pub views: u32,
    /// Format of the finished colour.
    pub format: vk::Format,
    /// Samples a pixel: `TYPE_1` or `TYPE_4`.
    pub samples: vk::SampleCountFlags,
}

impl TargetInfo {
    /// A bit for each view.
    pub(super) const fn view_mask(&self) -> u32 {
        (1 << self.views) - 1
    }

    /// Whether samples become one colour in the pass.
    pub(super) fn resolves(&self) -> bool {
        self.samples != vk::SampleCountFlags::TYPE_1
    }

    /// Bytes of one finished image, all views, at `texel` bytes a texel.
    pub fn bytes(&self, texel: u64) -> u64 {
        texel * u64::from(self.extent.width) * u64::from(self.extent.height) * u64::from(self.views)
    }
}

/// Images that somebody else owns and takes turns with: a headset's swapchains. Each has one layer a view.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lent<'a> {
    /// Finished colours, left in `COLOR_ATTACHMENT_OPTIMAL`.
    pub colors: &'a [vk::Image],
    /// Depths, left in `DEPTH_STENCIL_ATTACHMENT_OPTIMAL`; none where nobody wants them.
    pub depths: &'a [vk::Image],
    /// Fragment density maps, one for each colour; none without foveation.
    pub density_maps: &'a [vk::Image],
    /// The colours were made subsampled, so the samples have to be.
    pub subsampled: bool,
}

/// Which of the lent images a frame is drawn into; 0 and 0 for a target with images of its own.
#[derive(Clone, Copy, Debug, Default)]
pub struct Turn {
    /// Index of the colour.
    pub color: usize,
    /// Index of the depth.
    pub depth: usize,
}

/// A render pass with its images.
pub struct Target {
    /// What it was made as.
    pub info: TargetInfo,
    /// Made with the images.
    pass: Arc<Pass>,
    /// One for each pair of colour and depth, depths together.
    framebuffers: Vec<vk::Framebuffer>,
    depths: usize,
    /// The finished image, where it is our own.
    finished: Option<Image>,
    /// Samples and depth: the framebuffers refer to them.
    _transient: Vec<Image>,
    /// Views of lent images.
    views: Vec<vk::ImageView>,
    device: Arc<Device>,
}

impl Target {
    /// A target with a finished image of its own, which is ready to be copied from after the pass.
    ///
    /// # Errors
    /// Out of memory, or a size beyond the device's limit.
    pub fn new(device: &Arc<Device>, info: TargetInfo) -> Result<Self, GpuError> {
        let one = vk::SampleCountFlags::TYPE_1;
        let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC;
        check_limits(device, info)?;
        // An overlay blends what is encoded as sRGB as it is.
        let recast = info.format == vk::Format::R8G8B8A8_SRGB;
        let finished = ImageInfo { recast, ..attachment(info, info.format, one, usage) };
        let finished = Image::new(device, "finished colour", finished)?;
        let color = finished.raw;
        let layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
        let lent = Lent { colors: &[color], ..Lent::default() };
        let mut target = Self::begin_new(device, info, &lent, layout)?;
        target.finished = Some(finished);
        target.make(&lent)?;
        Ok(target)
    }

    /// A target over lent images, which have to outlive it.
    ///
    /// # Errors
    /// Out of memory, a size beyond the device's limit, or depth is wanted of a device that cannot resolve it.
    pub fn over(device: &Arc<Device>, info: TargetInfo, lent: &Lent<'_>) -> Result<Self, GpuError> {
        check_limits(device, info)?;
        let mut target = Self::begin_new(device, info, lent, vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)?;
        target.make(lent)?;
        Ok(target)
    }

    /// The pass alone, which leaves finished colours `finished`.
    fn begin_new(
        device: &Arc<Device>,
        info: TargetInfo,
        lent: &Lent<'_>,
        finished: vk::ImageLayout,
    ) -> Result<Self, GpuError> {
        let pass = PassInfo {
            target: info,
            finished,
            depth_kept: !lent.depths.is_empty(),
            density_map: !lent.density_maps.is_empty(),
        };
        Ok(Self {
            info,
            pass: Arc::new(Pass::new(device, &pass)?),
            framebuffers: Vec::new(),
            depths: 1,
            finished: None,
            _transient: Vec::new(),
            views: Vec::new(),
            device: Arc::clone(device),
        })
    }

    fn make(&mut self, lent: &Lent<'_>) -> Result<(), GpuError> {
        let device = Arc::clone(&self.device);
        let info = self.info;
        let resolves = info.resolves();
        let transient = vk::ImageUsageFlags::TRANSIENT_ATTACHMENT;
        let color = vk::ImageUsageFlags::COLOR_ATTACHMENT | transient;
        let depth = vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT | transient;
        let image = |name, format, usage| {
            let info =
                ImageInfo { subsampled: lent.subsampled, ..attachment(info, format, info.samples, usage) };
            Image::new(&device, name, info)
        };
        // Samples where they are resolved, and a depth wherever nobody lent one to be written directly.
        if resolves {
            self._transient.push(image("samples", info.format, color)?);
        }
        if resolves || lent.depths.is_empty() {
            self._transient.push(image("depth", DEPTH_FORMAT, depth)?);
        }
        let colors = self.lend(lent.colors, info.format, info.views)?;
        let depths = self.lend(lent.depths, DEPTH_FORMAT, info.views)?;
        let layers = info.views;
        let densities = self.lend(lent.density_maps, vk::Format::R8G8_UNORM, layers)?;
        self.depths = depths.len().max(1);
        for (index, &color) in colors.iter().enumerate() {
            for turn in 0..self.depths {
                let depth = depths.get(turn);
                let mut views: Vec<vk::ImageView> = self._transient.iter().map(|image| image.view).collect();
                if resolves {
                    views.push(color);
                    views.extend(depth);
                } else {
                    views.insert(0, color);
                    views.extend(depth);
                }
                views.extend(densities.get(index));
                let create = vk::FramebufferCreateInfo::default()
                    .render_pass(self.pass.raw)
                    .attachments(&views)
                    .width(info.extent.width)
                    .height(info.extent.height)
                    .layers(1);
                // SAFETY: pass and views are alive and match each other.
                let framebuffer = unsafe { device.raw.create_framebuffer(&create, None) }
                    .doing("creating a framebuffer")?;
                self.framebuffers.push(framebuffer);
            }
        }
        Ok(())
    }

    /// Views of all layers of lent images, kept to be destroyed.
    fn lend(
        &mut self,
        images: &[vk::Image],
        format: vk::Format,
        layers: u32,
    ) -> Result<Vec<vk::ImageView>, GpuError> {
        let aspect =
            if format == DEPTH_FORMAT { vk::ImageAspectFlags::DEPTH } else { vk::ImageAspectFlags::COLOR };
        let first = self.views.len();
        for &image in images {
            let range =
                vk::ImageSubresourceRange::default().aspect_mask(aspect).level_count(1).layer_count(layers);
            let create = vk::ImageViewCreateInfo::default()
                .image(image)
                .view_type(vk::ImageViewType::TYPE_2D_ARRAY)
                .format(format)
                .subresource_range(range);
            // SAFETY: the lender keeps the image, which has these layers.
            let view = unsafe { self.device.raw.create_image_view(&create, None) }
                .doing("creating an image view")?;
            self.views.push(view);
        }
        Ok(self.views[first..].to_vec())
    }

    /// Begins the pass into the images of `turn`, colour cleared to `clear` and depth to 0, and sets viewport and scissor.
    pub fn begin(&self, commands: Recorder<'_>, turn: Turn, clear: [f32; 4]) {
        let clears = [
            vk::ClearValue { color: vk::ClearColorValue { float32: clear } },
            vk::ClearValue { depth_stencil: vk::ClearDepthStencilValue { depth: 0.0, stencil: 0 } },
        ];
        let framebuffer = self.framebuffers[turn.color * self.depths + turn.depth];
        commands.begin_pass((self.pass.raw, framebuffer), self.info.extent, &clears);
    }

    /// Ends the pass; a finished image of our own is then in `TRANSFER_SRC_OPTIMAL`.
    pub fn end(&self, commands: Recorder<'_>) {
        // SAFETY: the pass begun by `begin` is open.
        unsafe { self.device.raw.cmd_end_render_pass(commands.raw) };
    }

    /// What pipelines that draw into it are compiled for.
    pub const fn pass(&self) -> &Arc<Pass> {
        &self.pass
    }

    /// The device it is on.
    pub const fn device(&self) -> &Arc<Device> {
        &self.device
    }

    /// The finished image, where it is the target's own: in `TRANSFER_SRC_OPTIMAL` after the pass.
    pub const fn finished(&self) -> Option<&Image> {
        self.finished.as_ref()
    }

    /// Records a copy of the target's own finished image, view after view, to the start of `buffer`.
    pub fn copy_to(&self, commands: Recorder<'_>, buffer: &Buffer) {
        if let Some(finished) = &self.finished {
            commands.copy_from_image(finished, buffer);
        }
    }

    /// Bytes of one finished image, all views: the formats that are copied from have four bytes a texel.
    pub fn bytes(&self) -> u64 {
        self.info.bytes(4)
    }
}

impl Drop for Target {
    fn drop(&mut self) {
        // SAFETY: owners drop targets only after the frames that use them have ended.
        unsafe {
            for &framebuffer in &self.framebuffers {
                self.device.raw.destroy_framebuffer(framebuffer, None);
            }
            for &view in &self.views {
                self.device.raw.destroy_image_view(view, None);
            }
        }
    }
}

fn attachment(
    info: TargetInfo,
    format: vk::Format,
    samples: vk::SampleCountFlags,
    usage: vk::ImageUsageFlags,
) -> ImageInfo {
    ImageInfo {
        extent: [info.extent.width, info.extent.height],
        layers: info.views,
        mips: 1,
        format,
        samples,
        usage,
        view: vk::ImageViewType::TYPE_2D_ARRAY,
        subsampled: false,
        recast: false,
    }
}

fn check_limits(device: &Device, info: TargetInfo) -> Result<(), GpuError> {
    let limits = &device.physical.limits;
    let limit =
        limits.max_image_dimension2_d.min(limits.max_framebuffer_width).min(limits.max_framebuffer_height);
    for (what, value) in [("an image width", info.extent.width), ("an image height", info.extent.height)] {
        if value > limit || value == 0 {
            return Err(GpuError::Limit { what, value: u64::from(value), limit: u64::from(limit) });
        }
    }
    Ok(())
}
