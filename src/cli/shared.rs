//! Arguments that several commands have.
use clap::Args;
use std::path::PathBuf;
use swell::commands::{Clock, CommandError, Frames};
use swell::scene::Scene;

#[derive(Args)]
pub struct SceneFile {
    /// Scene file; without one, the flagship: the open ocean.
    #[arg(long)]
    pub scene: Option<PathBuf>,
}

/// Which frames, and when they are.
#[derive(Args)]
pub struct Timeline {
    /// How many frames, or which: A..B without B. Files are numbered by frame, so parts of a sequence fit together.
    #[arg(long, default_value = "1", value_name = "N|A..B")]
    pub frames: Frames,
    /// Frames a second.
    #[arg(long, default_value_t = 30.0)]
    fps: f64,
    /// Time of frame 0, seconds.
    #[arg(long, default_value_t = 0.0, allow_negative_numbers = true)]
    start: f64,
}

impl SceneFile {
    /// Reads it, and tells what in it is hardly meant.
    pub fn load(self) -> Result<Scene, CommandError> {
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
    /// When frames are.
    pub fn clock(&self) -> Result<Clock, CommandError> {
        Ok(Clock::new(self.start, self.fps)?)
    }
}

/// Where compiled pipelines are kept: the user's cache folder, if there is one.
pub fn cache_folder() -> Option<PathBuf> {
    let variable = |name| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let base = variable("XDG_CACHE_HOME").or_else(|| Some(variable("HOME")?.join(".cache")))?;
    Some(base.join("swell"))
}
