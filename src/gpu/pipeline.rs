//! Graphics pipelines.

use super::depth_map::DepthMap;
use super::device::Device;
use super::error::{Doing, GpuError};
use super::recorder::Recorder;
use super::render_pass::Pass;
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

/// What a pipeline that draws depth alone is made from.
#[derive(Clone, Copy)]
pub struct DepthInfo<'a> {
    /// Name for validation messages and captures.
    pub name: &'a str,
    /// SPIR-V of the vertex stage and its entry point.
    pub vertex: (&'a [u8], &'a std::ffi::CStr),
    /// Vertex buffers.
    pub input: VertexInput<'a>,
    /// Depth is lowered by so many of its smallest steps (first), and so many times what it changes by over a texel (second).
    pub lowered: [f32; 2],
}

/// What every pipeline is made from.
struct Recipe<'a> {
    name: &'a str,
    pass: vk::RenderPass,
    samples: vk::SampleCountFlags,
    vertex: (&'a [u8], &'a std::ffi::CStr),
    /// Without one only depth is drawn.
    fragment: Option<(&'a [u8], &'a std::ffi::CStr)>,
    input: VertexInput<'a>,
    depth: DepthUse,
    /// Constant and by slope, towards the viewer.
    bias: Option<[f32; 2]>,
    blend: Blend,
    cull: bool,
    lines: bool,
}

/// A compiled pipeline.
pub struct Pipeline {
    raw: vk::Pipeline,
    device: Arc<Device>,
}

impl Pipeline {
    /// Compiles a pipeline for `pass`, of a target or one alike.
    ///
    /// # Errors
    /// The driver refuses, or lines are asked of a device that draws none.
    pub fn new(
        device: &Arc<Device>,
        pass: &Pass,
        layout: vk::PipelineLayout,
        info: &PipelineInfo<'_>,
    ) -> Result<Self, GpuError> {
        Self::within(device, (pass.raw, pass.samples), layout, info)
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
        let recipe = Recipe {
            name: info.name,
            pass,
            samples,
            vertex: info.vertex,
            fragment: Some(info.fragment),
            input: info.input,
            depth: info.depth,
            bias: (info.depth == DepthUse::Raised).then_some([8.0, 1.0]),
            blend: info.blend,
            cull: info.cull,
            lines: info.lines,
        };
        Self::create(device, layout, &recipe)
    }

    /// Compiles a pipeline that draws triangles of either side into `map`.
    ///
    /// # Errors
    /// The driver refuses.
    pub fn depth_only(
        device: &Arc<Device>,
        map: &DepthMap,
        layout: vk::PipelineLayout,
        info: &DepthInfo<'_>,
    ) -> Result<Self, GpuError> {
        let recipe = Recipe {
            name: info.name,
            pass: map.pass(),
            samples: vk::SampleCountFlags::TYPE_1,
            vertex: info.vertex,
            fragment: None,
            input: info.input,
            depth: DepthUse::Solid,
            bias: Some(info.lowered.map(|factor| -factor)),
            blend: Blend::Opaque,
            cull: false,
            lines: false,
        };
        Self::create(device, layout, &recipe)
    }

    fn create(device: &Arc<Device>, layout: vk::PipelineLayout, info: &Recipe<'_>) -> Result<Self, GpuError> {
        let vertex = Module::new(device, info.vertex.0)?;
        let fragment = info.fragment.map(|(spirv, _)| Module::new(device, spirv)).transpose()?;
        let stage = |flag, module: &Module<'_>, entry| {
            vk::PipelineShaderStageCreateInfo::default().stage(flag).module(module.raw).name(entry)
        };
        let mut stages = vec![stage(vk::ShaderStageFlags::VERTEX, &vertex, info.vertex.1)];
        if let (Some(module), Some((_, entry))) = (&fragment, info.fragment) {
            stages.push(stage(vk::ShaderStageFlags::FRAGMENT, module, entry));
        }
        let input = vk::PipelineVertexInputStateCreateInfo::default()
            .vertex_binding_descriptions(info.input.bindings)
            .vertex_attribute_descriptions(info.input.attributes);
        let assembly = vk::PipelineInputAssemblyStateCreateInfo::default()
            .topology(vk::PrimitiveTopology::TRIANGLE_LIST);
        let viewport = vk::PipelineViewportStateCreateInfo::default().viewport_count(1).scissor_count(1);
        let polygon = if info.lines { vk::PolygonMode::LINE } else { vk::PolygonMode::FILL };
        let [constant, slope] = info.bias.unwrap_or_default();
        let raster = vk::PipelineRasterizationStateCreateInfo::default()
            .polygon_mode(polygon)
            .cull_mode(if info.cull { vk::CullModeFlags::BACK } else { vk::CullModeFlags::NONE })
            .front_face(vk::FrontFace::COUNTER_CLOCKWISE)
            .line_width(1.0)
            .depth_bias_enable(info.bias.is_some())
            .depth_bias_constant_factor(constant)
            .depth_bias_slope_factor(slope);
        let samples = vk::PipelineMultisampleStateCreateInfo::default().rasterization_samples(info.samples);
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
        let colors = if fragment.is_some() { &blends[..] } else { &[] };
        let blend = vk::PipelineColorBlendStateCreateInfo::default().attachments(colors);
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
            .render_pass(info.pass)];
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
