//! Four lanes: SSE4.1, for x86 processors without AVX2. No fused multiply-add, and no half-precision conversion.
use super::{
    Float, Kernel, Simd, Texels,
    texels::{MOVED_HALF, REBIAS},
    x86,
};
use half::f16;
use std::arch::{asm, x86_64::*};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// SSE4.1: a value exists only where the processor has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sse(());

/// Four numbers.
#[derive(Clone, Copy, Debug)]
pub struct F32x4(__m128);

const LANES: usize = 4;

impl Sse {
    /// `None` where the processor does not have it.
    pub fn detect() -> Option<Self> {
        is_x86_feature_detected!("sse4.1").then_some(Self(()))
    }
}

impl Simd for Sse {
    type F32 = F32x4;
    type Wide = Self;

    #[inline(always)]
    fn wide(self) -> Self {
        self
    }

    #[inline(always)]
    fn run<K: Kernel>(self, kernel: K) -> K::Output {
        #[inline(never)]
        #[target_feature(enable = "sse4.1")]
        fn sse<K: Kernel>(simd: Sse, kernel: K) -> K::Output {
            kernel.run(simd)
        }
        // SAFETY: `self` exists, so the features were detected.
        unsafe { sse(self, kernel) }
    }

    #[inline(always)]
    fn splat(self, value: f32) -> F32x4 {
        // SAFETY: `self` exists only with SSE4.1.
        F32x4(unsafe { _mm_set1_ps(value) })
    }

    #[inline(always)]
    unsafe fn read(self, from: *const f32) -> F32x4 {
        // SAFETY: the caller vouches for the pointer; `self` exists only with SSE4.1.
        F32x4(unsafe { _mm_loadu_ps(from) })
    }

    #[inline(always)]
    fn prefetch(self, from: *const f32) {
        x86::prefetch(from);
    }

    #[inline(always)]
    fn pairs(self, table: &[[f32; 2]], indices: &[u16]) -> [F32x4; 2] {
        let [first, second] = x86::pairs(table, &indices[..LANES]);
        [F32x4(first), F32x4(second)]
    }

    #[inline(always)]
    fn texel_pairs(self, map: Texels<'_>, indices: &[u32]) -> [[F32x4; 3]; 2] {
        let indices = &indices[..LANES];
        let mut bits = [self.splat(0.0); LANES];
        for lane in 0..LANES {
            bits[lane] = F32x4(x86::texel_pair(map, indices[lane]));
        }
        self.transpose(&mut bits);
        let [a, b, c, d] = bits.map(|bits| bits.0);
        [[lower(a), upper(a), lower(b)], [lower(c), upper(c), lower(d)]]
    }

    #[inline(always)]
    fn transpose(self, rows: &mut [F32x4]) {
        let rows = &mut rows[..LANES];
        let [a, b, c, d] = [rows[0].0, rows[1].0, rows[2].0, rows[3].0];
        // SAFETY: `self` exists only with SSE4.1.
        unsafe {
            let (ab, ab_high) = (_mm_unpacklo_ps(a, b), _mm_unpackhi_ps(a, b));
            let (cd, cd_high) = (_mm_unpacklo_ps(c, d), _mm_unpackhi_ps(c, d));
            rows[0] = F32x4(_mm_movelh_ps(ab, cd));
            rows[1] = F32x4(_mm_movehl_ps(cd, ab));
            rows[2] = F32x4(_mm_movelh_ps(ab_high, cd_high));
            rows[3] = F32x4(_mm_movehl_ps(cd_high, ab_high));
        }
    }
}

/// The 16-bit floats in the lower halves of all lanes.
#[inline(always)]
fn lower(lanes: __m128) -> F32x4 {
    // SAFETY: the callers are operations of vectors, which exist only with SSE4.1.
    upper(unsafe { _mm_castsi128_ps(_mm_slli_epi32::<16>(_mm_castps_si128(lanes))) })
}

/// Those in the upper halves: sign and exponent go where a single has them.
#[inline(always)]
fn upper(lanes: __m128) -> F32x4 {
    // SAFETY: the callers are operations of vectors, which exist only with SSE4.1.
    unsafe {
        let moved = _mm_srai_epi32::<3>(_mm_castps_si128(lanes));
        let kept = _mm_and_si128(moved, _mm_set1_epi32(MOVED_HALF as i32));
        F32x4(_mm_mul_ps(_mm_castsi128_ps(kept), _mm_set1_ps(REBIAS)))
    }
}

impl Add for F32x4 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        // SAFETY: vectors exist only with SSE4.1.
        Self(unsafe { _mm_add_ps(self.0, other.0) })
    }
}

impl Sub for F32x4 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        // SAFETY: vectors exist only with SSE4.1.
        Self(unsafe { _mm_sub_ps(self.0, other.0) })
    }
}

impl Mul for F32x4 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        // SAFETY: vectors exist only with SSE4.1.
        Self(unsafe { _mm_mul_ps(self.0, other.0) })
    }
}

impl Div for F32x4 {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        // SAFETY: vectors exist only with SSE4.1.
        Self(unsafe { _mm_div_ps(self.0, other.0) })
    }
}

impl Neg for F32x4 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: vectors exist only with SSE4.1.
        Self(unsafe { _mm_xor_ps(self.0, _mm_set1_ps(-0.0)) })
    }
}

