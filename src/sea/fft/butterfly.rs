//! Small transforms X_k = sum over n of x_n e^{+2 pi i n k / R}, in registers: one signal in each lane.
//!
//! Twiddle factors within them are c (1 + i t) with t the tangent: the turn by 1 + i t is two fused multiply-adds, and c goes
//! into those of the sum that follows (Linzer and Feig 1993).
use crate::sea::simd::{Float, Simd};
use std::f64::consts::{FRAC_1_SQRT_2, PI};
use std::ops::{Add, Sub};

/// A complex number in each lane.
#[derive(Clone, Copy, Debug)]
pub struct Complex<V> {
    /// Real parts.
    pub re: V,
    /// Imaginary parts.
    pub im: V,
}

impl<V: Float> Add for Complex<V> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl<V: Float> Sub for Complex<V> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl<V: Float> Complex<V> {
    /// The product.
    #[inline(always)]
    pub fn times(self, other: Self) -> Self {
        Self {
            re: self.im.neg_mul_add(other.im, self.re * other.re),
            im: self.im.mul_add(other.re, self.re * other.im),
        }
    }

    /// `self + i other`.
    #[inline(always)]
    fn plus_i(self, other: Self) -> Self {
        Self { re: self.re - other.im, im: self.im + other.re }
    }

    /// `self - i other`.
    #[inline(always)]
    fn minus_i(self, other: Self) -> Self {
        Self { re: self.re + other.im, im: self.im - other.re }
    }

    /// `self + factor other`.
    #[inline(always)]
    fn plus(self, factor: V, other: Self) -> Self {
        Self { re: factor.mul_add(other.re, self.re), im: factor.mul_add(other.im, self.im) }
    }

    /// `self - factor other`.
    #[inline(always)]
    fn minus(self, factor: V, other: Self) -> Self {
        Self { re: factor.neg_mul_add(other.re, self.re), im: factor.neg_mul_add(other.im, self.im) }
    }

    /// `self + i factor other`.
    #[inline(always)]
    fn plus_i_times(self, factor: V, other: Self) -> Self {
        Self { re: factor.neg_mul_add(other.im, self.re), im: factor.mul_add(other.re, self.im) }
    }

    /// `self - i factor other`.
    #[inline(always)]
    fn minus_i_times(self, factor: V, other: Self) -> Self {
        Self { re: factor.mul_add(other.im, self.re), im: factor.neg_mul_add(other.re, self.im) }
    }

    /// `self (1 + i tangent)`.
    #[inline(always)]
    fn sheared(self, tangent: V) -> Self {
        Self { re: tangent.neg_mul_add(self.im, self.re), im: tangent.mul_add(self.re, self.im) }
    }
}

/// Transforms the `R` numbers of `x` in place.
///
/// # Panics
/// Unless `R` is 1, 2, 4, 8, 16 or 32.
#[inline(always)]
pub fn transform<S: Simd, const R: usize>(simd: S, x: &mut [Complex<S::F32>; R]) {
    match R {
        1 => {}
        2 => (x[0], x[1]) = (x[0] + x[1], x[0] - x[1]),
        4 => [x[0], x[1], x[2], x[3]] = four([x[0], x[1], x[2], x[3]]),
        8 => eight(simd, x),
        16 => sixteen(simd, x, 0, 1),
        32 => thirty_two(simd, x),
        _ => unreachable!("no transform of {R} points"),
    }
}

#[inline(always)]
fn four<V: Float>([a, b, c, d]: [Complex<V>; 4]) -> [Complex<V>; 4] {
    let (ac, ac_minus) = (a + c, a - c);
    let (bd, bd_minus) = (b + d, b - d);
    [ac + bd, ac_minus.plus_i(bd_minus), ac - bd, ac_minus.minus_i(bd_minus)]
}

#[inline(always)]
fn eight<S: Simd>(simd: S, x: &mut [Complex<S::F32>]) {
    let even = four([x[0], x[2], x[4], x[6]]);
    let odd = four([x[1], x[3], x[5], x[7]]);
    let (one, half) = (simd.splat(1.0), simd.splat(FRAC_1_SQRT_2 as f32));
    // e^{i pi/4} = (1 + i) / sqrt 2, e^{3 i pi/4} = -(1 - i) / sqrt 2.
    let first = odd[1].sheared(one);
    let third = odd[3].sheared(-one);
    x[0] = even[0] + odd[0];
    x[4] = even[0] - odd[0];
    x[1] = even[1].plus(half, first);
    x[5] = even[1].minus(half, first);
    x[2] = even[2].plus_i(odd[2]);
    x[6] = even[2].minus_i(odd[2]);
    x[3] = even[3].minus(half, third);
    x[7] = even[3].plus(half, third);
}

/// cos and tan of `turns` / 16 of a circle.
const fn sixteenth(turns: usize) -> (f64, f64) {
    const COS: [f64; 4] = [1.0, 0.923_879_532_511_286_7, FRAC_1_SQRT_2, 0.382_683_432_365_089_8];
    match turns {
        1 => (COS[1], COS[3] / COS[1]),
        2 => (COS[2], 1.0),
        3 => (COS[3], COS[1] / COS[3]),
        6 => (-COS[2], -1.0),
        9 => (-COS[1], COS[3] / COS[1]),
        _ => panic!("no such twiddle factor in a transform of 16 points"),
    }
}

