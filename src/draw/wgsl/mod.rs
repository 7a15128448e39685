//! WGSL to SPIR-V by naga: when Swell is built, by `build.rs`, which takes this folder in, and again while shaders are being changed.
//!
//! - `#include "file.wgsl"` on a line of its own takes in another file, once; errors still name the file they are in.
//! - A shader with `override CASCADES` is compiled once for each number of cascades: naga resolves overrides before it
//!   writes, as SPIR-V gets no specialisation constants from it.
//! - A shader is compiled anew for each of [`FLAVOURS`], where other files take the place of some that it includes.
//! - Each module holds one entry point, because Adreno's compilers have failed on several.
//! - How often each variant looks into a texture is counted, for docs/frame-cost.md and its test.

mod reflection;
mod source;
mod variant;

pub use reflection::Reflection;
pub use variant::Variant;

use naga::valid::{Capabilities, ValidationFlags, Validator};
use source::Source;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

/// As `sea::MAX_CASCADES`.
pub const MAX_CASCADES: u32 = 4;

/// A kind of sea or of shading: files that are included in the place of others.
struct Flavour {
    /// Before the names of what comes out.
    prefix: &'static str,
    /// What is included, and what instead. Shaders that include none of the former come without this flavour.
    instead: &'static [(&'static str, &'static str)],
    /// Fewest cascades that it is compiled for, where they matter.
    fewest: u32,
}

/// The first is the plain one.
const FLAVOURS: [Flavour; 4] = [
    Flavour { prefix: "", instead: &[], fewest: 1 },
    Flavour { prefix: "analytic_", instead: &[("waves.wgsl", "analytic.wgsl")], fewest: 0 },
    Flavour { prefix: "phong_", instead: &[("water.wgsl", "blinn_phong.wgsl")], fewest: 1 },
    Flavour {
        prefix: "analytic_phong_",
        instead: &[("waves.wgsl", "analytic.wgsl"), ("water.wgsl", "blinn_phong.wgsl")],
        fewest: 0,
    },
];

/// What is wrong, with file, line and column where they are known.
pub type Failure = String;

/// The files of `folder` that hold an entry point, and those that do not.
///
/// # Errors
/// The folder cannot be read.
pub fn files(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .map_err(|e| format!("{}: {e}", folder.display()))?
        .filter_map(|entry| entry.ok().map(|entry| entry.path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "wgsl"))
        .collect();
    files.sort();
    Ok(files)
}

/// One entry point of a file, in one flavour.
pub struct Entry {
    /// The file's name without its ending, after the flavour's prefix.
    pub stem: String,
    /// Its name.
    pub name: String,
    /// The number of cascades that the first variant is for.
    pub first: u32,
    /// For each number of cascades from `first`, or one where they make no difference.
    pub variants: Vec<Variant>,
}

/// Compiles every entry point of `file` in every flavour, none where it has none, and tells `reflection` what it declares.
///
/// # Errors
/// The file cannot be read, or naga refuses it.
pub fn compile(file: &Path, reflection: &mut Reflection) -> Result<Vec<Entry>, Failure> {
    let plain = Source::read(file, &[])?;
    if !plain.text.contains("@vertex") && !plain.text.contains("@fragment") {
        return Ok(Vec::new());
    }
    let mut entries = Vec::new();
    for flavour in &FLAVOURS {
        if flavour.instead.iter().all(|(name, _)| plain.seen.iter().any(|seen| seen.ends_with(name))) {
            let source = Source::read(file, flavour.instead)?;
            compile_flavour(&source, file, flavour, reflection, &mut entries)?;
        }
    }
    Ok(entries)
}

fn compile_flavour(
    source: &Source,
    file: &Path,
    flavour: &Flavour,
    reflection: &mut Reflection,
    entries: &mut Vec<Entry>,
) -> Result<(), Failure> {
    let module = naga::front::wgsl::parse_str(&source.text)
        .map_err(|error| source.error(error.location(&source.text), &describe(&error)))?;
    let capabilities = Capabilities::MULTIVIEW;
    let info = Validator::new(ValidationFlags::all(), capabilities)
        .validate(&module)
        .map_err(|error| source.error(error.location(&source.text), &describe(error.as_inner())))?;
    reflection.add(&module).map_err(|message| source.error(None, &message))?;
    let stem = format!("{}{}", flavour.prefix, file.file_stem().unwrap_or_default().to_string_lossy());
    let varies = module.overrides.iter().any(|(_, o)| o.name.as_deref() == Some("CASCADES"));
    for entry in &module.entry_points {
        // Stages to which the flavour makes no difference are the plain one's.
        let mut reached = BTreeSet::new();
        source.reach(&module, &entry.function.body, &mut reached);
        if !flavour.instead.iter().all(|(_, name)| reached.iter().any(|file| file.ends_with(name))) {
            continue;
        }
        let first = if varies { flavour.fewest } else { 1 };
        let mut variants = Vec::new();
        for cascades in first..=if varies { MAX_CASCADES } else { 1 } {
            let variant = Variant::write(&module, &info, entry, varies.then_some(cascades));
            variants.push(variant.map_err(|message| source.error(None, &message))?);
        }
        // The stages that do not look at CASCADES come out the same each time: one of them will do.
        variants.dedup();
        entries.push(Entry { stem: stem.clone(), name: entry.name.clone(), first, variants });
    }
    Ok(())
}

/// An error with the chain of its causes on one line.
fn describe(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        let _never = write!(text, ": {error}");
        cause = error.source();
    }
    text
}
