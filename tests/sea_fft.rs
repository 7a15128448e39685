//! The transform: the definition on known pairs, then everything against the definition.
use std::f64::consts::TAU;
use swell::sea::fft::{Fft, LANES, Lane, Planes};
use swell::sea::philox::gaussian;
use swell::sea::reference::{evolve::times, fft};

const SIZES: [usize; 6] = [16, 32, 64, 128, 256, 512];

fn noise(n: usize, lane: u32) -> Vec<[f64; 2]> {
    // Rounded to f32, so that both transforms see the same input.
    (0..n as i32).map(|i| gaussian(3, i, n as i32, lane).map(|v| f64::from(v as f32))).collect()
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
        let input = noise(n, 0);
        assert!(relative_rms(&fft::radix2(&input), &fft::naive(&input)) < 1e-12, "N = {n}");
    }
}

#[test]
fn every_size_and_lane_agrees_with_the_definition() {
    for n in SIZES {
        let signals: Vec<_> = (0..LANES as u32).map(|lane| noise(n, lane)).collect();
        let plane = |part: usize| -> Vec<Lane> {
            (0..n).map(|i| std::array::from_fn(|lane| signals[lane][i][part] as f32)).collect()
        };
        let (mut re, mut im) = (plane(0), plane(1));
        // Longer than needed and full of rubbish.
        let (mut dirty_re, mut dirty_im) = (vec![[f32::NAN; LANES]; n + 3], vec![[1e30; LANES]; n + 5]);
        let plan = Fft::new(n).expect("a size that exists");
        let result = plan
            .inverse(Planes { re: &mut re, im: &mut im }, Planes { re: &mut dirty_re, im: &mut dirty_im });
        for (lane, signal) in signals.iter().enumerate() {
            let got: Vec<_> =
                (0..n).map(|i| [f64::from(result.re[i][lane]), f64::from(result.im[i][lane])]).collect();
            // Eight roundings of 2^-24 that add up at random are about 1.5e-7.
            let error = relative_rms(&got, &fft::naive(signal));
            assert!(error < 4e-7, "N = {n}, lane {lane}: {error:e}");
        }
    }
}

#[test]
fn other_sizes_are_refused() {
    for n in [0, 1, 8, 24, 48, 1024, usize::MAX] {
        assert!(Fft::new(n).is_err(), "{n}");
    }
}
