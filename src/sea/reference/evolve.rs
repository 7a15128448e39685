//! Waves at a time, as the theory writes them.
use super::spectrum::{Complex, Wave};

/// Spectra of h, Du and Dv at one wave vector.
pub type Spectra = [Complex; 3];

/// h = h0(k) e^{-i w t} + conj(h0(-k)) e^{i w t}; (Du, Dv) = i k/|k| h.
pub fn evolve(wave: &Wave, time: f64) -> Spectra {
    let (sin, cos) = (wave.omega * time).sin_cos();
    let along = times(wave.along, [cos, -sin]);
    let against = times(wave.against, [cos, sin]);
    let h = [along[0] + against[0], along[1] + against[1]];
    let length = wave.k[0].hypot(wave.k[1]).max(f64::MIN_POSITIVE);
    let [du, dv] = wave.k.map(|k| times([0.0, k / length], h));
    [h, du, dv]
}

/// The product of two complex numbers.
pub fn times([a, b]: Complex, [c, d]: Complex) -> Complex {
    [a * c - b * d, a * d + b * c]
}
