//! `swell run`: a scene on a screen, or, where there is none, a clip.

use super::{Clock, CommandError, Frames, RenderOptions, render};
use crate::draw::Look;
use crate::gpu::Validation;
use crate::host::{
    AuthoringSettings, Companion, CompanionSettings, Fit, HeadsetSettings, HostError, Mirror, Script,
    WindowHost, WindowSettings, headset,
};
use crate::lod::Quality;
use crate::output::{OutputError, atomic::write_whole};
use crate::scene::{Scene, SceneError};
use crate::xr::{self, Platform, vendor::FoveationLevel};
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// What `swell run` is asked for.
#[derive(Clone, Debug)]
pub struct RunOptions {
    /// The end comes after so many frames; without, when somebody wants it.
    pub frames: Option<u64>,
    /// Where the last frame is kept.
    pub screenshot: Option<PathBuf>,
    /// Where a line is written for each frame.
    pub frame_log: Option<PathBuf>,
    /// Pixels of the window at first.
    pub size: [u32; 2],
    /// Shown in a headset.
    pub xr: Option<XrOptions>,
    /// A folder for the clip that is rendered where there is neither a display nor a headset.
    pub out: PathBuf,
    /// Part of the Vulkan device's name.
    pub device: Option<String>,
    /// Fail on anything the validation layers say.
    pub validate: bool,
    /// Worker threads for the sea; 0 for one a core.
    pub threads: usize,
    /// Where compiled pipelines are kept.
    pub cache: Option<PathBuf>,
    /// What a window authors.
    pub authoring: AuthoringOptions,
}

/// What a scene in a window is changed by, besides hands.
#[derive(Clone, Debug, Default)]
pub struct AuthoringOptions {
    /// The file that the scene was read from; without, the flagship that is built in.
    pub scene_file: Option<PathBuf>,
    /// The quality that stands for the scene's own.
    pub quality: Option<Quality>,
    /// A folder of shaders, compiled whenever they change.
    pub shaders: Option<PathBuf>,
    /// A script that plays what hands would do.
    pub play: Option<PathBuf>,
    /// A folder that every frame is written to.
    pub record: Option<PathBuf>,
}

/// How a headset is used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct XrOptions {
    /// Wait for a runtime and a headset.
    pub wait: bool,
    /// What a window beside it shows.
    pub mirror: Mirror,
    /// Factor on the recommended size of a view.
    pub scale: f32,
    /// Refresh rate to ask for, hertz.
    pub refresh_rate: Option<f32>,
    /// The runtime makes every other frame.
    pub space_warp: bool,
}

impl Default for XrOptions {
    fn default() -> Self {
        Self { wait: false, mirror: Mirror::None, scale: 1.0, refresh_rate: None, space_warp: false }
    }
}

/// Frames of a clip, and how many a second.
const CLIP: (u64, f64) = (90, 30.0);
/// Ctrl-C again, while the end is on its way: as the shell tells of a program that it ended.
const INTERRUPTED: i32 = 130;

/// Shows the scene in a headset where that was asked for, or else in a window, until somebody wants the end. Where no window
/// can be opened it goes to a headset if there is one, and else renders a clip and prints the clip's folder.
///
/// # Errors
/// No usable device, the device, the display or the headset's runtime was lost, fewer frames than were asked for, or a
/// validation message where those count.
pub fn run(scene: &Scene, options: &RunOptions) -> Result<(), CommandError> {
    let stop = listen()?;
    if let Some(xr) = options.xr {
        return in_headset(scene, options, xr, &stop);
    }
    match window(scene, options, &stop) {
        Err(CommandError::Host(HostError::NoDisplay(reason))) => match xr::about() {
            Ok(found) if found.headset.is_ok() => {
                eprintln!("no display ({reason}): showing it in the headset of {}", found.runtime);
                in_headset(scene, options, XrOptions::default(), &stop)
            }
            _ => {
                eprintln!(
                    "no display ({reason}) and no OpenXR runtime with a headset: rendering a clip instead"
                );
                clip(scene, options)
            }
        },
        other => other,
    }
}

/// Set once somebody wants the end: Ctrl-C, or what ends a service or a session.
fn listen() -> Result<Arc<AtomicBool>, CommandError> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&stop);
    ctrlc::set_handler(move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(INTERRUPTED);
        }
    })?;
    Ok(stop)
}

