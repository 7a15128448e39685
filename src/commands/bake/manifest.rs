//! `bake.json`: every parameter of a bake, and the time of each of its frames.
use super::files::Layout;
use super::{BakeError, Clock, Format};
use crate::output::{OutputError, atomic};
use crate::sea::{NormalKind, SeaSettings, Spectrum};
use serde::Serialize;
use std::collections::HashSet;
use std::fmt::Write as _;
use std::path::Path;
use std::{fs, io};

/// Name of the description in a bake's folder.
pub const MANIFEST: &str = "bake.json";

/// Between the parameters and the list of frames.
const FRAMES: &str = ",\n  \"frames\": [";

#[derive(Serialize)]
struct Parameters {
    swell: &'static str,
    format: &'static str,
    start: f64,
    fps: f64,
    gravity: f64,
    repeat_period: f64,
    normals: &'static str,
    foam: Foam,
    cascades: Vec<Cascade>,
}

#[derive(Serialize)]
struct Foam {
    threshold: f64,
    width: f64,
    fade_time: f64,
}

/// Angles in radians, lengths in metres; see `sea::CascadeSettings`.
#[derive(Serialize)]
struct Cascade {
    resolution: usize,
    patch_size: f64,
    rotation: f64,
    /// `null` has no upper limit: JSON has no infinity.
    band: [Option<f64>; 2],
    reference_resolution: usize,
    spectrum: &'static str,
    wind_speed: f64,
    wind_direction: f64,
    alignment: f64,
    choppiness: f64,
    small_wave_suppression: f64,
    roughness: f64,
    breaking: f64,
    amplitude: f64,
    fetch: f64,
    peak_enhancement: f64,
    depth: f64,
    seed: u64,
}

/// The description of one bake.
pub(super) struct Manifest {
    clock: Clock,
    /// Everything up to the list of frames.
    head: String,
}

impl Manifest {
    pub fn new(sea: &SeaSettings, clock: Clock, format: Format) -> serde_json::Result<Self> {
        let parameters = Parameters {
            swell: env!("CARGO_PKG_VERSION"),
            format: format.name(),
            start: clock.start(),
            fps: clock.fps(),
            gravity: sea.gravity,
            repeat_period: sea.repeat_period,
            normals: match sea.normals {
                NormalKind::Exact => "exact",
                NormalKind::Sheet => "sheet",
            },
            foam: Foam {
                threshold: sea.foam.threshold,
                width: sea.foam.width,
                fade_time: sea.foam.fade_time,
            },
            cascades: cascades(sea),
        };
        let mut head = serde_json::to_string_pretty(&parameters)?;
        head.truncate(head.trim_end_matches(['}', '\n']).len());
        Ok(Self { clock, head: head + FRAMES })
    }

    /// Refuses a folder that holds a bake of other parameters.
    pub fn agree(&self, folder: &Path) -> Result<(), BakeError> {
        let path = folder.join(MANIFEST);
        let written = match fs::read_to_string(&path) {
            Ok(written) => written,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
            Err(source) => return Err(OutputError::Read { path, source }.into()),
        };
        if written.starts_with(&self.head) {
            return Ok(());
        }
        let line = |text: Option<&str>| text.unwrap_or("nothing").trim().trim_end_matches(',').to_owned();
        let mut here = self.head.lines();
        let mut there = written.lines();
        loop {
            let (a, b) = (here.next(), there.next());
            if a != b || a.is_none() {
                return Err(BakeError::OtherParameters { path, there: line(b), here: line(a) });
            }
        }
    }

    /// Writes the description with all frames that are in the folder, whoever baked them.
    pub fn write(&self, folder: &Path, layout: &Layout) -> Result<(), OutputError> {
        let mut frames = frames_in(folder, layout)?;
        loop {
            let text = self.text(&frames);
            atomic::write_whole(&folder.join(MANIFEST), |sink| sink.write_all(text.as_bytes()))?;
            // Another process may have finished a frame and written the longer list meanwhile.
            let now = frames_in(folder, layout)?;
            if now == frames {
                return Ok(());
            }
            frames = now;
        }
    }

    fn text(&self, frames: &[u64]) -> String {
        let mut text = self.head.clone();
        for (index, &frame) in frames.iter().enumerate() {
            let comma = if index == 0 { "" } else { "," };
            // Writing to a string cannot fail; `{:?}` writes a float so that it reads back the same.
            let _ =
                write!(text, "{comma}\n    {{\"frame\": {frame}, \"time\": {:?}}}", self.clock.time(frame));
        }
        text.push_str(if frames.is_empty() { "]\n}\n" } else { "\n  ]\n}\n" });
        text
    }
}

fn cascades(sea: &SeaSettings) -> Vec<Cascade> {
    let limit = |k: f64| k.is_finite().then_some(k);
    let cascades = sea.cascades.iter().map(|c| Cascade {
        resolution: c.resolution,
        patch_size: c.patch_size,
        rotation: c.rotation,
        band: c.band.map(limit),
        reference_resolution: c.reference_resolution,
        spectrum: match c.spectrum {
            Spectrum::Phillips => "phillips",
            Spectrum::Jonswap => "jonswap",
            Spectrum::Tma => "tma",
        },
        wind_speed: c.wind_speed,
        wind_direction: c.wind_direction,
        alignment: c.alignment,
        choppiness: c.choppiness,
        small_wave_suppression: c.small_wave_suppression,
        roughness: c.roughness,
        breaking: c.breaking,
        amplitude: c.amplitude,
        fetch: c.fetch,
        peak_enhancement: c.peak_enhancement,
        depth: c.depth,
        seed: c.seed,
    });
    cascades.collect()
}

/// The frames of which every file is in `folder`, ascending.
fn frames_in(folder: &Path, layout: &Layout) -> Result<Vec<u64>, OutputError> {
    let unreadable = |source| OutputError::Read { path: folder.to_owned(), source };
    let names: HashSet<String> = fs::read_dir(folder)
        .map_err(unreadable)?
        .filter_map(|entry| entry.map(|entry| entry.file_name().into_string().ok()).transpose())
        .collect::<io::Result<_>>()
        .map_err(unreadable)?;
    let mut frames: Vec<u64> = names
        .iter()
        .filter_map(|name| name.strip_prefix("displacement_0_")?.split_once('.')?.0.parse().ok())
        .filter(|&frame| layout.files(frame).all(|file| names.contains(&file.name())))
        .collect();
    frames.sort_unstable();
    Ok(frames)
}
