//! What `swell info` tells about a scene.
use crate::scene::Scene;
use crate::sea::waves::{Front, Kind, Model, Wave, loops};
use serde::Serialize;
use std::f64::consts::TAU;
use std::io::{self, Write};

/// A scene in a few numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneSummary {
    /// Four standard deviations of the height, metres: close to the mean of the highest third of the waves.
    pub significant_wave_height: f64,
    /// Largest height culling allows for, metres.
    pub max_height: Option<f64>,
    /// Largest horizontal displacement culling allows for, metres.
    pub reach: f64,
    /// Patch size in metres and resolution of each cascade that makes waves.
    pub cascades: Vec<CascadeSummary>,
    /// Every wave or octave of each model, that of `[sea]` first.
    pub models: Vec<ModelSummary>,
    /// Seconds after which waves and octaves are where they were; `null` where that is never.
    pub loop_length: Option<f64>,
    /// What is allowed and hardly meant.
    pub warnings: Vec<String>,
    /// What headsets warn of besides.
    pub headset_warnings: Vec<String>,
}

/// A model in a few numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModelSummary {
    /// As in `model`: waves or fbm.
    pub model: &'static str,
    /// Its waves or octaves.
    pub waves: Vec<WaveSummary>,
}

/// A wave in a few numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct WaveSummary {
    /// sine, peaked, exp-sine, gerstner or circular.
    pub kind: &'static str,
    /// Metres.
    pub wavelength: f64,
    /// Metres.
    pub amplitude: f64,
    /// Of its crests, m/s.
    pub speed: f64,
    /// Seconds; `null` for a wave that stands still.
    pub period: Option<f64>,
    /// k Q A of a Gerstner wave, 0 for others.
    pub steepness: f64,
}

/// A cascade in a few numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CascadeSummary {
    /// Side of the patch, metres.
    pub patch_size: f64,
    /// Grid points along a side.
    pub resolution: usize,
    /// Smallest wave number carried, rad/m.
    pub from: f64,
    /// Wave number at which the cascade ends, rad/m: its band's end, or its grid's Nyquist number where that is less.
    pub to: f64,
}

impl SceneSummary {
    /// Sums up `scene`.
    pub fn new(scene: &Scene) -> Self {
        let spectral = scene.sea.cascades.iter().filter(|_| scene.sea.spectral);
        let cascades = spectral.map(|cascade| {
            let nyquist = std::f64::consts::PI * cascade.resolution as f64 / cascade.patch_size;
            CascadeSummary {
                patch_size: cascade.patch_size,
                resolution: cascade.resolution,
                from: cascade.band[0],
                to: cascade.band[1].min(nyquist),
            }
        });
        Self {
            significant_wave_height: 4.0 * scene.sea.expected_rms_height(),
            max_height: scene.lod.max_height,
            reach: scene.lod.reach,
            cascades: cascades.collect(),
            models: scene.sea.models.iter().map(ModelSummary::new).collect(),
            loop_length: loops::length(&scene.sea.models),
            headset_warnings: scene.in_headset().warnings.split_off(scene.warnings.len()),
            warnings: scene.warnings.clone(),
        }
    }

    /// Tells it on `out`, a line for each cascade and wave.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write_text(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "scene: waves of {:.2} m (significant height)", self.significant_wave_height)?;
        for CascadeSummary { patch_size, resolution, from, to } in &self.cascades {
            let longest = TAU / from.max(TAU / patch_size);
            writeln!(
                out,
                "    patch of {patch_size} m, {resolution} points a side: wavelengths {:.3} to {longest:.1} m",
                TAU / to
            )?;
        }
        for ModelSummary { model, waves } in &self.models {
            for (index, wave) in waves.iter().enumerate() {
                let WaveSummary { kind, wavelength, amplitude, speed, period, steepness } = wave;
                write!(out, "    {model} {}: {kind}, wavelength {wavelength:.3} m, ", index + 1)?;
                write!(out, "amplitude {amplitude:.3} m, speed {speed:.3} m/s, ")?;
                match period {
                    Some(period) => write!(out, "period {period:.3} s")?,
                    None => write!(out, "stands still")?,
                }
                if *steepness > 0.0 {
                    write!(out, ", steepness {steepness:.3}")?;
                }
                writeln!(out)?;
            }
        }
        match self.loop_length {
            _ if self.models.is_empty() => {}
            Some(length) => writeln!(out, "    loop of {length:.3} s")?,
            None => {
                writeln!(out, "    no loop: the periods have no common multiple; sea.loop_period makes one")?;
            }
        }
        self.headset_warnings.iter().try_for_each(|warning| writeln!(out, "    in a headset: {warning}"))
    }
}

impl ModelSummary {
    fn new(model: &Model) -> Self {
        let name = match model {
            Model::Waves(_) => "waves",
            Model::Fbm(_) => "fbm",
        };
        Self { model: name, waves: model.waves().iter().map(WaveSummary::new).collect() }
    }
}

impl WaveSummary {
    fn new(wave: &Wave) -> Self {
        let kind = match (wave.front, wave.kind) {
            (Front::Ring { .. }, _) => "circular",
            (_, Kind::Sine) => "sine",
            (_, Kind::Peaked) => "peaked",
            (_, Kind::ExpSine) => "exp-sine",
            (_, Kind::Gerstner) => "gerstner",
        };
        Self {
            kind,
            wavelength: wave.wavelength(),
            amplitude: wave.amplitude,
            speed: wave.speed(),
            period: Some(wave.period()).filter(|period| period.is_finite()),
            steepness: wave.steepness(),
        }
    }
}
