//! What frames took, one JSON object a line, for whoever plots or tests it.

use crate::draw::DrawCounts;
use crate::output::OutputError;
use serde::Serialize;
use std::fs::File;
use std::io::{LineWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// What every host knows of a frame.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct FrameRecord {
    /// Counted from 0.
    pub index: u64,
    /// The sea's time, seconds.
    pub time: f64,
    /// Draw calls of the sea.
    pub draws: u32,
    /// Patches.
    pub patches: u32,
    /// Triangles a view.
    pub triangles: u32,
    /// Vertices a view.
    pub vertices: u32,
    /// Bytes uploaded.
    pub uploaded: u64,
    /// From the beginning of the frame before to that of this one.
    pub milliseconds: f64,
    /// What the sea's step took, on other threads.
    pub sea_milliseconds: f64,
}

impl FrameRecord {
    /// Frame `index`, which shows the sea of `time` seconds.
    pub fn new(index: u64, time: f64, counts: DrawCounts, uploaded: u64) -> Self {
        let DrawCounts { draws, patches, triangles, vertices } = counts;
        let (milliseconds, sea_milliseconds) = (0.0, 0.0);
        Self { index, time, draws, patches, triangles, vertices, uploaded, milliseconds, sea_milliseconds }
    }

    /// With how long the frame and the sea's step took.
    #[must_use]
    pub fn took(self, frame: Duration, sea: Duration) -> Self {
        let [milliseconds, sea_milliseconds] = [frame, sea].map(|time| 1e3 * time.as_secs_f64());
        Self { milliseconds, sea_milliseconds, ..self }
    }
}

/// Bytes that hold any line: one that is longer would be written in pieces.
const LONGEST: usize = 16 << 10;

/// A growing file, or none. Each line is written at once and whole: whoever follows it, or reads what a killed program left,
/// finds no half.
pub struct FrameLog {
    file: Option<(LineWriter<File>, PathBuf)>,
}

impl FrameLog {
    /// Begins the file at `path`, where one is wanted.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn create(path: Option<&Path>) -> Result<Self, OutputError> {
        let open = |path: &Path| {
            let file = File::create(path).map_err(|source| failed(path, source))?;
            Ok((LineWriter::with_capacity(LONGEST, file), path.to_owned()))
        };
        Ok(Self { file: path.map(open).transpose()? })
    }

    /// Adds a line: a [`FrameRecord`], or what a host has to say besides.
    ///
    /// # Errors
    /// The disk is full.
    pub fn add(&mut self, record: &impl Serialize) -> Result<(), OutputError> {
        let Some((file, path)) = &mut self.file else { return Ok(()) };
        let line = serde_json::to_writer(&mut *file, record).map_err(std::io::Error::from);
        line.and_then(|()| file.write_all(b"\n")).map_err(|source| failed(path, source))
    }

    /// Ends the file.
    ///
    /// # Errors
    /// The disk is full.
    pub fn finish(&mut self) -> Result<(), OutputError> {
        let Some((mut file, path)) = self.file.take() else { return Ok(()) };
        file.flush().map_err(|source| failed(&path, source))
    }
}

fn failed(path: &Path, source: std::io::Error) -> OutputError {
    OutputError::Write { path: path.to_owned(), source }
}
