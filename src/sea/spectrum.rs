//! How much of which wave there is, eqs (3)-(14), and the packed amplitudes that every frame starts from.
use super::{
    dispersion::{frequency, harmonic, shoaling},
    error::SeaError,
    fft::{LANES, Lane},
    philox::gaussian,
    settings::{CascadeSettings, Spectrum},
};
use rayon::prelude::*;
use std::f64::consts::{E, PI, TAU};

/// E|h0(k)|^2 = P(k), m^2, of the wave vector `2 pi / L (i, j)` along the cascade's own axes.
///
/// The field is the sum over k of h0(k) e^{-i w t} + conj(h0(-k)) e^{i w t}, so its variance is the sum of
/// P(k) + P(-k), twice the sum of P. 0 at k = 0 (14), outside the band, and without wind.
pub fn power(cascade: &CascadeSettings, gravity: f64, i: i32, j: i32) -> f64 {
    let spacing = TAU / cascade.patch_size;
    let length = f64::from(i * i + j * j).sqrt();
    let k = spacing * length;
    if length == 0.0 || k < cascade.band[0] || k >= cascade.band[1] || cascade.wind_speed == 0.0 {
        return 0.0;
    }
    // The wind turned into the cascade's frame.
    let angle = cascade.wind_direction - cascade.rotation;
    let cosine = (f64::from(i) * libm::cos(angle) - f64::from(j) * libm::sin(angle)) / length;
    let density = match cascade.spectrum {
        Spectrum::Phillips => phillips(cascade, gravity, k),
        Spectrum::Jonswap | Spectrum::Tma => {
            let waves = frequency(cascade, gravity, k);
            // Half, because P(k) and P(-k) both reach the variance; dk^2 / k turns S(w) dw D dtheta into a grid's sum.
            0.5 * frequency_spectrum(cascade, gravity, k, waves.omega) * waves.group_velocity / k
                * spacing
                * spacing
                / spreading_integral(cascade.alignment)
        }
    };
    let cutoff = k * suppressed_length(cascade);
    density
        * spreading(cascade.alignment, cosine)
        * libm::exp(-cutoff * cutoff)
        * cascade.amplitude
        * cascade.amplitude
}

/// Eqs (3)-(5) without the direction: A exp(-1/(k L_w)^2) / k^4 with L_w = V^2/g.
fn phillips(cascade: &CascadeSettings, gravity: f64, k: f64) -> f64 {
    let largest = cascade.wind_speed * cascade.wind_speed / gravity;
    let fft = libm::pow(cascade.reference_resolution as f64, -0.25);
    let spatial = E / cascade.patch_size;
    let kl = k * largest;
    let k2 = k * k;
    fft * fft * spatial * spatial * libm::exp(-1.0 / (kl * kl)) / (k2 * k2)
}

/// S(omega), m^2 s: JONSWAP (Hasselmann et al. 1973), for TMA times the depth function of Kitaigorodskii et al. 1975
/// (Bouws et al. 1985).
fn frequency_spectrum(cascade: &CascadeSettings, gravity: f64, k: f64, omega: f64) -> f64 {
    let (wind, fetch) = (cascade.wind_speed, cascade.fetch);
    let alpha = 0.076 * libm::pow(wind * wind / (fetch * gravity), 0.22);
    let peak = 22.0 * libm::cbrt(gravity * gravity / (wind * fetch));
    let width = if omega <= peak { 0.07 } else { 0.09 };
    let offset = (omega - peak) / (width * peak);
    let enhancement = libm::pow(cascade.peak_enhancement, libm::exp(-0.5 * offset * offset));
    let ratio = peak / omega;
    let ratio4 = ratio * ratio * ratio * ratio;
    let omega2 = omega * omega;
    let deep =
        alpha * gravity * gravity / (omega2 * omega2 * omega) * libm::exp(-1.25 * ratio4) * enhancement;
    if cascade.spectrum == Spectrum::Tma {
        // k^-3 dk/dw in this depth over the same in deep water, at the same frequency.
        let kd = k * cascade.depth;
        let tanh = libm::tanh(kd);
        deep * tanh * tanh / (1.0 + shoaling(kd))
    } else {
        deep
    }
}

/// Eqs (6)-(9): |cos|^s, and less energy in waves that run against the wind.
fn spreading(alignment: f64, cosine: f64) -> f64 {
    let along = libm::pow(cosine.abs(), spreading_exponent(alignment));
    if cosine < 0.0 { along * opposing_energy(alignment) } else { along }
}

/// Integral of [`spreading`] over the circle: a Beta function.
fn spreading_integral(alignment: f64) -> f64 {
    let s = spreading_exponent(alignment);
    (1.0 + opposing_energy(alignment)) * PI.sqrt() * libm::tgamma(0.5 * (s + 1.0))
        / libm::tgamma(0.5 * s + 1.0)
}

/// Eq (6).
fn spreading_exponent(alignment: f64) -> f64 {
    1.0 + 5.0 * alignment * alignment
}

/// Eq (8).
fn opposing_energy(alignment: f64) -> f64 {
    0.01 + 0.49 * (1.0 - alignment) * (1.0 - alignment)
}

/// Eq (11), metres.
fn suppressed_length(cascade: &CascadeSettings) -> f64 {
    const SHORTEST: f64 = 0.001;
    SHORTEST * libm::pow(0.25 * cascade.patch_size / SHORTEST, cascade.small_wave_suppression)
}

