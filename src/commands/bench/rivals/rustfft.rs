//! RustFFT with a transpose: two complex transforms of the grid, the third and fourth real field being one and nothing.
//!
//! Rows, transpose, rows: the fields come out with their axes swapped, which spares it a second transpose.
use super::label;
use crate::commands::bench::BenchError;
use crate::commands::bench::fields::paired;
use crate::commands::bench::harness::{Body, Case};
use crate::commands::bench::sea::transform_work;
use rustfft::num_complex::Complex32;
use rustfft::{Fft, FftPlanner};
use std::sync::Arc;

struct Two {
    n: usize,
    rows: Arc<dyn Fft<f32>>,
    kept: [Vec<Complex32>; 2],
    arrays: [Vec<Complex32>; 2],
    turned: [Vec<Complex32>; 2],
    scratch: Vec<Complex32>,
}

impl Body for Two {
    fn prepare(&mut self) {
        for (array, kept) in self.arrays.iter_mut().zip(&self.kept) {
            array.copy_from_slice(kept);
        }
    }

    fn run(&mut self) -> Result<(), BenchError> {
        for (array, turned) in self.arrays.iter_mut().zip(&mut self.turned) {
            self.rows.process_with_scratch(array, &mut self.scratch);
            transpose::transpose(array, turned, self.n, self.n);
            self.rows.process_with_scratch(turned, &mut self.scratch);
        }
        Ok(())
    }
}

fn two(n: usize) -> Two {
    let rows = FftPlanner::new().plan_fft_inverse(n);
    let kept = [(0, Some(1)), (2, None)].map(|(a, b)| {
        let wave = |at: usize| {
            let [re, im] = paired(n, a, b, at % n, at / n);
            Complex32::new(re, im)
        };
        (0..n * n).map(wave).collect::<Vec<_>>()
    });
    let scratch = vec![Complex32::default(); rows.get_inplace_scratch_len()];
    Two { n, rows, arrays: kept.clone(), turned: kept.clone(), kept, scratch }
}

/// Both transforms.
pub fn case(n: usize) -> Case {
    Case::new(label("rustfft2", n), transform_work(n), two(n))
}

/// What it gives for the three fields, row by row.
#[cfg(test)]
pub fn results(n: usize) -> Vec<Vec<f32>> {
    let mut two = two(n);
    two.prepare();
    two.run().unwrap();
    let swapped = |at: usize| at % n * n + at / n;
    let part = |of: usize, take: fn(&Complex32) -> f32| {
        (0..n * n).map(|at| take(&two.turned[of][swapped(at)])).collect()
    };
    vec![part(0, |c| c.re), part(0, |c| c.im), part(1, |c| c.re)]
}
