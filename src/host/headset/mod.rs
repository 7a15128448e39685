//! Frames in a headset: the runtime says when a frame will be seen and from where.
//!
//! One thread does it all, and the sea's workers step ahead meanwhile. Whoever else wants a look (a window that mirrors, a
//! log, a person at the keyboard) is a [`Guest`] of this loop and never makes it wait.

mod adapt;
mod eyes;
mod leap;
mod pace;
mod panel;
mod patience;
mod ride;
mod session;
mod stage;
mod views;
mod visit;
mod warp;
mod world;

pub use visit::{Drawn, Guest, HeadsetFrame};

use super::HostError;
use super::authoring::AuthoringSettings;
use super::painter::{self, Painter};
use crate::draw::{Look, SkyMap};
use crate::gpu::Validation;
use crate::scene::Scene;
use crate::sea::SeaAhead;
use crate::xr::vendor::FoveationLevel;
use crate::xr::{Platform, XrError};
use adapt::Adapt;
use pace::Pace;
use panel::HeadsetPanel;
use patience::{Patience, find_runtime};
use ride::Ride;
use stage::Stage;
use std::path::PathBuf;
use std::sync::Arc;
use std::thread;
use std::time::Duration;
use world::{World, keep, open};

/// What to show, and how.
#[derive(Clone, Debug)]
pub struct HeadsetSettings {
    /// Where a runtime is looked for.
    pub platform: Platform,
    /// What is drawn on the surface.
    pub look: Look,
    /// Whether validation listens, Vulkan's and OpenXR's.
    pub validation: Validation,
    /// Worker threads for the sea; 0 for one a core.
    pub threads: usize,
    /// Where compiled pipelines are kept.
    pub cache: Option<PathBuf>,
    /// Wait for a runtime and a headset that are not there yet, or not any more.
    pub wait: bool,
    /// Frames end after this many were shown.
    pub frames: Option<u64>,
    /// Factor on the recommended size of a view, limited to what the runtime allows.
    pub scale: f32,
    /// Refresh rate wished for, hertz; the highest without a wish.
    pub refresh_rate: Option<f32>,
    /// How coarse the rim of a view may be, where the runtime can.
    pub foveation: FoveationLevel,
    /// Ask for clocks that last, where the runtime listens.
    pub sustained: bool,
    /// Tell Android's scheduler which threads make the frame.
    pub thread_hints: bool,
    /// Draw every other frame only, where the runtime makes those between from motion vectors (`XR_FB_space_warp`).
    pub space_warp: bool,
    /// Draw less finely while frames run late, beginning on the level of this number: [`crate::host::fallback::Ladder`].
    pub fallback: Option<usize>,
    /// The scene's text, for a panel that changes it; none without.
    pub authoring: Option<AuthoringSettings>,
}

/// What a run came to.
#[derive(Clone, Debug, Default)]
pub struct HeadsetReport {
    /// Frames that were drawn and shown.
    pub shown: u64,
    /// Frames that the runtime wanted empty, or whose images it did not give in time.
    pub skipped: u64,
    /// Steps of the sea that were made for a time at which no frame was seen, and made anew.
    pub missed: u64,
    /// Sessions begun anew after one was lost.
    pub recovered: u32,
    /// Number of the level that the run ended on, 0 for the best.
    pub level: usize,
    /// Everything validation said, the end included.
    pub said: Vec<String>,
}

/// How long between two looks at a session that does not run.
const REST: Duration = Duration::from_millis(10);
/// Sessions lost one after the other without a frame in between.
const MOST_LOSSES: u32 = 5;

/// Shows `scene` in a headset until the person, the runtime or `guest` ends it.
///
/// # Errors
/// No runtime or headset (unless they are waited for), no usable device, a runtime that has gone for good, out of memory.
pub fn headset(
    scene: &Scene,
    settings: &HeadsetSettings,
    guest: &mut dyn Guest,
) -> Result<HeadsetReport, HostError> {
    let scene = Arc::new(scene.in_headset());
    let (report, ride) = (HeadsetReport::default(), Ride::new(&scene)?);
    let adapt = Adapt::new(&scene, settings);
    let panel = settings.authoring.as_ref().map(|authoring| {
        let fit = authoring.fit.clone().then(|scene| *scene = scene.in_headset());
        HeadsetPanel::new(&AuthoringSettings { fit, ..authoring.clone() })
    });
    let panel = panel.transpose()?;
    let mut patience = Patience::default();
    let (runtime, started) = loop {
        let Some(runtime) = find_runtime(settings, guest, &mut patience)? else { return Ok(report) };
        let open = || open(settings, &runtime, guest, adapt.level().scale);
        match painter::start(&scene, settings.look, settings.threads, None, open) {
            Ok(started) => break (runtime, started),
            Err(error) => {
                // What a guest made on the device must not outlive the runtime.
                guest.closing();
                match error {
                    HostError::Xr(error) if settings.wait && error.may_pass() => {
                        if !patience.wait(&error, guest) {
                            return Ok(report);
                        }
                    }
                    error => return Err(error),
                }
            }
        }
    };
    let (sky, sea) = (Arc::new(started.sky), started.sea);
    let world = World { painter: started.painter, runtime };
    let mut show = Show { scene, settings, sky, sea, pace: Pace::default(), ride, adapt, panel, report };
    guest.level(show.adapt.number());
    let ended = show.go_on(world, started.opened, guest);
    // Whatever went wrong: what a guest made on the device must not outlive the runtime.
    guest.closing();
    show.report.missed = show.pace.missed();
    show.report.level = show.adapt.number();
    ended.map(|()| show.report)
}

