//! Sixteen lanes of AVX-512, for rows of 256 and more and for long straight work on every texel: half as many instructions.
use super::{
    Float, Kernel, Simd, Texels,
    avx512::Avx512,
    texels::{MOVED_HALF, REBIAS},
    x86,
};
use half::f16;
use std::arch::{asm, x86_64::*};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// AVX-512 with its longest vectors: a value exists only where the processor has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Avx512Wide(Avx512);

/// Sixteen numbers.
#[derive(Clone, Copy, Debug)]
pub struct F32x16(__m512);

const LANES: usize = 16;

impl Avx512Wide {
    /// The same processor.
    #[inline(always)]
    pub fn new(short: Avx512) -> Self {
        Self(short)
    }
}

/// A vector that holds these lane numbers.
#[inline(always)]
fn lanes(numbers: [i32; LANES]) -> __m512i {
    // SAFETY: an array of 64 bytes is read; the callers are operations of vectors, which exist only with AVX-512.
    unsafe { _mm512_loadu_epi32(numbers.as_ptr()) }
}

impl Simd for Avx512Wide {
    type F32 = F32x16;
    type Wide = Self;

    #[inline(always)]
    fn wide(self) -> Self {
        self
    }

    #[inline(always)]
    fn run<K: Kernel>(self, kernel: K) -> K::Output {
        #[inline(never)]
        #[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl,avx2,fma,f16c")]
        fn avx512_wide<K: Kernel>(simd: Avx512Wide, kernel: K) -> K::Output {
            x86::align_stack();
            kernel.run(simd)
        }
        // SAFETY: `self` exists, so the features were detected.
        unsafe { avx512_wide(self, kernel) }
    }

    #[inline(always)]
    fn splat(self, value: f32) -> F32x16 {
        // SAFETY: `self` exists only with AVX-512.
        F32x16(unsafe { _mm512_set1_ps(value) })
    }

    #[inline(always)]
    unsafe fn read(self, from: *const f32) -> F32x16 {
        // SAFETY: the caller vouches for the pointer; `self` exists only with AVX-512.
        F32x16(unsafe { _mm512_loadu_ps(from) })
    }

    #[inline(always)]
    unsafe fn read_halves(self, low: *const f32, high: *const f32) -> F32x16 {
        // SAFETY: the caller vouches for the pointers; `self` exists only with AVX-512.
        unsafe {
            let low = _mm512_castps256_ps512(_mm256_loadu_ps(low));
            F32x16(_mm512_insertf32x8::<1>(low, _mm256_loadu_ps(high)))
        }
    }

    #[inline(always)]
    unsafe fn read_neighbours(self, at: *const f32) -> [F32x16; 2] {
        // SAFETY: the caller vouches for the pointers; `self` exists only with AVX-512.
        unsafe {
            let before = _mm512_castps_si512(_mm512_loadu_ps(at.sub(LANES)));
            let here = _mm512_castps_si512(_mm512_loadu_ps(at));
            let after = _mm512_castps_si512(_mm512_loadu_ps(at.add(LANES)));
            let behind = _mm512_alignr_epi32::<15>(here, before);
            let ahead = _mm512_alignr_epi32::<1>(after, here);
            [F32x16(_mm512_castsi512_ps(behind)), F32x16(_mm512_castsi512_ps(ahead))]
        }
    }

    #[inline(always)]
    fn prefetch(self, from: *const f32) {
        x86::prefetch(from);
    }

    #[inline(always)]
    fn pairs(self, table: &[[f32; 2]], indices: &[u16]) -> [F32x16; 2] {
        let (first, second) = (x86::pairs(table, &indices[..4]), x86::pairs(table, &indices[4..8]));
        let (third, fourth) = (x86::pairs(table, &indices[8..12]), x86::pairs(table, &indices[12..LANES]));
        [join(first[0], second[0], third[0], fourth[0]), join(first[1], second[1], third[1], fourth[1])]
    }

    #[inline(always)]
    fn texel_pairs(self, map: Texels<'_>, indices: &[u32]) -> [[F32x16; 3]; 2] {
        let indices = &indices[..LANES];
        let mut bits = [self.splat(0.0).0; 4];
        for i in 0..4 {
            let (first, second) = (x86::texel_pair(map, indices[i]), x86::texel_pair(map, indices[4 + i]));
            let (third, fourth) =
                (x86::texel_pair(map, indices[8 + i]), x86::texel_pair(map, indices[12 + i]));
            bits[i] = join(first, second, third, fourth).0;
        }
        let [a, b, c, d] = squares(bits).map(F32x16);
        [[lower(a), upper(a), lower(b)], [lower(c), upper(c), lower(d)]]
    }

