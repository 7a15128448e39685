//! Arguments and what they lead to.

mod values;

use clap::{Args, Parser, Subcommand};
use std::io::{BufWriter, stdout};
use std::path::PathBuf;
use std::time::Duration;
use swell::commands::bench::{CaseName, IsaChoice};
use swell::commands::query::{Coordinates, Point};
use swell::commands::{
    self, AuthoringOptions, BakeOptions, BenchOptions, Clock, CommandError, Frames, RenderOptions,
    RunOptions, XrOptions, bake::Format,
};
use swell::draw::Look;
use swell::host::Mirror;
use swell::lod::Quality;
use swell::scene::Scene;
use values::{
    frame_count, grid_size, hertz, measuring_time, picture_size, point, quality, threads, xr_scale,
};

/// An ocean simulated on the CPU and drawn with Vulkan.
#[derive(Parser)]
#[command(version, arg_required_else_help = true)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Show a scene in a window or in a headset, or render a clip where there is neither.
    Run(Run),
    /// Draw a scene into pictures.
    Render(Render),
    /// Write the sea's maps into files.
    Bake(Bake),
    /// Tell where the surface is, as one JSON object a point.
    Query(Query),
    /// Measure what a frame costs on this machine.
    Bench(Bench),
    /// List Vulkan devices, what they lack, and which would be used.
    Info(Info),
}

#[derive(Args)]
struct SceneFile {
    /// Scene file; without one, the flagship: the open ocean.
    #[arg(long)]
    scene: Option<PathBuf>,
}

/// Which frames, and when they are.
#[derive(Args)]
struct Timeline {
    /// How many frames, or which: A..B without B. Files are numbered by frame, so parts of a sequence fit together.
    #[arg(long, default_value = "1", value_name = "N|A..B")]
    frames: Frames,
    /// Frames a second.
    #[arg(long, default_value_t = 30.0)]
    fps: f64,
    /// Time of frame 0, seconds.
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    start: f64,
}

#[derive(Args)]
struct Run {
    #[command(flatten)]
    scene: SceneFile,
    /// How finely the sea is drawn: low, medium, high or ultra; as the scene says if not given.
    #[arg(long, value_parser = quality, value_name = "QUALITY")]
    quality: Option<Quality>,
    /// End after N frames; without, when the window is closed.
    #[arg(long, value_parser = frame_count, value_name = "N")]
    frames: Option<u64>,
    /// Write the last frame to this file.
    #[arg(long, value_name = "F.png")]
    screenshot: Option<PathBuf>,
    /// Write a line of JSON for each frame to this file.
    #[arg(long, value_name = "F.jsonl")]
    frame_log: Option<PathBuf>,
    /// Pixels of the window.
    #[arg(long, default_value = "1280x720", value_parser = picture_size, value_name = "WxH")]
    size: [u32; 2],
    /// Compile the shaders in this folder whenever one of them changes, and draw with them.
    #[arg(long, value_name = "DIR", conflicts_with = "xr")]
    shaders: Option<PathBuf>,
    /// In a window, do what this script says in place of hands, and end with it: docs/panel.md has its words.
    #[arg(long, value_name = "F", conflicts_with = "xr")]
    play: Option<PathBuf>,
    /// Write every frame of a window to this folder, as frame_0000.png and so on.
    #[arg(long, value_name = "DIR", conflicts_with = "xr")]
    record: Option<PathBuf>,
    /// Show it in a headset, through OpenXR.
    #[arg(long)]
    xr: bool,
    /// Wait for the OpenXR runtime and its headset, at the start and whenever they go; implies --xr.
    #[arg(long)]
    xr_wait: bool,
    /// With --xr, what a window beside the headset shows: left, right, both or none.
    #[arg(long, default_value = "left", value_name = "EYE")]
    mirror: Mirror,
    /// With --xr, factor on the size that the headset recommends for a view: 0.1 to 4.
    #[arg(long, default_value_t = 1.0, value_parser = xr_scale, value_name = "FACTOR")]
    xr_scale: f32,
    /// With --xr, the refresh rate to ask for, hertz; the highest if not given.
    #[arg(long, value_parser = hertz, value_name = "HZ")]
    refresh_rate: Option<f32>,
    /// With --xr, let the runtime make every other frame where it can (XR_FB_space_warp).
    #[arg(long)]
    space_warp: bool,
    /// Folder for the clip that is rendered where there is neither display nor headset.
    #[arg(long, default_value = "out", value_name = "DIR")]
    out: PathBuf,
    /// Part of the name of the Vulkan device to use.
    #[arg(long)]
    device: Option<String>,
    /// Fail on anything the Vulkan validation layers say.
    #[arg(long)]
    validate: bool,
    /// Worker threads for the sea; one a core if not given.
    #[arg(long, default_value = "0", hide_default_value = true, value_parser = threads)]
    threads: usize,
}

