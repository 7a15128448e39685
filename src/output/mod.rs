//! Files that are written whole or not at all, and the formats of maps.
pub mod atomic;
pub mod exr;
pub mod npy;
pub mod png;

use std::{io, path::PathBuf};

/// Errors of writing files.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The folder for the files could not be made.
    #[error("cannot make the folder {}: {source}; choose another --out", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A file could not be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A file could not be written; nothing of it is left.
    #[error("cannot write {}: {source}; make room or choose another --out, whole files are kept", path.display())]
    Write {
        /// The file under its final name.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A leftover of an interrupted run could not be removed.
    #[error("cannot remove {}, left by an interrupted run: {source}; remove it by hand", path.display())]
    Remove {
        /// The leftover.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
}