    #[inline(always)]
    fn transpose(self, rows: &mut [F32x16]) {
        let rows = &mut rows[..LANES];
        // SAFETY: `self` exists only with AVX-512.
        unsafe {
            // Within quarters of four lanes: 4 x 4 squares.
            let first = squares([rows[0].0, rows[1].0, rows[2].0, rows[3].0]);
            let second = squares([rows[4].0, rows[5].0, rows[6].0, rows[7].0]);
            let third = squares([rows[8].0, rows[9].0, rows[10].0, rows[11].0]);
            let fourth = squares([rows[12].0, rows[13].0, rows[14].0, rows[15].0]);
            // Then the quarters change places.
            for i in 0..4 {
                let [a, b, c, d] = [first[i], second[i], third[i], fourth[i]];
                let (ab, ab_high) = (_mm512_shuffle_f32x4::<0x44>(a, b), _mm512_shuffle_f32x4::<0xee>(a, b));
                let (cd, cd_high) = (_mm512_shuffle_f32x4::<0x44>(c, d), _mm512_shuffle_f32x4::<0xee>(c, d));
                rows[i] = F32x16(_mm512_shuffle_f32x4::<0x88>(ab, cd));
                rows[4 + i] = F32x16(_mm512_shuffle_f32x4::<0xdd>(ab, cd));
                rows[8 + i] = F32x16(_mm512_shuffle_f32x4::<0x88>(ab_high, cd_high));
                rows[12 + i] = F32x16(_mm512_shuffle_f32x4::<0xdd>(ab_high, cd_high));
            }
        }
    }
}

/// Swaps rows and columns of the 4 x 4 squares that each quarter of four vectors makes.
#[inline(always)]
fn squares([a, b, c, d]: [__m512; 4]) -> [__m512; 4] {
    // SAFETY: the callers are operations of vectors, which exist only with AVX-512.
    unsafe {
        let (ab, ab_high) = (_mm512_unpacklo_ps(a, b), _mm512_unpackhi_ps(a, b));
        let (cd, cd_high) = (_mm512_unpacklo_ps(c, d), _mm512_unpackhi_ps(c, d));
        [
            _mm512_shuffle_ps::<0x44>(ab, cd),
            _mm512_shuffle_ps::<0xee>(ab, cd),
            _mm512_shuffle_ps::<0x44>(ab_high, cd_high),
            _mm512_shuffle_ps::<0xee>(ab_high, cd_high),
        ]
    }
}

/// Four quarters.
#[inline(always)]
fn join(a: __m128, b: __m128, c: __m128, d: __m128) -> F32x16 {
    // SAFETY: the callers are operations of vectors, which exist only with AVX-512.
    unsafe {
        let (low, high) = (_mm256_set_m128(b, a), _mm256_set_m128(d, c));
        F32x16(_mm512_insertf32x8::<1>(_mm512_castps256_ps512(low), high))
    }
}

/// Lanes 0, 2, .. of `a` and then of `b`.
#[inline(always)]
fn even(a: __m512, b: __m512) -> __m512 {
    let at = lanes([0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30]);
    // SAFETY: vectors exist only with AVX-512.
    unsafe { _mm512_permutex2var_ps(a, at, b) }
}

/// Lanes 1, 3, .. of `a` and then of `b`.
#[inline(always)]
fn odd(a: __m512, b: __m512) -> __m512 {
    let at = lanes([1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31]);
    // SAFETY: vectors exist only with AVX-512.
    unsafe { _mm512_permutex2var_ps(a, at, b) }
}

/// The 16-bit floats in the lower halves of all lanes.
#[inline(always)]
fn lower(lanes: F32x16) -> F32x16 {
    // SAFETY: vectors exist only with AVX-512.
    upper(F32x16(unsafe { _mm512_castsi512_ps(_mm512_slli_epi32::<16>(_mm512_castps_si512(lanes.0))) }))
}

/// Those in the upper halves: sign and exponent go where a single has them.
#[inline(always)]
fn upper(lanes: F32x16) -> F32x16 {
    // SAFETY: vectors exist only with AVX-512.
    unsafe {
        let moved = _mm512_srai_epi32::<3>(_mm512_castps_si512(lanes.0));
        let kept = _mm512_and_si512(moved, _mm512_set1_epi32(MOVED_HALF as i32));
        F32x16(_mm512_mul_ps(_mm512_castsi512_ps(kept), _mm512_set1_ps(REBIAS)))
    }
}

impl Add for F32x16 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        // SAFETY: vectors exist only with AVX-512.
        Self(unsafe { _mm512_add_ps(self.0, other.0) })
    }
}

impl Sub for F32x16 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        // SAFETY: vectors exist only with AVX-512.
        Self(unsafe { _mm512_sub_ps(self.0, other.0) })
    }
}

impl Mul for F32x16 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        // SAFETY: vectors exist only with AVX-512.
        Self(unsafe { _mm512_mul_ps(self.0, other.0) })
    }
}

impl Div for F32x16 {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        // SAFETY: vectors exist only with AVX-512.
        Self(unsafe { _mm512_div_ps(self.0, other.0) })
    }
}

impl Neg for F32x16 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: vectors exist only with AVX-512.
        Self(unsafe { _mm512_xor_ps(self.0, _mm512_set1_ps(-0.0)) })
    }
}

