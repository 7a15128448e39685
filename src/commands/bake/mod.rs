//! `swell bake`: the maps of a sea, frame by frame, into files.
//!
//! Every file appears whole or not at all, its content depends on scene, start and rate alone, and a file that is there
//! already is not written again: a bake that was killed goes on where it stopped, and ranges of frames baked by several
//! processes into one folder fit together. `docs/bake.md` describes the files.
mod encode;
mod files;
mod manifest;

use super::frames::{Clock, Frames};
use super::progress::Progress;
use crate::jobs::{JobsError, Workers};
use crate::output::{OutputError, atomic};
use crate::scene::Scene;
use crate::sea::{Sea, SeaError};
use files::{Layout, MapFile};
use std::collections::HashSet;
use std::path::PathBuf;
use std::{fs, str::FromStr, time::Duration};

pub use manifest::MANIFEST;

/// The format of the maps' files.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// NumPy arrays.
    #[default]
    Npy,
    /// OpenEXR images.
    Exr,
}

impl Format {
    /// Name and file extension.
    pub fn name(self) -> &'static str {
        match self {
            Self::Npy => "npy",
            Self::Exr => "exr",
        }
    }
}

impl FromStr for Format {
    type Err = String;

    fn from_str(given: &str) -> Result<Self, String> {
        match given {
            "npy" => Ok(Self::Npy),
            "exr" => Ok(Self::Exr),
            _ => Err(format!("format {given:?} is not one of: npy, exr")),
        }
    }
}

/// A description that has been in the making for longer will not be finished.
const ABANDONED: Duration = Duration::from_secs(60);

/// What to bake, and where to.
#[derive(Clone, Debug, PartialEq)]
pub struct BakeOptions {
    /// Folder of the files; made if it is not there.
    pub out: PathBuf,
    /// Which frames.
    pub frames: Frames,
    /// When they are.
    pub clock: Clock,
    /// File format.
    pub format: Format,
    /// Worker threads; 0 for one per processor.
    pub threads: usize,
}

/// What a bake did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BakeReport {
    /// Map files written.
    pub written: u64,
    /// Map files that were there already, whole.
    pub kept: u64,
}

/// Errors of baking; all of them leave only whole files behind.
#[derive(Debug, thiserror::Error)]
pub enum BakeError {
    /// Reading or writing files.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The folder holds another bake.
    #[error(
        "{} was baked with other parameters: {there} there, {here} now; give another --out or remove that folder",
        path.display()
    )]
    OtherParameters {
        /// The description of the bake that is there.
        path: PathBuf,
        /// Its first line that differs.
        there: String,
        /// The same line of this bake.
        here: String,
    },
    /// A sea that is not, or not only, maps.
    #[error(
        "nothing to bake: maps are of the spectrum alone, and this sea has {what}, which no map holds; ask `swell query` for its \
         points"
    )]
    Formulas {
        /// Which, and where the scene has them.
        what: &'static str,
    },
    /// A format that cannot hold the maps.
    #[error("cannot describe the maps of this sea: {0}; this is a bug, please report it")]
    Encode(std::io::Error),
    /// Building or stepping the sea.
    #[error(transparent)]
    Sea(#[from] SeaError),
    /// Starting threads.
    #[error(transparent)]
    Jobs(#[from] JobsError),
}

/// Writes the maps of `scene`'s sea for every frame asked for, and the description of all frames in the folder.
///
/// # Errors
/// A sea with formulas, a folder or file that cannot be written, a folder with a bake of other parameters, a sea that
/// cannot be built.
pub fn bake(scene: &Scene, options: &BakeOptions) -> Result<BakeReport, BakeError> {
    if !scene.sea.spectral || !scene.sea.models.is_empty() {
        let what = if scene.sea.spectral { "a [[layer]]" } else { "a [sea] model that is a formula" };
        return Err(BakeError::Formulas { what });
    }
    let folder = &options.out;
    fs::create_dir_all(folder).map_err(|source| OutputError::Folder { path: folder.clone(), source })?;
    let layout = Layout::new(&scene.sea, options.format).map_err(BakeError::Encode)?;
    let manifest = manifest::Manifest::new(&scene.sea, options.clock, options.format)
        .map_err(|error| BakeError::Encode(error.into()))?;
    manifest.agree(folder)?;

    let own: HashSet<String> = options
        .frames
        .indices()
        .flat_map(|frame| layout.files(frame).map(|file| file.name()).collect::<Vec<_>>())
        .collect();
    atomic::remove_leftovers(folder, |name, age| {
        // Other processes that bake other frames write the description too.
        own.contains(name) || name == MANIFEST && age > ABANDONED
    })?;
    manifest.write(folder, &layout)?;

    let mut report = BakeReport { written: 0, kept: 0 };
    let mut progress = Progress::new("baking", options.frames.count());
    let mut sea = None;
    for frame in options.frames.indices() {
        let missing = missing(folder, &layout, frame)?;
        report.kept += layout.files(frame).count() as u64 - missing.len() as u64;
        if !missing.is_empty() {
            // Built for the first file that is missing: a bake that is whole already costs nothing.
            let (workers, sea, maps) = match &mut sea {
                Some(ready) => ready,
                none => {
                    let workers = Workers::new(options.threads)?;
                    let built = workers.run(|| Sea::new(&scene.sea))?;
                    let maps = built.new_maps_with_planes();
                    none.insert((workers, built, maps))
                }
            };
            workers.run(|| sea.step(options.clock.time(frame), maps))?;
            for file in missing {
                let cascade = &maps.cascades[file.cascade];
                atomic::write_whole(&folder.join(file.name()), |sink| encode::write(&file, cascade, sink))?;
                report.written += 1;
            }
        }
        progress.step();
    }
    manifest.write(folder, &layout)?;
    Ok(report)
}

/// The files of `frame` that are not there whole.
fn missing(folder: &std::path::Path, layout: &Layout, frame: u64) -> Result<Vec<MapFile>, BakeError> {
    let mut missing = Vec::new();
    for file in layout.files(frame) {
        if !layout.is_whole(folder, &file)? {
            missing.push(file);
        }
    }
    Ok(missing)
}
