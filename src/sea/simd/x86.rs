//! What SSE and AVX2 share.
use super::Texels;
use std::arch::x86_64::*;

/// The pairs of `table` at four `indices`: their first numbers, their second numbers.
///
/// # Panics
/// When there are fewer indices, or one is beyond the table.
#[inline(always)]
pub fn pairs(table: &[[f32; 2]], indices: &[u16]) -> [__m128; 2] {
    let indices = &indices[..4];
    let first: *const f64 = table[usize::from(indices[0])].as_ptr().cast();
    let second: *const f64 = table[usize::from(indices[1])].as_ptr().cast();
    let third: *const f64 = table[usize::from(indices[2])].as_ptr().cast();
    let fourth: *const f64 = table[usize::from(indices[3])].as_ptr().cast();
    // SAFETY: each pointer is to a pair, 64 bits, that is within the table, and need not be aligned; SSE2 is part of x86-64.
    unsafe {
        let low = _mm_castpd_ps(_mm_loadh_pd(_mm_load_sd(first), second));
        let high = _mm_castpd_ps(_mm_loadh_pd(_mm_load_sd(third), fourth));
        [_mm_shuffle_ps::<0x88>(low, high), _mm_shuffle_ps::<0xdd>(low, high)]
    }
}

/// The bits of the texel at `index` and of the one after it.
#[inline(always)]
pub fn texel_pair(map: Texels<'_>, index: u32) -> __m128 {
    // SAFETY: the pointer is to two texels, 128 bits; SSE is part of x86-64.
    unsafe { _mm_loadu_ps(map.at(index).cast()) }
}

/// The bytes of four texels from those of four channels, for a shuffle.
#[inline(always)]
pub fn bytes_of_texels() -> __m128i {
    // SAFETY: SSE2 is part of x86-64.
    unsafe { _mm_setr_epi8(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15) }
}

/// Asks for the cache line of `from`.
#[inline(always)]
pub fn prefetch(from: *const f32) {
    // SAFETY: a prefetch of any address at all is allowed, and changes nothing that a program could see; SSE is part of
    // x86-64.
    unsafe { _mm_prefetch::<_MM_HINT_T0>(from.cast()) }
}

/// Makes the compiler align the stack of the function it is inlined into for vectors.
///
/// It decides on that before it knows which registers it will have to spill. Without anything on the stack that asks for
/// it, spilled vectors lie across cache lines, and every other access to them is two.
#[inline(always)]
pub fn align_stack() {
    #[repr(align(64))]
    struct Line(#[allow(dead_code, reason = "only its place counts")] u8);
    let mut line = Line(0);
    std::hint::black_box(&mut line);
}
