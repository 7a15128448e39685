//! What a frame is drawn into: colour and depth attachments, their render pass and framebuffer.
//!
//! One pass with one subpass. With more than one sample the colour is resolved inside the pass, so that on a tiled GPU
//! neither the samples nor the depth ever leave the tile.

use super::buffer::Buffer;
use super::device::Device;
use super::error::{Doing, GpuError};
use super::image::{Image, ImageInfo};
use super::recorder::Recorder;
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

/// A render pass with images of its own; after it the finished image is ready to be copied from.
pub struct Target {
    /// What it was made as.
    pub info: TargetInfo,
    /// The pass.
    pub pass: vk::RenderPass,
    framebuffer: vk::Framebuffer,
    finished: Image,
    /// Samples and depth: the framebuffer refers to them.
    _transient: Vec<Image>,
    device: Arc<Device>,
}

impl Target {
    /// Makes the images, the pass and the framebuffer.
    ///
    /// # Errors
    /// Out of memory, or a size beyond the device's limit.
    pub fn new(device: &Arc<Device>, info: TargetInfo) -> Result<Self, GpuError> {
        let limits = &device.physical.limits;
        let limit = limits
            .max_image_dimension2_d
            .min(limits.max_framebuffer_width)
            .min(limits.max_framebuffer_height);
        for (what, value) in [("an image width", info.extent.width), ("an image height", info.extent.height)]
        {
            if value > limit || value == 0 {
                return Err(GpuError::Limit { what, value: u64::from(value), limit: u64::from(limit) });
            }
        }
        let attachment = |format, samples, usage| ImageInfo {
            extent: [info.extent.width, info.extent.height],
            layers: info.views,
            mips: 1,
            format,
            samples,
            usage,
            view: vk::ImageViewType::TYPE_2D_ARRAY,
        };
        let transient = vk::ImageUsageFlags::TRANSIENT_ATTACHMENT;
        let color = vk::ImageUsageFlags::COLOR_ATTACHMENT;
        let depth = vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT;
        let one = vk::SampleCountFlags::TYPE_1;
        let finished = Image::new(
            device,
            "finished colour",
            attachment(info.format, one, color | vk::ImageUsageFlags::TRANSFER_SRC),
        )?;
        let mut images =
            vec![Image::new(device, "depth", attachment(DEPTH_FORMAT, info.samples, depth | transient))?];
        let resolves = info.samples != one;
        if resolves {
            images.push(Image::new(
                device,
                "samples",
                attachment(info.format, info.samples, color | transient),
            )?);
        }
        let mut target = Self {
            info,
            pass: vk::RenderPass::null(),
            framebuffer: vk::Framebuffer::null(),
            finished,
            _transient: images,
            device: Arc::clone(device),
        };
        target.pass = render_pass(device, info)?;
        let drawn = target._transient.get(1).unwrap_or(&target.finished).view;
        let mut views = vec![drawn, target._transient[0].view];
        if resolves {
            views.push(target.finished.view);
        }
        let create = vk::FramebufferCreateInfo::default()
            .render_pass(target.pass)
            .attachments(&views)
            .width(info.extent.width)
            .height(info.extent.height)
            .layers(1);
        // SAFETY: pass and views are alive and match each other.
        target.framebuffer =
            unsafe { device.raw.create_framebuffer(&create, None) }.doing("creating a framebuffer")?;
        Ok(target)
    }

    /// Begins the pass with colour cleared to `clear` and depth to 0, and sets viewport and scissor.
    pub fn begin(&self, commands: Recorder<'_>, clear: [f32; 4]) {
        let clears = [
            vk::ClearValue { color: vk::ClearColorValue { float32: clear } },
            vk::ClearValue { depth_stencil: vk::ClearDepthStencilValue { depth: 0.0, stencil: 0 } },
        ];
        let area = vk::Rect2D { offset: vk::Offset2D::default(), extent: self.info.extent };
        let begin = vk::RenderPassBeginInfo::default()
            .render_pass(self.pass)
            .framebuffer(self.framebuffer)
            .render_area(area)
            .clear_values(&clears);
        #[expect(clippy::cast_precision_loss, reason = "sizes are far below 2^24")]
        let (width, height) = (self.info.extent.width as f32, self.info.extent.height as f32);
        let viewport = vk::Viewport { x: 0.0, y: 0.0, width, height, min_depth: 0.0, max_depth: 1.0 };
        // SAFETY: `commands` is recording outside a pass; pass and framebuffer are alive.
        unsafe {
            self.device.raw.cmd_begin_render_pass(commands.raw, &begin, vk::SubpassContents::INLINE);
            self.device.raw.cmd_set_viewport(commands.raw, 0, &[viewport]);
            self.device.raw.cmd_set_scissor(commands.raw, 0, &[area]);
        }
    }

    /// Ends the pass; the finished image is then in `TRANSFER_SRC_OPTIMAL`.
    pub fn end(&self, commands: Recorder<'_>) {
        // SAFETY: the pass begun by `begin` is open.
        unsafe { self.device.raw.cmd_end_render_pass(commands.raw) };
    }

