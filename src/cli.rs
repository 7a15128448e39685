//! Arguments and what they lead to: a file for each command.

mod bake;
mod bench;
mod info;
mod query;
mod render;
mod run;
mod shared;
mod values;

use clap::{Parser, Subcommand};
use swell::commands::CommandError;

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
    Run(run::Run),
    /// Draw a scene into pictures.
    Render(render::Render),
    /// Write the sea's maps into files.
    Bake(bake::Bake),
    /// Tell where the surface is, as one JSON object a point.
    Query(query::Query),
    /// Measure what a frame costs on this machine.
    Bench(bench::Bench),
    /// List Vulkan devices, what they lack, and which would be used.
    Info(info::Info),
}

impl Arguments {
    /// Does what was asked.
    pub fn run(self, order: &[String]) -> Result<(), CommandError> {
        match self.command {
            Command::Run(run) => run.run(),
            Command::Render(render) => render.run(),
            Command::Bake(bake) => bake.run(),
            Command::Query(query) => query.run(order),
            Command::Bench(bench) => bench.run(),
            Command::Info(info) => info.run(),
        }
    }
}
