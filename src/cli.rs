//! Arguments and what they lead to.

use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;
use swell::commands::{self, CommandError, RenderOptions};
use swell::draw::Look;
use swell::scene::Scene;

/// An ocean simulated on the CPU and drawn with Vulkan.
#[derive(Parser)]
#[command(version, arg_required_else_help = true)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Draw a scene into pictures.
    Render(Render),
}

/// Which frames.
#[derive(Args)]
struct Frames {
    /// How many frames, or which: A..B without B. Files are numbered by frame, so parts of a sequence fit together.
    #[arg(long, default_value = "1", value_parser = frame_range, value_name = "N|A..B")]
    frames: std::ops::Range<u64>,
    /// Frames a second.
    #[arg(long, default_value_t = 30.0, value_parser = frames_a_second)]
    fps: f64,
    /// Time of frame 0, seconds.
    #[arg(long, default_value_t = 0.0, value_parser = seconds, allow_negative_numbers = true)]
    start: f64,
}

#[derive(Args)]
struct Render {
    /// Scene file; without one, the flagship: the open ocean.
    #[arg(long)]
    scene: Option<PathBuf>,
    /// A folder for frame_0000.png and so on, or one picture ending in .png (or .exr with --debug height).
    #[arg(long, value_name = "DIR|FILE")]
    out: PathBuf,
    #[command(flatten)]
    frames: Frames,
    /// Pixels of one view.
    #[arg(long, default_value = "1280x720", value_parser = picture_size, value_name = "WxH")]
    size: [u32; 2],
    /// Both eyes, side by side.
    #[arg(long)]
    stereo: bool,
    /// Where the viewer stands, world metres; the scene's own if not given.
    #[arg(long, value_parser = point, value_name = "X,Y,Z", allow_hyphen_values = true)]
    eye: Option<[f64; 3]>,
    /// What the viewer looks at, world metres; the scene's own direction if not given.
    #[arg(long, value_parser = point, value_name = "X,Y,Z", allow_hyphen_values = true)]
    look: Option<[f64; 3]>,
    /// Part of the name of the Vulkan device to use.
    #[arg(long)]
    device: Option<String>,
    /// Show this instead of water: wireframe, lod, normal, jacobian, height or holes.
    #[arg(long, value_name = "VIEW")]
    debug: Option<Look>,
    /// Fail on anything the Vulkan validation layers say.
    #[arg(long)]
    validate: bool,
    /// Worker threads for the sea; one a core if not given.
    #[arg(long, default_value_t = 0, hide_default_value = true)]
    threads: usize,
}

impl Arguments {
    /// Does what was asked.
    pub fn run(self) -> Result<(), CommandError> {
        match self.command {
            Command::Render(render) => render.run(),
        }
    }
}

impl Render {
    fn run(self) -> Result<(), CommandError> {
        let mut scene = load(self.scene)?;
        let camera = &mut scene.camera;
        if let Some(eye) = self.eye {
            for (look, (new, old)) in camera.look.iter_mut().zip(eye.iter().zip(camera.eye)) {
                *look += new - old;
            }
            camera.eye = eye;
        }
        camera.look = self.look.unwrap_or(camera.look);
        if camera.look == camera.eye {
            return Err(CommandError::Usage(
                "--look is the same point as --eye: there is no direction".to_owned(),
            ));
        }
        commands::render(
            &scene,
            &RenderOptions {
                out: self.out,
                frames: self.frames.frames,
                fps: self.frames.fps,
                start: self.frames.start,
                size: self.size,
                stereo: self.stereo,
                look: self.debug.unwrap_or_default(),
                device: self.device,
                validate: self.validate,
                threads: self.threads,
                cache: cache_folder(),
            },
        )
    }
}

fn load(scene: Option<PathBuf>) -> Result<Scene, CommandError> {
    Ok(match scene {
        Some(file) => Scene::load(file)?,
        None => Scene::flagship()?,
    })
}

/// Where compiled pipelines are kept: the user's cache folder, if there is one.
fn cache_folder() -> Option<PathBuf> {
    let variable = |name| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let base = variable("XDG_CACHE_HOME").or_else(|| Some(variable("HOME")?.join(".cache")))?;
    Some(base.join("swell"))
}

fn number(text: &str) -> Result<f64, String> {
    text.trim()
        .parse()
        .ok()
        .filter(|value: &f64| value.is_finite())
        .ok_or_else(|| format!("{text:?} is not a number"))
}

/// Far enough for any voyage, and f64 still resolves micrometres there.
const FARTHEST: f64 = 1e9;

fn point(text: &str) -> Result<[f64; 3], String> {
    let numbers: Vec<f64> = text.split(',').map(number).collect::<Result<_, _>>()?;
    if let Some(far) = numbers.iter().find(|value| value.abs() > FARTHEST) {
        return Err(format!("{far} is out of range: -1e9 to 1e9 metres"));
    }
    numbers.try_into().map_err(|_| "wanted three numbers: X,Y,Z".to_owned())
}

fn seconds(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if value.abs() <= FARTHEST { Ok(value) } else { Err("out of range: -1e9 to 1e9 seconds".to_owned()) }
}

fn frames_a_second(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if (0.001..=10_000.0).contains(&value) {
        Ok(value)
    } else {
        Err("out of range: 0.001 to 10000".to_owned())
    }
}

fn picture_size(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| text.parse().ok().filter(|side| (1..=16384).contains(side));
    let sides = text.split_once('x').and_then(|(width, height)| Some([side(width)?, side(height)?]));
    sides.ok_or_else(|| "wanted WIDTHxHEIGHT, each 1 to 16384".to_owned())
}

fn frame_range(text: &str) -> Result<std::ops::Range<u64>, String> {
    const MOST: u64 = 10_000_000;
    let frame = |text: &str| text.parse().ok().filter(|frame| *frame <= MOST);
    let range = match text.split_once("..") {
        Some((first, end)) => frame(first).zip(frame(end)).map(|(first, end)| first..end),
        None => frame(text).map(|count| 0..count),
    };
    range
        .filter(|range| range.start < range.end)
        .ok_or_else(|| format!("wanted N or A..B with A below B, 1 to {MOST} frames"))
}
