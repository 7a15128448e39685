//! The panel over the picture: egui's triangles and textures. Nothing waits: textures are filled in the frame that first shows them.

use super::error::DrawError;
use super::shaders;
use super::vertex_input::{by_vertex, field};
use crate::gpu::{
    BindingKind, Bindings, Blend, DepthUse, Device, FRAMES_IN_FLIGHT, GpuError, Image, ImageInfo, Overlay,
    Pipeline, PipelineInfo, Recorder, Resource, Sampler, Transition, UploadRing, VertexInput,
};
use ash::vk;
use egui::epaint::{ClippedPrimitive, ImageData, ImageDelta, Mesh, Primitive};
use egui::{Rect, TextureId};
use std::collections::HashMap;
use std::sync::Arc;

/// As `shaders/panel.wgsl` declares them.
static BINDINGS: [(u32, BindingKind); 2] = [(1, BindingKind::Texture), (12, BindingKind::Sampler)];
/// Bytes for a frame's triangles and texels at first; more are made when a frame wants more.
const SHARE: u64 = 1 << 20;
/// Of texels and indices in the ring.
const ALIGN: u64 = 4;

/// What is to be drawn, as egui hands it out.
#[derive(Default)]
pub struct Painting {
    /// Triangles.
    pub meshes: Vec<ClippedPrimitive>,
    /// Textures that are new or changed, in this order.
    pub textures: Vec<(TextureId, ImageDelta)>,
    /// Textures that nobody wants after this frame.
    pub unused: Vec<TextureId>,
    /// Pixels a point.
    pub scale: f32,
}

impl Painting {
    /// What `context` has put out for a frame.
    pub fn of(context: &egui::Context, mut output: egui::FullOutput) -> Self {
        let meshes = context.tessellate(output.shapes, output.pixels_per_point);
        let delta = &mut output.textures_delta;
        let changed = delta.set.drain();
        let textures = changed.flat_map(|(id, deltas)| deltas.into_iter().map(move |delta| (id, delta)));
        let textures = textures.collect();
        let unused = delta.free.drain().collect();
        Self { meshes, textures, unused, scale: output.pixels_per_point }
    }
}

/// A corner of a triangle as the shader reads it.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Corner {
    at: [f32; 2],
    uv: [f32; 2],
    color: [u8; 4],
}

/// A texture and the set that names it.
struct Texture {
    image: Image,
    bindings: Bindings,
}

/// What belongs to one of the frames in flight.
struct Slot {
    ring: UploadRing,
    /// Textures that this frame or one before it is the last to use.
    retired: Vec<Texture>,
}

/// Pipeline and textures of the panel.
pub struct Panel {
    pipeline: Pipeline,
    textures: HashMap<TextureId, Texture>,
    slots: Vec<Slot>,
    sampler: Sampler,
    corners: Vec<Corner>,
    _layout: Bindings,
    device: Arc<Device>,
}

impl Panel {
    /// Compiles it for overlays like `overlay`.
    ///
    /// # Errors
    /// Out of memory, or the driver refuses.
    pub fn new(device: &Arc<Device>, overlay: &Overlay) -> Result<Self, DrawError> {
        let layout = Bindings::new(device, &BINDINGS, 1)?;
        let info = PipelineInfo {
            name: "panel",
            vertex: (shaders::PANEL_VERTEX_MAIN, c"vertex_main"),
            fragment: (shaders::PANEL_FRAGMENT_MAIN, c"fragment_main"),
            input: VertexInput {
                bindings: &[by_vertex(0, size_of::<Corner>())],
                attributes: &[
                    field(0, 0, vk::Format::R32G32_SFLOAT, 0),
                    field(1, 0, vk::Format::R32G32_SFLOAT, 8),
                    field(2, 0, vk::Format::R8G8B8A8_UNORM, 16),
                ],
            },
            depth: DepthUse::Ignored,
            blend: Blend::Premultiplied,
            cull: false,
            lines: false,
        };
        let slot = |_| Ok(Slot { ring: UploadRing::new(device, 1, SHARE)?, retired: Vec::new() });
        Ok(Self {
            pipeline: overlay.pipeline(layout.pipeline_layout, &info)?,
            textures: HashMap::new(),
            slots: (0..FRAMES_IN_FLIGHT).map(slot).collect::<Result<_, GpuError>>()?,
            sampler: Sampler::new(device, "panel", vk::SamplerAddressMode::CLAMP_TO_EDGE, 1.0)?,
            corners: Vec::new(),
            _layout: layout,
            device: Arc::clone(device),
        })
    }

    /// Records `painting` over the picture of `overlay`, in the frame in flight `slot`, whose last use has ended.
    ///
    /// # Errors
    /// Out of memory.
    pub fn record(
        &mut self,
        commands: Recorder<'_>,
        overlay: &Overlay,
        slot: usize,
        painting: &Painting,
    ) -> Result<(), DrawError> {
        commands.begin_label(c"panel");
        let wanted = bytes(painting);
        let own = &mut self.slots[slot];
        own.retired.clear();
        if wanted > own.ring.share() {
            own.ring = UploadRing::new(&self.device, 1, wanted.next_power_of_two())?;
        }
        own.ring.begin(0);
        for (id, delta) in &painting.textures {
            self.fill(commands, slot, *id, delta)?;
        }
        overlay.begin(commands);
        self.pipeline.bind(commands);
        for primitive in &painting.meshes {
            if let Primitive::Mesh(mesh) = &primitive.primitive {
                self.draw(commands, overlay.extent, slot, mesh, primitive.clip_rect, painting.scale)?;
            }
        }
        overlay.end(commands);
        let unused = painting.unused.iter().filter_map(|id| self.textures.remove(id));
        self.slots[slot].retired.extend(unused);
        commands.end_label();
        Ok(())
    }

