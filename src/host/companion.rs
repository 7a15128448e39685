//! Who stands beside a headset's run: a window that mirrors it, a person at the keyboard, a log, a screenshot.
//!
//! Nothing here may cost the headset a frame. The window is shown what there is when it has a place for it, and whatever
//! happens to it ends the mirror and not the session.

use super::headset::{Drawn, Guest, HeadsetFrame};
use super::mirror::Mirror;
use super::{DesktopWindow, FrameLog, FrameRecord, HostError, Key, Screenshots, read_back};
use crate::draw::Eye;
use crate::gpu::{Device, GpuError, Image, Pace, Picture, Presenter};
use crate::xr::VIEWS;
use serde::Serialize;
use std::ffi::CStr;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// What is wanted beside the headset.
#[derive(Clone, Debug)]
pub struct CompanionSettings {
    /// What the window shows.
    pub mirror: Mirror,
    /// Pixels of the window at first.
    pub size: [u32; 2],
    /// Where the last frame is kept.
    pub screenshot: Option<PathBuf>,
    /// Where a line is written for each frame.
    pub frame_log: Option<PathBuf>,
    /// Set by somebody outside who wants the end.
    pub stop: Arc<AtomicBool>,
}

/// A mirror, a log and a screenshot.
pub struct Companion {
    window: Option<DesktopWindow>,
    extensions: Vec<&'static CStr>,
    settings: CompanionSettings,
    device: Option<Arc<Device>>,
    screenshots: Screenshots,
    /// A key asked for a screenshot.
    keep: bool,
    /// A key asked for the panel, or for its end.
    panel: bool,
    log: FrameLog,
    begun: Instant,
    frames: u64,
}

/// A line of the log.
#[derive(Serialize)]
struct HeadsetRecord {
    #[serde(flatten)]
    frame: FrameRecord,
    /// The session's state.
    state: &'static str,
    /// Whether anything was drawn.
    shown: bool,
    /// Where it was seen from: left, right.
    #[serde(skip_serializing_if = "Option::is_none")]
    eyes: Option<[EyeRecord; VIEWS]>,
}

/// A view as `swell render --eye --look` could have it, but for its angles.
#[derive(Serialize)]
struct EyeRecord {
    /// World metres.
    position: [f64; 3],
    /// Where it looks, of unit length.
    ahead: [f32; 3],
    /// Tangents to the left, right, up and down.
    tangents: [f32; 4],
}

impl EyeRecord {
    fn of(eye: &Eye) -> Self {
        let ahead = -eye.axes.z_axis;
        let fov = eye.fov;
        Self {
            position: eye.position.into(),
            ahead: ahead.into(),
            tangents: [fov.left, fov.right, fov.up, fov.down],
        }
    }
}

impl Companion {
    /// Opens the window, where one is wanted and there is a display.
    ///
    /// # Errors
    /// A log that cannot be written.
    pub fn new(settings: CompanionSettings) -> Result<Self, HostError> {
        let log = FrameLog::create(settings.frame_log.as_deref())?;
        let (mut window, mut extensions) = (None, Vec::new());
        if settings.mirror.layers().is_some() {
            let opened = DesktopWindow::open("Swell: mirror", settings.size)
                .and_then(|window| Ok((window.extensions()?, window)));
            match opened {
                Ok((needed, opened)) => (window, extensions) = (Some(opened), needed),
                Err(error) => eprintln!("nothing is mirrored: {error}"),
            }
        }
        Ok(Self {
            window,
            extensions,
            settings,
            device: None,
            screenshots: Screenshots::default(),
            keep: false,
            panel: false,
            log,
            begun: Instant::now(),
            frames: 0,
        })
    }

    /// Ends the log, and waits for screenshots.
    ///
    /// # Errors
    /// One of the files could not be written.
    pub fn finish(mut self) -> Result<(), HostError> {
        self.screenshots.finish()?;
        Ok(self.log.finish()?)
    }

    fn end_mirror(&mut self, why: &dyn std::fmt::Display) {
        eprintln!("the mirror ends, the headset goes on: {why}");
        self.window = None;
    }