#[derive(Args)]
struct Render {
    #[command(flatten)]
    scene: SceneFile,
    /// A folder for frame_0000.png and so on, or one picture ending in .png (or .exr with --debug height).
    #[arg(long, value_name = "DIR|FILE")]
    out: PathBuf,
    #[command(flatten)]
    timeline: Timeline,
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
    #[arg(long, default_value = "0", hide_default_value = true, value_parser = threads)]
    threads: usize,
}

#[derive(Args)]
struct Bake {
    #[command(flatten)]
    scene: SceneFile,
    /// Folder for the maps; what is whole in it is not written again.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    timeline: Timeline,
    /// Format of the maps: npy or exr.
    #[arg(long, default_value = "npy")]
    format: Format,
    /// Worker threads; one a core if not given.
    #[arg(long, default_value = "0", hide_default_value = true, value_parser = threads)]
    threads: usize,
}

#[derive(Args)]
struct Query {
    #[command(flatten)]
    scene: SceneFile,
    /// When, seconds.
    #[arg(long, allow_negative_numbers = true)]
    time: f64,
    /// The surface above or below this point of the world; may be given many times.
    #[arg(long, value_name = "X,Z", allow_hyphen_values = true)]
    at: Vec<Coordinates>,
    /// The water that rests at this point; may be given many times.
    #[arg(long, value_name = "X,Z", allow_hyphen_values = true)]
    rest: Vec<Coordinates>,
}

#[derive(Args)]
struct Bench {
    /// Write the report to this file as JSON.
    #[arg(long, value_name = "F.json")]
    json: Option<PathBuf>,
    /// Draw time against N into this file, as SVG.
    #[arg(long, value_name = "F.svg")]
    plot: Option<PathBuf>,
    /// Threads of the runs that have more than one; one a core if not given.
    #[arg(long, default_value = "0", hide_default_value = true, value_parser = threads)]
    threads: usize,
    /// Instruction set of the sea's kernels: avx512, avx2, sse, neon or scalar, or all that this machine has; the best
    /// if not given.
    #[arg(long, value_name = "ISA")]
    isa: Option<IsaChoice>,
    /// The cases to measure, by name; all if not given.
    #[arg(long, value_delimiter = ',', value_name = "NAME,..")]
    only: Vec<CaseName>,
    /// Points along a side of the grid.
    #[arg(long, value_delimiter = ',', default_value = "64,128,256,512", value_parser = grid_size, value_name = "N,..")]
    sizes: Vec<usize>,
    /// Seconds to measure each case for.
    #[arg(long, default_value = "0.5", value_parser = measuring_time, value_name = "SECONDS")]
    time: Duration,
    /// Part of the name of the Vulkan device whose upload is recorded; without one the best, or none.
    #[arg(long)]
    device: Option<String>,
}

#[derive(Args)]
struct Info {
    #[command(flatten)]
    scene: SceneFile,
    /// As JSON.
    #[arg(long)]
    json: bool,
}

impl Arguments {
    /// Does what was asked.
    pub fn run(self, order: &[String]) -> Result<(), CommandError> {
        match self.command {
            Command::Run(run) => run.run(),
            Command::Render(render) => render.run(),
            Command::Bake(bake) => bake.run(),
            Command::Query(query) => query.run(order),
            Command::Bench(bench) => commands::bench(&bench.options(), stdout().lock()),
            Command::Info(info) => commands::info(&info.scene.load()?, info.json, stdout().lock()),
        }
    }
}

impl SceneFile {
    fn load(self) -> Result<Scene, CommandError> {
        let scene = match self.scene {
            Some(file) => Scene::load(file)?,
            None => Scene::flagship()?,
        };
        for warning in &scene.warnings {
            eprintln!("warning: {warning}");
        }
        Ok(scene)
    }
}

