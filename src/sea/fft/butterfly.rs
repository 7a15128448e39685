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

    /// See [`Float::pinned`].
    #[inline(always)]
    fn pinned(self) -> Self {
        Self { re: self.re.pinned(), im: self.im.pinned() }
    }

    /// `self (1 + i tangent)`.
    #[inline(always)]
    fn sheared(self, tangent: V) -> Self {
        Self { re: tangent.neg_mul_add(self.im, self.re), im: tangent.mul_add(self.re, self.im) }
    }
}

/// Where the numbers of a transform come from and go to. All are read before the first is written, so that both may be
/// the same place; what is not wanted for long is neither read early nor written late, since registers are few.
pub trait Points<S: Simd> {
    /// Whether all are in registers before the first is read.
    const AT_HAND: bool = false;

    /// x_`n`.
    fn read(&self, n: usize) -> Complex<S::F32>;
    /// Takes X_`k`.
    fn write(&mut self, k: usize, value: Complex<S::F32>);
}

/// Transforms `R` numbers.
///
/// # Panics
/// Unless `R` is 1, 2, 4, 8, 16 or 32.
#[inline(always)]
pub fn transform<S: Simd, const R: usize>(simd: S, points: &mut impl Points<S>) {
    match R {
        1 => points.write(0, points.read(0)),
        2 => {
            let (a, b) = (points.read(0), points.read(1));
            points.write(0, a + b);
            points.write(1, a - b);
        }
        4 => write_all(points, 0, 1, four(read_all(points, 0, 1))),
        8 => eight(simd, points),
        16 => sixteen(simd, points),
        32 => thirty_two(simd, points),
        _ => unreachable!("no transform of {R} points"),
    }
}

#[inline(always)]
fn read_all<S: Simd>(points: &impl Points<S>, first: usize, stride: usize) -> [Complex<S::F32>; 4] {
    let at = |n: usize| first + n * stride;
    [points.read(at(0)), points.read(at(1)), points.read(at(2)), points.read(at(3))]
}

/// [`four`] of what is read now, and not all of it before anything is transformed: half of that would be spilled.
#[inline(always)]
fn four_read<S: Simd, P: Points<S>>(points: &P, first: usize, stride: usize) -> [Complex<S::F32>; 4] {
    let [a, b, c, d] = four(read_all(points, first, stride));
    if P::AT_HAND {
        return [a, b, c, d];
    }
    [a.pinned(), b.pinned(), c.pinned(), d.pinned()]
}

#[inline(always)]
fn write_all<S: Simd>(
    points: &mut impl Points<S>,
    first: usize,
    stride: usize,
    values: [Complex<S::F32>; 4],
) {
    let [a, b, c, d] = values;
    points.write(first, a);
    points.write(first + stride, b);
    points.write(first + 2 * stride, c);
    points.write(first + 3 * stride, d);
}

#[inline(always)]
fn four<V: Float>([a, b, c, d]: [Complex<V>; 4]) -> [Complex<V>; 4] {
    let (ac, ac_minus) = (a + c, a - c);
    let (bd, bd_minus) = (b + d, b - d);
    [ac + bd, ac_minus.plus_i(bd_minus), ac - bd, ac_minus.minus_i(bd_minus)]
}

#[inline(always)]
fn eight<S: Simd>(simd: S, points: &mut impl Points<S>) {
    let even = four_read(points, 0, 2);
    let odd = four_read(points, 1, 2);
    let (one, half) = (simd.splat(1.0), simd.splat(FRAC_1_SQRT_2 as f32));
    points.write(0, even[0] + odd[0]);
    points.write(4, even[0] - odd[0]);
    // e^{i pi/4} = (1 + i) / sqrt 2, e^{3 i pi/4} = -(1 - i) / sqrt 2.
    let first = odd[1].sheared(one);
    points.write(1, even[1].plus(half, first));
    points.write(5, even[1].minus(half, first));
    points.write(2, even[2].plus_i(odd[2]));
    points.write(6, even[2].minus_i(odd[2]));
    let third = odd[3].sheared(-one);
    points.write(3, even[3].minus(half, third));
    points.write(7, even[3].plus(half, third));
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

/// 4 x 4.
#[inline(always)]
fn sixteen<S: Simd>(simd: S, points: &mut impl Points<S>) {
    let a = four_read(points, 0, 4);
    let b = four_read(points, 1, 4);
    let c = four_read(points, 2, 4);
    let d = four_read(points, 3, 4);
    write_all(points, 0, 4, four([a[0], b[0], c[0], d[0]]));
    write_all(points, 1, 4, four_turned::<S, 1>(simd, [a[1], b[1], c[1], d[1]]));
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
    write_all(points, 2, 4, two);
    write_all(points, 3, 4, four_turned::<S, 3>(simd, [a[3], b[3], c[3], d[3]]));
}

/// 2 x 16.
#[inline(always)]
fn thirty_two<S: Simd>(simd: S, points: &mut impl Points<S>) {
    let zero = Complex { re: simd.splat(0.0), im: simd.splat(0.0) };
    let mut even = [zero; 16];
    sixteen(simd, &mut Even { points: &*points, even: &mut even });
    sixteen(simd, &mut Odd { simd, points, even: &even });
}

/// The even ones of 32 points, and where their transform is kept.
struct Even<'a, P, V> {
    points: &'a P,
    even: &'a mut [Complex<V>; 16],
}

impl<S: Simd, P: Points<S>> Points<S> for Even<'_, P, S::F32> {
    #[inline(always)]
    fn read(&self, n: usize) -> Complex<S::F32> {
        self.points.read(2 * n)
    }

    #[inline(always)]
    fn write(&mut self, k: usize, value: Complex<S::F32>) {
        self.even[k] = value;
    }
}

/// The odd ones, whose transform completes that of the even ones.
struct Odd<'a, S: Simd, P> {
    simd: S,
    points: &'a mut P,
    even: &'a [Complex<S::F32>; 16],
}

impl<S: Simd, P: Points<S>> Points<S> for Odd<'_, S, P> {
    #[inline(always)]
    fn read(&self, n: usize) -> Complex<S::F32> {
        self.points.read(2 * n + 1)
    }

    #[inline(always)]
    fn write(&mut self, k: usize, odd: Complex<S::F32>) {
        let even = self.even[k];
        let (low, high) = if k == 0 {
            (even + odd, even - odd)
        } else if k == 8 {
            (even.plus_i(odd), even.minus_i(odd))
        } else {
            let (cos, tan) = THIRTY_SECONDS[k];
            let odd = odd.sheared(self.simd.splat(tan));
            let cos = self.simd.splat(cos);
            (even.plus(cos, odd), even.minus(cos, odd))
        };
        self.points.write(k, low);
        self.points.write(k + 16, high);
    }
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
