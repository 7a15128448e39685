//! How much of which wave there is, eqs (3)-(14), and the packed amplitudes that every frame starts from.
use super::{
    dispersion::{frequency, harmonic, shoaling},
    error::SeaError,
    fft::layout::{Layout, TILE},
    philox::gaussian,
    settings::{CascadeSettings, Spectrum},
    simd::Aligned,
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

/// The amplitudes of half the wave vectors of a cascade, ku in 0..N/2; the other half is their conjugate mirror.
///
/// kv is in FFT order (0, 1, .., N/2 - 1, -N/2, .., -1), which makes eq (42)'s signs unnecessary.
/// The row and the column at the Nyquist index -N/2 are zero: there k and -k are the same grid point, so i k/|k| h
/// cannot be Hermitian and the horizontal displacement would not be real.
///
/// Everything lies in the tiles of a [`Layout`], in the order in which a step reads it.
#[derive(Clone, Debug, PartialEq)]
pub struct PackedSpectrum {
    layout: Layout,
    /// For each tile and each of its N rows kv: the factors of cos(w t) and sin(w t), eq (22), metres, of the tile's ku:
    /// real parts of the first, imaginary parts, real parts of the second, imaginary parts.
    amplitudes: Aligned<f32>,
    /// For each tile and kv = 0..=N/2: the choppiness over |k|, k in units of 2 pi / L; 0 where there is no wave.
    inverse: Aligned<f32>,
    /// For each tile and kv = 0..=N/2: index into [`PackedSpectrum::harmonics`].
    harmonic: Aligned<u16>,
    /// The distinct harmonics of 2 pi / T that occur, ascending.
    pub harmonics: Vec<u32>,
}

/// One tile of a [`PackedSpectrum`].
#[derive(Clone, Copy, Debug)]
pub struct SpectrumTile<'a> {
    /// N rows kv of four times the tile's lanes.
    pub amplitudes: &'a [f32],
    /// N/2 + 1 rows kv.
    pub inverse: &'a [f32],
    /// N/2 + 1 rows kv.
    pub harmonic: &'a [u16],
    /// Its first ku.
    pub first_ku: usize,
}

impl PackedSpectrum {
    /// The spectrum of cascade number `index` of a sea, laid out for `layout`.
    ///
    /// # Errors
    /// [`SeaError::Cascade`] when an amplitude does not fit an `f32`.
    pub fn new(
        cascade: &CascadeSettings,
        gravity: f64,
        period: f64,
        index: u32,
        layout: Layout,
    ) -> Result<Self, SeaError> {
        let (n, lanes) = (layout.n, TILE);
        let half = (n / 2 + 1) * lanes;
        let mut amplitudes = Aligned::zeros(2 * n * n);
        let mut inverse = Aligned::zeros(layout.tiles() * half);
        let mut numbers = vec![0_u32; layout.tiles() * half];
        amplitudes
            .par_chunks_exact_mut(4 * n * lanes)
            .zip(inverse.par_chunks_exact_mut(half))
            .zip(numbers.par_chunks_exact_mut(half))
            .enumerate()
            .for_each(|(tile, ((amplitudes, inverse), numbers))| {
                for (row, lane) in (0..n * lanes).map(|at| (at / lanes, at % lanes)) {
                    let (i, j) = ((tile * lanes + lane) as i32, signed(row, n));
                    let Some(mode) = Mode::new(cascade, gravity, index, [i, j]) else { continue };
                    for (part, value) in mode.amplitudes.into_iter().enumerate() {
                        amplitudes[(4 * row + part) * lanes + lane] = value as f32;
                    }
                    // Shared by kv and -kv.
                    let at = row.min(n - row) * lanes + lane;
                    inverse[at] = (cascade.choppiness / mode.length) as f32;
                    let k = TAU / cascade.patch_size * mode.length;
                    numbers[at] = harmonic(frequency(cascade, gravity, k).omega, period);
                }
            });
        if !amplitudes.iter().all(|part| part.is_finite()) {
            let value = format!("{}", cascade.amplitude);
            let allowed = "a smaller factor, or less wind: the waves are too high to compute";
            return Err(SeaError::Cascade { cascade: index as usize, key: "amplitude", value, allowed });
        }
        let mut harmonics = numbers.clone();
        harmonics.sort_unstable();
        harmonics.dedup();
        // At most as many as there are sums of two squares below 2 (N/2)^2: half of what 16 bits count.
        let mut harmonic = Aligned::zeros(numbers.len());
        for (index, number) in harmonic.iter_mut().zip(&numbers) {
            *index = harmonics.partition_point(|known| known < number) as u16;
        }
        Ok(Self { layout, amplitudes, inverse, harmonic, harmonics })
    }

    /// One of its tiles.
    pub fn tile(&self, tile: usize) -> SpectrumTile<'_> {
        let (n, lanes) = (self.layout.n, TILE);
        let (whole, half) = (4 * n * lanes, (n / 2 + 1) * lanes);
        SpectrumTile {
            amplitudes: &self.amplitudes[tile * whole..][..whole],
            inverse: &self.inverse[tile * half..][..half],
            harmonic: &self.harmonic[tile * half..][..half],
            first_ku: tile * lanes,
        }
    }
}

/// One wave vector and its opposite.
struct Mode {
    /// Factors of cos(w t) and sin(w t), eq (22), as (re, im, re, im), metres.
    amplitudes: [f64; 4],
    /// |k| in units of 2 pi / L.
    length: f64,
}

impl Mode {
    /// `None` where there is no wave.
    fn new(cascade: &CascadeSettings, gravity: f64, index: u32, [i, j]: [i32; 2]) -> Option<Self> {
        if j == -(cascade.resolution as i32) / 2 || (i == 0 && j == 0) {
            return None;
        }
        let [a, b] = initial_amplitude(cascade, gravity, index, i, j);
        let [c, minus_d] = initial_amplitude(cascade, gravity, index, -i, -j);
        let d = -minus_d;
        if [a, b, c, d] == [0.0; 4] {
            return None;
        }
        let length = f64::from(i * i + j * j).sqrt();
        Some(Self { amplitudes: [a + c, b + d, b - d, c - a], length })
    }
}

/// The signed wave index at position `index` of an FFT-ordered axis of `n`.
pub fn signed(index: usize, n: usize) -> i32 {
    if index < n / 2 { index as i32 } else { index as i32 - n as i32 }
}