/// [`four`] of a, b w^K, c w^{2K}, d w^{3K} with w = e^{2 pi i / 16}; K is 1 or 3.
#[inline(always)]
fn four_turned<S: Simd, const K: usize>(simd: S, [a, b, c, d]: [Complex<S::F32>; 4]) -> [Complex<S::F32>; 4] {
    let [(cos_1, tan_1), (cos_2, tan_2), (cos_3, tan_3)] =
        const { [sixteenth(K), sixteenth(2 * K), sixteenth(3 * K)] };
    let (b, c, d) = (
        b.sheared(simd.splat(tan_1 as f32)),
        c.sheared(simd.splat(tan_2 as f32)),
        d.sheared(simd.splat(tan_3 as f32)),
    );
    let (first, second) = (simd.splat(cos_1 as f32), simd.splat(cos_2 as f32));
    let ratio = simd.splat((cos_3 / cos_1) as f32);
    let (ac, ac_minus) = (a.plus(second, c), a.minus(second, c));
    let (bd, bd_minus) = (b.plus(ratio, d), b.minus(ratio, d));
    [
        ac.plus(first, bd),
        ac_minus.plus_i_times(first, bd_minus),
        ac.minus(first, bd),
        ac_minus.minus_i_times(first, bd_minus),
    ]
}

/// Sixteen numbers, `x[first + n stride]`, as 4 x 4.
#[inline(always)]
fn sixteen<S: Simd>(simd: S, x: &mut [Complex<S::F32>], first: usize, stride: usize) {
    let at = |n: usize| first + n * stride;
    let a = four([x[at(0)], x[at(4)], x[at(8)], x[at(12)]]);
    let b = four([x[at(1)], x[at(5)], x[at(9)], x[at(13)]]);
    let c = four([x[at(2)], x[at(6)], x[at(10)], x[at(14)]]);
    let d = four([x[at(3)], x[at(7)], x[at(11)], x[at(15)]]);
    let zeroth = four([a[0], b[0], c[0], d[0]]);
    let one = four_turned::<S, 1>(simd, [a[1], b[1], c[1], d[1]]);
    // w^2, i, w^6 = i w^2: the two turned ones share their factor.
    let two = {
        let (unit, half) = (simd.splat(1.0), simd.splat(FRAC_1_SQRT_2 as f32));
        let (b, d) = (b[2].sheared(unit), d[2].sheared(-unit));
        let (ac, ac_minus) = (a[2].plus_i(c[2]), a[2].minus_i(c[2]));
        let (bd, bd_minus) = (b - d, b + d);
        [
            ac.plus(half, bd),
            ac_minus.plus_i_times(half, bd_minus),
            ac.minus(half, bd),
            ac_minus.minus_i_times(half, bd_minus),
        ]
    };
    let three = four_turned::<S, 3>(simd, [a[3], b[3], c[3], d[3]]);
    for k in 0..4 {
        x[at(4 * k)] = zeroth[k];
        x[at(4 * k + 1)] = one[k];
        x[at(4 * k + 2)] = two[k];
        x[at(4 * k + 3)] = three[k];
    }
}

/// 2 x 16.
#[inline(always)]
fn thirty_two<S: Simd>(simd: S, x: &mut [Complex<S::F32>]) {
    sixteen(simd, x, 0, 2);
    sixteen(simd, x, 1, 2);
    let mut low = [x[0]; 16];
    let mut high = [x[0]; 16];
    for k in 0..16 {
        let (even, odd) = (x[2 * k], x[2 * k + 1]);
        if k == 0 {
            (low[k], high[k]) = (even + odd, even - odd);
        } else if k == 8 {
            (low[k], high[k]) = (even.plus_i(odd), even.minus_i(odd));
        } else {
            let (cos, tan) = THIRTY_SECONDS[k];
            let odd = odd.sheared(simd.splat(tan));
            let cos = simd.splat(cos);
            (low[k], high[k]) = (even.plus(cos, odd), even.minus(cos, odd));
        }
    }
    x[..16].copy_from_slice(&low);
    x[16..].copy_from_slice(&high);
}

/// cos and tan of k / 32 of a circle; those of 0 and 8 are not used.
const THIRTY_SECONDS: [(f32, f32); 16] = {
    // Taylor's series is exact to f64's last digits up to pi/4; the rest follows by symmetry.
    const fn sin_cos(angle: f64) -> (f64, f64) {
        let (mut sin, mut cos, mut term, mut n) = (0.0, 0.0, 1.0, 0);
        while n < 24 {
            match n % 4 {
                0 => cos += term,
                1 => sin += term,
                2 => cos -= term,
                _ => sin -= term,
            }
            n += 1;
            term *= angle / n as f64;
        }
        (sin, cos)
    }
    let mut table = [(1.0, 0.0); 16];
    let mut k = 1;
    while k < 16 {
        if k != 8 {
            let (sin, cos) = sin_cos(PI * k as f64 / 16.0);
            table[k] = (cos as f32, (sin / cos) as f32);
        }
        k += 1;
    }
    table
};
