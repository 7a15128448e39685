//! The sea's patches and skirt.

use super::counts::DrawCounts;
use super::patch_grid::{GridVertex, PatchGrid};
use super::sea_stages::SeaStages;
use super::vertex_input::{by_instance, by_vertex, field};
use crate::gpu::{
    Bindings, Blend, Buffer, DepthUse, Device, GpuError, Pass, Pipeline, PipelineInfo, Recorder, UploadRing,
    VertexInput, upload_buffer,
};
use crate::lod::{self, Selection, Tessellation};
use ash::vk;
use std::ffi::CStr;
use std::ops::Range;
use std::sync::Arc;

/// What is drawn on the surface.
#[derive(Clone, Copy)]
pub struct Layer {
    /// SPIR-V of the fragment stage.
    pub fragment: &'static [u8],
    /// Its entry point.
    pub entry: &'static CStr,
    /// Edges instead of triangles, drawn over what is there.
    pub lines: bool,
}

impl Layer {
    fn pipeline(&self, vertex: Stage) -> PipelineInfo<'static> {
        PipelineInfo {
            name: "sea",
            vertex,
            fragment: (self.fragment, self.entry),
            input: VertexInput::default(),
            depth: if self.lines { DepthUse::Raised } else { DepthUse::Solid },
            blend: Blend::Opaque,
            cull: false,
            lines: self.lines,
        }
    }
}

/// Meshes and pipelines of the sea's surface.
pub struct Ocean {
    layers: Vec<[Pipeline; 2]>,
    meshes: Meshes,
}

/// Grid and skirt.
struct Meshes {
    vertices: Buffer,
    indices: Buffer,
    /// Where the indices of each pattern, or piece, are in `indices`.
    patterns: Vec<Range<u32>>,
    /// How many vertices of the grid each of them uses.
    pattern_vertices: Vec<u32>,
    skirt_vertices: Buffer,
    skirt_indices: Buffer,
}

impl Ocean {
    /// Meshes for patches of `cells` x `cells`, a skirt for `settings`, and a pair of pipelines for each layer.
    ///
    /// # Errors
    /// Out of memory, or the device cannot draw lines.
    pub fn new(
        device: &Arc<Device>,
        pass: &Pass,
        bindings: &Bindings,
        settings: &lod::LodSettings,
        stages: SeaStages,
        layers: &[Layer],
    ) -> Result<Self, GpuError> {
        let vertex = [(stages.patch(), c"vertex_main"), (stages.skirt(), c"vertex_main")];
        let make = |layer| surface(device, pass, bindings, vertex, layer);
        let layers = layers.iter().map(make).collect::<Result<_, GpuError>>()?;
        Ok(Self { layers, meshes: Meshes::new(device, settings)? })
    }

    /// Other meshes, between frames that have ended.
    ///
    /// # Errors
    /// Out of memory.
    pub fn set_meshes(&mut self, device: &Arc<Device>, settings: &lod::LodSettings) -> Result<(), GpuError> {
        self.meshes = Meshes::new(device, settings)?;
        Ok(())
    }

    /// Copies the instances of `selection` to the ring and returns their offset.
    ///
    /// # Errors
    /// The ring is full.
    pub fn upload(ring: &mut UploadRing, selection: &Selection) -> Result<u64, GpuError> {
        ring.push(bytemuck::cast_slice(selection.instances()), 16)
    }

    /// Records the draws of `selection`, whose instances are at `instances` in the ring, inside the pass.
    pub fn draw(
        &self,
        commands: Recorder<'_>,
        ring: &UploadRing,
        instances: u64,
        selection: &Selection,
    ) -> DrawCounts {
        let mut counts = DrawCounts::default();
        for surface in &self.layers {
            counts += self.draw_with(surface, commands, (ring, instances), selection);
        }
        counts
    }

    /// The same with other pipelines. `instances` are a ring and where they are in it.
    pub fn draw_with(
        &self,
        [patches, skirt]: &[Pipeline; 2],
        commands: Recorder<'_>,
        instances: (&UploadRing, u64),
        selection: &Selection,
    ) -> DrawCounts {
        commands.begin_label(c"sea");
        let mut counts = self.draw_patches(patches, commands, instances, selection);
        skirt.bind(commands);
        commands.vertex_buffer(0, self.meshes.skirt_vertices.raw, 0);
        commands.index_buffer(&self.meshes.skirt_indices);
        commands.draw_indexed(0..lod::skirt::SKIRT_INDICES as u32, 0..1);
        let skirt = [lod::skirt::SKIRT_INDICES / 3, lod::skirt::SKIRT_VERTICES].map(|n| n as u32);
        counts += DrawCounts::draw(skirt[0], skirt[1], 1);
        commands.end_label();
        counts
    }

