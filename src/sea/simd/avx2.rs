//! Eight lanes: AVX2 with fused multiply-add and half-precision conversion (Haswell, Zen and later).
use super::{
    Float, Kernel, Simd, Texels,
    texels::{MOVED_HALF, REBIAS},
    x86,
};
use half::f16;
use std::arch::{asm, x86_64::*};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// AVX2: a value exists only where the processor has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Avx2(());

/// Eight numbers.
#[derive(Clone, Copy, Debug)]
pub struct F32x8(__m256);

const LANES: usize = 8;

impl Avx2 {
    /// `None` where the processor, or the operating system, does not have it.
    pub fn detect() -> Option<Self> {
        let all = is_x86_feature_detected!("avx2")
            && is_x86_feature_detected!("fma")
            && is_x86_feature_detected!("f16c");
        all.then_some(Self(()))
    }
}

impl Simd for Avx2 {
    type F32 = F32x8;
    type Wide = Self;

    #[inline(always)]
    fn wide(self) -> Self {
        self
    }

    #[inline(always)]
    fn run<K: Kernel>(self, kernel: K) -> K::Output {
        #[inline(never)]
        #[target_feature(enable = "avx2,fma,f16c")]
        fn avx2<K: Kernel>(simd: Avx2, kernel: K) -> K::Output {
            x86::align_stack();
            kernel.run(simd)
        }
        // SAFETY: `self` exists, so the features were detected.
        unsafe { avx2(self, kernel) }
    }

    #[inline(always)]
    fn splat(self, value: f32) -> F32x8 {
        // SAFETY: `self` exists only with AVX2.
        F32x8(unsafe { _mm256_set1_ps(value) })
    }

    #[inline(always)]
    unsafe fn read(self, from: *const f32) -> F32x8 {
        // SAFETY: the caller vouches for the pointer; `self` exists only with AVX2.
        F32x8(unsafe { _mm256_loadu_ps(from) })
    }

    #[inline(always)]
    fn prefetch(self, from: *const f32) {
        x86::prefetch(from);
    }

    #[inline(always)]
    fn pairs(self, table: &[[f32; 2]], indices: &[u16]) -> [F32x8; 2] {
        let (low, high) = (x86::pairs(table, &indices[..4]), x86::pairs(table, &indices[4..LANES]));
        // SAFETY: `self` exists only with AVX2.
        unsafe {
            let even = _mm256_set_m128(high[0], low[0]);
            let odd = _mm256_set_m128(high[1], low[1]);
            [F32x8(even), F32x8(odd)]
        }
    }

    #[inline(always)]
    fn texel_pairs(self, map: Texels<'_>, indices: &[u32]) -> [[F32x8; 3]; 2] {
        let indices = &indices[..LANES];
        // SAFETY: `self` exists only with AVX2.
        unsafe {
            let mut bits = [_mm256_setzero_ps(); 4];
            for i in 0..4 {
                let (low, high) = (x86::texel_pair(map, indices[i]), x86::texel_pair(map, indices[4 + i]));
                bits[i] = _mm256_set_m128(high, low);
            }
            let [a, b, c, d] = squares(bits);
            [[lower(a), upper(a), lower(b)], [lower(c), upper(c), lower(d)]]
        }
    }

    #[inline(always)]
    fn transpose(self, rows: &mut [F32x8]) {
        let rows = &mut rows[..LANES];
        // SAFETY: `self` exists only with AVX2.
        unsafe {
            // Within halves of four lanes: 4 x 4 squares.
            let upper = squares([rows[0].0, rows[1].0, rows[2].0, rows[3].0]);
            let lower = squares([rows[4].0, rows[5].0, rows[6].0, rows[7].0]);
            // Then the halves change places.
            for i in 0..4 {
                rows[i] = F32x8(_mm256_permute2f128_ps::<0x20>(upper[i], lower[i]));
                rows[4 + i] = F32x8(_mm256_permute2f128_ps::<0x31>(upper[i], lower[i]));
            }
        }
    }
}

