//! What a sea is made from: checked, resolved parameters, in SI units and radians.
use super::{
    error::SeaError,
    spectrum::expected_variance,
    waves::{self, Model},
};
use std::f64::consts::{PI, TAU};

/// Which statistical description of a wind sea the amplitudes follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spectrum {
    /// "VR Ocean" eqs (3)-(5), as printed: `amplitude` scales it, its height is not calibrated.
    Phillips,
    /// Hasselmann et al. 1973: a sea still growing over a finite fetch.
    Jonswap,
    /// Bouws et al. 1985: JONSWAP in water of finite depth.
    Tma,
}

/// Which normal the gradient map holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NormalKind {
    /// Cross product of the displaced surface's full tangents.
    Exact,
    /// "VR Ocean" eq (47): the normal of the undisplaced height sheet.
    Sheet,
}

/// Foam that appears where the surface is squeezed together and fades afterwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoamSettings {
    /// Compression 1 - J, summed over cascades, at which foam begins.
    pub threshold: f64,
    /// Further compression, above `threshold`, at which foam is whole.
    pub width: f64,
    /// Seconds in which a compression of 1 fades to nothing; 0 keeps no memory.
    pub fade_time: f64,
}

/// One periodic patch of sea carrying one band of wave numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct CascadeSettings {
    /// Grid points along each side, N: a power of two in 16..=512.
    pub resolution: usize,
    /// Side of the periodic patch, L, metres.
    pub patch_size: f64,
    /// Angle of the cascade's own axes, radians counter-clockwise seen from above (see `docs/conventions.md`).
    pub rotation: f64,
    /// Wave numbers carried, rad/m, half open: `band[0] <= k < band[1]`.
    pub band: [f64; 2],
    /// N of eq (5)'s normalisation: the sea's own resolution, so that bands of different N still join.
    pub reference_resolution: usize,
    /// The spectrum's shape.
    pub spectrum: Spectrum,
    /// Wind speed, m/s; 0 gives a flat sea.
    pub wind_speed: f64,
    /// Direction the wind blows towards, radians from +X counter-clockwise seen from above (pi/2 is -Z).
    pub wind_direction: f64,
    /// Alpha of eqs (6)-(9), 0 (all directions) ..= 1 (with the wind).
    pub alignment: f64,
    /// Lambda of eq (25), scales the horizontal displacement.
    pub choppiness: f64,
    /// Beta of eq (11), 0 (none) ..= 1 (everything below a quarter of the patch).
    pub small_wave_suppression: f64,
    /// Roughness of the water itself at scales below the map, 0..=1, eq (49).
    pub roughness: f64,
    /// Share of the cascade's compression that counts for foam, 0..=1: ripples are steep and do not break.
    pub breaking: f64,
    /// Factor on every displacement.
    pub amplitude: f64,
    /// Distance over which the wind has blown, metres (JONSWAP, TMA).
    pub fetch: f64,
    /// JONSWAP's gamma, 1 (Pierson-Moskowitz shape) ..= 7.
    pub peak_enhancement: f64,
    /// Water depth, metres (TMA).
    pub depth: f64,
    /// Seed of the Gaussian numbers.
    pub seed: u64,
}

/// A whole sea: cascades with disjoint bands and models, whose displacements add up.
#[derive(Clone, Debug, PartialEq)]
pub struct SeaSettings {
    /// One or more (at most [`MAX_CASCADES`]), by descending patch size.
    pub cascades: Vec<CascadeSettings>,
    /// Whether the cascades make waves. Where models alone do, one flat cascade carries the roughness of the water.
    pub spectral: bool,
    /// Formulas, at most [`waves::MAX_MODELS`].
    pub models: Vec<Model>,
    /// Acceleration of gravity, m/s^2.
    pub gravity: f64,
    /// T of eq (16), seconds: the animation closes after it.
    pub repeat_period: f64,
    /// Foam.
    pub foam: FoamSettings,
    /// Normals of the gradient map.
    pub normals: NormalKind,
}

