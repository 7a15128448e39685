//! Fourier transforms for reading: the definition, and the paper's radix-2 algorithm.
use super::{evolve::times, spectrum::Complex};
use std::f64::consts::TAU;

/// X_x = sum over k of x_k e^{+2 pi i k x / N}: the definition.
pub fn naive(input: &[Complex]) -> Vec<Complex> {
    let n = input.len();
    let term = |k: usize, x: usize| {
        let (sin, cos) = (TAU * (k * x % n) as f64 / n as f64).sin_cos();
        times(input[k], [cos, sin])
    };
    (0..n)
        .map(|x| (0..n).map(|k| term(k, x)).fold([0.0; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]]))
        .collect()
}

/// Cooley and Tukey's radix-2 transform by decimation in time, eqs (32)-(36), with the twiddle factor's sign turned so
/// that the kernel is eq (1)'s e^{+i}: eq (33) prints the forward one, which flattens crests.
pub fn radix2(input: &[Complex]) -> Vec<Complex> {
    let n = input.len();
    let digits = n.ilog2();
    let reverse = |i: usize| (i as u32).reverse_bits() >> (32 - digits);
    let mut local: Vec<Complex> = (0..n).map(|i| input[reverse(i) as usize]).collect();
    let mut temp = local.clone();
    for pass in 0..digits {
        let stride = 1 << pass;
        for butterfly in 0..n / 2 {
            let (group, position) = (butterfly / stride, butterfly % stride);
            let top = group * 2 * stride + position;
            let bottom = top + stride;
            let exponent = position * (n >> (pass + 1));
            let (sin, cos) = (TAU * exponent as f64 / n as f64).sin_cos();
            let turned = times(local[bottom], [cos, sin]);
            temp[top] = [local[top][0] + turned[0], local[top][1] + turned[1]];
            temp[bottom] = [local[top][0] - turned[0], local[top][1] - turned[1]];
        }
        std::mem::swap(&mut local, &mut temp);
    }
    local
}

/// A transform along both axes of an n x n grid, rows first.
pub fn separable(grid: &[Complex], n: usize, transform: impl Fn(&[Complex]) -> Vec<Complex>) -> Vec<Complex> {
    let rows: Vec<Complex> = grid.chunks_exact(n).flat_map(&transform).collect();
    let mut result = vec![[0.0; 2]; n * n];
    for column in 0..n {
        let line: Vec<Complex> = (0..n).map(|row| rows[row * n + column]).collect();
        for (row, value) in transform(&line).into_iter().enumerate() {
            result[row * n + column] = value;
        }
    }
    result
}
