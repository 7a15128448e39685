//! The one render pass: attachments, multiview, and what goes before and after.
//!
//! Attachments: 0 colour (samples, or the finished image itself), 1 depth; then, as far as they are there, the resolved
//! colour, the resolved depth and the fragment density map, in this order.

use super::device::Device;
use super::error::{Doing, GpuError};
use super::target::{DEPTH_FORMAT, TargetInfo};
use ash::vk;
use std::sync::Arc;

/// How a pass leaves its images.
#[derive(Clone, Copy, Debug)]
pub(super) struct PassInfo {
    pub target: TargetInfo,
    /// Layout of the finished colour after the pass.
    pub finished: vk::ImageLayout,
    /// Depth is kept after the pass, for whoever reads it.
    pub depth_kept: bool,
    /// There is a fragment density map.
    pub density_map: bool,
}

impl PassInfo {
    pub fn resolves(&self) -> bool {
        self.target.resolves()
    }
}

/// One attachment, in the words that both forms of `vkCreateRenderPass` share.
struct Attachment {
    format: vk::Format,
    samples: vk::SampleCountFlags,
    load: vk::AttachmentLoadOp,
    store: vk::AttachmentStoreOp,
    from: vk::ImageLayout,
    to: vk::ImageLayout,
}

const COLOR: vk::ImageLayout = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
const DEPTH: vk::ImageLayout = vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
const DENSITY: vk::ImageLayout = vk::ImageLayout::FRAGMENT_DENSITY_MAP_OPTIMAL_EXT;

fn attachments(info: &PassInfo) -> Vec<Attachment> {
    let (clear, ignore) = (vk::AttachmentLoadOp::CLEAR, vk::AttachmentLoadOp::DONT_CARE);
    let (keep, drop) = (vk::AttachmentStoreOp::STORE, vk::AttachmentStoreOp::DONT_CARE);
    let one = vk::SampleCountFlags::TYPE_1;
    let from = vk::ImageLayout::UNDEFINED;
    let TargetInfo { format, samples, .. } = info.target;
    let (color, depth) = if info.resolves() {
        ((drop, COLOR), drop)
    } else {
        ((keep, info.finished), if info.depth_kept { keep } else { drop })
    };
    let mut all = vec![
        Attachment { format, samples, load: clear, store: color.0, from, to: color.1 },
        Attachment { format: DEPTH_FORMAT, samples, load: clear, store: depth, from, to: DEPTH },
    ];
    if info.resolves() {
        all.push(Attachment { format, samples: one, load: ignore, store: keep, from, to: info.finished });
        if info.depth_kept {
            let format = DEPTH_FORMAT;
            all.push(Attachment { format, samples: one, load: ignore, store: keep, from, to: DEPTH });
        }
    }
    if info.density_map {
        let format = vk::Format::R8G8_UNORM;
        let load = vk::AttachmentLoadOp::LOAD;
        all.push(Attachment { format, samples: one, load, store: drop, from: DENSITY, to: DENSITY });
    }
    all
}

/// What came before may still use these images, and what comes after reads the finished one.
fn dependencies() -> [vk::SubpassDependency; 2] {
    use vk::{AccessFlags as A, PipelineStageFlags as S};
    let tests = S::EARLY_FRAGMENT_TESTS | S::LATE_FRAGMENT_TESTS;
    [
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
    ]
}

/// What pipelines are compiled for: a target's pass. They are good for every target that was made alike, of any size, and a pass
/// may outlive its target.
pub struct Pass {
    pub(super) raw: vk::RenderPass,
    pub(super) samples: vk::SampleCountFlags,
    device: Arc<Device>,
}

impl Pass {
    /// Creates the pass.
    ///
    /// # Errors
    /// Out of memory, or depth samples are to be kept on a device that cannot resolve them.
    pub(super) fn new(device: &Arc<Device>, info: &PassInfo) -> Result<Self, GpuError> {
        let raw =
            if info.resolves() && info.depth_kept { second(device, info) } else { first(device, info) }?;
        device.name(raw, "ocean pass");
        Ok(Self { raw, samples: info.target.samples, device: Arc::clone(device) })
    }
}

impl Drop for Pass {
    fn drop(&mut self) {
        // SAFETY: frames that use it have ended when the targets and pipelines that share it go.
        unsafe { self.device.raw.destroy_render_pass(self.raw, None) };
    }
}

/// The density map's place, last of all attachments.
fn density_map(count: usize) -> vk::RenderPassFragmentDensityMapCreateInfoEXT<'static> {
    let last = vk::AttachmentReference::default().attachment(count as u32 - 1).layout(DENSITY);
    vk::RenderPassFragmentDensityMapCreateInfoEXT::default().fragment_density_map_attachment(last)
}

