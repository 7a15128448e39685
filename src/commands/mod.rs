//! The jobs of the command line, as functions: each takes a scene and plain options.

pub mod bake;
pub mod bench;
pub mod frames;
mod info;
mod progress;
pub mod query;
mod render;
mod run;
mod scene_summary;

pub use bake::{BakeError, BakeOptions, BakeReport, bake};
pub use bench::{BenchError, BenchOptions, bench};
pub use frames::{Clock, Frames, FramesError};
pub use info::info;
pub use progress::Progress;
pub use query::{QueryError, query};
pub use render::{RenderOptions, render};
pub use run::{AuthoringOptions, RunOptions, XrOptions, run};
pub use scene_summary::SceneSummary;

use crate::host::HostError;
use crate::output::OutputError;
use crate::scene::SceneError;

/// Why a command did not do its job.
#[derive(Debug, thiserror::Error)]
pub enum CommandError {
    /// The command line asks for something that makes no sense.
    #[error("{0}")]
    Usage(String),
    /// The scene file is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Frames or times that make no animation.
    #[error(transparent)]
    Frames(#[from] FramesError),
    /// Baking failed.
    #[error(transparent)]
    Bake(#[from] BakeError),
    /// Measuring failed.
    #[error(transparent)]
    Bench(#[from] BenchError),
    /// A file that is to be written at the end cannot be.
    #[error("{option} {}: cannot be written: {source}; choose another place", path.display())]
    Place {
        /// The option that names it.
        option: &'static str,
        /// The file.
        path: std::path::PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A query failed.
    #[error(transparent)]
    Query(#[from] QueryError),
    /// Drawing failed.
    #[error(transparent)]
    Host(#[from] HostError),
    /// A file could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The answer could not be written.
    #[error("cannot write the answer: {0}")]
    Answer(std::io::Error),
    /// It ended before all was done.
    #[error("ended after {drawn} of {wanted} frames")]
    Early {
        /// Frames drawn.
        drawn: u64,
        /// Frames asked for.
        wanted: u64,
    },
    /// Nobody to tell that the end is wanted.
    #[error("cannot listen for Ctrl-C: {0}")]
    Signals(#[from] ctrlc::Error),
    /// The validation layers had something to say.
    #[error("the validation layers sent {count} messages (above)")]
    Validation {
        /// How many.
        count: usize,
    },
}

impl CommandError {
    /// 2 where the command line or the scene file is wrong, 1 where the work failed.
    pub const fn exit_status(&self) -> u8 {
        match self {
            Self::Usage(_) | Self::Scene(_) | Self::Frames(_) | Self::Bake(BakeError::Formulas { .. }) => 2,
            _ => 1,
        }
    }
}