fn window(scene: &Scene, options: &RunOptions, stop: &Arc<AtomicBool>) -> Result<(), CommandError> {
    let AuthoringOptions { shaders, play, record, .. } = options.authoring.clone();
    let settings = WindowSettings {
        size: options.size,
        device: options.device.clone(),
        validation: if options.validate { Validation::On } else { Validation::Off },
        threads: options.threads,
        cache: options.cache.clone(),
        frames: options.frames,
        screenshot: options.screenshot.clone(),
        frame_log: options.frame_log.clone(),
        stop: Arc::clone(stop),
        authoring: authored(&options.authoring)?,
        shaders,
        play: play.as_deref().map(Script::load).transpose().map_err(HostError::from)?,
        record,
    };
    let mut host = WindowHost::new(scene, settings)?;
    let ended = host.run();
    let said = host.close();
    let ending = ended?;
    if !said.is_empty() {
        return Err(CommandError::Validation { count: said.len() });
    }
    match options.frames {
        Some(wanted) if !ending.complete => Err(CommandError::Early { drawn: ending.frames, wanted }),
        _ => Ok(()),
    }
}

/// The text that the scene was read from.
fn authored(options: &AuthoringOptions) -> Result<AuthoringSettings, CommandError> {
    let AuthoringOptions { scene_file: file, quality, .. } = options.clone();
    let text = match &file {
        Some(file) => {
            fs::read_to_string(file).map_err(|source| SceneError::Read { path: file.clone(), source })?
        }
        None => Scene::FLAGSHIP.to_owned(),
    };
    let fit = Fit::new(move |scene| scene.lod.quality = quality.unwrap_or(scene.lod.quality));
    Ok(AuthoringSettings { text, file, fit })
}

fn in_headset(
    scene: &Scene,
    options: &RunOptions,
    xr: XrOptions,
    stop: &Arc<AtomicBool>,
) -> Result<(), CommandError> {
    if let Some(device) = &options.device {
        let reason = "the headset's runtime says which Vulkan device draws; leave --device out with --xr";
        return Err(CommandError::Usage(format!("--device {device}: {reason}")));
    }
    let mut companion = Companion::new(CompanionSettings {
        mirror: xr.mirror,
        size: options.size,
        screenshot: options.screenshot.clone(),
        frame_log: options.frame_log.clone(),
        stop: Arc::clone(stop),
    })?;
    let settings = HeadsetSettings {
        platform: Platform,
        look: Look::Water,
        validation: if options.validate { Validation::On } else { Validation::Off },
        threads: options.threads,
        cache: options.cache.clone(),
        wait: xr.wait,
        frames: options.frames,
        scale: xr.scale,
        refresh_rate: xr.refresh_rate,
        foveation: FoveationLevel::default(),
        sustained: true,
        thread_hints: true,
        space_warp: xr.space_warp,
        fallback: None,
        authoring: Some(authored(&options.authoring)?),
    };
    let shown = headset(scene, &settings, &mut companion);
    // The files are ended whatever happened.
    let finished = companion.finish();
    let report = shown?;
    finished?;
    eprintln!(
        "{} frames shown, {} left empty; {} steps of the sea made anew; {} sessions begun anew",
        report.shown, report.skipped, report.missed, report.recovered
    );
    if !report.said.is_empty() {
        return Err(CommandError::Validation { count: report.said.len() });
    }
    match options.frames {
        Some(wanted) if report.shown < wanted => Err(CommandError::Early { drawn: report.shown, wanted }),
        _ => Ok(()),
    }
}

/// What there is to see without a screen.
fn clip(scene: &Scene, options: &RunOptions) -> Result<(), CommandError> {
    let frames = options.frames.unwrap_or(CLIP.0);
    let render_options = RenderOptions {
        out: options.out.clone(),
        frames: Frames::new(0..frames)?,
        clock: Clock::new(0.0, CLIP.1)?,
        size: options.size,
        stereo: false,
        look: Look::Water,
        device: options.device.clone(),
        validate: options.validate,
        threads: options.threads,
        cache: options.cache.clone(),
    };
    render(scene, &render_options)?;
    if let Some(path) = &options.screenshot {
        copy(&options.out.join(format!("frame_{:04}.png", frames - 1)), path)?;
    }
    println!("{}", options.out.display());
    Ok(())
}

fn copy(from: &Path, to: &Path) -> Result<(), OutputError> {
    write_whole(to, |mut sink| io::copy(&mut File::open(from)?, &mut sink).map(|_| ()))
}