/// What survives the runtime.
struct Show<'a> {
    scene: Arc<Scene>,
    settings: &'a HeadsetSettings,
    sky: Arc<SkyMap>,
    sea: SeaAhead,
    pace: Pace,
    ride: Ride,
    adapt: Adapt,
    panel: Option<HeadsetPanel>,
    report: HeadsetReport,
}

/// Why a session is over.
enum Over {
    /// Wanted.
    Ended,
    /// It was lost; the runtime is there.
    Lost,
}

impl Show<'_> {
    fn go_on(&mut self, world: World, stage: Stage, guest: &mut dyn Guest) -> Result<(), HostError> {
        let (mut world, mut stage) = (world, Some(stage));
        let mut losses = 0;
        self.use_level(&mut world)?;
        loop {
            let shown = self.report.shown;
            let over = self.session(&mut world, &mut stage, guest);
            let drew = self.report.shown > shown;
            losses = if drew { 0 } else { losses };
            let lost = match over {
                Ok(Over::Ended) => return self.part(world, stage, drew, guest),
                Ok(Over::Lost) | Err(HostError::Xr(XrError::SessionLost { .. })) => None,
                // A headset that went takes its system with it: no session can be made for it any more.
                Err(HostError::Xr(error)) if error.may_pass() || (losses > 0 && !drew) => Some(error),
                Err(error) => {
                    // The error worth telling is the first.
                    let _second = self.part(world, stage, drew, guest);
                    return Err(error);
                }
            };
            if self.is_enough(guest) {
                return self.part(world, stage, drew, guest);
            }
            losses += 1;
            let lost = lost.or((losses > MOST_LOSSES).then_some(XrError::LostAgain { times: losses }));
            match lost {
                None => {
                    eprintln!("the session was lost; beginning another");
                    if let Err(error) = keep(&world, stage.as_ref(), drew, guest) {
                        let _second = self.part(world, stage, false, guest);
                        return Err(error);
                    }
                    stage = None;
                    thread::sleep(REST * 10 * losses);
                }
                Some(error) => {
                    let parted = self.part(world, stage, drew, guest);
                    if !self.settings.wait {
                        return Err(error.into());
                    }
                    parted?;
                    let Some((found, opened)) = self.again(&error, guest)? else { return Ok(()) };
                    (world, stage, losses) = (found, Some(opened), 0);
                    self.use_level(&mut world)?;
                }
            }
            self.report.recovered += 1;
        }
    }

    /// Everything goes in order, and what validation said of it is kept.
    fn part(
        &mut self,
        world: World,
        stage: Option<Stage>,
        drew: bool,
        guest: &mut dyn Guest,
    ) -> Result<(), HostError> {
        let vulkan = world.painter.device().instance().heard();
        let openxr = world.runtime.heard();
        let kept = keep(&world, stage.as_ref(), drew, guest);
        guest.closing();
        if let Some(panel) = &mut self.panel {
            panel.forget();
        }
        // In this order: what is drawn into, what draws, the device with it, the runtime.
        drop(stage);
        drop(world);
        self.report.said.extend([vulkan.all(), openxr.all()].concat());
        kept
    }

    /// A runtime that came back after it had `gone`, its device and a first session; nothing where the guest would not wait
    /// longer.
    fn again(&mut self, gone: &XrError, guest: &mut dyn Guest) -> Result<Option<(World, Stage)>, HostError> {
        let mut patience = Patience::default();
        if !patience.wait(gone, guest) {
            return Ok(None);
        }
        loop {
            let Some(runtime) = find_runtime(self.settings, guest, &mut patience)? else { return Ok(None) };
            match open(self.settings, &runtime, guest, self.adapt.level().scale) {
                Err(HostError::Xr(error)) if error.may_pass() => {
                    guest.closing();
                    if !patience.wait(&error, guest) {
                        return Ok(None);
                    }
                }
                opened => {
                    let (device, stage) = opened?;
                    let painter = Painter::new(
                        &device,
                        stage.as_ref().pass(),
                        &self.scene,
                        &self.sky,
                        self.settings.look,
                    )?;
                    return Ok(Some((World { painter, runtime }, stage)));
                }
            }
        }
    }

    /// Whether all was shown that was to be, or the guest wants the end.
    fn is_enough(&self, guest: &mut dyn Guest) -> bool {
        self.settings.frames.is_some_and(|frames| self.report.shown >= frames) || !guest.goes_on()
    }
}
