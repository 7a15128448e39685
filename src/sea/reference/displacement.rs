//! The displacement field of a whole cascade, from the settings to metres.
use super::{evolve::evolve, fft, spectrum::Complex, spectrum::spectrum};
use crate::sea::CascadeSettings;

/// (Du, h, Dv), metres, at every grid point `[j N + i]`, and the largest imaginary part of h, which should be rounding.
pub fn displacement(
    cascade: &CascadeSettings,
    gravity: f64,
    period: f64,
    index: u32,
    time: f64,
) -> (Vec<[f64; 3]>, f64) {
    let n = cascade.resolution;
    let waves = spectrum(cascade, gravity, period, index);
    let [height, du, dv] = [0, 1, 2].map(|field| {
        let spectrum: Vec<Complex> = waves.iter().map(|wave| evolve(wave, time)[field]).collect();
        let mut grid = fft::separable(&spectrum, n, fft::radix2);
        // The spectrum is centred on index N/2: eqs (42)(43).
        for (index, value) in grid.iter_mut().enumerate() {
            if (index % n + index / n) & 1 == 1 {
                *value = value.map(|part| -part);
            }
        }
        grid
    });
    let residue = height.iter().fold(0.0, |largest: f64, value| largest.max(value[1].abs()));
    let field = (0..n * n)
        .map(|at| [cascade.choppiness * du[at][0], height[at][0], cascade.choppiness * dv[at][0]])
        .collect();
    (field, residue)
}