/// Swaps rows and columns of the 4 x 4 squares that each half of four vectors makes.
#[inline(always)]
fn squares([a, b, c, d]: [__m256; 4]) -> [__m256; 4] {
    // SAFETY: the callers are operations of vectors, which exist only with AVX2.
    unsafe {
        let (ab, ab_high) = (_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b));
        let (cd, cd_high) = (_mm256_unpacklo_ps(c, d), _mm256_unpackhi_ps(c, d));
        [
            _mm256_shuffle_ps::<0x44>(ab, cd),
            _mm256_shuffle_ps::<0xee>(ab, cd),
            _mm256_shuffle_ps::<0x44>(ab_high, cd_high),
            _mm256_shuffle_ps::<0xee>(ab_high, cd_high),
        ]
    }
}

/// The 16-bit floats in the lower halves of all lanes.
#[inline(always)]
fn lower(lanes: __m256) -> F32x8 {
    // SAFETY: the callers are operations of vectors, which exist only with AVX2.
    upper(unsafe { _mm256_castsi256_ps(_mm256_slli_epi32::<16>(_mm256_castps_si256(lanes))) })
}

/// Those in the upper halves: sign and exponent go where a single has them.
#[inline(always)]
fn upper(lanes: __m256) -> F32x8 {
    // SAFETY: the callers are operations of vectors, which exist only with AVX2.
    unsafe {
        let moved = _mm256_srai_epi32::<3>(_mm256_castps_si256(lanes));
        let kept = _mm256_and_si256(moved, _mm256_set1_epi32(MOVED_HALF as i32));
        F32x8(_mm256_mul_ps(_mm256_castsi256_ps(kept), _mm256_set1_ps(REBIAS)))
    }
}

impl Add for F32x8 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        // SAFETY: vectors exist only with AVX2.
        Self(unsafe { _mm256_add_ps(self.0, other.0) })
    }
}

impl Sub for F32x8 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        // SAFETY: vectors exist only with AVX2.
        Self(unsafe { _mm256_sub_ps(self.0, other.0) })
    }
}

impl Mul for F32x8 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        // SAFETY: vectors exist only with AVX2.
        Self(unsafe { _mm256_mul_ps(self.0, other.0) })
    }
}

impl Div for F32x8 {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        // SAFETY: vectors exist only with AVX2.
        Self(unsafe { _mm256_div_ps(self.0, other.0) })
    }
}

impl Neg for F32x8 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: vectors exist only with AVX2.
        Self(unsafe { _mm256_xor_ps(self.0, _mm256_set1_ps(-0.0)) })
    }
}

