//! Graphics pipelines.

use super::device::Device;
use super::error::{Doing, GpuError};
use super::recorder::Recorder;
use super::target::Target;
use ash::vk;
use std::sync::Arc;

/// How a pipeline treats depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthUse {
    /// Nearer things hide farther ones.
    Solid,
    /// As `Solid`, moved a little towards the viewer: lines on a surface.
    Raised,
    /// Drawn at infinity, where nothing else was; writes no depth.
    Background,
    /// Neither tested nor written: over everything.
    Ignored,
}

/// What becomes of the colour that is there already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blend {
    /// It is replaced.
    Opaque,
    /// It shows through as far as alpha is below 1.
    Over,
    /// The same, by colours that were multiplied with their alpha already.
    Premultiplied,
}

/// Vertex buffers and what is in them.
#[derive(Clone, Copy, Debug, Default)]
pub struct VertexInput<'a> {
    /// Buffers.
    pub bindings: &'a [vk::VertexInputBindingDescription],
    /// Their fields.
    pub attributes: &'a [vk::VertexInputAttributeDescription],
}

/// What a pipeline is made from.
#[derive(Clone, Copy)]
pub struct PipelineInfo<'a> {
    /// Name for validation messages and captures.
    pub name: &'a str,
    /// SPIR-V of the vertex stage and its entry point.
    pub vertex: (&'a [u8], &'a std::ffi::CStr),
    /// SPIR-V of the fragment stage and its entry point.
    pub fragment: (&'a [u8], &'a std::ffi::CStr),
    /// Vertex buffers.
    pub input: VertexInput<'a>,
    /// Depth.
    pub depth: DepthUse,
    /// Blending.
    pub blend: Blend,
    /// Leave out triangles that are clockwise on the screen: the backs of closed meshes.
    pub cull: bool,
    /// Draw the triangles' edges.
    pub lines: bool,
}

/// A compiled pipeline.
pub struct Pipeline {
    raw: vk::Pipeline,
    device: Arc<Device>,
}

impl Pipeline {
    /// Compiles a pipeline for `target`'s pass.
    ///
    /// # Errors
    /// The driver refuses, or lines are asked of a device that draws none.
    pub fn new(
        device: &Arc<Device>,
        target: &Target,
        layout: vk::PipelineLayout,
        info: &PipelineInfo<'_>,
    ) -> Result<Self, GpuError> {
        Self::within(device, (target.pass, target.info.samples), layout, info)
    }

