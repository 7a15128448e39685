//! `swell bench`: what each thing of a frame costs on this machine, beside what others pay for the same.
//!
//! [`harness`] lets the cases of one size take turns; what a case is stands in the file of its name. See
//! `docs/performance.md` for what each row means.
mod cores;
mod fields;
mod harness;
mod lod;
mod machine;
mod paths;
mod peak;
mod plot;
mod query;
mod report;
mod rivals;
mod samples;
mod sea;
mod selection;
mod table;
mod upload;

pub use selection::{CASES, CaseName, IsaChoice};

use super::{CommandError, Progress};
use harness::{Case, Pools, ROUNDS, measure};
use report::{Report, Row};
use selection::Selection;
use std::io::Write;
use std::path::PathBuf;
use std::time::Duration;

/// What to measure, and where the answer goes.
#[derive(Clone, Debug)]
pub struct BenchOptions {
    /// File for the report as JSON.
    pub json: Option<PathBuf>,
    /// File for the plot of time against N, SVG.
    pub plot: Option<PathBuf>,
    /// Threads of the runs that have more than one; 0 for one a core.
    pub threads: usize,
    /// Instruction sets.
    pub isa: IsaChoice,
    /// The cases; none means all.
    pub only: Vec<CaseName>,
    /// Points along a side.
    pub sizes: Vec<usize>,
    /// What one case is measured for.
    pub time: Duration,
    /// Part of the name of the Vulkan device whose upload is recorded.
    pub device: Option<String>,
}

/// Errors of measuring.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// Making or stepping a sea.
    #[error(transparent)]
    Sea(#[from] crate::sea::SeaError),
    /// Making the quadtree.
    #[error(transparent)]
    Lod(#[from] crate::lod::LodError),
    /// Starting threads.
    #[error(transparent)]
    Jobs(#[from] crate::jobs::JobsError),
    /// Opening Vulkan or recording an upload.
    #[error(transparent)]
    Gpu(#[from] crate::gpu::GpuError),
    /// A rival does not do it.
    #[error("{rival} failed at {n} x {n}: {reason}")]
    Rival {
        /// Who.
        rival: &'static str,
        /// Points along a side.
        n: usize,
        /// What it said.
        reason: String,
    },
}

/// Measures what `options` select, writes the table to `out` and the files that are asked for.
///
/// # Errors
/// An instruction set that this machine lacks, a file that cannot be written (found before anything is measured), a case
/// that fails.
pub fn bench(options: &BenchOptions, mut out: impl Write) -> Result<(), CommandError> {
    let selection = Selection::new(options)?;
    paths::check(options)?;
    let machine = machine::Machine::measure(&selection.isas);
    write!(out, "{machine}").map_err(CommandError::Answer)?;
    let mut rows = Vec::new();
    let mut pools = Pools::default();
    let mut progress = Progress::new("measuring", u64::from(ROUNDS) * selection.sizes.len() as u64);
    for &n in &selection.sizes {
        let mut cases = cases(&selection, n)?;
        measure(&mut cases, &mut pools, options.time, || progress.step())?;
        rows.extend(cases.iter().flat_map(Row::of_case));
    }
    progress.finish();
    let report = Report::new(machine, rows);
    table::write(&report, &mut out).map_err(CommandError::Answer)?;
    if let Some(path) = &options.json {
        paths::write(path, &report.json())?;
    }
    if let Some(path) = &options.plot {
        paths::write(path, &plot::draw(&report))?;
    }
    Ok(())
}

/// Everything of size `n`.
fn cases(selection: &Selection, n: usize) -> Result<Vec<Case>, BenchError> {
    let mut cases = rivals::cases(selection, n)?;
    cases.extend(sea::cases(selection, n)?);
    cases.extend(cores::cases(selection, n));
    if n == selection.detail {
        cases.extend(query::cases(selection)?);
        cases.extend(upload::cases(selection)?);
        cases.extend(lod::cases(selection)?);
    }
    Ok(cases)
}
