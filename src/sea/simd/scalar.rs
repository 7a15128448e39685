//! One lane, in plain Rust: for processors that have no kernels of their own, and to compare with.
use super::{Float, Kernel, Simd, Texels};
use half::f16;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Plain Rust.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scalar;

/// One number.
#[derive(Clone, Copy, Debug)]
pub struct F32x1(f32);

impl Simd for Scalar {
    type F32 = F32x1;
    type Wide = Self;

    #[inline(always)]
    fn wide(self) -> Self {
        self
    }

    #[inline(never)]
    fn run<K: Kernel>(self, kernel: K) -> K::Output {
        kernel.run(self)
    }

    #[inline(always)]
    fn splat(self, value: f32) -> F32x1 {
        F32x1(value)
    }

    #[inline(always)]
    unsafe fn read(self, from: *const f32) -> F32x1 {
        // SAFETY: the caller vouches for the pointer.
        F32x1(unsafe { from.read() })
    }

    #[inline(always)]
    fn prefetch(self, _: *const f32) {}

    #[inline(always)]
    fn pairs(self, table: &[[f32; 2]], indices: &[u16]) -> [F32x1; 2] {
        let [first, second] = table[usize::from(indices[0])];
        [F32x1(first), F32x1(second)]
    }

    #[inline(always)]
    fn texel_pairs(self, map: Texels<'_>, indices: &[u32]) -> [[F32x1; 3]; 2] {
        map.pair(indices[0])
            .map(|[first, second, third, _]| [first, second, third].map(|half| F32x1(half.to_f32())))
    }

    #[inline(always)]
    fn transpose(self, _: &mut [F32x1]) {}
}

impl Add for F32x1 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for F32x1 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Mul for F32x1 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl Div for F32x1 {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0)
    }
}

impl Neg for F32x1 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Float for F32x1 {
    const LANES: usize = 1;

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }

    #[inline(always)]
    fn neg_mul_add(self, factor: Self, term: Self) -> Self {
        term - self * factor
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self.0 > other.0 { self } else { other }
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self.0 < other.0 { self } else { other }
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    #[inline(always)]
    unsafe fn write(self, to: *mut f32) {
        // SAFETY: the caller vouches for the pointer.
        unsafe { to.write(self.0) }
    }

    #[inline(always)]
    fn mirrored(self, next: Self) -> Self {
        next
    }

    #[inline(always)]
    fn pair_sums(self, other: Self, factor: Self) -> Self {
        (self + other) * factor
    }

    #[inline(always)]
    fn store_halves(texels: [Self; 4], to: &mut [[f16; 4]]) {
        for (part, texel) in to[0].iter_mut().zip(texels) {
            *part = f16::from_f32_const(texel.0);
        }
    }

    #[inline(always)]
    fn store_bytes(texels: [Self; 4], to: &mut [[u8; 4]]) {
        for (part, texel) in to[0].iter_mut().zip(texels) {
            *part = texel.0.round_ties_even() as u8;
        }
    }
}
