//! Frames in a window of the desktop, for a person who flies about. See `docs/window.md`.

mod clock;
mod desktop;
mod input;
mod interface;
mod panel;
mod readout;
mod record;
mod script;
mod shader_watch;

pub use desktop::DesktopWindow;
pub use input::Key;
pub use script::{Script, ScriptError};

use super::afloat::Afloat;
use super::authoring::{Authoring, AuthoringSettings, cut};
use super::painter::{self, Painter};
use super::view::Viewer;
use super::{FrameLog, FrameRecord, HostError, Screenshots, read_back};
use crate::draw::{DrawCounts, Eye, Look, Moment, SkyMap};
use crate::gpu::{
    Device, DeviceNeeds, Directly, Instance, Layers, Pace, PhysicalDevice, Picture, Presenter, Target,
    TargetInfo, Turn, Validation,
};
use crate::scene::Scene;
use crate::sea::{SeaAhead, query::Surface};
use ash::vk;
use clock::Clock;
use panel::PanelOver;
use readout::{Readout, TITLE};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// What to open, and with what.
#[derive(Clone, Debug)]
pub struct WindowSettings {
    /// Pixels of the window at first.
    pub size: [u32; 2],
    /// Part of the name of the Vulkan device to use.
    pub device: Option<String>,
    /// Whether validation listens.
    pub validation: Validation,
    /// Worker threads for the sea; 0 for one a core.
    pub threads: usize,
    /// Where compiled pipelines are kept.
    pub cache: Option<PathBuf>,
    /// The end comes after so many frames; without, when somebody wants it.
    pub frames: Option<u64>,
    /// Where the last frame is kept.
    pub screenshot: Option<PathBuf>,
    /// Where a line is written for each frame.
    pub frame_log: Option<PathBuf>,
    /// Set by somebody outside who wants the end.
    pub stop: Arc<AtomicBool>,
    /// The scene's text, for the panel to change.
    pub authoring: AuthoringSettings,
    /// A folder of shaders to be compiled whenever they change.
    pub shaders: Option<PathBuf>,
    /// What hands do, in their place; the end comes with its end.
    pub play: Option<Script>,
    /// A folder that every frame is written to.
    pub record: Option<PathBuf>,
}

/// How it ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ending {
    /// Frames drawn.
    pub frames: u64,
    /// Whether those were all that were asked for.
    pub complete: bool,
}

/// A frame shows no earlier than the screen has a place for it, and a screen that shows nothing holds up nobody for longer.
const PATIENCE: Duration = Duration::from_millis(100);

/// Looks by key, F1 to F7.
const LOOKS: [Look; 7] =
    [Look::Water, Look::Wireframe, Look::Lod, Look::Normal, Look::Jacobian, Look::Height, Look::Holes];

/// A renderer, its sea and its window.
pub struct WindowHost {
    sea: SeaAhead,
    /// Dropped before what its frames use, since dropping it waits for them.
    painter: Painter,
    authoring: Authoring,
    /// Dropped before the target that it is drawn on.
    panel: PanelOver,
    opened: Opened,
    scene: Arc<Scene>,
    sky: Arc<SkyMap>,
    look: Look,
    settings: WindowSettings,
    viewer: Viewer,
    afloat: Afloat,
    readout: Readout,
    screenshots: Screenshots,
    log: FrameLog,
    /// Frames so far.
    drawn: u64,
}

/// What is drawn into, and where that is shown.
struct Opened {
    /// Dropped first: it reads the target.
    window: DesktopWindow,
    target: Target,
}

impl AsRef<Target> for Opened {
    fn as_ref(&self) -> &Target {
        &self.target
    }
}

/// How a frame found its place.
struct Now {
    /// Since the start.
    since: Duration,
    /// Since the frame before.
    took: Duration,
}

