//! The sea's models from a scene: waves one by one, fractal sums, layers; and what their steepness sums to.
use super::assemble::{defaults, names};
use super::draft::{LayerDraft, Loops, SeaDraft, SeaModel, Shape, WaveDraft};
use super::field::Alternative;
use super::reader::Reader;
use super::schema;
use crate::sea::waves::{
    FbmSettings, Front, Kernel, Kind, MAX_MODELS, MAX_OCTAVES, MAX_WAVES, Model, Wave, gerstner, loops,
};
use std::f64::consts::TAU;
use std::ops::Range;
use toml::de::DeTable;

/// The greatest wave number that ramps may lead to, rad/m: a wavelength of 6 mm.
const MOST_FREQUENCY: f64 = 1000.0;
/// The greatest speed that ramps may lead to, rad/s.
const MOST_SPEED: f64 = 1000.0;
/// Sums of steepnesses that exceed 1 by no more than this were meant to be 1.
const ROUNDING: f64 = 1e-9;

/// A model as it was found.
pub(super) enum ModelDraft {
    Waves(Vec<FoundWave>),
    Fbm(Box<FbmSettings>, Range<usize>),
}

/// A wave and where it was found.
#[derive(Clone)]
pub(super) struct FoundWave {
    draft: WaveDraft,
    /// "sea.wave 2", counted from 1.
    name: String,
    span: Range<usize>,
}

/// Reads the waves under `path`, "sea" or "layer".
pub(super) fn read_waves(reader: &mut Reader<'_>, path: &str, table: &DeTable<'_>) -> ModelDraft {
    let key = format!("{path}.wave");
    let mut waves = Vec::new();
    for (index, (wave, span)) in reader.tables(path, table, "wave").into_iter().enumerate() {
        let mut draft: WaveDraft = defaults(schema::WAVE);
        reader.check_names(&key, wave, &names(schema::WAVE), &[]);
        reader.read(&key, wave, schema::WAVE, &mut draft);
        check_shape(reader, &key, wave, &draft);
        waves.push(FoundWave { draft, name: format!("{key} {}", index + 1), span });
    }
    ModelDraft::Waves(waves)
}

/// Reports keys that the kind of wave has no use for, and those of a Gerstner wave that say too much or too little.
fn check_shape(reader: &mut Reader<'_>, path: &str, table: &DeTable<'_>, draft: &WaveDraft) {
    let mut report = |key: &str, problem: String| {
        if let Some(item) = table.get(key) {
            reader.contradiction(format!("{path}.{key}"), item.span(), problem);
        }
    };
    for (key, shapes) in schema::KEYS_OF_KINDS {
        if !shapes.contains(&draft.shape) {
            report(key, is_for(shapes));
        }
    }
    let Alternative { kind, alone, together } = schema::GERSTNER_FORMS;
    if draft.shape.word() == kind {
        let [a, b] = together.map(|(key, _)| key);
        match [alone, a, b].map(|key| table.get(key).is_some()) {
            [true, true, _] | [true, _, true] => {
                report(alone, format!("says it all: leave out {a} and {b}, or give both in its place"));
            }
            [false, true, false] => report(a, format!("needs {b} beside it; or give {alone} in its place")),
            [false, false, true] => report(b, format!("needs {a} beside it; or give {alone} in its place")),
            _ => {}
        }
    }
}

/// "is for the kinds peaked and circular"
fn is_for(shapes: &[Shape]) -> String {
    let words: Vec<&str> = shapes.iter().map(|shape| shape.word()).collect();
    match words.split_last() {
        Some((last, [])) => format!("is for the kind {last}"),
        Some((last, others)) => format!("is for the kinds {} and {last}", others.join(", ")),
        None => "is for no kind".to_owned(),
    }
}

