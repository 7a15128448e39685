//! `[lod]`: the quadtree, and how densely its patches are drawn.
use super::assemble::{defaults, names};
use super::draft::{LodDraft, SignalDraft};
use super::reader::Reader;
use super::schema;
use crate::lod::tessellation::{Component, Signal};
use crate::lod::{LodSettings, SignalSettings, Tessellation};
use crate::sea::waves::Model;
use crate::sea::{SeaSettings, octaves};
use std::f64::consts::TAU;
use toml::de::DeTable;

/// Fewest levels of patches that are all alike.
const FEWEST_LEVELS: u32 = 2;

/// `[lod]` and `[lod.signal]`.
pub(super) fn read_lod(reader: &mut Reader<'_>, root: &DeTable<'_>) -> LodDraft {
    let mut lod: LodDraft = defaults(schema::LOD);
    lod.signal = defaults(schema::LOD_SIGNAL);
    let Some(table) = reader.table("", root, "lod") else { return lod };
    reader.check_names("lod", table, &names(schema::LOD), &["signal"]);
    reader.read("lod", table, schema::LOD, &mut lod);
    if let Some(item) = table.get("levels")
        && !lod.by_signal
        && lod.settings.levels.is_some_and(|levels| levels < FEWEST_LEVELS)
    {
        let problem = format!("needs lod.tessellation = \"signal\": the grid has {FEWEST_LEVELS} or more");
        reader.contradiction("lod.levels".to_owned(), item.span(), problem);
    }
    let Some(table) = reader.table("lod", table, "signal") else { return lod };
    reader.check_names("lod.signal", table, &names(schema::LOD_SIGNAL), &[]);
    reader.read("lod.signal", table, schema::LOD_SIGNAL, &mut lod.signal);
    let SignalSettings { fresnel, distance, .. } = lod.signal.settings;
    for (name, ascends, problem) in [
        ("fresnel", fresnel[0] <= fresnel[1], "descends; give the smaller number first"),
        ("distance", distance[0] < distance[1], "does not ascend; give the nearer distance first"),
    ] {
        if let Some(item) = table.get(name).filter(|_| !ascends) {
            reader.contradiction(format!("lod.signal.{name}"), item.span(), problem.to_owned());
        }
    }
    lod
}

/// The settings of a draft for `sea`, which says what the draft leaves open.
pub(super) fn settings(lod: LodDraft, sea: &SeaSettings) -> LodSettings {
    let SignalDraft { threshold, density, settings } = lod.signal;
    let tessellation = if lod.by_signal {
        let frequency = signal(sea).highest_frequency(threshold);
        Tessellation::Signal(SignalSettings { frequency, density, ..settings })
    } else {
        Tessellation::Grid
    };
    LodSettings {
        max_height: Some(lod.settings.max_height.unwrap_or_else(|| sea.max_height())),
        reach: lod.reach.unwrap_or_else(|| sea.reach()),
        tessellation,
        ..lod.settings
    }
}

/// What moves a sea's surface: octaves of its spectra, and each wave and octave of its models.
fn signal(sea: &SeaSettings) -> Signal {
    let octaves = octaves::octaves(sea).into_iter().map(|octave| (octave.wave_number, octave.variance));
    let waves = sea.models.iter().flat_map(Model::waves).map(|wave| (wave.k, wave.variance()));
    let component = |(wave_number, variance): (f64, f64)| Component {
        frequency: wave_number / TAU,
        amplitude: (2.0 * variance.max(0.0)).sqrt(),
    };
    Signal(octaves.chain(waves).map(component).collect())
}
