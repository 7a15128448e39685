//! A pass over a finished picture or an empty one, for what is drawn on a screen or a panel and not in the world.
//!
//! Colours are blended as they are encoded (sRGB), which is how people who draw user interfaces mean them: the pass sees the
//! picture through a view that encodes nothing. One sample a pixel, no depth, one layer.

use super::device::Device;
use super::error::{Doing, GpuError};
use super::image::Image;
use super::pipeline::{Pipeline, PipelineInfo};
use super::recorder::Recorder;
use ash::vk;
use std::sync::Arc;

const ONE: vk::SampleCountFlags = vk::SampleCountFlags::TYPE_1;

/// The pass, and the picture it draws on.
pub struct Overlay {
    /// Pixels.
    pub extent: [u32; 2],
    pass: vk::RenderPass,
    view: vk::ImageView,
    framebuffer: vk::Framebuffer,
    device: Arc<Device>,
}

impl Overlay {
    /// A pass over the first layer of `picture`, a target's own finished image of [`vk::Format::R8G8B8A8_SRGB`], which has to
    /// outlive it. The picture is in `TRANSFER_SRC_OPTIMAL` before and after.
    ///
    /// # Errors
    /// Out of memory.
    pub fn new(device: &Arc<Device>, picture: &Image) -> Result<Self, GpuError> {
        let format = vk::Format::R8G8B8A8_UNORM;
        Self::over(device, (picture.raw, picture.info.extent), format, Ground::Picture)
    }

    /// A pass over the first layer of `image`, which somebody lends: of 8-bit sRGB colours in `format`, `extent` pixels large, made
    /// to be seen in other formats. It is black first, and left in `COLOR_ATTACHMENT_OPTIMAL`.
    ///
    /// # Errors
    /// Out of memory.
    pub fn lent(
        device: &Arc<Device>,
        image: vk::Image,
        extent: [u32; 2],
        format: vk::Format,
    ) -> Result<Self, GpuError> {
        let format = match format {
            vk::Format::B8G8R8A8_SRGB => vk::Format::B8G8R8A8_UNORM,
            _ => vk::Format::R8G8B8A8_UNORM,
        };
        Self::over(device, (image, extent), format, Ground::Black)
    }

    fn over(
        device: &Arc<Device>,
        (image, extent): (vk::Image, [u32; 2]),
        format: vk::Format,
        ground: Ground,
    ) -> Result<Self, GpuError> {
        let mut overlay = Self {
            extent,
            pass: create_pass(device, format, ground)?,
            view: vk::ImageView::null(),
            framebuffer: vk::Framebuffer::null(),
            device: Arc::clone(device),
        };
        device.name(overlay.pass, "overlay pass");
        let range = vk::ImageSubresourceRange::default()
            .aspect_mask(vk::ImageAspectFlags::COLOR)
            .level_count(1)
            .layer_count(1);
        let view = vk::ImageViewCreateInfo::default()
            .image(image)
            .view_type(vk::ImageViewType::TYPE_2D)
            .format(format)
            .subresource_range(range);
        // SAFETY: the picture is alive, and was made to be seen in other formats of its size.
        let made = unsafe { device.raw.create_image_view(&view, None) };
        overlay.view = made.doing("creating an image view")?;
        let views = [overlay.view];
        let create = vk::FramebufferCreateInfo::default()
            .render_pass(overlay.pass)
            .attachments(&views)
            .width(overlay.extent[0])
            .height(overlay.extent[1])
            .layers(1);
        // SAFETY: pass and view are alive and match each other.
        let made = unsafe { device.raw.create_framebuffer(&create, None) };
        overlay.framebuffer = made.doing("creating a framebuffer")?;
        Ok(overlay)
    }

    /// Compiles a pipeline for this pass; it is good for every other overlay too.
    ///
    /// # Errors
    /// The driver refuses.
    pub fn pipeline(
        &self,
        layout: vk::PipelineLayout,
        info: &PipelineInfo<'_>,
    ) -> Result<Pipeline, GpuError> {
        Pipeline::within(&self.device, (self.pass, ONE), layout, info)
    }

    /// Begins the pass, and sets viewport and scissor to all of the picture.
    pub fn begin(&self, commands: Recorder<'_>) {
        let [width, height] = self.extent;
        commands.begin_pass(
            (self.pass, self.framebuffer),
            vk::Extent2D { width, height },
            &[vk::ClearValue::default()],
        );
    }

    /// Ends the pass.
    pub fn end(&self, commands: Recorder<'_>) {
        // SAFETY: the pass begun by `begin` is open.
        unsafe { self.device.raw.cmd_end_render_pass(commands.raw) };
    }
}

impl Drop for Overlay {
    fn drop(&mut self) {
        // SAFETY: owners drop overlays only after the frames that use them have ended. Null handles are ignored.
        unsafe {
            self.device.raw.destroy_framebuffer(self.framebuffer, None);
            self.device.raw.destroy_image_view(self.view, None);
            self.device.raw.destroy_render_pass(self.pass, None);
        }
    }
}

/// What is drawn over.
#[derive(Clone, Copy)]
enum Ground {
    /// What was drawn before.
    Picture,
    /// Nothing.
    Black,
}

fn create_pass(device: &Device, format: vk::Format, ground: Ground) -> Result<vk::RenderPass, GpuError> {
    use vk::{AccessFlags as A, PipelineStageFlags as S};
    let (load, from, to) = match ground {
        Ground::Picture => {
            let layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
            (vk::AttachmentLoadOp::LOAD, layout, layout)
        }
        Ground::Black => {
            let (from, to) = (vk::ImageLayout::UNDEFINED, vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL);
            (vk::AttachmentLoadOp::CLEAR, from, to)
        }
    };
    let attachments = [vk::AttachmentDescription::default()
        .format(format)
        .samples(ONE)
        .load_op(load)
        .store_op(vk::AttachmentStoreOp::STORE)
        .stencil_load_op(vk::AttachmentLoadOp::DONT_CARE)
        .stencil_store_op(vk::AttachmentStoreOp::DONT_CARE)
        .initial_layout(from)
        .final_layout(to)];
    let colors =
        [vk::AttachmentReference::default().attachment(0).layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)];
    let subpasses = [vk::SubpassDescription::default()
        .pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS)
        .color_attachments(&colors)];
    let drawn = (S::COLOR_ATTACHMENT_OUTPUT, A::COLOR_ATTACHMENT_WRITE | A::COLOR_ATTACHMENT_READ);
    let dependencies = [
        // The picture was drawn just before, and copied from in an earlier frame.
        vk::SubpassDependency::default()
            .src_subpass(vk::SUBPASS_EXTERNAL)
            .dst_subpass(0)
            .src_stage_mask(S::COLOR_ATTACHMENT_OUTPUT | S::TRANSFER)
            .src_access_mask(A::COLOR_ATTACHMENT_WRITE)
            .dst_stage_mask(drawn.0)
            .dst_access_mask(drawn.1),
        vk::SubpassDependency::default()
            .src_subpass(0)
            .dst_subpass(vk::SUBPASS_EXTERNAL)
            .src_stage_mask(drawn.0)
            .src_access_mask(A::COLOR_ATTACHMENT_WRITE)
            .dst_stage_mask(S::TRANSFER)
            .dst_access_mask(A::TRANSFER_READ),
    ];
    let create = vk::RenderPassCreateInfo::default()
        .attachments(&attachments)
        .subpasses(&subpasses)
        .dependencies(&dependencies);
    // SAFETY: `create` refers to locals that live past the call.
    unsafe { device.raw.create_render_pass(&create, None) }.doing("creating a render pass")
}
