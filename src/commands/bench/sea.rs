//! The sea's cases: the transforms alone, whole steps, and the stages of a step.
use super::harness::{Body, Case, Label, Work};
use super::{BenchError, fields, selection::Selection};
use crate::sea::fft::ThreeFields;
use crate::sea::simd::Isa;
use crate::sea::{CascadeSettings, FoamSettings, Sea, SeaMaps, SeaSettings, split_bands, stages::STAGES};
use std::time::Duration;

/// Seconds of sea from one call to the next: a headset's frame.
const FRAME: f64 = 1.0 / 72.0;

/// Seconds between two ticks of the foam's memory in a sea that repeats after 200 s.
const TICK: f64 = 0.1;

/// Patch sizes of seas of one to four cascades, metres, those of a sea by descending size.
const PATCHES: [f64; 4] = [256.0, 61.0, 17.0, 5.0];

/// A sea of `cascades` cascades of `n` points, as `foam` says.
pub fn settings(n: usize, cascades: usize, foam: FoamSettings) -> SeaSettings {
    let patches: Vec<(f64, usize)> = PATCHES[..cascades].iter().map(|&size| (size, n)).collect();
    let cascade = |(&(patch_size, resolution), band)| CascadeSettings {
        patch_size,
        resolution,
        reference_resolution: n,
        band,
        ..CascadeSettings::default()
    };
    let cascades = patches.iter().zip(split_bands(&patches)).map(cascade).collect();
    SeaSettings { cascades, foam, ..SeaSettings::default() }
}

/// Foam without a memory: a step is then the same work every time.
pub const NO_MEMORY: FoamSettings = FoamSettings { threshold: 0.45, width: 0.6, fade_time: 0.0 };

/// A sea being stepped.
struct Step {
    sea: Sea,
    maps: SeaMaps,
    time: f64,
    advance: f64,
}

impl Body for Step {
    fn prepare(&mut self) {
        self.time += self.advance;
        self.sea.take_times();
    }

    fn run(&mut self) -> Result<(), BenchError> {
        Ok(self.sea.step(self.time, &mut self.maps)?)
    }

    fn parts(&mut self, take: &mut dyn FnMut(usize, Duration)) {
        for (part, time) in self.sea.take_times().into_iter().enumerate() {
            take(part, time);
        }
    }
}

/// The three fields' inverse transforms.
struct Transforms(ThreeFields);

impl Body for Transforms {
    fn run(&mut self) -> Result<(), BenchError> {
        self.0.inverse();
        Ok(())
    }
}

/// Bytes that a step reads and writes at least, for each point: half a spectrum of h0(k), conj(h0(-k)) and a harmonic
/// (16 bytes a wave, and 6 that two share); two maps of 8 and 4 bytes with their chains.
const STEP_BYTES: f64 = 9.5 + 12.0 * 4.0 / 3.0;
/// The same of three fields' transforms: half spectra in, planes out.
const TRANSFORM_BYTES: f64 = 24.0;

/// The work of three real fields' transforms of `n` x `n`, the same whoever does it: 5 M log2 M operations are ascribed
/// to a complex transform of M points, half of that to a real one.
pub fn transform_work(n: usize) -> Work {
    let points = (n * n) as f64;
    Work { points, bytes: points * TRANSFORM_BYTES, flops: 1.5 * 5.0 * points * points.log2() }
}

/// The cases of size `n`: transforms and steps on every instruction set and number of threads; at the size of detail also
/// parts of the step, more cascades, and a tick of the foam's memory.
///
/// # Errors
/// A size that the sea does not have.
pub fn cases(selection: &Selection, n: usize) -> Result<Vec<Case>, BenchError> {
    let mut cases = Vec::new();
    let detail = n == selection.detail;
    for &isa in &selection.isas {
        for &threads in &selection.threads {
            let label = |name: &str, cascades| {
                let name = name.to_owned();
                Label { name, n, cascades, threads, isa: isa.name() }
            };
            if threads == 1 && selection.wants("fft3") {
                cases.push(transforms(label("fft3", 1), isa)?);
            }
            let stages = detail && selection.wants("stages");
            if stages || selection.wants("step") {
                let case = step(label("step", 1), isa, NO_MEMORY, FRAME)?;
                cases.push(if stages { case.with_parts(stage_names()) } else { case });
            }
            for (name, cascades) in [("step_2c", 2), ("step_3c", 3), ("step_4c", 4)] {
                if detail && selection.wants(name) {
                    cases.push(step(label(name, cascades), isa, NO_MEMORY, FRAME)?);
                }
            }
            if detail && selection.wants("step_foam_tick") {
                cases.push(step(label("step_foam_tick", 1), isa, FoamSettings::default(), TICK)?);
            }
        }
    }
    Ok(cases)
}

/// The fields that everybody transforms, on `isa`.
///
/// # Errors
/// A size that the sea does not have.
pub fn filled(n: usize, isa: Isa) -> Result<ThreeFields, BenchError> {
    let mut fields = ThreeFields::new(n, isa)?;
    fields
        .fill(|field, ku, kv| fields::half_spectrum(n, field, ku as usize, kv.rem_euclid(n as i32) as usize));
    Ok(fields)
}

fn transforms(label: Label, isa: Isa) -> Result<Case, BenchError> {
    let n = label.n;
    Ok(Case::new(label, transform_work(n), Transforms(filled(n, isa)?)))
}

fn step(label: Label, isa: Isa, foam: FoamSettings, advance: f64) -> Result<Case, BenchError> {
    let mut sea = Sea::with_isa(&settings(label.n, label.cascades, foam), isa)?;
    let mut maps = sea.new_maps();
    // Between two ticks of the foam's memory; makes all of it, which no later step has to.
    let time = 0.5 * TICK;
    sea.step(time, &mut maps)?;
    let points = (label.n * label.n * label.cascades) as f64;
    let work = Work { points, bytes: points * STEP_BYTES, flops: 0.0 };
    Ok(Case::new(label, work, Step { sea, maps, time, advance }))
}

/// "stage_" and each stage's name.
fn stage_names() -> Vec<String> {
    STAGES.iter().map(|stage| format!("stage_{}", stage.name)).collect()
}