impl Float for F32x8 {
    const LANES: usize = LANES;

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        // SAFETY: vectors exist only with AVX2 and FMA.
        Self(unsafe { _mm256_fmadd_ps(self.0, factor.0, term.0) })
    }

    #[inline(always)]
    fn neg_mul_add(self, factor: Self, term: Self) -> Self {
        // SAFETY: vectors exist only with AVX2 and FMA.
        Self(unsafe { _mm256_fnmadd_ps(self.0, factor.0, term.0) })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: vectors exist only with AVX2.
        Self(unsafe { _mm256_max_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: vectors exist only with AVX2.
        Self(unsafe { _mm256_min_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: vectors exist only with AVX2.
        Self(unsafe { _mm256_andnot_ps(_mm256_set1_ps(-0.0), self.0) })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: vectors exist only with AVX2.
        Self(unsafe { _mm256_sqrt_ps(self.0) })
    }

    #[inline(always)]
    unsafe fn write(self, to: *mut f32) {
        // SAFETY: the caller vouches for the pointer; vectors exist only with AVX2.
        unsafe { _mm256_storeu_ps(to, self.0) }
    }

    #[inline(always)]
    fn mirrored(self, next: Self) -> Self {
        // SAFETY: vectors exist only with AVX2.
        unsafe {
            let joined = _mm256_blend_ps::<1>(self.0, next.0);
            Self(_mm256_permutevar8x32_ps(joined, _mm256_setr_epi32(0, 7, 6, 5, 4, 3, 2, 1)))
        }
    }

    #[inline(always)]
    fn pinned(self) -> Self {
        #[inline]
        #[target_feature(enable = "avx")]
        fn pinned(mut vector: __m256) -> __m256 {
            // SAFETY: nothing but a comment.
            unsafe {
                asm!("/* {vector} */", vector = inout(ymm_reg) vector, options(nomem, nostack, preserves_flags));
            }
            vector
        }
        // SAFETY: vectors exist only with AVX2.
        Self(unsafe { pinned(self.0) })
    }

    #[inline(always)]
    fn pair_sums(self, other: Self, factor: Self) -> Self {
        // SAFETY: vectors exist only with AVX2.
        unsafe {
            let even = _mm256_shuffle_ps::<0x88>(self.0, other.0);
            let odd = _mm256_shuffle_ps::<0xdd>(self.0, other.0);
            // Products are exact. A plain addition would become the horizontal one, which is slower than all of this.
            let sums = _mm256_fmadd_ps(odd, factor.0, _mm256_mul_ps(even, factor.0));
            Self(_mm256_castpd_ps(_mm256_permute4x64_pd::<0xd8>(_mm256_castps_pd(sums))))
        }
    }

    #[inline(always)]
    fn store_halves(texels: [Self; 4], to: &mut [[f16; 4]]) {
        let to = to[..LANES].as_mut_ptr().cast::<__m256i>();
        // SAFETY: eight texels of eight bytes are written, and there are; vectors exist only with AVX2 and F16C.
        unsafe {
            const NEAREST: i32 = _MM_FROUND_TO_NEAREST_INT;
            let (a, b) = (_mm256_cvtps_ph::<NEAREST>(texels[0].0), _mm256_cvtps_ph::<NEAREST>(texels[1].0));
            let (c, d) = (_mm256_cvtps_ph::<NEAREST>(texels[2].0), _mm256_cvtps_ph::<NEAREST>(texels[3].0));
            // Halves of 128 bits: texels 0..4 and 4..8 of two channels.
            let ab = _mm256_set_m128i(_mm_unpackhi_epi16(a, b), _mm_unpacklo_epi16(a, b));
            let cd = _mm256_set_m128i(_mm_unpackhi_epi16(c, d), _mm_unpacklo_epi16(c, d));
            let (first, second) = (_mm256_unpacklo_epi32(ab, cd), _mm256_unpackhi_epi32(ab, cd));
            _mm256_storeu_si256(to, _mm256_permute2x128_si256::<0x20>(first, second));
            _mm256_storeu_si256(to.add(1), _mm256_permute2x128_si256::<0x31>(first, second));
        }
    }

    #[inline(always)]
    fn store_bytes(texels: [Self; 4], to: &mut [[u8; 4]]) {
        let to = to[..LANES].as_mut_ptr().cast::<__m256i>();
        // SAFETY: eight texels of four bytes are written, and there are; vectors exist only with AVX2.
        unsafe {
            let (a, b) = (_mm256_cvtps_epi32(texels[0].0), _mm256_cvtps_epi32(texels[1].0));
            let (c, d) = (_mm256_cvtps_epi32(texels[2].0), _mm256_cvtps_epi32(texels[3].0));
            // Cut off at both ends on the way: four texels of a channel, then those of the next, in each 128 bits.
            let words = [_mm256_packs_epi32(a, b), _mm256_packs_epi32(c, d)];
            let bytes = _mm256_packus_epi16(words[0], words[1]);
            let order = _mm256_broadcastsi128_si256(x86::bytes_of_texels());
            _mm256_storeu_si256(to, _mm256_shuffle_epi8(bytes, order));
        }
    }
}
