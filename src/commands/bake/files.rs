//! Names, sizes and headers of the files of a bake.
use super::{Format, encode};
use crate::output::OutputError;
use crate::sea::{CascadeMaps, SeaSettings};
use std::fs::File;
use std::io::{self, Cursor, Read};
use std::path::Path;

/// A file's first bytes are compared up to here: all of a NumPy header, the format of an OpenEXR image.
const HEADER_BYTES: usize = 128;

/// Which of a cascade's maps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Map {
    Displacement,
    Gradient,
}

/// One file: one map of one cascade in one frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct MapFile {
    pub map: Map,
    pub cascade: usize,
    pub frame: u64,
    pub format: Format,
}

impl MapFile {
    /// `displacement_0_0012.npy`: the cascade, then the frame in at least four digits.
    pub fn name(&self) -> String {
        let map = match self.map {
            Map::Displacement => "displacement",
            Map::Gradient => "gradient",
        };
        format!("{map}_{}_{:04}.{}", self.cascade, self.frame, self.format.name())
    }
}

/// How a whole file of some map begins, and how long it is: the same in each frame.
struct Shape {
    header: Vec<u8>,
    bytes: u64,
}

/// The files each frame has.
pub(super) struct Layout {
    format: Format,
    /// Displacement and gradient of each cascade.
    shapes: Vec<[Shape; 2]>,
}

impl Layout {
    /// The layout of bakes of `sea`.
    ///
    /// # Errors
    /// Those of encoding a map, which memory does not cause.
    pub fn new(sea: &SeaSettings, format: Format) -> io::Result<Self> {
        let shape = |map, maps: &CascadeMaps| {
            let mut bytes = Cursor::new(Vec::new());
            encode::write(&MapFile { map, cascade: 0, frame: 0, format }, maps, &mut bytes)?;
            let bytes = bytes.into_inner();
            let header = bytes.iter().copied().take(HEADER_BYTES).collect();
            Ok::<_, io::Error>(Shape { header, bytes: bytes.len() as u64 })
        };
        let shapes = sea.cascades.iter().map(|cascade| {
            let flat = CascadeMaps::new(cascade, true);
            Ok([shape(Map::Displacement, &flat)?, shape(Map::Gradient, &flat)?])
        });
        Ok(Self { format, shapes: shapes.collect::<io::Result<_>>()? })
    }

    /// The files of `frame`.
    pub fn files(&self, frame: u64) -> impl Iterator<Item = MapFile> {
        let format = self.format;
        (0..self.shapes.len()).flat_map(move |cascade| {
            [Map::Displacement, Map::Gradient].map(|map| MapFile { map, cascade, frame, format })
        })
    }

    /// Whether `file` is in `folder` with the header and the length it must have.
    ///
    /// # Errors
    /// [`OutputError::Read`] for a file that is there but cannot be read.
    pub fn is_whole(&self, folder: &Path, file: &MapFile) -> Result<bool, OutputError> {
        let path = folder.join(file.name());
        let [displacement, gradient] = &self.shapes[file.cascade];
        let shape = match file.map {
            Map::Displacement => displacement,
            Map::Gradient => gradient,
        };
        let check = || {
            let opened = match File::open(&path) {
                Ok(opened) => opened,
                Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(false),
                Err(error) => return Err(error),
            };
            let metadata = opened.metadata()?;
            if !metadata.is_file() || metadata.len() != shape.bytes {
                return Ok(false);
            }
            let mut header = Vec::with_capacity(HEADER_BYTES);
            opened.take(HEADER_BYTES as u64).read_to_end(&mut header)?;
            Ok(header == shape.header)
        };
        check().map_err(|source| OutputError::Read { path: path.clone(), source })
    }
}
