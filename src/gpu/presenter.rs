//! Finished pictures shown on a window: scaled into its images by blits, side by side where there are several.
//!
//! Pictures are never drawn into a window's images. So a window's size, formats and pace are no business of whoever draws,
//! and a headset's pictures are shown as they are.

use super::commands::{Commands, FRAMES_IN_FLIGHT};
use super::device::Device;
use super::error::GpuError;
use super::picture::{Layers, Picture, fill};
use super::surface::{Shown, Surface};
use super::swapchain::{NotAcquired, Pace, Swapchain};
use ash::khr;
use std::ffi::CStr;
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

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
