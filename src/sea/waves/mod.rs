//! Waves written down as formulas: sums of sines, peaked, Gerstner and circular waves, and fractal sums of octaves.
//!
//! A [`Model`] gives for a rest point and a time a [`Sample`]: displacement, its derivatives and so the normal, and foam.
//! Models add up with each other and with the spectral sea: displacements and derivatives are summed, the normal is that
//! of the summed tangents, and foam is summed up to 1. Equations and sources are in `docs/waves.md`.
//!
//! # One form for all
//! Whatever it was made from, a model is a list of [`Wave`]s in the same few numbers: [`gerstner`] says how a steepness
//! becomes an amplitude, [`fbm`] how ramps become octaves. One function of the phase for each [`Kind`] is then all there
//! is to evaluate, here in `f64` and in the WGSL twins of the same names in `f32`.
//!
//! # Large worlds
//! Phases are turns, reduced to half a turn to either side without loss: see [`turns`]. What a shader sees is
//! [`ModelsUniform`], in which each wave has its phase at an anchor near the eye, so that only positions relative to that
//! anchor meet single precision.
pub mod circular;
pub mod exp_sine;
pub mod fbm;
pub mod gerstner;
pub mod loops;
pub mod peaked;
mod sample;
pub mod sine;
mod turns;
mod uniform;
mod wave;

pub use fbm::{Fbm, FbmFoam, FbmSettings, Kernel, Lean};
pub use sample::Sample;
pub use turns::turns;
pub use uniform::{ModelUniform, ModelsUniform, NO_FOAM, WaveUniform};
pub use wave::{Front, Kind, Wave};

use super::error::SeaError;

/// Most models of one sea.
pub const MAX_MODELS: usize = 4;
/// Most waves of all models of [`Model::Waves`] together.
pub const MAX_WAVES: usize = 32;
/// Most octaves of all models of [`Model::Fbm`] together.
pub const MAX_OCTAVES: usize = 64;

/// A way to make water move that is a sum of formulas.
#[derive(Clone, Debug, PartialEq)]
pub enum Model {
    /// Waves chosen one by one.
    Waves(Vec<Wave>),
    /// Octaves that follow from a first one and ramps.
    Fbm(Fbm),
}

impl Model {
    /// Its waves, or octaves.
    pub fn waves(&self) -> &[Wave] {
        match self {
            Self::Waves(waves) => waves,
            Self::Fbm(fbm) => &fbm.octaves,
        }
    }

    /// The model alone at the rest point (x, z), metres, and `time`, seconds.
    pub fn sample(&self, rest: [f64; 2], time: f64) -> Sample {
        let mut sum = Sample::default();
        for wave in self.waves() {
            wave.add(rest, time, &mut sum);
        }
        if let Self::Fbm(fbm) = self {
            sum.foam = fbm.foam.cover(sum.displacement[1] / fbm.max_height(), sum.normal()[1]);
        }
        sum
    }

    /// Heights, metres, that it never leaves: the lowest and the highest.
    pub fn height_range(&self) -> [f64; 2] {
        self.waves().iter().map(Wave::height_range).fold([0.0; 2], |[a, b], [low, high]| [a + low, b + high])
    }

    /// The longest horizontal displacement there can be, metres.
    pub fn reach(&self) -> f64 {
        self.waves().iter().map(|wave| wave.horizontal.abs()).sum()
    }

    /// Variance of the height about its mean, square metres.
    pub fn variance(&self) -> f64 {
        self.waves().iter().map(Wave::variance).sum()
    }
}

/// The sum of `models` at the rest point (x, z), metres, and `time`, seconds.
pub fn evaluate(models: &[Model], rest: [f64; 2], time: f64) -> Sample {
    models.iter().fold(Sample::default(), |sum, model| sum + model.sample(rest, time))
}

/// Checks what a sea's models must fulfil together, and each of their numbers.
///
/// # Errors
/// [`SeaError::Sea`] names the number and its range.
pub fn validate(models: &[Model]) -> Result<(), SeaError> {
    let count = |octaves: bool| {
        let of_kind = models.iter().filter(|model| matches!(model, Model::Fbm(_)) == octaves);
        of_kind.map(|model| model.waves().len()).sum::<usize>()
    };
    let most = |key, count: usize, most: usize, allowed| {
        if count <= most { Ok(()) } else { Err(SeaError::Sea { key, value: count.to_string(), allowed }) }
    };
    most("number of models", models.len(), MAX_MODELS, "at most 4")?;
    most("number of waves", count(false), MAX_WAVES, "at most 32")?;
    most("number of octaves", count(true), MAX_OCTAVES, "at most 64")?;
    models.iter().flat_map(Model::waves).try_for_each(Wave::validate)
}