    /// The same for any pass, whose colour has so many samples.
    pub(super) fn within(
        device: &Arc<Device>,
        (pass, samples): (vk::RenderPass, vk::SampleCountFlags),
        layout: vk::PipelineLayout,
        info: &PipelineInfo<'_>,
    ) -> Result<Self, GpuError> {
        if info.lines && !device.physical.wireframe {
            let feature = "fillModeNonSolid, which --debug wireframe needs".to_owned();
            return Err(GpuError::Missing { device: device.physical.name.clone(), feature });
        }
        let vertex = Module::new(device, info.vertex.0)?;
        let fragment = Module::new(device, info.fragment.0)?;
        let stage = |flag, module: &Module, entry| {
            vk::PipelineShaderStageCreateInfo::default().stage(flag).module(module.raw).name(entry)
        };
        let stages = [
            stage(vk::ShaderStageFlags::VERTEX, &vertex, info.vertex.1),
            stage(vk::ShaderStageFlags::FRAGMENT, &fragment, info.fragment.1),
        ];
        let input = vk::PipelineVertexInputStateCreateInfo::default()
            .vertex_binding_descriptions(info.input.bindings)
            .vertex_attribute_descriptions(info.input.attributes);
        let assembly = vk::PipelineInputAssemblyStateCreateInfo::default()
            .topology(vk::PrimitiveTopology::TRIANGLE_LIST);
        let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
        let polygon = if info.lines { vk::PolygonMode::LINE } else { vk::PolygonMode::FILL };
        let raised = info.depth == DepthUse::Raised;
        let raster = vk::PipelineRasterizationStateCreateInfo::default()
            .polygon_mode(polygon)
            .cull_mode(if info.cull { vk::CullModeFlags::BACK } else { vk::CullModeFlags::NONE })
            .front_face(vk::FrontFace::COUNTER_CLOCKWISE)
            .line_width(1.0)
            .depth_bias_enable(raised)
            .depth_bias_constant_factor(8.0)
            .depth_bias_slope_factor(1.0);
        let samples = vk::PipelineMultisampleStateCreateInfo::default().rasterization_samples(samples);
        let depth = vk::PipelineDepthStencilStateCreateInfo::default()
            .depth_test_enable(info.depth != DepthUse::Ignored)
            .depth_write_enable(matches!(info.depth, DepthUse::Solid | DepthUse::Raised))
            .depth_compare_op(vk::CompareOp::GREATER_OR_EQUAL);
        let blends = [vk::PipelineColorBlendAttachmentState::default()
            .blend_enable(info.blend != Blend::Opaque)
            .src_color_blend_factor(match info.blend {
                Blend::Premultiplied => vk::BlendFactor::ONE,
                Blend::Opaque | Blend::Over => vk::BlendFactor::SRC_ALPHA,
            })
            .dst_color_blend_factor(vk::BlendFactor::ONE_MINUS_SRC_ALPHA)
            .src_alpha_blend_factor(vk::BlendFactor::ZERO)
            .dst_alpha_blend_factor(vk::BlendFactor::ONE)
            .color_write_mask(vk::ColorComponentFlags::RGBA)];
        let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(&blends);
        let dynamic = [vk::DynamicState::VIEWPORT, vk::DynamicState::SCISSOR];
        let dynamic = vk::PipelineDynamicStateCreateInfo::default().dynamic_states(&dynamic);
        let create = [vk::GraphicsPipelineCreateInfo::default()
            .stages(&stages)
            .vertex_input_state(&input)
            .input_assembly_state(&assembly)
            .viewport_state(&viewport)
            .rasterization_state(&raster)
            .multisample_state(&samples)
            .depth_stencil_state(&depth)
            .color_blend_state(&blend)
            .dynamic_state(&dynamic)
            .layout(layout)
            .render_pass(pass)];
        // SAFETY: every part referred to lives past the call; the stages were validated when Swell was built.
        let made = unsafe { device.raw.create_graphics_pipelines(device.cache.raw, &create, None) };
        let raw = made.map_err(|(_, result)| result).doing("compiling a pipeline")?[0];
        device.name(raw, info.name);
        Ok(Self { raw, device: Arc::clone(device) })
    }

    /// Draws with this pipeline from here on.
    pub fn bind(&self, commands: Recorder<'_>) {
        // SAFETY: `commands` is recording inside the pass the pipeline was made for.
        unsafe { self.device.raw.cmd_bind_pipeline(commands.raw, vk::PipelineBindPoint::GRAPHICS, self.raw) };
    }
}

impl Drop for Pipeline {
    fn drop(&mut self) {
        // SAFETY: owners drop pipelines only after the frames that use them have ended.
        unsafe { self.device.raw.destroy_pipeline(self.raw, None) };
    }
}

/// A shader module, needed only while a pipeline is made.
struct Module<'a> {
    raw: vk::ShaderModule,
    device: &'a Device,
}

impl<'a> Module<'a> {
    fn new(device: &'a Device, spirv: &[u8]) -> Result<Self, GpuError> {
        // The build wrote whole words, the lowest byte first; here they get the alignment that words need.
        let words: Vec<u32> = device
            .shader(spirv)
            .chunks_exact(4)
            .map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
            .collect();
        let info = vk::ShaderModuleCreateInfo::default().code(&words);
        // SAFETY: the words were written and validated by naga, when Swell was built or since.
        let raw = unsafe { device.raw.create_shader_module(&info, None) };
        let raw = raw.doing("creating a shader module")?;
        Ok(Self { raw, device })
    }
}

impl Drop for Module<'_> {
    fn drop(&mut self) {
        // SAFETY: pipelines keep no reference to their modules.
        unsafe { self.device.raw.destroy_shader_module(self.raw, None) };
    }
}
