//! `swell run`.
use super::shared::{SceneFile, cache_folder};
use super::values::{frame_count, hertz, picture_size, quality, threads, xr_scale};
use clap::Args;
use std::path::PathBuf;
use swell::commands::{self, AuthoringOptions, CommandError, RunOptions, XrOptions};
use swell::host::Mirror;
use swell::lod::Quality;

#[derive(Args)]
pub struct Run {
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

impl Run {
    /// Does it.
    pub fn run(self) -> Result<(), CommandError> {
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
