//! The paper's algorithm as it is printed: [`crate::sea::reference`], compiled as everything is.
//!
//! The spectrum is made before, as in the paper; a step is evolution, three radix-2 transforms, displacement, gradient,
//! packing and both mip chains.
use super::label;
use crate::commands::bench::BenchError;
use crate::commands::bench::harness::{Body, Case, Work};
use crate::sea::reference::{evolve::evolve, fft, gradient, mips, spectrum};
use crate::sea::{CascadeSettings, NormalKind, SeaSettings, mip_levels};
use std::hint::black_box;

/// The largest size that takes a fraction of a second a step.
pub const LARGEST: usize = 512;

struct Printed {
    cascade: CascadeSettings,
    waves: Vec<spectrum::Wave>,
    time: f64,
}

impl Body for Printed {
    fn prepare(&mut self) {
        self.time += 1.0 / 72.0;
    }

    fn run(&mut self) -> Result<(), BenchError> {
        let n = self.cascade.resolution;
        let spectra: Vec<_> = self.waves.iter().map(|wave| evolve(wave, self.time)).collect();
        let [height, du, dv] = [0, 1, 2].map(|field| {
            let spectrum: Vec<_> = spectra.iter().map(|spectra| spectra[field]).collect();
            fft::separable(&spectrum, n, fft::radix2)
        });
        // The spectrum is centred on index N/2: eqs (42)(43).
        let sign = |at: usize| if (at % n + at / n) & 1 == 1 { -1.0 } else { 1.0 };
        let choppiness = self.cascade.choppiness;
        let metres = |at: usize| {
            let sign = sign(at);
            [sign * choppiness * du[at][0], sign * height[at][0], sign * choppiness * dv[at][0]]
        };
        let field: Vec<[f64; 3]> = (0..n * n).map(metres).collect();
        let mut normals = gradient::gradient(&field, &self.cascade, NormalKind::Exact);
        let mut texels: Vec<[f64; 4]> =
            field.iter().zip(&normals).map(|(d, normal)| [d[0], d[1], d[2], 1.0 - normal[3]]).collect();
        for level in 0..mip_levels(n) {
            if level > 0 {
                normals = mips::halve(&normals, n >> (level - 1));
                texels = mips::halve(&texels, n >> (level - 1));
            }
            let packed: Vec<[f64; 4]> = normals.iter().map(|&normal| gradient::unrounded(normal)).collect();
            black_box((&packed, &texels));
        }
        Ok(())
    }
}

/// A step of a cascade of `n` x `n`.
pub fn case(n: usize) -> Case {
    let cascade = CascadeSettings { resolution: n, reference_resolution: n, ..CascadeSettings::default() };
    let SeaSettings { gravity, repeat_period, .. } = SeaSettings::default();
    let waves = spectrum::spectrum(&cascade, gravity, repeat_period, 0);
    let points = (n * n) as f64;
    Case::new(
        label("paper_step", n),
        Work { points, ..Work::default() },
        Printed { cascade, waves, time: 0.0 },
    )
}