/// Reads the octaves under `path`, "sea" or "layer", whose table begins at `span`.
pub(super) fn read_fbm(
    reader: &mut Reader<'_>,
    path: &str,
    table: &DeTable<'_>,
    span: Range<usize>,
) -> ModelDraft {
    let mut fbm: FbmSettings = defaults(schema::FBM);
    fbm.foam = defaults(schema::FBM_FOAM);
    reader.read(path, table, schema::FBM, &mut fbm);
    let place = |key: &str| table.get(key).map_or(span.clone(), |item| item.span());
    let last = (fbm.octaves - 1) as f64;
    for (key, first, ramp, most, unit) in [
        ("frequency_ramp", fbm.frequency, fbm.frequency_ramp, MOST_FREQUENCY, "rad/m"),
        ("speed_ramp", fbm.speed.abs(), fbm.speed_ramp, MOST_SPEED, "rad/s"),
    ] {
        let reached = first * libm::pow(ramp, last);
        if reached > most {
            let problem = format!(
                "leads to {reached:.0} {unit} in the last octave, more than {most}; give less, or fewer octaves"
            );
            reader.contradiction(format!("{path}.{key}"), place(key), problem);
        }
    }
    if let Some(foam) = reader.table(path, table, "foam") {
        let path = format!("{path}.foam");
        reader.check_names(&path, foam, &names(schema::FBM_FOAM), &[]);
        reader.read(&path, foam, schema::FBM_FOAM, &mut fbm.foam);
        let mut ascends = |key: &str, good: bool| {
            if let (Some(item), false) = (foam.get(key), good) {
                let problem = "does not ascend: give the lesser one first".to_owned();
                reader.contradiction(format!("{path}.{key}"), item.span(), problem);
            }
        };
        ascends("range", fbm.foam.range[0] < fbm.foam.range[1]);
        ascends("reflection", fbm.foam.reflection[0] <= fbm.foam.reflection[1]);
    }
    ModelDraft::Fbm(Box::new(fbm), span)
}

/// Reads every `[[layer]]`.
pub(super) fn read_layers(reader: &mut Reader<'_>, root: &DeTable<'_>, models: &mut Vec<ModelDraft>) {
    for (table, span) in reader.tables("", root, "layer") {
        if models.len() == MAX_MODELS {
            let problem = format!("is one model too many: at most {MAX_MODELS}, that of [sea] included");
            reader.contradiction("layer".to_owned(), span, problem);
            break;
        }
        let mut layer: LayerDraft = defaults(schema::LAYER);
        reader.read("layer", table, schema::LAYER, &mut layer);
        let fbm = layer.model == SeaModel::Fbm;
        let own = [names(schema::LAYER), if fbm { names(schema::FBM) } else { Vec::new() }].concat();
        reader.check_names("layer", table, &own, if fbm { &["foam"] } else { &["wave"] });
        models.push(if fbm {
            read_fbm(reader, "layer", table, span)
        } else {
            read_waves(reader, "layer", table)
        });
    }
}

/// Checks what the models say together and works them out.
pub(super) fn build(
    reader: &mut Reader<'_>,
    drafts: Vec<ModelDraft>,
    sea: &SeaDraft,
    loops_span: Range<usize>,
) -> Vec<Model> {
    check_counts(reader, &drafts);
    let scale = check_loops(reader, &drafts, sea, loops_span);
    let closed = |wave: Wave| sea.loop_period.map_or(wave, |period| loops::close(wave, period));
    let models = drafts.into_iter().map(|draft| match draft {
        ModelDraft::Waves(found) => {
            let count = gerstner_count(&found);
            Model::Waves(
                found.iter().map(|found| closed(wave(&found.draft, sea.gravity, count, scale))).collect(),
            )
        }
        ModelDraft::Fbm(settings, _) => {
            let mut fbm = FbmSettings { choppiness: scale * settings.choppiness, ..*settings }.build();
            fbm.octaves.iter_mut().for_each(|octave| *octave = closed(*octave));
            Model::Fbm(fbm)
        }
    });
    models.collect()
}

fn check_counts(reader: &mut Reader<'_>, drafts: &[ModelDraft]) {
    let waves: Vec<_> = drafts.iter().flat_map(found_waves).collect();
    if let Some(extra) = waves.get(MAX_WAVES) {
        let problem = format!("is one wave too many: at most {MAX_WAVES}, layers included");
        reader.contradiction(key(&extra.name), extra.span.clone(), problem);
    }
    let mut octaves = 0;
    for draft in drafts {
        if let ModelDraft::Fbm(settings, span) = draft {
            octaves += settings.octaves;
            if octaves > MAX_OCTAVES {
                let problem = format!("brings the octaves of all models to {octaves}: at most {MAX_OCTAVES}");
                reader.contradiction("layer".to_owned(), span.clone(), problem);
                break;
            }
        }
    }
}