impl WindowHost {
    /// Opens a window and Vulkan, makes the sea and the sky side by side, and begins the sea's first step.
    ///
    /// # Errors
    /// [`HostError::NoDisplay`]; no usable device, a sky file that cannot be read, out of memory, a log that cannot be
    /// written.
    pub fn new(scene: &Scene, settings: WindowSettings) -> Result<Self, HostError> {
        let window = DesktopWindow::open(TITLE, settings.size)?;
        let log = FrameLog::create(settings.frame_log.as_deref())?;
        let authoring = Authoring::new(&settings.authoring)?;
        let panel = PanelOver::new(settings.shaders.as_deref());
        let open = || open(window, &settings);
        let started = painter::start(scene, Look::Water, settings.threads, Some(0.0), open)?;
        Ok(Self {
            sea: started.sea,
            painter: started.painter,
            authoring,
            panel,
            opened: started.opened,
            scene: Arc::new(scene.clone()),
            sky: Arc::new(started.sky),
            look: Look::Water,
            settings,
            viewer: Viewer::new(&scene.camera),
            afloat: Afloat::default(),
            readout: Readout::new(),
            screenshots: Screenshots::default(),
            log,
            drawn: 0,
        })
    }

    /// Draws frames until somebody wants the end, or all that were asked for are drawn.
    ///
    /// # Errors
    /// The device, the display or a worker failed, or a file could not be written.
    pub fn run(&mut self) -> Result<Ending, HostError> {
        let start = Instant::now();
        let mut clock = Clock::new(self.opened.window.refresh());
        let (mut time, mut before) = (0.0, Duration::ZERO);
        let wanted = self.settings.frames;
        while wanted.is_none_or(|wanted| self.drawn < wanted) {
            self.opened.window.pump(true)?;
            if self.is_over()? {
                break;
            }
            if self.opened.window.is_hidden() || !self.fit_target()? {
                continue;
            }
            let since = start.elapsed();
            let now = Now { since, took: since - std::mem::replace(&mut before, since) };
            clock.set_refresh(self.opened.window.refresh());
            let last = wanted.is_some_and(|wanted| self.drawn + 1 == wanted);
            let following = (!last).then(|| match &self.settings.play {
                Some(play) => time + play.step(),
                None => clock.following(now.since.as_secs_f64()),
            });
            self.author(following.unwrap_or(time))?;
            self.run_panel(1e3 * now.took.as_secs_f64());
            let counts = self.frame(following, &now)?;
            let record = FrameRecord::new(self.drawn, time, counts, self.painter.uploaded())
                .took(now.took, self.sea.last_step());
            self.log.add(&record)?;
            if let Some(title) = self.readout.frame(&record) {
                self.opened.window.set_title(&title);
            }
            self.record_frame()?;
            self.drawn += 1;
            time = following.unwrap_or(time);
        }
        self.painter.wait_all()?;
        if let Some(path) = self.settings.screenshot.clone() {
            self.keep(path)?;
        }
        self.screenshots.finish()?;
        self.log.finish()?;
        Ok(Ending { frames: self.drawn, complete: wanted.is_none_or(|wanted| self.drawn == wanted) })
    }

    /// Does what keys ask for; whether one, or somebody else, asked for the end.
    fn is_over(&mut self) -> Result<bool, HostError> {
        let mut over = self.opened.window.is_closed() || self.settings.stop.load(Ordering::Relaxed);
        over |= self.play()?;
        for key in self.opened.window.pressed() {
            match key {
                Key::End => over = true,
                Key::Reset => {
                    // What was dragged before the key does not turn the view after it.
                    let _before = self.opened.window.input().controls(1);
                    self.viewer.reset();
                }
                Key::Orbit => self.viewer.toggle_orbit(),
                Key::Screenshot => {
                    let path = self.screenshots.next_name(Path::new(""));
                    eprintln!("{}", path.display());
                    self.keep(path)?;
                }
                Key::Fullscreen => {} // the window has seen to it
                Key::Readout => {
                    if let Some(title) = self.readout.toggle() {
                        self.opened.window.set_title(title);
                    }
                }
                Key::Look(index) => self.change_look(LOOKS[index])?,
                Key::Panel => self.toggle_panel(),
                Key::Quick(quick) => self.authoring.panel.quick(quick),
            }
        }
        Ok(over)
    }

