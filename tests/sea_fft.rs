//! The transform: the definition on known pairs, then every instruction set against the definition.
#![allow(clippy::expect_used, reason = "a test may panic")]
use std::f64::consts::TAU;
use swell::sea::fft::ThreeFields;
use swell::sea::philox::gaussian;
use swell::sea::reference::{evolve::times, fft};
use swell::sea::simd::Isa;
use swell::sea::spectrum::signed;

const SIZES: [usize; 6] = [16, 32, 64, 128, 256, 512];

fn noise(n: usize) -> Vec<[f64; 2]> {
    (0..n as i32).map(|i| gaussian(3, i, n as i32, 0)).collect()
}

fn relative_rms(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    let error: f64 = a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).powi(2)).sum();
    (error / b.iter().flatten().map(|b| b * b).sum::<f64>()).sqrt()
}

#[test]
fn the_definition_knows_its_pairs() {
    for n in [16, 32] {
        // A unit impulse at k is the wave e^{+2 pi i k x / N}: the sign of eq (1).
        for k in [0, 1, 5, n - 1] {
            let mut input = vec![[0.0; 2]; n];
            input[k] = [1.0, 0.0];
            let wave: Vec<[f64; 2]> = (0..n)
                .map(|x| (TAU * (k * x) as f64 / n as f64).sin_cos())
                .map(|(sin, cos)| [cos, sin])
                .collect();
            assert!(relative_rms(&fft::naive(&input), &wave) < 1e-13);
            // And back: the conjugate wave's transform is N at that k.
            let conjugate: Vec<_> = wave.iter().map(|[re, im]| [*re, -im]).collect();
            let scaled: Vec<_> = input.iter().map(|v| times(*v, [n as f64, 0.0])).collect();
            assert!(relative_rms(&fft::naive(&conjugate), &scaled) < 1e-13);
        }
    }
}

#[test]
fn radix_2_as_printed_is_the_definition() {
    for n in SIZES {
        let input = noise(n);
        assert!(relative_rms(&fft::radix2(&input), &fft::naive(&input)) < 1e-12, "N = {n}");
    }
}

/// A Hermitian spectrum of white noise without its Nyquist numbers, rounded to f32 so that all see the same input.
fn spectrum(n: usize, field: usize) -> Vec<[f64; 2]> {
    let mut grid = vec![[0.0; 2]; n * n];
    for at in 0..n * n {
        let (i, j) = (signed(at % n, n), signed(at / n, n));
        let nyquist = -(n as i32) / 2;
        if i == nyquist || j == nyquist || i < 0 || (i == 0 && j < 0) {
            continue;
        }
        let [re, im] = gaussian(7, i, j, field as u32).map(|part| f64::from(part as f32));
        let opposite = (n - at / n) % n * n + (n - at % n) % n;
        grid[at] = [re, if opposite == at { 0.0 } else { im }];
        grid[opposite] = [re, -grid[at][1]];
    }
    grid
}

/// FFTW 3.3.10 in single precision on white noise: 1.19e-7 at N = 64 to 1.52e-7 at 512, measured in C. Less than twice that.
const BOUND: f64 = 2.2e-7;

#[test]
fn every_size_and_instruction_set_agrees_with_the_definition() {
    for n in SIZES {
        let spectra: Vec<_> = (0..3).map(|field| spectrum(n, field)).collect();
        // In f64 the printed algorithm is as good as the definition, see above, and 512 x 512 end today.
        let truth: Vec<_> = spectra.iter().map(|grid| fft::separable(grid, n, fft::radix2)).collect();
        for isa in Isa::available() {
            let mut fields = ThreeFields::new(n, isa).expect("a size that exists");
            fields.fill(|field, ku, kv| {
                let row = kv.rem_euclid(n as i32) as usize;
                spectra[field][row * n + ku as usize].map(|part| part as f32)
            });
            // What lies about must not be seen.
            fields.soil(f32::NAN);
            fields.inverse();
            for (field, truth) in truth.iter().enumerate() {
                let got: Vec<_> =
                    (0..n).flat_map(|v| fields.row(field, v)).map(|&x| [f64::from(x), 0.0]).collect();
                let error = relative_rms(&got, truth);
                assert!(error < BOUND, "{isa}, N = {n}, field {field}: {error:e}");
            }
        }
    }
}

#[test]
fn fused_instruction_sets_agree_to_the_bit() {
    for n in SIZES {
        let mut bits: Vec<(Isa, Vec<u32>)> = Vec::new();
        for isa in Isa::available() {
            let mut fields = ThreeFields::new(n, isa).expect("a size that exists");
            fields.fill(|field, ku, kv| gaussian(1, ku, kv, field as u32).map(|part| part as f32));
            fields.inverse();
            bits.push((
                isa,
                (0..3 * n).flat_map(|at| fields.row(at / n, at % n)).map(|x| x.to_bits()).collect(),
            ));
        }
        for (a, b) in bits.iter().flat_map(|a| bits.iter().map(move |b| (a, b))) {
            if a.0.rounds_products() == b.0.rounds_products() {
                assert!(a.1 == b.1, "N = {n}: {} and {} differ", a.0, b.0);
            }
        }
    }
}

#[test]
fn other_sizes_are_refused() {
    for n in [0, 1, 8, 24, 48, 1024, usize::MAX] {
        assert!(ThreeFields::new(n, Isa::best()).is_err(), "{n}");
    }
}
