//! A square texture of depths that is drawn in a pass of its own and then sampled: what some light sees.

use super::device::Device;
use super::error::{Doing, GpuError};
use super::image::{Image, ImageInfo};
use super::recorder::Recorder;
use ash::vk;
use std::sync::Arc;

/// 16 bits: half the memory of the picture's depth, and any device can draw and sample it.
const FORMAT: vk::Format = vk::Format::D16_UNORM;

/// The texture, its pass and framebuffer. Depth is reversed as everywhere: the greater hides the lesser, and 0 is nothing.
pub struct DepthMap {
    /// In `SHADER_READ_ONLY_OPTIMAL` after the pass.
    pub image: Image,
    pass: vk::RenderPass,
    framebuffer: vk::Framebuffer,
    device: Arc<Device>,
}

impl DepthMap {
    /// A map of `side` x `side` texels.
    ///
    /// # Errors
    /// Out of memory, or a side beyond the device's limit.
    pub fn new(device: &Arc<Device>, name: &str, side: u32) -> Result<Self, GpuError> {
        let limits = &device.physical.limits;
        let limit = limits
            .max_image_dimension2_d
            .min(limits.max_framebuffer_width)
            .min(limits.max_framebuffer_height);
        if side > limit {
            let (value, limit) = (u64::from(side), u64::from(limit));
            return Err(GpuError::Limit { what: "a depth map's side", value, limit });
        }
        let usage = vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT | vk::ImageUsageFlags::SAMPLED;
        let image = Image::new(device, name, ImageInfo { usage, ..ImageInfo::texture(side, 1, FORMAT) })?;
        let mut map = Self {
            image,
            pass: vk::RenderPass::null(),
            framebuffer: vk::Framebuffer::null(),
            device: Arc::clone(device),
        };
        map.pass = create_pass(device)?;
        device.name(map.pass, name);
        let views = [map.image.view];
        let create = vk::FramebufferCreateInfo::default()
            .render_pass(map.pass)
            .attachments(&views)
            .width(side)
            .height(side)
            .layers(1);
        // SAFETY: pass and view are alive and match each other.
        let made = unsafe { device.raw.create_framebuffer(&create, None) };
        map.framebuffer = made.doing("creating a framebuffer")?;
        Ok(map)
    }

    /// The pass that pipelines are made for.
    pub(super) const fn pass(&self) -> vk::RenderPass {
        self.pass
    }

    /// Begins the pass, all depths 0, and sets viewport and scissor. What sampled the map before has ended by then.
    pub fn begin(&self, commands: Recorder<'_>) {
        let clears =
            [vk::ClearValue { depth_stencil: vk::ClearDepthStencilValue { depth: 0.0, stencil: 0 } }];
        let [width, height] = self.image.info.extent;
        commands.begin_pass((self.pass, self.framebuffer), vk::Extent2D { width, height }, &clears);
    }

    /// Ends the pass: fragment shaders may sample the map from here on.
    pub fn end(&self, commands: Recorder<'_>) {
        // SAFETY: the pass begun by `begin` is open.
        unsafe { self.device.raw.cmd_end_render_pass(commands.raw) };
    }
}

impl Drop for DepthMap {
    fn drop(&mut self) {
        // SAFETY: owners drop maps only after the frames that use them have ended; null handles are ignored.
        unsafe {
            self.device.raw.destroy_framebuffer(self.framebuffer, None);
            self.device.raw.destroy_render_pass(self.pass, None);
        }
    }
}

/// One depth attachment, cleared and kept; between what sampled it before and what samples it after.
fn create_pass(device: &Device) -> Result<vk::RenderPass, GpuError> {
    use vk::{AccessFlags as A, ImageLayout as L, PipelineStageFlags as S};
    let attachments = [vk::AttachmentDescription::default()
        .format(FORMAT)
        .samples(vk::SampleCountFlags::TYPE_1)
        .load_op(vk::AttachmentLoadOp::CLEAR)
        .store_op(vk::AttachmentStoreOp::STORE)
        .stencil_load_op(vk::AttachmentLoadOp::DONT_CARE)
        .stencil_store_op(vk::AttachmentStoreOp::DONT_CARE)
        .initial_layout(L::UNDEFINED)
        .final_layout(L::SHADER_READ_ONLY_OPTIMAL)];
    let depth = vk::AttachmentReference::default().attachment(0).layout(L::DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
    let subpasses = [vk::SubpassDescription::default()
        .pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS)
        .depth_stencil_attachment(&depth)];
    let tests = S::EARLY_FRAGMENT_TESTS | S::LATE_FRAGMENT_TESTS;
    let (read, write) = (A::DEPTH_STENCIL_ATTACHMENT_READ, A::DEPTH_STENCIL_ATTACHMENT_WRITE);
    let dependencies = [
        vk::SubpassDependency::default()
            .src_subpass(vk::SUBPASS_EXTERNAL)
            .dst_subpass(0)
            .src_stage_mask(S::FRAGMENT_SHADER | tests)
            .src_access_mask(write)
            .dst_stage_mask(tests)
            .dst_access_mask(read | write),
        vk::SubpassDependency::default()
            .src_subpass(0)
            .dst_subpass(vk::SUBPASS_EXTERNAL)
            .src_stage_mask(tests)
            .src_access_mask(write)
            .dst_stage_mask(S::FRAGMENT_SHADER)
            .dst_access_mask(A::SHADER_READ),
    ];
    let create = vk::RenderPassCreateInfo::default()
        .attachments(&attachments)
        .subpasses(&subpasses)
        .dependencies(&dependencies);
    // SAFETY: `create` refers to locals that live past the call.
    unsafe { device.raw.create_render_pass(&create, None) }.doing("creating a render pass")
}
