//! Four lanes: NEON, part of every 64-bit ARM processor.
use super::{
    Float, Kernel, Simd, Texels,
    texels::{MOVED_HALF, REBIAS},
};
use half::f16;
use std::arch::{aarch64::*, asm};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// NEON: a value exists only where the processor has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Neon(());

/// Four numbers.
#[derive(Clone, Copy, Debug)]
pub struct F32x4(float32x4_t);

const LANES: usize = 4;

impl Neon {
    /// `None` where the processor does not have it.
    pub fn detect() -> Option<Self> {
        std::arch::is_aarch64_feature_detected!("neon").then_some(Self(()))
    }
}

impl Simd for Neon {
    type F32 = F32x4;
    type Wide = Self;

    #[inline(always)]
    fn wide(self) -> Self {
        self
    }

    #[inline(always)]
    fn run<K: Kernel>(self, kernel: K) -> K::Output {
        #[inline(never)]
        #[target_feature(enable = "neon")]
        fn neon<K: Kernel>(simd: Neon, kernel: K) -> K::Output {
            kernel.run(simd)
        }
        // SAFETY: `self` exists, so the features were detected.
        unsafe { neon(self, kernel) }
    }

    #[inline(always)]
    fn splat(self, value: f32) -> F32x4 {
        // SAFETY: `self` exists only with NEON.
        F32x4(unsafe { vdupq_n_f32(value) })
    }

    #[inline(always)]
    unsafe fn read(self, from: *const f32) -> F32x4 {
        // SAFETY: the caller vouches for the pointer; `self` exists only with NEON.
        F32x4(unsafe { vld1q_f32(from) })
    }

    #[inline(always)]
    fn prefetch(self, from: *const f32) {
        // SAFETY: a prefetch of any address at all is allowed, and changes nothing that a program could see.
        unsafe {
            asm!("prfm pldl1keep, [{from}]", from = in(reg) from, options(nostack, preserves_flags, readonly));
        }
    }

    #[inline(always)]
    fn pairs(self, table: &[[f32; 2]], indices: &[u16]) -> [F32x4; 2] {
        let indices = &indices[..LANES];
        // SAFETY: each pointer is to a pair that is within the table; `self` exists only with NEON.
        unsafe {
            let at = [usize::from(indices[0]), indices[1].into(), indices[2].into(), indices[3].into()];
            let low = vcombine_f32(vld1_f32(table[at[0]].as_ptr()), vld1_f32(table[at[1]].as_ptr()));
            let high = vcombine_f32(vld1_f32(table[at[2]].as_ptr()), vld1_f32(table[at[3]].as_ptr()));
            [F32x4(vuzp1q_f32(low, high)), F32x4(vuzp2q_f32(low, high))]
        }
    }

    #[inline(always)]
    fn texel_pairs(self, map: Texels<'_>, indices: &[u32]) -> [[F32x4; 3]; 2] {
        let indices = &indices[..LANES];
        let mut bits = [self.splat(0.0); LANES];
        for lane in 0..LANES {
            // SAFETY: the pointer is to a texel and the one after it, 128 bits; `self` exists only with NEON.
            bits[lane] = F32x4(unsafe { vreinterpretq_f32_u16(vld1q_u16(map.at(indices[lane]).cast())) });
        }
        self.transpose(&mut bits);
        // SAFETY: `self` exists only with NEON.
        let [a, b, c, d] = bits.map(|bits| unsafe { vreinterpretq_u32_f32(bits.0) });
        [[lower(a), upper(a), lower(b)], [lower(c), upper(c), lower(d)]]
    }

    #[inline(always)]
    fn transpose(self, rows: &mut [F32x4]) {
        let rows = &mut rows[..LANES];
        let [a, b, c, d] = [rows[0].0, rows[1].0, rows[2].0, rows[3].0];
        // SAFETY: `self` exists only with NEON.
        unsafe {
            let ab = vreinterpretq_f64_f32(vtrn1q_f32(a, b));
            let ab_odd = vreinterpretq_f64_f32(vtrn2q_f32(a, b));
            let cd = vreinterpretq_f64_f32(vtrn1q_f32(c, d));
            let cd_odd = vreinterpretq_f64_f32(vtrn2q_f32(c, d));
            rows[0] = F32x4(vreinterpretq_f32_f64(vzip1q_f64(ab, cd)));
            rows[1] = F32x4(vreinterpretq_f32_f64(vzip1q_f64(ab_odd, cd_odd)));
            rows[2] = F32x4(vreinterpretq_f32_f64(vzip2q_f64(ab, cd)));
            rows[3] = F32x4(vreinterpretq_f32_f64(vzip2q_f64(ab_odd, cd_odd)));
        }
    }
}

/// The 16-bit floats in the lower halves of all lanes.
#[inline(always)]
fn lower(lanes: uint32x4_t) -> F32x4 {
    // SAFETY: the callers are operations of vectors, which exist only with NEON.
    upper(unsafe { vshlq_n_u32::<16>(lanes) })
}

