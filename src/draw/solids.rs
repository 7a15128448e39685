//! Opaque, lit things that float on the sea.

use super::counts::DrawCounts;
use super::error::DrawError;
use super::shaders;
use super::solid_meshes::{Meshes, Part, SolidVertex};
use super::vertex_input::{by_instance, by_vertex, field};
use crate::gpu::{
    Bindings, Blend, Buffer, DepthUse, Device, GpuError, Pass, Pipeline, PipelineInfo, Recorder, UploadRing,
    VertexInput, upload_buffer,
};
use ash::vk;
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Mat3, Vec3};
use std::ops::Range;
use std::sync::Arc;

/// The most solids that one frame shows.
pub const MOST_SOLIDS: usize = 384;

/// A unit mesh: one metre across, centred on its origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A cube.
    Box,
    /// A ball.
    Sphere,
    /// A cylinder along y, with flat ends.
    Cylinder,
}

/// Every shape, in the order of the meshes.
const SHAPES: [Shape; 3] = [Shape::Box, Shape::Sphere, Shape::Cylinder];

/// One thing of one colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// Its mesh.
    pub shape: Shape,
    /// Of its centre, world metres.
    pub position: DVec3,
    /// Columns: its own x, y and z in the world; orthonormal and right-handed.
    pub axes: Mat3,
    /// Along its own axes, metres, each above 0.
    pub size: Vec3,
    /// Albedo, linear Rec. 709, 0..=1.
    pub color: [f32; 3],
    /// Share of its distance by which depth brings it forward, 0 for most things: water that stands less than
    /// `lead / (1 + lead)` of the eye's height above it does not hide it. See [`super::Raft`].
    pub lead: f32,
}

impl Solid {
    /// World height that no part of it is above.
    pub(super) fn top(&self) -> f64 {
        self.position.y + 0.5 * f64::from(self.size.length())
    }
}

/// Where something is and how it is turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// World metres.
    pub position: DVec3,
    /// Columns: its own x, y and z in the world; orthonormal and right-handed.
    pub axes: Mat3,
}

impl Pose {
    /// The world position of a point in its own metres.
    pub fn at(&self, point: Vec3) -> DVec3 {
        self.position + (self.axes * point).as_dvec3()
    }

    /// A solid of `size` metres around a point in its own metres.
    pub(super) fn solid(&self, shape: Shape, point: Vec3, size: Vec3, color: [f32; 3]) -> Solid {
        Solid { shape, position: self.at(point), axes: self.axes, size, color, lead: 0.0 }
    }
}

/// `Solid` of `shaders/body.wgsl`: three axes times the size, each with a channel of the colour, and the centre
/// relative to the frame's origin, with the lead.
#[repr(C)]
#[derive(Clone, Copy, Default, Pod, Zeroable)]
pub struct SolidInstance([[f32; 4]; 4]);

impl SolidInstance {
    /// As seen from `origin` (world metres): subtracted in `f64`.
    fn new(solid: &Solid, origin: DVec3) -> Self {
        let column = |i: usize| (solid.axes.col(i) * solid.size[i]).extend(solid.color[i]).into();
        let place = (solid.position - origin).as_vec3().extend(solid.lead).into();
        Self([column(0), column(1), column(2), place])
    }
}

/// Meshes and pipeline of solids.
pub struct Solids {
    pipeline: Pipeline,
    vertices: Buffer,
    indices: Buffer,
    parts: [Part; 3],
    instances: Vec<SolidInstance>,
}

/// A frame's instances in the upload ring, by shape.
#[derive(Clone, Debug, Default)]
pub struct Uploaded {
    offset: u64,
    shapes: [Range<u32>; 3],
}

impl Solids {
    /// Bytes of instances that a frame may need.
    pub const BYTES: u64 = (MOST_SOLIDS * size_of::<SolidInstance>()) as u64 + 16;

    /// Meshes, and the pipeline for `pass`.
    ///
    /// # Errors
    /// Out of memory, or the driver refuses.
    pub fn new(device: &Arc<Device>, pass: &Pass, bindings: &Bindings) -> Result<Self, GpuError> {
        let mut meshes = Meshes::default();
        let parts = SHAPES.map(|shape| {
            meshes.part(match shape {
                Shape::Box => Meshes::cube,
                Shape::Sphere => Meshes::ball,
                Shape::Cylinder => Meshes::cylinder,
            })
        });
        let usage = vk::BufferUsageFlags::VERTEX_BUFFER;
        let vertices = upload_buffer(device, "solids", bytemuck::cast_slice(&meshes.vertices), usage)?;
        let usage = vk::BufferUsageFlags::INDEX_BUFFER;
        let indices = upload_buffer(device, "solid indices", bytemuck::cast_slice(&meshes.indices), usage)?;
        let info = PipelineInfo {
            name: "solids",
            vertex: (shaders::SOLID_VERTEX_MAIN, c"vertex_main"),
            fragment: (shaders::SOLID_FRAGMENT_MAIN, c"fragment_main"),
            input: INPUT,
            depth: DepthUse::Solid,
            blend: Blend::Opaque,
            cull: true,
            lines: false,
        };
        let pipeline = Pipeline::new(device, pass, bindings.pipeline_layout, &info)?;
        Ok(Self { pipeline, vertices, indices, parts, instances: Vec::with_capacity(MOST_SOLIDS) })
    }

