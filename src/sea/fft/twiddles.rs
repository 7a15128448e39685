//! Tables of e^{2 pi i j / N}.
use super::layout::{Layout, ROW_RADIX};
use crate::sea::simd::Aligned;
use std::f64::consts::TAU;

/// The factors between the two transforms that each of a column and a row consists of.
#[derive(Clone, Debug)]
pub struct Twiddles {
    /// e^{2 pi i q k / N} as (re, im) for q in 0..R2, k in 0..R1, `[q][k]`.
    pub columns: Aligned<f32>,
    /// e^{2 pi i k n / N} for k in 0..N/16, n in 0..16: per k sixteen real parts, then sixteen imaginary ones.
    pub rows: Aligned<f32>,
}

impl Twiddles {
    /// Those of `layout`.
    pub fn new(layout: &Layout) -> Self {
        let factor = |product: usize| {
            let (sin, cos) = libm::sincos(TAU * (product % layout.n) as f64 / layout.n as f64);
            [cos as f32, sin as f32]
        };
        let mut columns = Aligned::zeros(2 * layout.n);
        for (at, pair) in columns.as_chunks_mut().0.iter_mut().enumerate() {
            *pair = factor(at / layout.r1 * (at % layout.r1));
        }
        let mut rows = Aligned::zeros(2 * layout.n);
        for (k, parts) in rows.chunks_exact_mut(2 * ROW_RADIX).enumerate() {
            for n in 0..ROW_RADIX {
                [parts[n], parts[n + ROW_RADIX]] = factor(k * n);
            }
        }
        Self { columns, rows }
    }
}