    /// Fills all of a texture, or a part of it.
    fn fill(
        &mut self,
        commands: Recorder<'_>,
        slot: usize,
        id: TextureId,
        delta: &ImageDelta,
    ) -> Result<(), DrawError> {
        let ImageData::Color(texels) = &delta.image;
        let size = texels.size.map(|side| u32::try_from(side).unwrap_or(u32::MAX));
        let at = delta.pos.unwrap_or_default().map(|at| i32::try_from(at).unwrap_or(i32::MAX));
        let mut begin = Transition::FILL;
        if delta.pos.is_none() {
            let new = self.texture(size)?;
            self.slots[slot].retired.extend(self.textures.insert(id, new));
        } else {
            begin.from = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;
        }
        let Some(texture) = self.textures.get(&id) else { return Ok(()) };
        let ring = &mut self.slots[slot].ring;
        let offset = ring.push(bytemuck::cast_slice(&texels.pixels), ALIGN)?;
        let layers =
            vk::ImageSubresourceLayers::default().aspect_mask(vk::ImageAspectFlags::COLOR).layer_count(1);
        let region = vk::BufferImageCopy::default()
            .buffer_offset(offset)
            .image_subresource(layers)
            .image_offset(vk::Offset3D { x: at[0], y: at[1], z: 0 })
            .image_extent(vk::Extent3D { width: size[0], height: size[1], depth: 1 });
        let mut scratch = Vec::new();
        begin.record(commands, std::iter::once(&texture.image), &mut scratch);
        commands.copy_to_image(ring.buffer(), &texture.image, &[region]);
        Transition::SAMPLE.record(commands, std::iter::once(&texture.image), &mut scratch);
        Ok(())
    }

    /// An empty texture.
    fn texture(&self, extent: [u32; 2]) -> Result<Texture, GpuError> {
        let info = ImageInfo { extent, ..ImageInfo::texture(1, 1, vk::Format::R8G8B8A8_UNORM) };
        let image = Image::new(&self.device, "panel", info)?;
        let bindings = Bindings::new(&self.device, &BINDINGS, 1)?;
        bindings.write(0, |binding| match binding {
            1 => Resource::Texture(&image),
            _ => Resource::Sampler(&self.sampler),
        });
        Ok(Texture { image, bindings })
    }

    fn draw(
        &mut self,
        commands: Recorder<'_>,
        extent: [u32; 2],
        slot: usize,
        mesh: &Mesh,
        clip: Rect,
        scale: f32,
    ) -> Result<(), DrawError> {
        let Some(texture) = self.textures.get(&mesh.texture_id) else { return Ok(()) };
        let Some((corner, size)) = pixels(clip, scale, extent) else { return Ok(()) };
        let to_clip = extent.map(|side| 2.0 * scale / side as f32);
        self.corners.clear();
        self.corners.extend(mesh.vertices.iter().map(|vertex| Corner {
            at: [vertex.pos.x * to_clip[0] - 1.0, vertex.pos.y * to_clip[1] - 1.0],
            uv: [vertex.uv.x, vertex.uv.y],
            color: vertex.color.to_array(),
        }));
        let ring = &mut self.slots[slot].ring;
        let vertices = ring.push(bytemuck::cast_slice(&self.corners), ALIGN)?;
        let indices = ring.push(bytemuck::cast_slice(&mesh.indices), ALIGN)?;
        texture.bindings.bind(commands, 0, &[]);
        commands.scissor(corner, size);
        commands.vertex_buffer(0, ring.buffer(), vertices);
        commands.wide_index_buffer(ring.buffer(), indices);
        commands.draw_indexed(0..u32::try_from(mesh.indices.len()).unwrap_or(0), 0..1);
        Ok(())
    }
}

/// Bytes of the ring that `painting` takes.
fn bytes(painting: &Painting) -> u64 {
    let mesh = |primitive: &ClippedPrimitive| match &primitive.primitive {
        Primitive::Mesh(mesh) => mesh.vertices.len() * size_of::<Corner>() + 4 * mesh.indices.len() + 8,
        Primitive::Callback(_) => 0,
    };
    let texels = |delta: &ImageDelta| 4 * delta.image.width() * delta.image.height() + 4;
    let all = painting.meshes.iter().map(mesh).sum::<usize>()
        + painting.textures.iter().map(|(_, delta)| texels(delta)).sum::<usize>();
    all as u64
}

/// The part of a picture of `extent` pixels that `clip`, in points, leaves: its corner and its size; none if there is nothing.
fn pixels(clip: Rect, scale: f32, extent: [u32; 2]) -> Option<([u32; 2], [u32; 2])> {
    let end = |points: f32, most: u32| ((points * scale).round().max(0.0) as u32).min(most);
    let from = [end(clip.min.x, extent[0]), end(clip.min.y, extent[1])];
    let to = [end(clip.max.x, extent[0]), end(clip.max.y, extent[1])];
    let size = [to[0].saturating_sub(from[0]), to[1].saturating_sub(from[1])];
    (!size.contains(&0)).then_some((from, size))
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    #[test]
    fn clips_stay_within_the_picture() {
        let clip =
            |x0: f32, y0: f32, x1, y1| pixels(Rect { min: pos2(x0, y0), max: pos2(x1, y1) }, 2.0, [100, 80]);
        assert_eq!(clip(10.0, 10.0, 20.0, 30.0), Some(([20, 20], [20, 40])));
        assert_eq!(clip(-5.0, -5.0, f32::INFINITY, 1e9), Some(([0, 0], [100, 80])));
        assert_eq!(clip(60.0, 10.0, 70.0, 30.0), None, "outside");
        assert_eq!(clip(20.0, 10.0, 10.0, 30.0), None, "inside out");
    }
}
