//! `swell bake`.
use super::shared::{SceneFile, Timeline};
use super::values::threads;
use clap::Args;
use std::path::PathBuf;
use swell::commands::{self, BakeOptions, CommandError, bake::Format};

#[derive(Args)]
pub struct Bake {
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

impl Bake {
    /// Does it.
    pub fn run(self) -> Result<(), CommandError> {
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
