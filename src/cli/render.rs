//! `swell render`.
use super::shared::{SceneFile, Timeline, cache_folder};
use super::values::{picture_size, point, threads};
use clap::Args;
use std::path::PathBuf;
use swell::commands::{self, CommandError, RenderOptions};
use swell::draw::Look;

#[derive(Args)]
pub struct Render {
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

impl Render {
    /// Does it.
    pub fn run(self) -> Result<(), CommandError> {
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
