//! Recording of one frame's commands, in safe words.

use super::buffer::Buffer;
use super::device::Device;
use super::image::Image;
use ash::vk;
use std::ffi::CStr;
use std::ops::Range;

/// A command buffer being recorded. [`super::Commands::begin`] gives it, [`super::Commands::submit`] ends it.
#[derive(Clone, Copy)]
pub struct Recorder<'a> {
    pub(super) raw: vk::CommandBuffer,
    pub(super) device: &'a Device,
}

impl Recorder<'_> {
    /// Opens a span that captures and validation messages show.
    pub fn begin_label(self, name: &CStr) {
        self.device.begin_label(self.raw, name);
    }

    /// Closes the span opened last.
    pub fn end_label(self) {
        self.device.end_label(self.raw);
    }

    /// Begins `pass` into all of `framebuffer`, and sets viewport and scissor to it. Both are alive, and match.
    pub(super) fn begin_pass(
        self,
        (pass, framebuffer): (vk::RenderPass, vk::Framebuffer),
        extent: vk::Extent2D,
        clears: &[vk::ClearValue],
    ) {
        let area = vk::Rect2D { offset: vk::Offset2D::default(), extent };
        let begin = vk::RenderPassBeginInfo::default()
            .render_pass(pass)
            .framebuffer(framebuffer)
            .render_area(area)
            .clear_values(clears);
        #[expect(clippy::cast_precision_loss, reason = "sizes are far below 2^24")]
        let (width, height) = (extent.width as f32, extent.height as f32);
        let viewport = vk::Viewport { x: 0.0, y: 0.0, width, height, min_depth: 0.0, max_depth: 1.0 };
        // SAFETY: recording outside a pass; who calls vouches for pass and framebuffer.
        unsafe {
            self.device.raw.cmd_begin_render_pass(self.raw, &begin, vk::SubpassContents::INLINE);
            self.device.raw.cmd_set_viewport(self.raw, 0, &[viewport]);
            self.device.raw.cmd_set_scissor(self.raw, 0, &[area]);
        }
    }

    /// Reads vertices (or instances) of input binding `slot` from `buffer` at `offset`.
    pub fn vertex_buffer(self, slot: u32, buffer: vk::Buffer, offset: u64) {
        // SAFETY: recording; owners keep buffers until the frames that use them have ended.
        unsafe { self.device.raw.cmd_bind_vertex_buffers(self.raw, slot, &[buffer], &[offset]) };
    }

    /// Reads 16-bit indices from `buffer`.
    pub fn index_buffer(self, buffer: &Buffer) {
        // SAFETY: as for vertices.
        unsafe { self.device.raw.cmd_bind_index_buffer(self.raw, buffer.raw, 0, vk::IndexType::UINT16) };
    }

    /// Reads 32-bit indices from `buffer` at `offset`.
    pub fn wide_index_buffer(self, buffer: vk::Buffer, offset: u64) {
        // SAFETY: as for vertices.
        unsafe { self.device.raw.cmd_bind_index_buffer(self.raw, buffer, offset, vk::IndexType::UINT32) };
    }

    /// Draws only into this rectangle from here on: its upper left corner and its size, pixels.
    pub fn scissor(self, [x, y]: [u32; 2], [width, height]: [u32; 2]) {
        let offset = vk::Offset2D { x: x.cast_signed(), y: y.cast_signed() };
        let area = [vk::Rect2D { offset, extent: vk::Extent2D { width, height } }];
        // SAFETY: recording; every pipeline's scissor is dynamic.
        unsafe { self.device.raw.cmd_set_scissor(self.raw, 0, &area) };
    }

    /// Draws `indices` for each of `instances`. Pipeline, bindings and buffers are bound and cover both ranges.
    pub fn draw_indexed(self, indices: Range<u32>, instances: Range<u32>) {
        let (count, copies) = (indices.len() as u32, instances.len() as u32);
        // SAFETY: the renderer binds what its pipelines read, over ranges it made itself.
        unsafe {
            self.device.raw.cmd_draw_indexed(self.raw, count, copies, indices.start, 0, instances.start);
        }
    }

    /// Draws `vertices` vertices that come from no buffer.
    pub fn draw(self, vertices: u32) {
        // SAFETY: as above.
        unsafe { self.device.raw.cmd_draw(self.raw, vertices, 1, 0, 0) };
    }

    /// Copies mip 0 of `image`, which is in `TRANSFER_SRC_OPTIMAL`, layer after layer to the start of `buffer`, for the
    /// host to read once the work has ended.
    pub fn copy_from_image(self, image: &Image, buffer: &Buffer) {
        let region = [image.copy_region(0, 0)];
        let layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
        let barrier = vk::MemoryBarrier::default()
            .src_access_mask(vk::AccessFlags::TRANSFER_WRITE)
            .dst_access_mask(vk::AccessFlags::HOST_READ);
        // SAFETY: recording outside a pass; what filled the image made it readable by copies; the buffer holds its texels.
        unsafe {
            self.device.raw.cmd_copy_image_to_buffer(self.raw, image.raw, layout, buffer.raw, &region);
            self.device.raw.cmd_pipeline_barrier(
                self.raw,
                vk::PipelineStageFlags::TRANSFER,
                vk::PipelineStageFlags::HOST,
                vk::DependencyFlags::empty(),
                &[barrier],
                &[],
                &[],
            );
        }
    }

    /// Copies a lent colour image, just drawn and in `COLOR_ATTACHMENT_OPTIMAL`, to `image`, which has its size, layers and
    /// format. Leaves the one as it was and the other in `TRANSFER_SRC_OPTIMAL`.
    pub fn copy_lent(self, lent: vk::Image, image: &Image) {
        use vk::{AccessFlags as A, ImageLayout as L, PipelineStageFlags as S};
        let barrier = |raw, from, to, after, before| {
            vk::ImageMemoryBarrier::default()
                .old_layout(from)
                .new_layout(to)
                .src_access_mask(after)
                .dst_access_mask(before)
                .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
                .image(raw)
                .subresource_range(image.everything())
        };
        let (drawn, source, copied) =
            (L::COLOR_ATTACHMENT_OPTIMAL, L::TRANSFER_SRC_OPTIMAL, L::TRANSFER_DST_OPTIMAL);
        let before = [
            barrier(lent, drawn, source, A::COLOR_ATTACHMENT_WRITE, A::TRANSFER_READ),
            // Whoever looked at the picture before has finished reading.
            barrier(image.raw, L::UNDEFINED, copied, A::empty(), A::TRANSFER_WRITE),
        ];
        let after = [
            barrier(lent, source, drawn, A::TRANSFER_READ, A::empty()),
            barrier(image.raw, copied, source, A::TRANSFER_WRITE, A::TRANSFER_READ),
        ];
        let layers =
            vk::ImageSubresourceLayers::default().aspect_mask(image.aspect()).layer_count(image.info.layers);
        let [width, height] = image.info.extent;
        let region = [vk::ImageCopy::default()
            .src_subresource(layers)
            .dst_subresource(layers)
            .extent(vk::Extent3D { width, height, depth: 1 })];
        let flags = vk::DependencyFlags::empty();
        let raw = &self.device.raw;
        // SAFETY: recording outside a pass; the lender keeps the image meanwhile, and both have these layers and this size.
        unsafe {
            let drawn = S::COLOR_ATTACHMENT_OUTPUT | S::TRANSFER;
            raw.cmd_pipeline_barrier(self.raw, drawn, S::TRANSFER, flags, &[], &[], &before);
            raw.cmd_copy_image(self.raw, lent, source, image.raw, copied, &region);
            let later = S::COLOR_ATTACHMENT_OUTPUT | S::TRANSFER;
            raw.cmd_pipeline_barrier(self.raw, S::TRANSFER, later, flags, &[], &[], &after);
        }
    }

    /// Fills `image`, which is in `TRANSFER_DST_OPTIMAL`, from `buffer`.
    pub fn copy_to_image(self, buffer: vk::Buffer, image: &Image, regions: &[vk::BufferImageCopy]) {
        let layout = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
        // SAFETY: recording outside a pass; regions were made from the image's own size, within the buffer.
        unsafe { self.device.raw.cmd_copy_buffer_to_image(self.raw, buffer, image.raw, layout, regions) };
    }
}