    /// Records a copy of the finished image, view after view, to the start of `buffer`.
    pub fn copy_to(&self, commands: Recorder<'_>, buffer: &Buffer) {
        let region = [self.finished.copy_region(0, 0)];
        let layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
        let barrier = vk::MemoryBarrier::default()
            .src_access_mask(vk::AccessFlags::TRANSFER_WRITE)
            .dst_access_mask(vk::AccessFlags::HOST_READ);
        // SAFETY: the pass has ended, which made the image readable by copies; the buffer holds all its texels.
        unsafe {
            self.device.raw.cmd_copy_image_to_buffer(
                commands.raw,
                self.finished.raw,
                layout,
                buffer.raw,
                &region,
            );
            self.device.raw.cmd_pipeline_barrier(
                commands.raw,
                vk::PipelineStageFlags::TRANSFER,
                vk::PipelineStageFlags::HOST,
                vk::DependencyFlags::empty(),
                &[barrier],
                &[],
                &[],
            );
        }
    }

    /// Bytes of one finished image, all views: both formats in use have four bytes a texel.
    pub fn bytes(&self) -> u64 {
        4 * u64::from(self.info.extent.width)
            * u64::from(self.info.extent.height)
            * u64::from(self.info.views)
    }
}

impl Drop for Target {
    fn drop(&mut self) {
        // SAFETY: owners drop targets only after the frames that use them have ended.
        unsafe {
            self.device.raw.destroy_framebuffer(self.framebuffer, None);
            self.device.raw.destroy_render_pass(self.pass, None);
        }
    }
}

/// Attachments: 0 colour (samples, or the image itself), 1 depth, 2 the resolved image where there are samples.
fn render_pass(device: &Device, info: TargetInfo) -> Result<vk::RenderPass, GpuError> {
    let resolves = info.samples != vk::SampleCountFlags::TYPE_1;
    let attachment = |format, samples, load, store, layout| {
        vk::AttachmentDescription::default()
            .format(format)
            .samples(samples)
            .load_op(load)
            .store_op(store)
            .stencil_load_op(vk::AttachmentLoadOp::DONT_CARE)
            .stencil_store_op(vk::AttachmentStoreOp::DONT_CARE)
            .initial_layout(vk::ImageLayout::UNDEFINED)
            .final_layout(layout)
    };
    let (clear, ignore) = (vk::AttachmentLoadOp::CLEAR, vk::AttachmentLoadOp::DONT_CARE);
    let (store, drop) = (vk::AttachmentStoreOp::STORE, vk::AttachmentStoreOp::DONT_CARE);
    let color_layout = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
    let depth_layout = vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    let copied = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
    let depth = attachment(DEPTH_FORMAT, info.samples, clear, drop, depth_layout);
    let mut attachments = if resolves {
        vec![attachment(info.format, info.samples, clear, drop, color_layout), depth]
    } else {
        vec![attachment(info.format, info.samples, clear, store, copied), depth]
    };
    if resolves {
        attachments.push(attachment(info.format, vk::SampleCountFlags::TYPE_1, ignore, store, copied));
    }
    let refer = |index, layout| vk::AttachmentReference::default().attachment(index).layout(layout);
    let (colors, depth, resolved) =
        ([refer(0, color_layout)], refer(1, depth_layout), [refer(2, color_layout)]);
    let mut subpass = vk::SubpassDescription::default()
        .pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS)
        .color_attachments(&colors)
        .depth_stencil_attachment(&depth);
    if resolves {
        subpass = subpass.resolve_attachments(&resolved);
    }
    use vk::{AccessFlags as A, PipelineStageFlags as S};
    let tests = S::EARLY_FRAGMENT_TESTS | S::LATE_FRAGMENT_TESTS;
    let dependencies = [
        // The frame before may still write these images, or be copied from.
        vk::SubpassDependency::default()
            .src_subpass(vk::SUBPASS_EXTERNAL)
            .dst_subpass(0)
            .src_stage_mask(S::COLOR_ATTACHMENT_OUTPUT | tests | S::TRANSFER)
            .src_access_mask(A::COLOR_ATTACHMENT_WRITE | A::DEPTH_STENCIL_ATTACHMENT_WRITE)
            .dst_stage_mask(S::COLOR_ATTACHMENT_OUTPUT | tests)
            .dst_access_mask(
                A::COLOR_ATTACHMENT_WRITE
                    | A::COLOR_ATTACHMENT_READ
                    | A::DEPTH_STENCIL_ATTACHMENT_WRITE
                    | A::DEPTH_STENCIL_ATTACHMENT_READ,
            ),
        vk::SubpassDependency::default()
            .src_subpass(0)
            .dst_subpass(vk::SUBPASS_EXTERNAL)
            .src_stage_mask(S::COLOR_ATTACHMENT_OUTPUT)
            .src_access_mask(A::COLOR_ATTACHMENT_WRITE)
            .dst_stage_mask(S::TRANSFER)
            .dst_access_mask(A::TRANSFER_READ),
    ];
    let view_masks = [(1_u32 << info.views) - 1];
    let mut multiview =
        vk::RenderPassMultiviewCreateInfo::default().view_masks(&view_masks).correlation_masks(&view_masks);
    let subpasses = [subpass];
    let create = vk::RenderPassCreateInfo::default()
        .attachments(&attachments)
        .subpasses(&subpasses)
        .dependencies(&dependencies)
        .push_next(&mut multiview);
    // SAFETY: `create` refers to locals that live past the call.
    let pass = unsafe { device.raw.create_render_pass(&create, None) }.doing("creating a render pass")?;
    device.name(pass, "ocean pass");
    Ok(pass)
}
