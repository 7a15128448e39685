//! Frames without a screen: the frame loop around an offscreen target.

use super::afloat::Afloat;
use super::painter::{self, Painter};
use crate::draw::{self, DrawCounts, Eye, HiddenMesh, Look, Moment, Solid};
use crate::gpu::{
    Buffer, Device, DeviceNeeds, Directly, FRAMES_IN_FLIGHT, GpuError, Instance, MemoryLocation,
    PhysicalDevice, Target, TargetInfo, Turn, Validation,
};
use crate::host::HostError;
use crate::raft::BuoySettings;
use crate::scene::Scene;
use crate::sea::SeaAhead;
use ash::vk;
use std::path::PathBuf;
use std::sync::Arc;

/// What to draw, and with what.
#[derive(Clone, Debug)]
pub struct HeadlessSettings {
    /// Pixels of one view.
    pub size: [u32; 2],
    /// Two views, from the scene camera's two eyes.
    pub stereo: bool,
    /// What is drawn on the surface; [`Look::Metres`] gives `f32` pixels, all others sRGB bytes (RGBA).
    pub look: Look,
    /// Part of the name of the Vulkan device to use.
    pub device: Option<String>,
    /// Whether validation listens.
    pub validation: Validation,
    /// Worker threads for the sea; 0 for one a core.
    pub threads: usize,
    /// Where compiled pipelines are kept.
    pub cache: Option<PathBuf>,
}

/// One finished frame.
pub struct Finished<'a> {
    /// Which of the times it is.
    pub index: usize,
    /// Pixels, rows from the top, view after view, four bytes each.
    pub pixels: &'a [u8],
    /// What it took to draw.
    pub counts: DrawCounts,
}

/// A renderer, its target and its sea.
pub struct Headless {
    sea: SeaAhead,
    /// Dropped before what its frames use, since dropping it waits for them.
    painter: Painter,
    eyes: Vec<Eye>,
    buoys: Vec<BuoySettings>,
    afloat: Afloat,
    /// What floats besides the scene's buoys.
    solids: Vec<Solid>,
    vignette: f32,
    offscreen: Offscreen,
}

/// Where frames go.
struct Offscreen {
    readback: Vec<Buffer>,
    target: Target,
}

impl AsRef<Target> for Offscreen {
    fn as_ref(&self) -> &Target {
        &self.target
    }
}

impl Headless {
    /// Opens Vulkan, makes the sea and the sky side by side, and begins the sea's step to `first` (seconds).
    ///
    /// # Errors
    /// No usable device, a sky file that cannot be read, a size beyond the device, out of memory.
    pub fn new(scene: &Scene, settings: &HeadlessSettings, first: f64) -> Result<Self, HostError> {
        let open = || open(settings);
        let started = painter::start(scene, settings.look, settings.threads, Some(first), open)?;
        #[expect(clippy::cast_precision_loss, reason = "picture sizes")]
        let aspect = settings.size[0] as f32 / settings.size[1] as f32;
        let eyes = draw::eyes(&scene.camera, aspect, settings.stereo);
        Ok(Self {
            sea: started.sea,
            painter: started.painter,
            eyes,
            buoys: scene.buoys.clone(),
            afloat: Afloat::default(),
            solids: Vec::new(),
            vignette: 0.0,
            offscreen: started.opened,
        })
    }

    /// Looks from `eyes`, one for each view, from the next frame on; a view without a new eye keeps its own.
    pub fn set_eyes(&mut self, eyes: &[Eye]) {
        for (own, eye) in self.eyes.iter_mut().zip(eyes) {
            *own = *eye;
        }
    }

    /// Shows `solids` besides the scene's buoys, through a vignette closed by `vignette` (0..=1), from the next frame on.
    pub fn set_scenery(&mut self, solids: &[Solid], vignette: f32) {
        self.solids.clear();
        self.solids.extend_from_slice(solids);
        self.vignette = vignette;
    }

