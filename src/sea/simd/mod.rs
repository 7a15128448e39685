//! Vectors of `f32` as wide as the processor has them, chosen when the program runs.
//!
//! A kernel is written once, over [`Simd`], and run by [`Isa::run`], which compiles it for every instruction set and picks
//! one. Kernels contain no unsafe code: a value of a type that implements [`Simd`] exists only where the processor has the
//! instructions, and every vector comes from such a value.
//!
//! # Bits
//! On AVX2, AVX-512 and NEON the same kernel gives the same bits: they all have fused multiply-add, every operation here
//! is exact or correctly rounded, and no kernel's arithmetic depends on the number of lanes. SSE4.1 and the portable
//! fallback round products before they add; they agree with each other.
//!
//! # Inlining
//! Everything a kernel calls must be `#[inline(always)]`, or it is compiled without the instruction set and passes
//! vectors through memory. Closures are not: loops are written out.
mod aligned;
#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
#[cfg(target_arch = "x86_64")]
mod avx512_wide;
mod channels;
mod isa;
#[cfg(target_arch = "aarch64")]
mod neon;
mod scalar;
#[cfg(target_arch = "x86_64")]
mod sse;
mod strided;
mod texels;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use aligned::Aligned;
pub use channels::{Channels, ChannelsMut};
pub use isa::{Isa, Kernel, NoSuchIsa};
pub use strided::{Strided, StridedMut};
pub use texels::{MOVED_HALF, REBIAS, Texels};

use half::f16;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Most lanes that a vector has.
pub const MAX_LANES: usize = 16;

/// An instruction set that this processor has.
pub trait Simd: Copy + Send + Sync + 'static {
    /// Its vector.
    type F32: Float;
    /// The same instruction set with its longest vectors, where those are not its best for all work.
    type Wide: Simd;

    /// That one.
    fn wide(self) -> Self::Wide;

    /// Lanes of the vector, at most [`MAX_LANES`].
    const LANES: usize = Self::F32::LANES;

    /// Runs `kernel` in a function of its own: what several kernels use is compiled once.
    fn run<K: Kernel>(self, kernel: K) -> K::Output;

    /// `value` in every lane.
    fn splat(self, value: f32) -> Self::F32;

    /// The [`Simd::LANES`] numbers from `from` on, aligned or not.
    ///
    /// # Safety
    /// They may be read.
    unsafe fn read(self, from: *const f32) -> Self::F32;

    /// Half as many numbers from `low` on and as many from `high` on.
    ///
    /// # Safety
    /// They may be read.
    #[inline(always)]
    unsafe fn read_halves(self, low: *const f32, high: *const f32) -> Self::F32 {
        let mut lanes = [0.0; MAX_LANES];
        let half = <Self::F32 as Float>::LANES / 2;
        for lane in 0..half {
            // SAFETY: the caller vouches for the pointers.
            (lanes[lane], lanes[lane + half]) = unsafe { (*low.add(lane), *high.add(lane)) };
        }
        self.load(&lanes)
    }

    /// The first [`Simd::LANES`] numbers of `from`.
    ///
    /// # Panics
    /// When `from` is shorter.
    #[inline(always)]
    fn load(self, from: &[f32]) -> Self::F32 {
        // SAFETY: the slice is long enough.
        unsafe { self.read(from[..<Self::F32 as Float>::LANES].as_ptr()) }
    }

    /// The neighbours, before and after, of each of the [`Simd::LANES`] numbers from `at` on.
    ///
    /// # Safety
    /// A vector before `at`, the one there and one after it may be read.
    #[inline(always)]
    unsafe fn read_neighbours(self, at: *const f32) -> [Self::F32; 2] {
        // SAFETY: the caller vouches for the pointer.
        unsafe { [self.read(at.sub(1)), self.read(at.add(1))] }
    }

    /// Asks for the cache line of `from`, which will be read soon.
    fn prefetch(self, from: *const f32);

    /// The pairs of `table` at the first [`Simd::LANES`] of `indices`, as a vector of first and one of second numbers.
    ///
    /// # Panics
    /// When `indices` is shorter, or an index is beyond the table.
    fn pairs(self, table: &[[f32; 2]], indices: &[u16]) -> [Self::F32; 2];

    /// The first three numbers of the texels at the first [`Simd::LANES`] of `indices`, each modulo [`Texels`]' power of
    /// two, and of the texels that follow them.
    ///
    /// # Panics
    /// When `indices` is shorter.
    fn texel_pairs(self, map: Texels<'_>, indices: &[u32]) -> [[Self::F32; 3]; 2];

    /// Swaps rows and columns of the square that the first [`Simd::LANES`] vectors are.
    ///
    /// # Panics
    /// When there are fewer.
    fn transpose(self, rows: &mut [Self::F32]);
}

/// A vector of `f32`. Operations act on each lane by itself unless they say otherwise.
pub trait Float:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// `self * factor + term`, rounded once where the processor can.
    fn mul_add(self, factor: Self, term: Self) -> Self;
    /// `term - self * factor`, as [`Float::mul_add`].
    fn neg_mul_add(self, factor: Self, term: Self) -> Self;
    /// The larger one; `other` where one is not a number.
    fn max(self, other: Self) -> Self;
    /// The smaller one; `other` where one is not a number.
    fn min(self, other: Self) -> Self;
    /// Without its sign.
    fn abs(self) -> Self;
    /// The root, correctly rounded.
    fn sqrt(self) -> Self;

    /// Lanes of the vector.
    const LANES: usize;

    /// Writes all lanes to `to` and after it, aligned or not.
    ///
    /// # Safety
    /// They may be written there.
    unsafe fn write(self, to: *mut f32);

    /// Writes all lanes to the start of `to`.
    ///
    /// # Panics
    /// When `to` is shorter.
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        // SAFETY: the slice is long enough.
        unsafe { self.write(to[..Self::LANES].as_mut_ptr()) }
    }

    /// Lane 0 is `next`'s lane 0; lane i > 0 is `self`'s lane LANES - i.
    fn mirrored(self, next: Self) -> Self;

    /// Itself, in a register: what is pinned in a program before is computed before, and what comes after it after. The
    /// compiler, which has its own mind about the order, does not know how few registers that order needs.
    #[inline(always)]
    fn pinned(self) -> Self {
        self
    }

    /// Sums of neighbours times `factor`, a power of two: those of `self` in the lower half of the lanes, those of `other`
    /// in the upper.
    fn pair_sums(self, other: Self, factor: Self) -> Self;

    /// Writes four vectors as half-precision texels, rounded to nearest, ties to even.
    ///
    /// # Panics
    /// When `to` is shorter than a vector.
    fn store_halves(texels: [Self; 4], to: &mut [[f16; 4]]);

    /// Writes four vectors of numbers up to 255 as bytes, rounded to nearest, ties to even, negative ones as 0; what comes of
    /// larger ones is unspecified.
    ///
    /// # Panics
    /// When `to` is shorter than a vector.
    fn store_bytes(texels: [Self; 4], to: &mut [[u8; 4]]);
}