/// The renderer binds one pair of maps for each, so their number is fixed.
pub const MAX_CASCADES: usize = 4;

/// Standard deviations by which [`SeaSettings::max_height`] and [`SeaSettings::reach`] exceed the still sea. A Gaussian
/// field passes 5 once in two million independent points; a frame has fewer.
const BOUND: f64 = 5.0;

/// Waves of the smaller patch that fit along its side at the boundary of its band: fewer would show its edges.
const WAVES_PER_PATCH: f64 = 6.0;

impl Default for FoamSettings {
    fn default() -> Self {
        Self { threshold: 0.45, width: 0.6, fade_time: 4.0 }
    }
}

impl Default for CascadeSettings {
    /// A fresh breeze over 256 m of deep water.
    fn default() -> Self {
        Self {
            resolution: 256,
            patch_size: 256.0,
            rotation: 0.0,
            band: [0.0, f64::INFINITY],
            reference_resolution: 256,
            spectrum: Spectrum::Jonswap,
            wind_speed: 10.0,
            wind_direction: 0.0,
            alignment: 0.6,
            choppiness: 0.9,
            small_wave_suppression: 0.1,
            roughness: 0.1,
            breaking: 1.0,
            amplitude: 1.0,
            fetch: 100_000.0,
            peak_enhancement: 3.3,
            depth: 20.0,
            seed: 1,
        }
    }
}

impl Default for SeaSettings {
    /// One default cascade.
    fn default() -> Self {
        Self {
            cascades: vec![CascadeSettings::default()],
            spectral: true,
            models: Vec::new(),
            gravity: 9.81,
            repeat_period: 200.0,
            foam: FoamSettings::default(),
            normals: NormalKind::Exact,
        }
    }
}

impl SeaSettings {
    /// Checks every parameter.
    ///
    /// # Errors
    /// [`SeaError::Sea`] or [`SeaError::Cascade`] for the first that is out of range.
    pub fn validate(&self) -> Result<(), SeaError> {
        let sea = |key, value: f64, good: bool, allowed| {
            if good { Ok(()) } else { Err(SeaError::Sea { key, value: value.to_string(), allowed }) }
        };
        let count = self.cascades.len();
        sea("number of cascades", count as f64, (1..=MAX_CASCADES).contains(&count), "1..=4")?;
        sea("gravity", self.gravity, within(self.gravity, 0.01, 1000.0), "0.01..=1000 m/s^2")?;
        sea("repeat_period", self.repeat_period, within(self.repeat_period, 1.0, 86_400.0), "1..=86400 s")?;
        let FoamSettings { threshold, width, fade_time } = self.foam;
        sea("foam threshold", threshold, threshold.is_finite(), "a finite number")?;
        sea("foam width", width, within(width, 0.0, f64::MAX), "0 or more")?;
        sea("foam fade_time", fade_time, within(fade_time, 0.0, 600.0), "0..=600 s")?;
        self.cascades.iter().enumerate().try_for_each(|(index, cascade)| cascade.validate(index))?;
        waves::validate(&self.models)
    }

    /// Standard deviation of the summed height, metres, from the sums of the spectra and the models' own.
    pub fn expected_rms_height(&self) -> f64 {
        let models: f64 = self.models.iter().map(Model::variance).sum();
        (self.spectral_variance() + models).sqrt()
    }

    fn spectral_variance(&self) -> f64 {
        self.cascades.iter().map(|cascade| expected_variance(cascade, self.gravity)).sum()
    }

    /// A height, metres, that waves rise to or sink by only once in millions of points: five standard deviations of the
    /// spectra's, and the most that models can make.
    pub fn max_height(&self) -> f64 {
        let [lowest, highest] = self
            .models
            .iter()
            .map(Model::height_range)
            .fold([0.0; 2], |[a, b], [low, high]| [a + low, b + high]);
        BOUND * self.spectral_variance().sqrt() + highest.max(-lowest)
    }