    /// Hides `meshes`, one for each view, from the next frame on.
    ///
    /// # Errors
    /// As [`draw::Renderer::set_hidden_area`].
    pub fn set_hidden_area(&mut self, meshes: [HiddenMesh<'_>; 2]) -> Result<(), HostError> {
        self.painter.set_hidden_area(meshes)
    }

    /// Draws the sea at each of `times` and hands every finished frame to `take`. The first time of the first run is
    /// best the one given to [`Self::new`], whose sea is on its way; later runs begin where they like, also after an error.
    /// While one frame is drawn the next one's sea is simulated and the one before is taken.
    ///
    /// # Errors
    /// The device or a worker failed, or `take` did.
    pub fn run(
        &mut self,
        times: impl IntoIterator<Item = f64>,
        mut take: impl FnMut(Finished<'_>) -> Result<(), HostError>,
    ) -> Result<(), HostError> {
        let mut drawn = [DrawCounts::default(); FRAMES_IN_FLIGHT];
        let mut times = times.into_iter();
        let Some(first) = times.next() else { return Ok(()) };
        self.sea.begin(first)?;
        for index in 0.. {
            let slot = index % FRAMES_IN_FLIGHT;
            let following = times.next();
            let maps = self.sea.next(following)?;
            let Offscreen { readback, target } = &self.offscreen;
            self.afloat.begin(&self.buoys, maps);
            self.afloat.add(&self.solids);
            let solids = self.afloat.solids();
            let moment = Moment { eyes: &self.eyes, maps, solids, vignette: self.vignette };
            drawn[slot] = self.painter.paint(index, (target, Turn::default()), moment, |commands| {
                target.copy_to(commands, &readback[slot]);
            })?;
            if let Some(before) = index.checked_sub(1) {
                self.finish(before, &drawn, &mut take)?;
            }
            if following.is_none() {
                return self.finish(index, &drawn, &mut take);
            }
        }
        Ok(())
    }

    fn finish(
        &self,
        index: usize,
        drawn: &[DrawCounts; FRAMES_IN_FLIGHT],
        take: &mut impl FnMut(Finished<'_>) -> Result<(), HostError>,
    ) -> Result<(), HostError> {
        let slot = index % FRAMES_IN_FLIGHT;
        self.painter.wait(index)?;
        let Offscreen { readback, target } = &self.offscreen;
        let bytes = readback[slot].bytes();
        let length = usize::try_from(target.bytes()).unwrap_or(usize::MAX).min(bytes.len());
        take(Finished { index, pixels: &bytes[..length], counts: drawn[slot] })
    }

    /// The device drawn on.
    pub fn device(&self) -> &Device {
        self.painter.device()
    }

    /// Ends everything, and returns what validation has said, the end included: it tells of what was never destroyed.
    pub fn close(self) -> Vec<String> {
        let heard = self.painter.device().instance().heard();
        drop(self);
        heard.all()
    }

    /// Bytes uploaded by the latest frame.
    pub const fn uploaded(&self) -> u64 {
        self.painter.uploaded()
    }
}

/// Vulkan, and a target with buffers to read it back.
fn open(settings: &HeadlessSettings) -> Result<(Arc<Device>, Offscreen), HostError> {
    let instance = Instance::new(settings.validation, &[], &Directly)?;
    let physical = PhysicalDevice::choose(&instance, settings.device.as_deref())?;
    let needs = DeviceNeeds { cache: settings.cache.as_deref(), ..DeviceNeeds::default() };
    let device = Device::new(instance, physical, &needs)?;
    let metres = settings.look == Look::Metres;
    let target = Target::new(
        &device,
        TargetInfo {
            extent: vk::Extent2D { width: settings.size[0], height: settings.size[1] },
            views: if settings.stereo { 2 } else { 1 },
            format: if metres { vk::Format::R32_SFLOAT } else { vk::Format::R8G8B8A8_SRGB },
            // A height between two surfaces would be the height of neither.
            samples: if metres { vk::SampleCountFlags::TYPE_1 } else { vk::SampleCountFlags::TYPE_4 },
        },
    )?;
    let usage = vk::BufferUsageFlags::TRANSFER_DST;
    let readback = (0..FRAMES_IN_FLIGHT)
        .map(|_| Buffer::new(&device, "readback", target.bytes(), usage, MemoryLocation::GpuToCpu))
        .collect::<Result<_, GpuError>>()?;
    Ok((device, Offscreen { readback, target }))
}