impl Float for F32x16 {
    const LANES: usize = LANES;

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        // SAFETY: vectors exist only with AVX-512.
        Self(unsafe { _mm512_fmadd_ps(self.0, factor.0, term.0) })
    }

    #[inline(always)]
    fn neg_mul_add(self, factor: Self, term: Self) -> Self {
        // SAFETY: vectors exist only with AVX-512.
        Self(unsafe { _mm512_fnmadd_ps(self.0, factor.0, term.0) })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: vectors exist only with AVX-512.
        Self(unsafe { _mm512_max_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: vectors exist only with AVX-512.
        Self(unsafe { _mm512_min_ps(self.0, other.0) })
    }

    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: vectors exist only with AVX-512.
        Self(unsafe { _mm512_andnot_ps(_mm512_set1_ps(-0.0), self.0) })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: vectors exist only with AVX-512.
        Self(unsafe { _mm512_sqrt_ps(self.0) })
    }

    #[inline(always)]
    unsafe fn write(self, to: *mut f32) {
        // SAFETY: the caller vouches for the pointer; vectors exist only with AVX-512.
        unsafe { _mm512_storeu_ps(to, self.0) }
    }

    #[inline(always)]
    fn mirrored(self, next: Self) -> Self {
        let at = lanes([16, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1]);
        // SAFETY: vectors exist only with AVX-512.
        Self(unsafe { _mm512_permutex2var_ps(self.0, at, next.0) })
    }

    #[inline(always)]
    fn pinned(self) -> Self {
        #[inline]
        #[target_feature(enable = "avx512f")]
        fn pinned(mut vector: __m512) -> __m512 {
            // SAFETY: nothing but a comment.
            unsafe {
                asm!("/* {vector} */", vector = inout(zmm_reg) vector, options(nomem, nostack, preserves_flags));
            }
            vector
        }
        // SAFETY: vectors exist only with AVX-512.
        Self(unsafe { pinned(self.0) })
    }

    #[inline(always)]
    fn pair_sums(self, other: Self, factor: Self) -> Self {
        Self(odd(self.0, other.0)).mul_add(factor, Self(even(self.0, other.0)) * factor)
    }

    #[inline(always)]
    fn store_halves(texels: [Self; 4], to: &mut [[f16; 4]]) {
        // Element e of a texel's four is word 16 e + texel of the two joined pairs.
        const fn words(first: i16) -> [i16; 32] {
            let mut words = [0; 32];
            let mut i = 0;
            while i < 32 {
                words[i] = first + i as i16 / 4 + 16 * (i as i16 % 4);
                i += 1;
            }
            words
        }
        const LOW: [i16; 32] = words(0);
        const HIGH: [i16; 32] = words(8);
        let to = to[..LANES].as_mut_ptr().cast::<i16>();
        // SAFETY: sixteen texels of eight bytes are written, and there are; vectors exist only with AVX-512.
        unsafe {
            const NEAREST: i32 = _MM_FROUND_TO_NEAREST_INT;
            let (a, b) = (_mm512_cvtps_ph::<NEAREST>(texels[0].0), _mm512_cvtps_ph::<NEAREST>(texels[1].0));
            let (c, d) = (_mm512_cvtps_ph::<NEAREST>(texels[2].0), _mm512_cvtps_ph::<NEAREST>(texels[3].0));
            let ab = _mm512_inserti64x4::<1>(_mm512_castsi256_si512(a), b);
            let cd = _mm512_inserti64x4::<1>(_mm512_castsi256_si512(c), d);
            let (low, high) = (_mm512_loadu_epi16(LOW.as_ptr()), _mm512_loadu_epi16(HIGH.as_ptr()));
            _mm512_storeu_epi16(to, _mm512_permutex2var_epi16(ab, low, cd));
            _mm512_storeu_epi16(to.add(32), _mm512_permutex2var_epi16(ab, high, cd));
        }
    }

    #[inline(always)]
    fn store_bytes(texels: [Self; 4], to: &mut [[u8; 4]]) {
        let to = to[..LANES].as_mut_ptr().cast::<i32>();
        // SAFETY: sixteen texels of four bytes are written, and there are; vectors exist only with AVX-512.
        unsafe {
            let (a, b) = (_mm512_cvtps_epi32(texels[0].0), _mm512_cvtps_epi32(texels[1].0));
            let (c, d) = (_mm512_cvtps_epi32(texels[2].0), _mm512_cvtps_epi32(texels[3].0));
            // Cut off at both ends on the way: four texels of a channel, then those of the next, in each 128 bits.
            let words = [_mm512_packs_epi32(a, b), _mm512_packs_epi32(c, d)];
            let bytes = _mm512_packus_epi16(words[0], words[1]);
            let order = _mm512_broadcast_i32x4(x86::bytes_of_texels());
            _mm512_storeu_epi32(to, _mm512_shuffle_epi8(bytes, order));
        }
    }
}