impl Float for F32x4 {
    const LANES: usize = LANES;

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
        // SAFETY: vectors exist only with SSE4.1.
        Self(unsafe { _mm_max_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: vectors exist only with SSE4.1.
        Self(unsafe { _mm_min_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: vectors exist only with SSE4.1.
        Self(unsafe { _mm_andnot_ps(_mm_set1_ps(-0.0), self.0) })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: vectors exist only with SSE4.1.
        Self(unsafe { _mm_sqrt_ps(self.0) })
    }

    #[inline(always)]
    unsafe fn write(self, to: *mut f32) {
        // SAFETY: the caller vouches for the pointer; vectors exist only with SSE4.1.
        unsafe { _mm_storeu_ps(to, self.0) }
    }

    #[inline(always)]
    fn mirrored(self, next: Self) -> Self {
        // SAFETY: vectors exist only with SSE4.1.
        unsafe {
            let joined = _mm_blend_ps::<1>(self.0, next.0);
            Self(_mm_shuffle_ps::<0b01_10_11_00>(joined, joined))
        }
    }

    #[inline(always)]
    fn pinned(mut self) -> Self {
        // SAFETY: nothing but a comment.
        unsafe {
            asm!("/* {vector} */", vector = inout(xmm_reg) self.0, options(nomem, nostack, preserves_flags));
        }
        self
    }

    #[inline(always)]
    fn pair_sums(self, other: Self, factor: Self) -> Self {
        // SAFETY: vectors exist only with SSE4.1.
        unsafe {
            let even = _mm_shuffle_ps::<0x88>(self.0, other.0);
            let odd = _mm_shuffle_ps::<0xdd>(self.0, other.0);
            Self(_mm_mul_ps(_mm_add_ps(even, odd), factor.0))
        }
    }

    #[inline(always)]
    fn store_halves(texels: [Self; 4], to: &mut [[f16; 4]]) {
        let to = to[..LANES].as_mut_ptr().cast::<__m128i>();
        // SAFETY: four texels of eight bytes are written, and there are; vectors exist only with SSE4.1.
        unsafe {
            let (a, b) = (halves(texels[0].0), halves(texels[1].0));
            let (c, d) = (halves(texels[2].0), halves(texels[3].0));
            // Two channels share 32 bits.
            let ab = _mm_or_si128(a, _mm_slli_epi32::<16>(b));
            let cd = _mm_or_si128(c, _mm_slli_epi32::<16>(d));
            _mm_storeu_si128(to, _mm_unpacklo_epi32(ab, cd));
            _mm_storeu_si128(to.add(1), _mm_unpackhi_epi32(ab, cd));
        }
    }

    #[inline(always)]
    fn store_bytes(texels: [Self; 4], to: &mut [[u8; 4]]) {
        let to = to[..LANES].as_mut_ptr().cast::<__m128i>();
        // SAFETY: four texels of four bytes are written, and there are; vectors exist only with SSE4.1.
        unsafe {
            let (a, b) = (_mm_cvtps_epi32(texels[0].0), _mm_cvtps_epi32(texels[1].0));
            let (c, d) = (_mm_cvtps_epi32(texels[2].0), _mm_cvtps_epi32(texels[3].0));
            // Cut off at both ends on the way: four texels of a channel, then those of the next, in each 128 bits.
            let words = [_mm_packs_epi32(a, b), _mm_packs_epi32(c, d)];
            let bytes = _mm_packus_epi16(words[0], words[1]);
            let order = x86::bytes_of_texels();
            _mm_storeu_si128(to, _mm_shuffle_epi8(bytes, order));
        }
    }
}

/// The half-precision bits of four finite numbers or infinities, rounded to nearest, ties to even, in 32 bits each.
///
/// From 2^-14 on the mantissa is cut with a carry; below, adding 1/2 lets the processor round to the 2^-24 that
/// subnormal halves are apart.
#[inline(always)]
fn halves(values: __m128) -> __m128i {
    // SAFETY: vectors exist only with SSE4.1.
    unsafe {
        let magnitude = _mm_andnot_si128(_mm_set1_epi32(i32::MIN), _mm_castps_si128(values));
        let sign = _mm_andnot_si128(_mm_set1_epi32(0x7fff_ffff), _mm_castps_si128(values));
        let odd = _mm_and_si128(_mm_srli_epi32::<13>(magnitude), _mm_set1_epi32(1));
        let rebased = _mm_add_epi32(magnitude, _mm_set1_epi32(0xfff - (112 << 23)));
        let normal = _mm_srli_epi32::<13>(_mm_add_epi32(rebased, odd));
        let normal = _mm_min_epi32(normal, _mm_set1_epi32(0x7c00));
        let half = _mm_set1_ps(0.5);
        let lifted = _mm_add_ps(_mm_castsi128_ps(magnitude), half);
        let subnormal = _mm_sub_epi32(_mm_castps_si128(lifted), _mm_castps_si128(half));
        let small = _mm_cmplt_epi32(magnitude, _mm_set1_epi32(113 << 23));
        _mm_or_si128(_mm_blendv_epi8(normal, subnormal, small), _mm_srli_epi32::<16>(sign))
    }
}
