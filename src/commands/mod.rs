//! The jobs of the command line, as functions: each takes a scene and plain options.

mod progress;
mod render;

pub use progress::Progress;
pub use render::{RenderOptions, render};

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
    /// Drawing failed.
    #[error(transparent)]
    Host(#[from] HostError),
    /// A file could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
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
            Self::Usage(_) | Self::Scene(_) => 2,
            _ => 1,
        }
    }
}