    /// Keeps both eyes, or the one that is mirrored.
    fn keep(&mut self, picture: &Image, path: PathBuf) -> Result<(), HostError> {
        let Some(device) = &self.device else { return Ok(()) };
        let pixels = read_back(device, picture)?;
        let [width, height] = picture.info.extent;
        let view = 4 * width as usize * height as usize;
        let (views, pixels) = match self.settings.mirror {
            Mirror::Left => (1, pixels.into_iter().take(view).collect()),
            Mirror::Right => (1, pixels.into_iter().skip(view).collect()),
            Mirror::Both | Mirror::None => (VIEWS as u32, pixels),
        };
        self.screenshots.write(path, picture.info.extent, views, pixels);
        Ok(())
    }

    fn mirror(&mut self, drawn: &Drawn<'_>) {
        let (Some(window), Some(picture), Some(layers)) =
            (&mut self.window, drawn.picture, self.settings.mirror.layers())
        else {
            return;
        };
        if let Err(error) = window.show(&Picture::finished(picture), layers, Duration::ZERO) {
            self.end_mirror(&error);
        }
    }
}

impl Guest for Companion {
    fn goes_on(&mut self) -> bool {
        if let Some(window) = &mut self.window {
            let pumped = window.pump(false);
            for key in window.pressed() {
                match key {
                    Key::End => self.settings.stop.store(true, Ordering::Relaxed),
                    Key::Screenshot => self.keep = true,
                    Key::Panel => self.panel ^= true,
                    _ => {}
                }
            }
            let closed = window.is_closed();
            match pumped {
                Err(error) => self.end_mirror(&error),
                Ok(()) if closed => self.end_mirror(&"its window was closed"),
                Ok(()) => {}
            }
        }
        !self.settings.stop.load(Ordering::Relaxed)
    }

    fn looks(&self) -> bool {
        self.window.is_some() || self.settings.screenshot.is_some()
    }

    fn instance_extensions(&self) -> &[&'static CStr] {
        &self.extensions
    }

    fn device_extensions(&self) -> &[&'static CStr] {
        if self.window.is_some() { Presenter::DEVICE_EXTENSIONS } else { &[] }
    }

    fn refused(&mut self, why: &GpuError) {
        self.end_mirror(why);
    }

    fn opened(&mut self, device: &Arc<Device>) -> Result<(), HostError> {
        self.device = Some(Arc::clone(device));
        let attached = self.window.as_mut().map(|window| window.attach(device, Pace::Mirror));
        if let Some(Err(error)) = attached {
            self.end_mirror(&error);
        }
        Ok(())
    }

    fn last(&mut self, picture: &Image) -> Result<(), HostError> {
        if let Some(window) = &self.window {
            window.wait()?;
        }
        match self.settings.screenshot.clone() {
            Some(path) => self.keep(picture, path),
            None => Ok(()),
        }
    }

    fn closing(&mut self) {
        if let Some(window) = &mut self.window {
            window.detach();
        }
        self.device = None;
    }

    fn asks_for_panel(&mut self) -> bool {
        std::mem::take(&mut self.panel)
    }

    fn frame(&mut self, frame: &HeadsetFrame<'_>) -> Result<(), HostError> {
        let took = self.begun.elapsed();
        self.begun = Instant::now();
        let drawn = frame.drawn.as_ref();
        let (counts, uploaded, sea) =
            drawn.map_or_else(Default::default, |drawn| (drawn.counts, drawn.uploaded, drawn.sea));
        self.log.add(&HeadsetRecord {
            frame: FrameRecord::new(self.frames, frame.time, counts, uploaded).took(took, sea),
            state: frame.state,
            shown: drawn.is_some(),
            eyes: drawn.map(|drawn| drawn.eyes.each_ref().map(EyeRecord::of)),
        })?;
        self.frames += 1;
        if let Some(drawn) = drawn {
            self.mirror(drawn);
            if let (true, Some(picture)) = (std::mem::take(&mut self.keep), drawn.picture) {
                let path = self.screenshots.next_name(Path::new(""));
                eprintln!("{}", path.display());
                self.keep(picture, path)?;
            }
        }
        Ok(())
    }
}
