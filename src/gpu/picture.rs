//! A finished picture, and the commands that fill an image of a window with it.

use super::commands::Commands;
use super::error::GpuError;
use super::fit::{Area, fit};
use super::image::Image;
use super::recorder::Recorder;
use super::swapchain::Acquired;
use ash::vk;

/// A finished picture, one layer a view. Whatever draws it has been submitted.
#[derive(Clone, Copy, Debug)]
pub struct Picture {
    /// An image made to be copied from.
    pub image: vk::Image,
    /// Pixels of one layer.
    pub extent: [u32; 2],
    /// In which layout it is, and is left: `TRANSFER_SRC_OPTIMAL`, already made readable by copies, or
    /// `COLOR_ATTACHMENT_OPTIMAL`, which this sees to.
    pub layout: vk::ImageLayout,
}

impl Picture {
    /// The finished image of a target of our own.
    pub const fn finished(image: &Image) -> Self {
        Self { image: image.raw, extent: image.info.extent, layout: vk::ImageLayout::TRANSFER_SRC_OPTIMAL }
    }
}

/// Which views of a picture are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layers {
    /// One.
    One(u32),
    /// The first two, side by side.
    Both,
}

impl Layers {
    const fn range(self) -> std::ops::Range<u32> {
        match self {
            Self::One(layer) => layer..layer + 1,
            Self::Both => 0..2,
        }
    }
}

/// Records and submits what fills `image` with `layers` of `picture`.
pub fn fill(
    commands: &Commands,
    image: Acquired,
    extent: [u32; 2],
    picture: &Picture,
    layers: Layers,
) -> Result<(), GpuError> {
    let recorder = commands.begin()?;
    recorder.begin_label(c"window");
    record(recorder, image.image, extent, picture, layers);
    recorder.end_label();
    commands.submit_signalling(Some(image.filled))
}

fn record(recorder: Recorder<'_>, window: vk::Image, extent: [u32; 2], picture: &Picture, layers: Layers) {
    use vk::{AccessFlags as A, ImageLayout as L, PipelineStageFlags as S};
    let whole = vk::ImageSubresourceRange::default()
        .aspect_mask(vk::ImageAspectFlags::COLOR)
        .level_count(1)
        .layer_count(vk::REMAINING_ARRAY_LAYERS);
    let barrier = |image, from: (L, S, A), to: (L, S, A)| {
        let barrier = vk::ImageMemoryBarrier::default()
            .src_access_mask(from.2)
            .dst_access_mask(to.2)
            .old_layout(from.0)
            .new_layout(to.0)
            .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
            .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
            .image(image)
            .subresource_range(whole);
        // SAFETY: recording outside a pass; both images outlive the work, and the layouts are those they are in.
        unsafe {
            recorder.device.raw.cmd_pipeline_barrier(
                recorder.raw,
                from.1,
                to.1,
                vk::DependencyFlags::empty(),
                &[],
                &[],
                &[barrier],
            );
        }
    };
    let empty = (L::UNDEFINED, S::TRANSFER, A::empty());
    let filling = (L::TRANSFER_DST_OPTIMAL, S::TRANSFER, A::TRANSFER_WRITE);
    let shown = (L::PRESENT_SRC_KHR, S::BOTTOM_OF_PIPE, A::empty());
    let drawn = (picture.layout, S::COLOR_ATTACHMENT_OUTPUT, A::COLOR_ATTACHMENT_WRITE);
    let read = (L::TRANSFER_SRC_OPTIMAL, S::TRANSFER, A::TRANSFER_READ);
    let borrowed = picture.layout != read.0;

    let views = layers.range();
    let count = views.len() as u32;
    let areas = (0..count).map(|index| fit(picture.extent, extent, index, count));
    let covered: u64 = areas.clone().map(pixels).sum();
    barrier(window, empty, filling);
    if covered < u64::from(extent[0]) * u64::from(extent[1]) {
        let black = vk::ClearColorValue { float32: [0.0, 0.0, 0.0, 1.0] };
        // SAFETY: recording outside a pass; the image is in this layout.
        unsafe {
            recorder.device.raw.cmd_clear_color_image(recorder.raw, window, filling.0, &black, &[whole]);
        }
        barrier(window, filling, filling);
    }
    if borrowed {
        barrier(picture.image, drawn, read);
    }
    for (view, area) in views.zip(areas).filter(|(_, area)| pixels(*area) > 0) {
        let whole_picture = Area { from: [0, 0], to: picture.extent };
        let region = [vk::ImageBlit::default()
            .src_subresource(layer(view))
            .src_offsets(offsets(whole_picture))
            .dst_subresource(layer(0))
            .dst_offsets(offsets(area))];
        let same = area == whole_picture;
        let filter = if same { vk::Filter::NEAREST } else { vk::Filter::LINEAR };
        // SAFETY: recording outside a pass; both images are in these layouts and hold the regions.
        unsafe {
            recorder.device.raw.cmd_blit_image(
                recorder.raw,
                picture.image,
                read.0,
                window,
                filling.0,
                &region,
                filter,
            );
        }
    }
    if borrowed {
        barrier(picture.image, (read.0, read.1, A::empty()), drawn);
    }
    barrier(window, filling, shown);
}

fn pixels(area: Area) -> u64 {
    u64::from(area.to[0] - area.from[0]) * u64::from(area.to[1] - area.from[1])
}

fn layer(index: u32) -> vk::ImageSubresourceLayers {
    vk::ImageSubresourceLayers::default()
        .aspect_mask(vk::ImageAspectFlags::COLOR)
        .base_array_layer(index)
        .layer_count(1)
}

fn offsets(area: Area) -> [vk::Offset3D; 2] {
    [(area.from, 0), (area.to, 1)].map(|(at, z)| vk::Offset3D { x: at[0] as i32, y: at[1] as i32, z })
}
