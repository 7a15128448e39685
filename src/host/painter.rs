//! What every host draws frames with: a renderer, and a command buffer for each frame in flight.

use super::HostError;
use crate::draw::{DrawCounts, HiddenMesh, Look, Moment, Renderer, SkyMap};
use crate::gpu::{Commands, Device, FRAMES_IN_FLIGHT, GpuError, Pass, Recorder, Target, Turn};
use crate::jobs::Workers;
use crate::lod::Quality;
use crate::scene::Scene;
use crate::sea::{Sea, SeaAhead};
use std::sync::Arc;
use std::thread;

/// A renderer and its frames in flight.
pub struct Painter {
    /// Dropped before what their frames use, since dropping them waits for the frames.
    commands: Vec<Commands>,
    renderer: Renderer,
    device: Arc<Device>,
}

impl Painter {
    /// A renderer of `scene`, seen as `look`, for targets of `pass`.
    ///
    /// # Errors
    /// Out of memory, or the device cannot draw this look.
    pub fn new(
        device: &Arc<Device>,
        pass: &Pass,
        scene: &Scene,
        sky: &SkyMap,
        look: Look,
    ) -> Result<Self, HostError> {
        let renderer = Renderer::new(device, pass, scene, sky, look)?;
        let commands = (0..FRAMES_IN_FLIGHT)
            .map(|i| Commands::new(device, &format!("frame {i}")))
            .collect::<Result<_, GpuError>>()?;
        Ok(Self { commands, renderer, device: Arc::clone(device) })
    }

    /// Records frame `index` into `target`, then whatever `after` adds, and hands both to the device. Waits for the frame
    /// before the last where the device is that far behind.
    ///
    /// # Errors
    /// The device was lost, or the maps are not the scene's.
    pub fn paint(
        &mut self,
        index: usize,
        target: (&Target, Turn),
        moment: Moment<'_>,
        after: impl FnOnce(Recorder<'_>),
    ) -> Result<DrawCounts, HostError> {
        self.paint_moving(index, target, None, moment, after)
    }

    /// The same, with the frame's motion vectors into `motion`, where there is one, right after the frame.
    ///
    /// # Errors
    /// As [`Self::paint`], or motion was not prepared.
    pub fn paint_moving(
        &mut self,
        index: usize,
        (target, turn): (&Target, Turn),
        motion: Option<(&Target, Turn)>,
        moment: Moment<'_>,
        after: impl FnOnce(Recorder<'_>),
    ) -> Result<DrawCounts, HostError> {
        let slot = index % FRAMES_IN_FLIGHT;
        let recording = self.commands[slot].begin()?;
        let mut counts = self.renderer.record(recording, target, turn, slot, moment)?;
        if let Some((target, turn)) = motion {
            counts += self.renderer.record_motion(recording, target, turn)?;
        }
        after(recording);
        self.commands[slot].submit()?;
        Ok(counts)
    }

    /// Waits until frame `index`, one of the last [`FRAMES_IN_FLIGHT`], is drawn.
    ///
    /// # Errors
    /// The device was lost.
    pub fn wait(&self, index: usize) -> Result<(), HostError> {
        Ok(self.commands[index % FRAMES_IN_FLIGHT].wait()?)
    }

    /// Waits until every frame is drawn: before what they are drawn into changes.
    ///
    /// # Errors
    /// The device was lost.
    pub fn wait_all(&self) -> Result<(), HostError> {
        (0..FRAMES_IN_FLIGHT).try_for_each(|index| self.wait(index))
    }

    /// Hides `meshes`, one for each view, from the next frame on.
    ///
    /// # Errors
    /// As [`Renderer::set_hidden_area`].
    pub fn set_hidden_area(&mut self, meshes: [HiddenMesh<'_>; 2]) -> Result<(), HostError> {
        self.wait_all()?;
        Ok(self.renderer.set_hidden_area(&self.device, meshes)?)
    }

    /// Readies motion vectors for targets like `target`. The frame after has none before it.
    ///
    /// # Errors
    /// As [`Renderer::prepare_motion`], or the device was lost.
    pub fn prepare_motion(&mut self, target: &Target) -> Result<(), HostError> {
        self.wait_all()?;
        Ok(self.renderer.prepare_motion(&self.device, target.pass())?)
    }

    /// Draws with another preset of the quadtree from the next frame on.
    ///
    /// # Errors
    /// As [`Renderer::set_quality`], or the device was lost.
    pub fn set_quality(&mut self, scene: &Scene, quality: Quality) -> Result<(), HostError> {
        self.wait_all()?;
        Ok(self.renderer.set_quality(&self.device, scene, quality)?)
    }

    /// Draws `scene` from the next frame on, which differs in colours, exposure and what floats from the one it was made for.
    pub fn repaint(&mut self, scene: &Scene, sky: &SkyMap, rms_height: f64) {
        self.renderer.repaint(scene, sky, rms_height);
    }

    /// The device drawn on.
    pub const fn device(&self) -> &Arc<Device> {
        &self.device
    }

    /// Bytes uploaded by the latest frame.
    pub const fn uploaded(&self) -> u64 {
        self.renderer.uploaded()
    }
}

/// What a host begins with, besides what it opened itself.
pub struct Started<T> {
    /// The sea, its first step on the way where its time was known.
    pub sea: SeaAhead,
    /// The sky, for a renderer that has to be made anew.
    pub sky: SkyMap,
    /// The renderer.
    pub painter: Painter,
    /// What `open` returned.
    pub opened: T,
}

/// Makes the sea's spectra and the sky on threads of their own while `open` opens Vulkan and whatever is drawn to, then
/// the renderer. `threads` workers step the sea (0 for one a core), first to the time `first`, seconds.
///
/// # Errors
/// Those of `open`, a sky file that cannot be read, out of memory.
pub fn start<T: AsRef<Target>>(
    scene: &Scene,
    look: Look,
    threads: usize,
    first: Option<f64>,
    open: impl FnOnce() -> Result<(Arc<Device>, T), HostError>,
) -> Result<Started<T>, HostError> {
    thread::scope(|scope| {
        let sea = scope.spawn(|| begin_sea(scene, threads, first));
        let sky = scope.spawn(|| SkyMap::new(&scene.sky));
        let (device, opened) = open()?;
        let sky = joined(sky.join())??;
        let painter = Painter::new(&device, opened.as_ref().pass(), scene, &sky, look)?;
        Ok(Started { sea: joined(sea.join())??, sky, painter, opened })
    })
}

/// A sea on workers of its own, its step to `first` on the way where that time is known.
///
/// # Errors
/// Out of threads, or a parameter that no checked scene has.
pub fn begin_sea(scene: &Scene, threads: usize, first: Option<f64>) -> Result<SeaAhead, HostError> {
    let workers = Workers::new(threads)?;
    let sea = workers.run(|| Sea::new(&scene.sea))?;
    let mut ahead = SeaAhead::new(sea, workers);
    if let Some(first) = first {
        ahead.begin(first)?;
    }
    Ok(ahead)
}

/// A panic of a helper thread goes on in the caller's.
fn joined<T>(result: thread::Result<T>) -> Result<T, HostError> {
    result.map_err(|panic| std::panic::resume_unwind(panic))
}