/// Those in the upper halves: sign and exponent go where a single has them.
#[inline(always)]
fn upper(lanes: uint32x4_t) -> F32x4 {
    // SAFETY: the callers are operations of vectors, which exist only with NEON.
    unsafe {
        let moved = vshrq_n_s32::<3>(vreinterpretq_s32_u32(lanes));
        let kept = vandq_u32(vreinterpretq_u32_s32(moved), vdupq_n_u32(MOVED_HALF));
        F32x4(vmulq_f32(vreinterpretq_f32_u32(kept), vdupq_n_f32(REBIAS)))
    }
}

impl Add for F32x4 {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        // SAFETY: vectors exist only with NEON.
        Self(unsafe { vaddq_f32(self.0, other.0) })
    }
}

impl Sub for F32x4 {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        // SAFETY: vectors exist only with NEON.
        Self(unsafe { vsubq_f32(self.0, other.0) })
    }
}

impl Mul for F32x4 {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        // SAFETY: vectors exist only with NEON.
        Self(unsafe { vmulq_f32(self.0, other.0) })
    }
}

impl Div for F32x4 {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        // SAFETY: vectors exist only with NEON.
        Self(unsafe { vdivq_f32(self.0, other.0) })
    }
}

impl Neg for F32x4 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: vectors exist only with NEON.
        Self(unsafe { vnegq_f32(self.0) })
    }
}

impl Float for F32x4 {
    const LANES: usize = LANES;

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        // SAFETY: vectors exist only with NEON.
        Self(unsafe { vfmaq_f32(term.0, self.0, factor.0) })
    }

    #[inline(always)]
    fn neg_mul_add(self, factor: Self, term: Self) -> Self {
        // SAFETY: vectors exist only with NEON.
        Self(unsafe { vfmsq_f32(term.0, self.0, factor.0) })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: vectors exist only with NEON.
        Self(unsafe { vbslq_f32(vcgtq_f32(self.0, other.0), self.0, other.0) })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: vectors exist only with NEON.
        Self(unsafe { vbslq_f32(vcltq_f32(self.0, other.0), self.0, other.0) })
    }

    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: vectors exist only with NEON.
        Self(unsafe { vabsq_f32(self.0) })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: vectors exist only with NEON.
        Self(unsafe { vsqrtq_f32(self.0) })
    }

    #[inline(always)]
    unsafe fn write(self, to: *mut f32) {
        // SAFETY: the caller vouches for the pointer; vectors exist only with NEON.
        unsafe { vst1q_f32(to, self.0) }
    }

    #[inline(always)]
    fn mirrored(self, next: Self) -> Self {
        // SAFETY: vectors exist only with NEON.
        unsafe {
            // 3 2 1 0, then one lane back: next's 0 comes first.
            let swapped = vrev64q_f32(self.0);
            let reversed = vextq_f32::<2>(swapped, swapped);
            let first = vextq_f32::<1>(next.0, next.0);
            Self(vextq_f32::<3>(first, reversed))
        }
    }

    #[inline(always)]
    fn pinned(mut self) -> Self {
        // SAFETY: nothing but a comment.
        unsafe {
            asm!("/* {vector:v} */", vector = inout(vreg) self.0, options(nomem, nostack, preserves_flags));
        }
        self
    }

    #[inline(always)]
    fn pair_sums(self, other: Self, factor: Self) -> Self {
        // SAFETY: vectors exist only with NEON.
        Self(unsafe { vmulq_f32(vpaddq_f32(self.0, other.0), factor.0) })
    }

    #[inline(always)]
    fn store_halves(texels: [Self; 4], to: &mut [[f16; 4]]) {
        let to = to[..LANES].as_mut_ptr().cast::<u16>();
        let (a, b) = (halves(texels[0].0), halves(texels[1].0));
        let (c, d) = (halves(texels[2].0), halves(texels[3].0));
        // SAFETY: four texels of eight bytes are written, and there are; vectors exist only with NEON.
        unsafe { vst4_u16(to, uint16x4x4_t(a, b, c, d)) }
    }

    #[inline(always)]
    fn store_bytes(texels: [Self; 4], to: &mut [[u8; 4]]) {
        let to = to[..LANES].as_mut_ptr().cast::<u32>();
        // SAFETY: four texels of four bytes are written, and there are; vectors exist only with NEON.
        unsafe {
            let (a, b) = (vcvtnq_u32_f32(texels[0].0), vcvtnq_u32_f32(texels[1].0));
            let (c, d) = (vcvtnq_u32_f32(texels[2].0), vcvtnq_u32_f32(texels[3].0));
            // Shift left and insert: each channel above those before it.
            let two = vsliq_n_u32::<8>(a, b);
            let three = vsliq_n_u32::<16>(two, c);
            vst1q_u32(to, vsliq_n_u32::<24>(three, d));
        }
    }
}

/// Rounded to half precision. The intrinsic for it is not stable yet: it has the type `f16`.
#[inline(always)]
fn halves(values: float32x4_t) -> uint16x4_t {
    let bits: uint16x4_t;
    // SAFETY: the instruction reads and writes the two registers named; every 64-bit ARM has it.
    unsafe {
        asm!("fcvtn {bits:v}.4h, {values:v}.4s", bits = out(vreg) bits, values = in(vreg) values,
            options(pure, nomem, nostack, preserves_flags));
    }
    bits
}