    /// The same for the length of the horizontal displacement, metres.
    pub fn reach(&self) -> f64 {
        let variance = |cascade: &CascadeSettings| {
            cascade.choppiness * cascade.choppiness * expected_variance(cascade, self.gravity)
        };
        let models: f64 = self.models.iter().map(Model::reach).sum();
        BOUND * self.cascades.iter().map(variance).sum::<f64>().sqrt() + models
    }
}

impl CascadeSettings {
    /// One that makes no waves: as small as there is, of water of this roughness.
    pub fn flat(roughness: f64) -> Self {
        Self {
            resolution: 16,
            reference_resolution: 16,
            patch_size: 64.0,
            wind_speed: 0.0,
            roughness,
            ..Self::default()
        }
    }

    fn validate(&self, cascade: usize) -> Result<(), SeaError> {
        let error = |key, value: String, allowed| Err(SeaError::Cascade { cascade, key, value, allowed });
        if !self.resolution.is_power_of_two() || !(16..=512).contains(&self.resolution) {
            return error("resolution", self.resolution.to_string(), "a power of two in 16..=512");
        }
        if self.reference_resolution == 0 {
            return error("reference_resolution", "0".to_owned(), "1 or more");
        }
        let [low, high] = self.band;
        if !(low >= 0.0 && low < high) {
            return error("band", format!("[{low}, {high}]"), "two ascending wave numbers, 0 rad/m or more");
        }
        let numbers = [
            ("patch_size", self.patch_size, 0.1, 1e6, "0.1..=1e6 m"),
            ("rotation", self.rotation, f64::MIN, f64::MAX, "a finite angle"),
            ("wind_speed", self.wind_speed, 0.0, 100.0, "0..=100 m/s"),
            ("wind_direction", self.wind_direction, f64::MIN, f64::MAX, "a finite angle"),
            ("alignment", self.alignment, 0.0, 1.0, "0..=1"),
            ("choppiness", self.choppiness, 0.0, 10.0, "0..=10"),
            ("small_wave_suppression", self.small_wave_suppression, 0.0, 1.0, "0..=1"),
            ("roughness", self.roughness, 0.0, 1.0, "0..=1"),
            ("breaking", self.breaking, 0.0, 1.0, "0..=1"),
            ("amplitude", self.amplitude, 0.0, 1e6, "0..=1e6"),
            ("fetch", self.fetch, 1.0, 1e8, "1..=1e8 m"),
            ("peak_enhancement", self.peak_enhancement, 1.0, 10.0, "1..=10"),
            ("depth", self.depth, 0.01, 1e5, "0.01..=1e5 m"),
        ];
        for (key, value, low, high, allowed) in numbers {
            if !within(value, low, high) {
                return error(key, value.to_string(), allowed);
            }
        }
        Ok(())
    }
}

/// Disjoint bands of wave numbers, rad/m, for cascades of `(patch size in metres, resolution)` in descending order of
/// patch size, which together cover everything from 0 up.
///
/// A boundary lies where six waves fit along the smaller patch, or at half the larger cascade's Nyquist number where
/// that comes first: beyond it the larger one's gradients, central differences, lose more than a third of the slope.
pub fn split_bands(patches: &[(f64, usize)]) -> Vec<[f64; 2]> {
    let mut low = 0.0;
    let mut bands = Vec::with_capacity(patches.len());
    for (index, &(size, resolution)) in patches.iter().enumerate() {
        let high = patches.get(index + 1).map_or(f64::INFINITY, |&(smaller, _)| {
            let half_nyquist = 0.5 * PI * resolution as f64 / size;
            (WAVES_PER_PATCH * TAU / smaller).min(half_nyquist).max(low)
        });
        bands.push([low, high]);
        low = high;
    }
    bands
}

fn within(value: f64, low: f64, high: f64) -> bool {
    value.is_finite() && (low..=high).contains(&value)
}