    /// Copies `solids` to the ring, relative to `origin`, one shape after the other.
    ///
    /// # Errors
    /// More than [`MOST_SOLIDS`], or the ring is full.
    pub fn upload(
        &mut self,
        ring: &mut UploadRing,
        solids: &[Solid],
        origin: DVec3,
    ) -> Result<Uploaded, DrawError> {
        if solids.len() > MOST_SOLIDS {
            return Err(DrawError::TooManySolids { count: solids.len() });
        }
        self.instances.clear();
        let shapes = SHAPES.map(|shape| {
            let start = self.instances.len() as u32;
            let of_shape = solids.iter().filter(|solid| solid.shape == shape);
            self.instances.extend(of_shape.map(|solid| SolidInstance::new(solid, origin)));
            start..self.instances.len() as u32
        });
        let offset = ring.push(bytemuck::cast_slice(&self.instances), 16)?;
        Ok(Uploaded { offset, shapes })
    }

    /// Copies `before` to the ring as [`Self::upload`] did `now`: relative to the same `origin`, in the same order. What
    /// has no counterpart is taken to have stood still.
    ///
    /// # Errors
    /// The ring is full.
    pub fn upload_before(
        &mut self,
        ring: &mut UploadRing,
        now: &[Solid],
        before: &[Solid],
        origin: DVec3,
    ) -> Result<u64, DrawError> {
        self.instances.clear();
        for shape in SHAPES {
            let of_shape = now.iter().enumerate().filter(|(_, solid)| solid.shape == shape);
            self.instances.extend(of_shape.map(|(i, solid)| {
                let earlier = before.get(i).filter(|earlier| earlier.shape == shape);
                SolidInstance::new(earlier.unwrap_or(solid), origin)
            }));
        }
        Ok(ring.push(bytemuck::cast_slice(&self.instances), 16)?)
    }

    /// The pipeline of solids on which no shadows fall.
    pub const fn pipeline(&self) -> &Pipeline {
        &self.pipeline
    }

    /// Draws what was uploaded, inside the pass: one call for each shape that there is.
    pub fn draw_with(
        &self,
        pipeline: &Pipeline,
        commands: Recorder<'_>,
        ring: &UploadRing,
        uploaded: &Uploaded,
    ) -> DrawCounts {
        let mut counts = DrawCounts::default();
        if uploaded.shapes.iter().all(Range::is_empty) {
            return counts;
        }
        commands.begin_label(c"solids");
        pipeline.bind(commands);
        commands.vertex_buffer(0, self.vertices.raw, 0);
        commands.vertex_buffer(1, ring.buffer(), uploaded.offset);
        commands.index_buffer(&self.indices);
        for (part, instances) in self.parts.iter().zip(&uploaded.shapes) {
            if instances.is_empty() {
                continue;
            }
            commands.draw_indexed(part.indices.clone(), instances.clone());
            let triangles = part.indices.len() as u32 / 3;
            counts += DrawCounts::draw(triangles, part.vertices, instances.len() as u32);
        }
        commands.end_label();
        counts
    }
}

const ROW: vk::Format = vk::Format::R32G32B32A32_SFLOAT;

/// `Solid` of `shaders/body.wgsl`.
pub const INPUT: VertexInput<'static> = VertexInput {
    bindings: &[by_vertex(0, size_of::<SolidVertex>()), by_instance(1, size_of::<SolidInstance>())],
    attributes: &[
        field(0, 0, vk::Format::R32G32B32_SFLOAT, 0),
        field(1, 0, vk::Format::R32G32B32_SFLOAT, 12),
        field(2, 1, ROW, 0),
        field(3, 1, ROW, 16),
        field(4, 1, ROW, 32),
        field(5, 1, ROW, 48),
    ],
};

/// The same, and `Before` of `shaders/motion.wgsl`.
pub const MOTION_INPUT: VertexInput<'static> = VertexInput {
    bindings: &[
        by_vertex(0, size_of::<SolidVertex>()),
        by_instance(1, size_of::<SolidInstance>()),
        by_instance(2, size_of::<SolidInstance>()),
    ],
    attributes: &[
        field(0, 0, vk::Format::R32G32B32_SFLOAT, 0),
        field(1, 0, vk::Format::R32G32B32_SFLOAT, 12),
        field(2, 1, ROW, 0),
        field(3, 1, ROW, 16),
        field(4, 1, ROW, 32),
        field(5, 1, ROW, 48),
        field(6, 2, ROW, 0),
        field(7, 2, ROW, 16),
        field(8, 2, ROW, 32),
        field(9, 2, ROW, 48),
    ],
};
