//! Waves at a moment: eqs (19)-(24), and the spectra of the horizontal displacement.
use super::{
    clock::Phase,
    fft::{LANES, Lane},
    spectrum::{Modes, PackedSpectrum},
};

/// Fills `table` with (cos, sin) of every harmonic of `spectrum` at `phase`: far fewer than there are wave vectors.
///
/// # Panics
/// When `table` is shorter than the spectrum's `harmonics`.
pub fn rotations(spectrum: &PackedSpectrum, phase: Phase, table: &mut [[f32; 2]]) {
    for (entry, &harmonic) in table[..spectrum.harmonics.len()].iter_mut().zip(&spectrum.harmonics) {
        let (sin, cos) = libm::sincos(std::f64::consts::TAU * phase.turns(harmonic));
        *entry = [cos as f32, sin as f32];
    }
}

/// Spectra of one tile: eight kv across the lanes, N entries ku in FFT order, each complex.
pub struct TileSpectra<'a> {
    /// h.
    pub height: [&'a mut [Lane]; 2],
    /// Du over the choppiness.
    pub du: [&'a mut [Lane]; 2],
    /// Dv over the choppiness.
    pub dv: [&'a mut [Lane]; 2],
}

/// h(k, t) = h0(k) e^{-i w t} + conj(h0(-k)) e^{i w t}, so that waves run along +k, and D(k) = i k/|k| h, which with
/// e^{+ik.x} draws points towards crests.
///
/// `modes` are the N of one tile, `rotations` the table of [`rotations`], every slice of `out` has length N.
pub fn evolve(modes: &[Modes], rotations: &[[f32; 2]], out: &mut TileSpectra<'_>) {
    let n = modes.len();
    let [h_re, h_im] = out.height.each_mut().map(|part| &mut part[..n]);
    let [u_re, u_im] = out.du.each_mut().map(|part| &mut part[..n]);
    let [v_re, v_im] = out.dv.each_mut().map(|part| &mut part[..n]);
    for (ku, m) in modes.iter().enumerate() {
        let mut cos: Lane = [0.0; LANES];
        let mut sin: Lane = [0.0; LANES];
        for lane in 0..LANES {
            [cos[lane], sin[lane]] = rotations[m.harmonic[lane] as usize];
        }
        let mut re: Lane = [0.0; LANES];
        let mut im: Lane = [0.0; LANES];
        for lane in 0..LANES {
            re[lane] = m.cos_re[lane] * cos[lane] + m.sin_re[lane] * sin[lane];
            im[lane] = m.cos_im[lane] * cos[lane] + m.sin_im[lane] * sin[lane];
        }
        h_re[ku] = re;
        h_im[ku] = im;
        for lane in 0..LANES {
            u_re[ku][lane] = -m.unit_u[lane] * im[lane];
            u_im[ku][lane] = m.unit_u[lane] * re[lane];
            v_re[ku][lane] = -m.unit_v[lane] * im[lane];
            v_im[ku][lane] = m.unit_v[lane] * re[lane];
        }
    }
}
