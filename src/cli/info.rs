//! `swell info`.
use super::shared::SceneFile;
use clap::Args;
use std::io::stdout;
use swell::commands::{self, CommandError};

#[derive(Args)]
pub struct Info {
    #[command(flatten)]
    scene: SceneFile,
    /// As JSON.
    #[arg(long)]
    json: bool,
}

impl Info {
    /// Does it.
    pub fn run(self) -> Result<(), CommandError> {
        commands::info(&self.scene.load()?, self.json, stdout().lock())
    }
}
