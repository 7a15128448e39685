//! Eight lanes again, with what AVX-512 adds to short vectors: twice as many registers (Skylake-X, Zen 4 and later).
//!
//! Sixteen lanes were tried in columns and short rows, and are slower where the processor halves 512-bit arithmetic, see `docs/performance.md`. The
//! operations are AVX2's; compiled here, they have 32 registers.
use super::{Kernel, Simd, Texels, avx2::F32x8, avx512_wide::Avx512Wide, x86};

/// AVX-512: a value exists only where the processor has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Avx512(super::avx2::Avx2);

impl Avx512 {
    /// `None` where the processor, or the operating system, does not have it.
    pub fn detect() -> Option<Self> {
        let all = is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512bw")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl");
        super::avx2::Avx2::detect().filter(|_| all).map(Self)
    }
}

impl Simd for Avx512 {
    type F32 = F32x8;
    type Wide = Avx512Wide;

    #[inline(always)]
    fn wide(self) -> Avx512Wide {
        Avx512Wide::new(self)
    }

    #[inline(always)]
    fn run<K: Kernel>(self, kernel: K) -> K::Output {
        #[inline(never)]
        #[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl,avx2,fma,f16c")]
        fn avx512<K: Kernel>(simd: Avx512, kernel: K) -> K::Output {
            x86::align_stack();
            kernel.run(simd)
        }
        // SAFETY: `self` exists, so the features were detected.
        unsafe { avx512(self, kernel) }
    }

    #[inline(always)]
    fn splat(self, value: f32) -> F32x8 {
        self.0.splat(value)
    }

    #[inline(always)]
    unsafe fn read(self, from: *const f32) -> F32x8 {
        // SAFETY: the caller vouches for the pointer.
        unsafe { self.0.read(from) }
    }

    #[inline(always)]
    fn prefetch(self, from: *const f32) {
        self.0.prefetch(from);
    }

    #[inline(always)]
    fn pairs(self, table: &[[f32; 2]], indices: &[u16]) -> [F32x8; 2] {
        self.0.pairs(table, indices)
    }

    #[inline(always)]
    fn texel_pairs(self, map: Texels<'_>, indices: &[u32]) -> [[F32x8; 3]; 2] {
        self.0.texel_pairs(map, indices)
    }

    #[inline(always)]
    fn transpose(self, rows: &mut [F32x8]) {
        self.0.transpose(rows);
    }
}