/// Vulkan 1.0's form, with multiview chained.
fn first(device: &Device, info: &PassInfo) -> Result<vk::RenderPass, GpuError> {
    let attachments: Vec<_> = attachments(info)
        .iter()
        .map(|a| {
            vk::AttachmentDescription::default()
                .format(a.format)
                .samples(a.samples)
                .load_op(a.load)
                .store_op(a.store)
                .stencil_load_op(vk::AttachmentLoadOp::DONT_CARE)
                .stencil_store_op(vk::AttachmentStoreOp::DONT_CARE)
                .initial_layout(a.from)
                .final_layout(a.to)
        })
        .collect();
    let refer = |index, layout| vk::AttachmentReference::default().attachment(index).layout(layout);
    let (colors, depth, resolved) = ([refer(0, COLOR)], refer(1, DEPTH), [refer(2, COLOR)]);
    let mut subpass = vk::SubpassDescription::default()
        .pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS)
        .color_attachments(&colors)
        .depth_stencil_attachment(&depth);
    if info.resolves() {
        subpass = subpass.resolve_attachments(&resolved);
    }
    let view_masks = [info.target.view_mask()];
    let mut multiview =
        vk::RenderPassMultiviewCreateInfo::default().view_masks(&view_masks).correlation_masks(&view_masks);
    let (subpasses, dependencies) = ([subpass], dependencies());
    let mut density = density_map(attachments.len());
    let mut create = vk::RenderPassCreateInfo::default()
        .attachments(&attachments)
        .subpasses(&subpasses)
        .dependencies(&dependencies)
        .push_next(&mut multiview);
    if info.density_map {
        create = create.push_next(&mut density);
    }
    // SAFETY: `create` refers to locals that live past the call.
    unsafe { device.raw.create_render_pass(&create, None) }.doing("creating a render pass")
}

/// `VK_KHR_create_renderpass2`'s form, which can resolve depth.
fn second(device: &Device, info: &PassInfo) -> Result<vk::RenderPass, GpuError> {
    let create_pass = device.render_pass2.as_ref().ok_or_else(|| GpuError::Missing {
        device: device.physical.name.clone(),
        feature: "VK_KHR_depth_stencil_resolve, which keeping depth samples needs".to_owned(),
    })?;
    let attachments: Vec<_> = attachments(info)
        .iter()
        .map(|a| {
            vk::AttachmentDescription2::default()
                .format(a.format)
                .samples(a.samples)
                .load_op(a.load)
                .store_op(a.store)
                .stencil_load_op(vk::AttachmentLoadOp::DONT_CARE)
                .stencil_store_op(vk::AttachmentStoreOp::DONT_CARE)
                .initial_layout(a.from)
                .final_layout(a.to)
        })
        .collect();
    let refer = |index, layout, aspect| {
        vk::AttachmentReference2::default().attachment(index).layout(layout).aspect_mask(aspect)
    };
    let (color, depth) = (vk::ImageAspectFlags::COLOR, vk::ImageAspectFlags::DEPTH);
    let (colors, resolved) = ([refer(0, COLOR, color)], [refer(2, COLOR, color)]);
    let (depth_samples, depth_resolved) = (refer(1, DEPTH, depth), refer(3, DEPTH, depth));
    // Between two surfaces a mean depth is the depth of neither: one sample's stands for the pixel.
    let mut resolve = vk::SubpassDescriptionDepthStencilResolve::default()
        .depth_resolve_mode(vk::ResolveModeFlags::SAMPLE_ZERO)
        .stencil_resolve_mode(vk::ResolveModeFlags::NONE)
        .depth_stencil_resolve_attachment(&depth_resolved);
    let view_masks = [info.target.view_mask()];
    let subpasses = [vk::SubpassDescription2::default()
        .pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS)
        .view_mask(view_masks[0])
        .color_attachments(&colors)
        .resolve_attachments(&resolved)
        .depth_stencil_attachment(&depth_samples)
        .push_next(&mut resolve)];
    let dependencies = dependencies().map(|d| {
        vk::SubpassDependency2::default()
            .src_subpass(d.src_subpass)
            .dst_subpass(d.dst_subpass)
            .src_stage_mask(d.src_stage_mask)
            .src_access_mask(d.src_access_mask)
            .dst_stage_mask(d.dst_stage_mask)
            .dst_access_mask(d.dst_access_mask)
    });
    let mut density = density_map(attachments.len());
    let mut create = vk::RenderPassCreateInfo2::default()
        .attachments(&attachments)
        .subpasses(&subpasses)
        .dependencies(&dependencies)
        .correlated_view_masks(&view_masks);
    if info.density_map {
        create = create.push_next(&mut density);
    }
    // SAFETY: `create` refers to locals that live past the call.
    unsafe { create_pass.create_render_pass2(&create, None) }.doing("creating a render pass")
}