impl Timeline {
    fn clock(&self) -> Result<Clock, CommandError> {
        Ok(Clock::new(self.start, self.fps)?)
    }
}

impl Run {
    fn run(self) -> Result<(), CommandError> {
        let authoring = AuthoringOptions {
            scene_file: self.scene.scene.clone(),
            quality: self.quality,
            shaders: self.shaders,
            play: self.play,
            record: self.record,
        };
        let mut scene = self.scene.load()?;
        scene.lod.quality = self.quality.unwrap_or(scene.lod.quality);
        let options = RunOptions {
            frames: self.frames,
            screenshot: self.screenshot,
            frame_log: self.frame_log,
            size: self.size,
            xr: (self.xr || self.xr_wait).then_some(XrOptions {
                wait: self.xr_wait,
                mirror: self.mirror,
                scale: self.xr_scale,
                refresh_rate: self.refresh_rate,
                space_warp: self.space_warp,
            }),
            out: self.out,
            device: self.device,
            validate: self.validate,
            threads: self.threads,
            cache: cache_folder(),
            authoring,
        };
        commands::run(&scene, &options)
    }
}

impl Render {
    fn run(self) -> Result<(), CommandError> {
        let mut scene = self.scene.load()?;
        let camera = &mut scene.camera;
        if let Some(eye) = self.eye {
            for (look, (new, old)) in camera.look.iter_mut().zip(eye.iter().zip(camera.eye)) {
                *look += new - old;
            }
            camera.eye = eye;
        }
        camera.look = self.look.unwrap_or(camera.look);
        if camera.look == camera.eye {
            let [x, y, z] = camera.eye;
            return Err(CommandError::Usage(format!(
                "--look and --eye are both {x},{y},{z}: there is no direction to look in"
            )));
        }
        let options = RenderOptions {
            out: self.out,
            frames: self.timeline.frames,
            clock: self.timeline.clock()?,
            size: self.size,
            stereo: self.stereo,
            look: self.debug.unwrap_or_default(),
            device: self.device,
            validate: self.validate,
            threads: self.threads,
            cache: cache_folder(),
        };
        commands::render(&scene, &options)
    }
}

impl Bake {
    fn run(self) -> Result<(), CommandError> {
        let scene = self.scene.load()?;
        let options = BakeOptions {
            out: self.out,
            frames: self.timeline.frames,
            clock: self.timeline.clock()?,
            format: self.format,
            threads: self.threads,
        };
        let report = commands::bake(&scene, &options)?;
        eprintln!("{} files written, {} were there already", report.written, report.kept);
        Ok(())
    }
}

impl Bench {
    fn options(self) -> BenchOptions {
        BenchOptions {
            json: self.json,
            plot: self.plot,
            threads: self.threads,
            isa: self.isa.unwrap_or(IsaChoice::Best),
            only: self.only,
            sizes: self.sizes,
            time: self.time,
            device: self.device,
        }
    }
}

impl Query {
    fn run(self, order: &[String]) -> Result<(), CommandError> {
        let (mut at, mut rest) = (self.at.into_iter(), self.rest.into_iter());
        // clap sorts values by option; answers come in the order of the questions.
        let points: Vec<Point> = order
            .iter()
            .filter_map(|word| match word.split('=').next() {
                Some("--at") => at.next().map(|point| Point::At(point.0)),
                Some("--rest") => rest.next().map(|point| Point::Rest(point.0)),
                _ => None,
            })
            .collect();
        if points.is_empty() {
            return Err(CommandError::Usage("no point to ask about: give --at X,Z or --rest X,Z".to_owned()));
        }
        if !(-1e9..=1e9).contains(&self.time) {
            return Err(CommandError::Usage(format!(
                "--time {} is out of range: -1e9 to 1e9 seconds",
                self.time
            )));
        }
        Ok(commands::query(&self.scene.load()?, self.time, &points, BufWriter::new(stdout().lock()))?)
    }
}

/// Where compiled pipelines are kept: the user's cache folder, if there is one.
fn cache_folder() -> Option<PathBuf> {
    let variable = |name| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let base = variable("XDG_CACHE_HOME").or_else(|| Some(variable("HOME")?.join(".cache")))?;
    Some(base.join("swell"))
}