    /// The patches alone.
    pub fn draw_patches(
        &self,
        patches: &Pipeline,
        commands: Recorder<'_>,
        instances: (&UploadRing, u64),
        selection: &Selection,
    ) -> DrawCounts {
        let mut counts = DrawCounts::default();
        patches.bind(commands);
        commands.vertex_buffer(0, self.meshes.vertices.raw, 0);
        commands.vertex_buffer(1, instances.0.buffer(), instances.1);
        commands.index_buffer(&self.meshes.indices);
        for batch in selection.batches() {
            let indices = self.meshes.patterns[batch.mesh].clone();
            let (triangles, instances) = (indices.len() as u32 / 3, batch.instances.len() as u32);
            commands.draw_indexed(indices, batch.instances);
            counts += DrawCounts::draw(triangles, self.meshes.pattern_vertices[batch.mesh], instances);
        }
        counts.patches += selection.patches() as u32;
        counts
    }

    /// Bytes of instances that a frame may need.
    pub const fn instance_bytes(most_patches: usize) -> u64 {
        (most_patches * size_of::<lod::Instance>()) as u64 + 16
    }
}

impl Meshes {
    fn new(device: &Arc<Device>, settings: &lod::LodSettings) -> Result<Self, GpuError> {
        let cells = settings.quality.preset().cells;
        let PatchGrid { vertices, indices, patterns, pattern_vertices } = match settings.tessellation {
            Tessellation::Grid => PatchGrid::new(cells),
            Tessellation::Signal(_) => PatchGrid::pieces(cells),
        };
        let usage = vk::BufferUsageFlags::VERTEX_BUFFER;
        let vertices = upload_buffer(device, "grid", bytemuck::cast_slice(&vertices), usage)?;
        let usage = vk::BufferUsageFlags::INDEX_BUFFER;
        let indices = upload_buffer(device, "patterns", bytemuck::cast_slice(&indices), usage)?;
        let (skirt, skirt_indices) = lod::skirt(settings.size, settings.skirt_extent);
        let skirt_vertices = upload_buffer(
            device,
            "skirt",
            bytemuck::cast_slice(&skirt),
            vk::BufferUsageFlags::VERTEX_BUFFER,
        )?;
        let skirt_indices = upload_buffer(
            device,
            "skirt indices",
            bytemuck::cast_slice(&skirt_indices),
            vk::BufferUsageFlags::INDEX_BUFFER,
        )?;
        Ok(Self { vertices, indices, patterns, pattern_vertices, skirt_vertices, skirt_indices })
    }
}

/// SPIR-V of a stage and its entry point.
pub type Stage = (&'static [u8], &'static CStr);

/// Pipelines of the patches and of the skirt, with their `vertex` stages in this order.
///
/// # Errors
/// The driver refuses, or cannot draw lines.
pub fn surface(
    device: &Arc<Device>,
    pass: &Pass,
    bindings: &Bindings,
    vertex: [Stage; 2],
    layer: &Layer,
) -> Result<[Pipeline; 2], GpuError> {
    Ok([patches(device, pass, bindings, vertex[0], layer)?, skirt(device, pass, bindings, vertex[1], layer)?])
}

/// The patches' pipeline alone.
///
/// # Errors
/// As [`surface`].
pub fn patches(
    device: &Arc<Device>,
    pass: &Pass,
    bindings: &Bindings,
    vertex: Stage,
    layer: &Layer,
) -> Result<Pipeline, GpuError> {
    let info = PipelineInfo { name: "patches", input: PATCH_INPUT, ..layer.pipeline(vertex) };
    Pipeline::new(device, pass, bindings.pipeline_layout, &info)
}

/// The skirt's pipeline alone.
///
/// # Errors
/// As [`surface`].
pub fn skirt(
    device: &Arc<Device>,
    pass: &Pass,
    bindings: &Bindings,
    vertex: Stage,
    layer: &Layer,
) -> Result<Pipeline, GpuError> {
    let info = PipelineInfo { name: "skirt", input: SKIRT_INPUT, ..layer.pipeline(vertex) };
    Pipeline::new(device, pass, bindings.pipeline_layout, &info)
}

/// `Patch` of `shaders/patch.wgsl`: a [`GridVertex`], and an instance of [`lod::Instance`].
pub const PATCH_INPUT: VertexInput<'static> = VertexInput {
    bindings: &[by_vertex(0, size_of::<GridVertex>()), by_instance(1, size_of::<lod::Instance>())],
    attributes: &[
        field(0, 0, vk::Format::R16G16B16A16_SFLOAT, 0),
        field(1, 0, vk::Format::R8_UNORM, 12),
        field(2, 0, vk::Format::R8G8B8A8_UNORM, 8),
        field(3, 1, vk::Format::R32G32B32A32_SFLOAT, 0),
        field(4, 1, vk::Format::R32G32B32A32_SFLOAT, 16),
    ],
};

/// [`lod::SkirtVertex`].
const SKIRT_INPUT: VertexInput<'static> = VertexInput {
    bindings: &[by_vertex(0, size_of::<lod::SkirtVertex>())],
    attributes: &[field(0, 0, vk::Format::R32G32B32A32_SFLOAT, 0)],
};