/// Variance of the height, m^2, that the spectrum promises on the cascade's grid: the sum over k of P(k) + P(-k).
///
/// The horizontal displacement's variance, both components together, is this times choppiness squared.
pub fn expected_variance(cascade: &CascadeSettings, gravity: f64) -> f64 {
    let half = cascade.resolution as i32 / 2;
    // Collected in order: a parallel sum would depend on the number of threads.
    let rows: Vec<f64> = (1 - half..half)
        .into_par_iter()
        .map(|j| (1 - half..half).map(|i| power(cascade, gravity, i, j)).sum())
        .collect();
    2.0 * rows.iter().sum::<f64>()
}

/// h0(k), metres, eq (13).
pub fn initial_amplitude(cascade: &CascadeSettings, gravity: f64, index: u32, i: i32, j: i32) -> [f64; 2] {
    let scale = (0.5 * power(cascade, gravity, i, j)).sqrt();
    if scale == 0.0 {
        return [0.0; 2];
    }
    gaussian(cascade.seed, i, j, index).map(|part| part * scale)
}

/// Eight wave vectors of one ku and neighbouring kv, ready for eq (24).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Modes {
    /// Real part of the factor of cos(w t), eq (22), metres.
    pub cos_re: Lane,
    /// Its imaginary part.
    pub cos_im: Lane,
    /// Real part of the factor of sin(w t).
    pub sin_re: Lane,
    /// Its imaginary part.
    pub sin_im: Lane,
    /// ku / |k|.
    pub unit_u: Lane,
    /// kv / |k|.
    pub unit_v: Lane,
    /// Index into [`PackedSpectrum::harmonics`].
    pub harmonic: [u32; LANES],
}

/// The amplitudes of half the wave vectors of a cascade, kv in 0..N/2; the other half is their conjugate mirror.
///
/// Both directions are in FFT order (0, 1, .., N/2 - 1, -N/2, .., -1), which makes eq (42)'s signs unnecessary.
/// The row and the column at the Nyquist index -N/2 are zero: there k and -k are the same grid point, so i k/|k| h
/// cannot be Hermitian and the horizontal displacement would not be real.
#[derive(Clone, Debug, PartialEq)]
pub struct PackedSpectrum {
    /// N.
    pub resolution: usize,
    /// N/16 tiles of eight kv, each with N entries in the order of ku: `modes[tile * N + ku]`.
    pub modes: Vec<Modes>,
    /// The distinct harmonics of 2 pi / T that occur, ascending.
    pub harmonics: Vec<u32>,
}

impl PackedSpectrum {
    /// The spectrum of cascade number `index` of a sea.
    ///
    /// # Errors
    /// [`SeaError::Cascade`] when an amplitude does not fit an `f32`.
    pub fn new(cascade: &CascadeSettings, gravity: f64, period: f64, index: u32) -> Result<Self, SeaError> {
        let n = cascade.resolution;
        let mut modes: Vec<Modes> = (0..n * n / (2 * LANES))
            .into_par_iter()
            .map(|entry| {
                let ku = signed(entry % n, n);
                let mut modes = Modes::default();
                for lane in 0..LANES {
                    let kv = (entry / n * LANES + lane) as i32;
                    modes.set(lane, cascade, gravity, period, index, [ku, kv]);
                }
                modes
            })
            .collect();
        if !modes.iter().all(Modes::is_finite) {
            let value = format!("{}", cascade.amplitude);
            let allowed = "a smaller factor, or less wind: the waves are too high to compute";
            return Err(SeaError::Cascade { cascade: index as usize, key: "amplitude", value, allowed });
        }
        let mut harmonics: Vec<u32> = modes.iter().flat_map(|modes| modes.harmonic).collect();
        harmonics.sort_unstable();
        harmonics.dedup();
        for entry in &mut modes {
            for harmonic in &mut entry.harmonic {
                *harmonic = harmonics.partition_point(|known| known < harmonic) as u32;
            }
        }
        Ok(Self { resolution: n, modes, harmonics })
    }
}

impl Modes {
    /// Fills one lane; `harmonic` holds the harmonic itself until all are known.
    fn set(
        &mut self,
        lane: usize,
        cascade: &CascadeSettings,
        gravity: f64,
        period: f64,
        index: u32,
        [i, j]: [i32; 2],
    ) {
        if i == -(cascade.resolution as i32) / 2 || (i == 0 && j == 0) {
            return;
        }
        let [a, b] = initial_amplitude(cascade, gravity, index, i, j);
        let [c, minus_d] = initial_amplitude(cascade, gravity, index, -i, -j);
        let d = -minus_d;
        if [a, b, c, d] == [0.0; 4] {
            return;
        }
        self.cos_re[lane] = (a + c) as f32;
        self.cos_im[lane] = (b + d) as f32;
        self.sin_re[lane] = (b - d) as f32;
        self.sin_im[lane] = (c - a) as f32;
        let length = f64::from(i * i + j * j).sqrt();
        self.unit_u[lane] = (f64::from(i) / length) as f32;
        self.unit_v[lane] = (f64::from(j) / length) as f32;
        let k = TAU / cascade.patch_size * length;
        self.harmonic[lane] = harmonic(frequency(cascade, gravity, k).omega, period);
    }

    fn is_finite(&self) -> bool {
        [self.cos_re, self.cos_im, self.sin_re, self.sin_im].iter().flatten().all(|part| part.is_finite())
    }
}

/// The signed wave index at position `index` of an FFT-ordered axis of `n`.
pub fn signed(index: usize, n: usize) -> i32 {
    if index < n / 2 { index as i32 } else { index as i32 - n as i32 }
}