    /// Draws and shows a frame, and begins the sea's step to `following`.
    fn frame(&mut self, following: Option<f64>, now: &Now) -> Result<DrawCounts, HostError> {
        // The old sea has no step after this frame's, the new one its first.
        let incoming = self.authoring.begin_incoming(following)?;
        let Opened { window, target } = &mut self.opened;
        let maps = self.sea.next(if incoming { None } else { following })?;
        let vk::Extent2D { width, height } = target.info.extent;
        let controls = window.input().controls(height);
        let surface = |x, z| Surface::above(maps, x, z).height();
        self.viewer.update(&controls, now.took.as_secs_f64(), surface);
        #[expect(clippy::cast_precision_loss, reason = "picture sizes")]
        let eyes: [Eye; 1] = [self.viewer.eye(width as f32 / height as f32)];
        let turn = Turn::default();
        #[expect(clippy::cast_possible_truncation, reason = "its remainder by the frames in flight counts")]
        let index = self.drawn as usize;
        self.afloat.begin(&self.scene.buoys, maps);
        let moment = Moment { eyes: &eyes, maps, solids: self.afloat.solids(), vignette: 0.0 };
        cut(&mut self.authoring.panel, maps, &eyes[0]);
        let mut over = Ok(());
        let panel = &mut self.panel;
        let counts = self.painter.paint(index, (target, turn), moment, |recorder| {
            over = panel.record(recorder, target, index);
        })?;
        over?;
        if let Some(finished) = target.finished() {
            window.show(&Picture::finished(finished), Layers::One(0), PATIENCE)?;
        }
        if incoming {
            self.adopt_incoming()?;
        }
        Ok(counts)
    }

    /// Makes the target as large as the window; whether the window has a size.
    fn fit_target(&mut self) -> Result<bool, HostError> {
        let Some([width, height]) = self.opened.window.extent()? else { return Ok(false) };
        let info = self.opened.target.info;
        let extent = vk::Extent2D { width, height };
        if extent != info.extent {
            self.painter.wait_all()?;
            self.opened.window.wait()?;
            self.panel.drop_overlay();
            self.opened.target = Target::new(self.painter.device(), TargetInfo { extent, ..info })?;
        }
        Ok(true)
    }

    /// Shows the sea as `look` from the next frame on; one that the device cannot show is told of and left alone.
    fn change_look(&mut self, look: Look) -> Result<(), HostError> {
        self.painter.wait_all()?;
        let device = Arc::clone(self.painter.device());
        match Painter::new(&device, self.opened.target.pass(), &self.scene, &self.sky, look) {
            Ok(painter) => (self.painter, self.look) = (painter, look),
            Err(error) => eprintln!("this look cannot be shown: {error}"),
        }
        Ok(())
    }

    /// Has the picture drawn last written to `path`, if there is one yet.
    fn keep(&mut self, path: PathBuf) -> Result<(), HostError> {
        if self.drawn == 0 {
            return Ok(());
        }
        if let Some(picture) = self.opened.target.finished() {
            let pixels = read_back(self.painter.device(), picture)?;
            self.screenshots.write(path, picture.info.extent, picture.info.layers, pixels);
        }
        Ok(())
    }

    /// The device drawn on.
    pub fn device(&self) -> &Device {
        self.painter.device()
    }

    /// Ends everything, and returns what validation has said, the end included.
    pub fn close(self) -> Vec<String> {
        let heard = self.painter.device().instance().heard();
        drop(self);
        heard.all()
    }
}

/// Vulkan on the window, and a target of its size.
fn open(mut window: DesktopWindow, settings: &WindowSettings) -> Result<(Arc<Device>, Opened), HostError> {
    let instance = Instance::new(settings.validation, &window.extensions()?, &Directly)?;
    let physical = PhysicalDevice::choose(&instance, settings.device.as_deref())?;
    let needs = DeviceNeeds {
        extensions: Presenter::DEVICE_EXTENSIONS,
        cache: settings.cache.as_deref(),
        ..DeviceNeeds::default()
    };
    let device = Device::new(instance, physical, &needs)?;
    window.attach(&device, Pace::Window)?;
    let [width, height] = window.extent()?.unwrap_or(settings.size);
    let info = TargetInfo {
        extent: vk::Extent2D { width, height },
        views: 1,
        format: vk::Format::R8G8B8A8_SRGB,
        samples: vk::SampleCountFlags::TYPE_4,
    };
    let target = Target::new(&device, info)?;
    Ok((device, Opened { window, target }))
}
