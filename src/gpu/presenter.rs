//! Finished pictures shown on a window: scaled into its images by blits, side by side where there are several.
//!
//! Pictures are never drawn into a window's images. So a window's size, formats and pace are no business of whoever draws,
//! and a headset's pictures are shown as they are.

use super::commands::{Commands, FRAMES_IN_FLIGHT};
use super::device::Device;
use super::error::GpuError;
use super::fit::{Area, fit};
use super::image::Image;
use super::recorder::Recorder;
use super::surface::{Shown, Surface};
use super::swapchain::{Acquired, NotAcquired, Pace, Swapchain};
use ash::{khr, vk};
use std::ffi::CStr;
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

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

/// What became of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It is on its way to the screen.
    Shown,
    /// No image of the window was free in time.
    Late,
    /// The window has no size.
    NoSize,
}

/// A window's surface and images, and the commands that fill them.
pub struct Presenter {
    /// Dropped before the images they fill, since dropping them waits for the work.
    commands: Vec<Commands>,
    /// Which of them are next.
    slot: usize,
    swapchain: Option<Swapchain>,
    /// The window's size that the swapchain was made for.
    size: [u32; 2],
    /// The window's size as last seen, and since when.
    seen: [u32; 2],
    since: Instant,
    pace: Pace,
    surface: Rc<Surface>,
    window: Arc<dyn Shown>,
    device: Arc<Device>,
}

/// How long a mirror's size stays the same before it has that size.
const AT_REST: Duration = Duration::from_millis(300);

/// A lost surface or a changed window is tried again this often before it counts as gone.
const TRIES: usize = 4;

impl Presenter {
    /// What a device must be opened with.
    pub const DEVICE_EXTENSIONS: &[&'static CStr] = &[khr::swapchain::NAME];

    /// Makes a surface on `window`, and images as soon as there is something to show.
    ///
    /// # Errors
    /// The window is gone, or the device cannot show anything on it.
    pub fn new(device: &Arc<Device>, window: &Arc<dyn Shown>, pace: Pace) -> Result<Self, GpuError> {
        if !device.presents {
            let feature = "VK_KHR_swapchain, which windows need".to_owned();
            return Err(GpuError::Missing { device: device.physical.name.clone(), feature });
        }
        let surface = Rc::new(Surface::new(device, window)?);
        let commands = (0..FRAMES_IN_FLIGHT)
            .map(|i| Commands::new(device, &format!("present {i}")))
            .collect::<Result<_, GpuError>>()?;
        Ok(Self {
            commands,
            slot: 0,
            swapchain: None,
            size: [0, 0],
            seen: [0, 0],
            since: Instant::now(),
            pace,
            surface,
            window: Arc::clone(window),
            device: Arc::clone(device),
        })
    }

    /// Pixels that pictures are shown on, for a window whose size is `size`; none while the window has no size. Makes
    /// the images anew where the window has changed, and only then waits for the device.
    ///
    /// # Errors
    /// The window is gone, out of memory, or the device was lost.
    pub fn extent(&mut self, size: [u32; 2]) -> Result<Option<[u32; 2]>, GpuError> {
        for last in (0..TRIES).rev() {
            match self.fresh(size) {
                Err(error) if error.is_lost_surface() && last > 0 => self.renew()?,
                Err(error) => return Err(error),
                Ok(()) => break,
            }
        }
        Ok(self.swapchain.as_ref().map(|chain| [chain.extent.width, chain.extent.height]))
    }

    /// Shows `layers` of `picture` on a window whose size is `size`, waiting for an image of the window no longer than
    /// `patience`. With [`Pace::Mirror`] it waits for nothing else either.
    ///
    /// # Errors
    /// The window is gone, out of memory, or the device was lost.
    pub fn show(
        &mut self,
        picture: &Picture,
        layers: Layers,
        size: [u32; 2],
        patience: Duration,
    ) -> Result<Outcome, GpuError> {
        if self.pace == Pace::Mirror && (!self.commands[self.slot].is_done() || !self.is_settled(size)) {
            return Ok(Outcome::Late);
        }
        for last in (0..TRIES).rev() {
            if self.extent(size)?.is_none() {
                return Ok(Outcome::NoSize);
            }
            match self.attempt(picture, layers, patience) {
                Ok(()) => return Ok(Outcome::Shown),
                Err(NotAcquired::Late) => return Ok(Outcome::Late),
                Err(NotAcquired::OutOfDate) => self.rebuild(size)?,
                Err(NotAcquired::Failed(error)) if error.is_lost_surface() && last > 0 => self.renew()?,
                Err(NotAcquired::Failed(error)) => return Err(error),
            }
        }
        Ok(Outcome::Late)
    }

    /// Making images anew waits for the queue, which a headset's frames are in too: a mirror that is being dragged larger
    /// gets new ones once, when it has come to rest.
    fn is_settled(&mut self, size: [u32; 2]) -> bool {
        if size != self.seen {
            (self.seen, self.since) = (size, Instant::now());
        }
        size == self.size || self.swapchain.is_none() || self.since.elapsed() > AT_REST
    }

    /// Makes images where there are none that fit.
    fn fresh(&mut self, size: [u32; 2]) -> Result<(), GpuError> {
        if size.contains(&0) {
            return self.drop_images();
        }
        let fits = match &self.swapchain {
            Some(chain) if self.size == size => !chain.suboptimal || self.still_fits(chain)?,
            _ => false,
        };
        if fits { Ok(()) } else { self.rebuild(size) }
    }

    /// Some systems call images suboptimal that could not be any better.
    fn still_fits(&self, chain: &Swapchain) -> Result<bool, GpuError> {
        Ok(super::swapchain::extent(&self.surface.capabilities()?, self.size) == chain.extent)
    }

    fn rebuild(&mut self, size: [u32; 2]) -> Result<(), GpuError> {
        self.wait()?;
        let old = self.swapchain.take();
        self.swapchain = Swapchain::new(&self.surface, &self.device, size, self.pace, old)?;
        self.size = size;
        Ok(())
    }

    fn drop_images(&mut self) -> Result<(), GpuError> {
        if self.swapchain.is_some() {
            self.wait()?;
            self.swapchain = None;
        }
        Ok(())
    }

    /// A new surface for a lost one.
    fn renew(&mut self) -> Result<(), GpuError> {
        self.drop_images()?;
        let surface = Surface::new(&self.device, &self.window)
            .map_err(|error| GpuError::NoWindow(format!("it was lost, and there is no new one: {error}")))?;
        self.surface = Rc::new(surface);
        Ok(())
    }

    /// Waits until no picture is being read any more.
    ///
    /// # Errors
    /// The device was lost.
    pub fn wait(&self) -> Result<(), GpuError> {
        self.commands.iter().try_for_each(Commands::wait)
    }

    fn attempt(&mut self, picture: &Picture, layers: Layers, patience: Duration) -> Result<(), NotAcquired> {
        let Some(swapchain) = &mut self.swapchain else { return Err(NotAcquired::OutOfDate) };
        let image = swapchain.acquire(patience)?;
        let extent = [swapchain.extent.width, swapchain.extent.height];
        let commands = &self.commands[self.slot];
        fill(commands, image, extent, picture, layers).map_err(NotAcquired::Failed)?;
        self.slot = (self.slot + 1) % FRAMES_IN_FLIGHT;
        match swapchain.present(image) {
            // The picture has gone its way; the next one finds new images.
            Err(NotAcquired::OutOfDate) => {
                self.size = [0, 0];
                Ok(())
            }
            other => other,
        }
    }
}

/// Records and submits what fills `image` with `layers` of `picture`.
fn fill(
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
