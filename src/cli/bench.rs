//! `swell bench`.
use super::values::{grid_size, measuring_time, threads};
use clap::Args;
use std::io::stdout;
use std::path::PathBuf;
use std::time::Duration;
use swell::commands::bench::{CaseName, IsaChoice};
use swell::commands::{self, BenchOptions, CommandError};

#[derive(Args)]
pub struct Bench {
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

impl Bench {
    /// Does it.
    pub fn run(self) -> Result<(), CommandError> {
        let options = BenchOptions {
            json: self.json,
            plot: self.plot,
            threads: self.threads,
            isa: self.isa.unwrap_or(IsaChoice::Best),
            only: self.only,
            sizes: self.sizes,
            time: self.time,
            device: self.device,
        };
        commands::bench(&options, stdout().lock())
    }
}
