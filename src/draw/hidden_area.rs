//! The parts of a view that the headset's lenses do not show: drawn first, black and nearest, so that nothing is shaded
//! there. OpenXR tells them (`XR_KHR_visibility_mask`) as triangles in the plane one metre before the eye.

use super::counts::DrawCounts;
use super::error::DrawError;
use super::shaders;
use super::vertex_input::{by_vertex, field};
use crate::gpu::{
    Bindings, Blend, Buffer, DepthUse, Device, GpuError, Pass, Pipeline, PipelineInfo, Recorder, VertexInput,
    upload_buffer,
};
use ash::vk;
use std::sync::Arc;

/// One view's hidden triangles, as `xrGetVisibilityMaskKHR` gives them.
#[derive(Clone, Copy, Debug, Default)]
pub struct HiddenMesh<'a> {
    /// (x, y) in the view's plane z = -1: tangents of the angles to the right and up.
    pub vertices: &'a [[f32; 2]],
    /// Three for each triangle.
    pub indices: &'a [u32],
}

/// Both views' triangles in one buffer, and their pipeline.
pub struct HiddenArea {
    pipeline: Pipeline,
    mesh: Option<(Buffer, u32)>,
}

impl HiddenArea {
    /// The pipeline for `pass`, and nothing hidden.
    ///
    /// # Errors
    /// The driver refuses.
    pub fn new(device: &Arc<Device>, pass: &Pass, bindings: &Bindings) -> Result<Self, GpuError> {
        let info = PipelineInfo {
            name: "hidden area",
            vertex: (shaders::HIDDEN_AREA_VERTEX_MAIN, c"vertex_main"),
            fragment: (shaders::HIDDEN_AREA_FRAGMENT_MAIN, c"fragment_main"),
            input: INPUT,
            depth: DepthUse::Solid,
            blend: Blend::Opaque,
            cull: false,
            lines: false,
        };
        Ok(Self { pipeline: Pipeline::new(device, pass, bindings.pipeline_layout, &info)?, mesh: None })
    }

    /// Hides `meshes`, one for each view, from now on; waits for the device.
    ///
    /// # Errors
    /// Indices that are no triangles of the vertices, or out of memory.
    pub fn set(&mut self, device: &Arc<Device>, meshes: [HiddenMesh<'_>; 2]) -> Result<(), DrawError> {
        let mut corners: Vec<[f32; 3]> = Vec::new();
        for (view, mesh) in [0.0, 1.0].into_iter().zip(meshes) {
            if mesh.indices.len() % 3 != 0 {
                return Err(DrawError::HiddenIndices { count: mesh.indices.len() });
            }
            for &index in mesh.indices {
                let corner = usize::try_from(index).ok().and_then(|index| mesh.vertices.get(index));
                let &[x, y] =
                    corner.ok_or(DrawError::HiddenIndex { index, vertices: mesh.vertices.len() })?;
                corners.push([x, y, view]);
            }
        }
        // Uploading waits for its fence, which is signalled after everything that was submitted before: also when there
        // is nothing to upload any more, no frame draws the old mesh when this replaces it.
        let usage = vk::BufferUsageFlags::VERTEX_BUFFER;
        let bytes = if corners.is_empty() { &[0; 12] } else { bytemuck::cast_slice(&corners) };
        let buffer = upload_buffer(device, "hidden area", bytes, usage)?;
        let count = corners.len() as u32;
        self.mesh = (count > 0).then_some((buffer, count));
        Ok(())
    }

    /// Draws it, first, inside the pass.
    pub fn draw(&self, commands: Recorder<'_>) -> DrawCounts {
        let Some((buffer, count)) = &self.mesh else { return DrawCounts::default() };
        commands.begin_label(c"hidden area");
        self.pipeline.bind(commands);
        commands.vertex_buffer(0, buffer.raw, 0);
        commands.draw(*count);
        commands.end_label();
        DrawCounts::draw(count / 3, *count, 1)
    }
}

const INPUT: VertexInput<'static> = VertexInput {
    bindings: &[by_vertex(0, 12)],
    attributes: &[field(0, 0, vk::Format::R32G32B32_SFLOAT, 0)],
};