/// The factor on every steepness; a warning or a fault where they sum to more than 1.
fn check_loops(
    reader: &mut Reader<'_>,
    drafts: &[ModelDraft],
    sea: &SeaDraft,
    loops_span: Range<usize>,
) -> f64 {
    let mut steep: Vec<(String, f64, Range<usize>)> = Vec::new();
    for (index, draft) in drafts.iter().enumerate() {
        match draft {
            ModelDraft::Waves(found) => {
                let count = gerstner_count(found);
                let gerstner = found.iter().filter(|found| found.draft.shape == Shape::Gerstner);
                steep.extend(gerstner.map(|found| {
                    let steepness = wave(&found.draft, sea.gravity, count, 1.0).steepness();
                    (found.name.clone(), steepness, found.span.clone())
                }));
            }
            ModelDraft::Fbm(settings, span) if settings.kernel == Kernel::Gerstner => {
                let sum = settings.build().octaves.iter().map(Wave::steepness).sum();
                let base = index == 0 && sea.model == SeaModel::Fbm;
                let name = format!("the octaves of {}", if base { "[sea]" } else { "a [[layer]]" });
                steep.push((name, sum, span.clone()));
            }
            ModelDraft::Fbm(..) => {}
        }
    }
    steep.retain(|(_, steepness, _)| *steepness > 0.0);
    let sum: f64 = steep.iter().map(|(_, steepness, _)| steepness).sum();
    if sum <= 1.0 + ROUNDING {
        return 1.0;
    }
    let list: Vec<_> =
        steep.iter().map(|(name, steepness, _)| format!("{name} ({})", short(*steepness))).collect();
    let sums = format!("the steepness of {} sums to {}, more than 1", list.join(", "), short(sum));
    match sea.loops {
        Loops::Limit => return 1.0 / sum,
        Loops::Refuse => {
            let problem = format!("refuses this sea: {sums}; give less");
            reader.contradiction("sea.loops".to_owned(), loops_span, problem);
        }
        Loops::Allow => {
            let advice = "give less, or sea.loops = \"limit\"";
            reader.warn(&steep[0].2, format!("{sums}: the surface may loop through itself; {advice}"));
        }
    }
    1.0
}

fn short(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}

/// "sea.wave" of "sea.wave 2".
fn key(name: &str) -> String {
    name.split(' ').next().unwrap_or(name).to_owned()
}

fn found_waves(draft: &ModelDraft) -> &[FoundWave] {
    match draft {
        ModelDraft::Waves(waves) => waves,
        ModelDraft::Fbm(..) => &[],
    }
}

/// n of Q = q / (k A n).
fn gerstner_count(waves: &[FoundWave]) -> usize {
    waves.iter().filter(|found| found.draft.shape == Shape::Gerstner).count()
}

/// Works a wave out, its steepness or q times `scale`.
fn wave(draft: &WaveDraft, gravity: f64, count: usize, scale: f64) -> Wave {
    let k = TAU / draft.wavelength;
    let speed = draft.speed.unwrap_or_else(|| (gravity / k).sqrt());
    let (sin, cos) = libm::sincos(draft.direction.unwrap_or_default());
    let amplitude = draft.amplitude.unwrap_or(0.1);
    let plain = Wave {
        kind: Kind::Sine,
        front: Front::Plane { direction: [cos, -sin] },
        k,
        frequency: speed / draft.wavelength,
        amplitude,
        horizontal: 0.0,
        sharpness: 1.0,
        phase: draft.phase,
    };
    match draft.shape {
        Shape::Sine => plain,
        Shape::Peaked => Wave { kind: Kind::Peaked, sharpness: draft.sharpness.unwrap_or(2.0), ..plain },
        Shape::Gerstner => {
            let [amplitude, horizontal] = match draft.q {
                Some(q) => [amplitude, gerstner::of_q(k, scale * q, count)],
                None => gerstner::of_steepness(k, scale * draft.steepness.unwrap_or(0.5)),
            };
            Wave { kind: Kind::Gerstner, amplitude, horizontal, ..plain }
        }
        Shape::Circular => Wave {
            kind: if draft.sharpness.is_some() { Kind::Peaked } else { Kind::Sine },
            sharpness: draft.sharpness.unwrap_or(1.0),
            front: Front::Ring { centre: draft.centre.unwrap_or_default() },
            ..plain
        },
    }
}
