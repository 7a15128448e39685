//! Vectors at regular distances in a slice, whose bounds are checked once for all.
use super::{Float, Simd};
use std::marker::PhantomData;

/// Some vectors to read.
#[derive(Clone, Copy, Debug)]
pub struct Strided<'a, S> {
    simd: S,
    first: *const f32,
    stride: usize,
    count: usize,
    reach: usize,
    slice: PhantomData<&'a [f32]>,
}

impl<'a, S: Simd> Strided<'a, S> {
    /// `count` vectors of `from`, the first at `first`, each `stride` after the one before.
    ///
    /// # Panics
    /// When they are not all within the slice.
    #[inline(always)]
    pub fn new(simd: S, from: &'a [f32], first: usize, stride: usize, count: usize) -> Self {
        Self::reaching(simd, from, first, stride, count, 0)
    }

    /// As [`Strided::new`], and with every vector those up to `reach` numbers after it.
    ///
    /// # Panics
    /// As it.
    #[inline(always)]
    pub fn reaching(
        simd: S,
        from: &'a [f32],
        first: usize,
        stride: usize,
        count: usize,
        reach: usize,
    ) -> Self {
        check::<S>(from.len(), first, stride, count, reach);
        // SAFETY: `first` is within the slice.
        Self { simd, first: unsafe { from.as_ptr().add(first) }, stride, count, reach, slice: PhantomData }
    }

    /// Vector `index`.
    ///
    /// # Panics
    /// When there is none: where the number of vectors is known to the compiler, so is the answer.
    #[inline(always)]
    pub fn load(self, index: usize) -> S::F32 {
        self.load_after(index, 0)
    }

    /// The vector `offset` numbers after vector `index`.
    ///
    /// # Panics
    /// As [`Strided::load`], and when `offset` is beyond the reach.
    #[inline(always)]
    pub fn load_after(self, index: usize, offset: usize) -> S::F32 {
        assert!(index < self.count && offset <= self.reach);
        // SAFETY: every vector up to `count`, and what it reaches, was checked to be within the slice.
        unsafe { self.simd.read(self.first.add(index * self.stride + offset)) }
    }

    /// As [`Strided::load_after`], but the upper half of the lanes begins `apart` numbers after the lower half; 0 for a
    /// vector that is in one piece.
    ///
    /// # Panics
    /// As it, for `offset` + `apart`.
    #[inline(always)]
    pub fn load_halves(self, index: usize, offset: usize, apart: usize) -> S::F32 {
        if apart == 0 {
            return self.load_after(index, offset);
        }
        assert!(index < self.count && apart <= self.reach && offset <= self.reach - apart);
        // SAFETY: every vector up to `count`, and what it reaches, was checked to be within the slice.
        unsafe {
            let low = self.first.add(index * self.stride + offset);
            self.simd.read_halves(low, low.add(apart))
        }
    }

    /// The neighbours, before and after, of each number of the vector `offset` numbers after vector `index`.
    ///
    /// # Panics
    /// As [`Strided::load`], and when there is no vector before that one, or one after it is beyond the reach.
    #[inline(always)]
    pub fn load_neighbours(self, index: usize, offset: usize) -> [S::F32; 2] {
        let lanes = <S::F32 as Float>::LANES;
        assert!(index < self.count && offset >= lanes && offset + lanes <= self.reach);
        // SAFETY: every vector up to `count`, and what it reaches, was checked to be within the slice.
        unsafe { self.simd.read_neighbours(self.first.add(index * self.stride + offset)) }
    }

    /// Asks for the cache line `offset` numbers after vector `index`, which will be read soon; it may be anywhere.
    #[inline(always)]
    pub fn prefetch_after(self, index: usize, offset: usize) {
        self.simd.prefetch(self.first.wrapping_add(index * self.stride + offset));
    }
}

/// Some vectors to write.
#[derive(Debug)]
pub struct StridedMut<'a, S> {
    first: *mut f32,
    stride: usize,
    count: usize,
    reach: usize,
    slice: PhantomData<(&'a mut [f32], S)>,
}

impl<'a, S: Simd> StridedMut<'a, S> {
    /// As [`Strided::new`].
    ///
    /// # Panics
    /// As it.
    #[inline(always)]
    pub fn new(simd: S, to: &'a mut [f32], first: usize, stride: usize, count: usize) -> Self {
        Self::reaching(simd, to, first, stride, count, 0)
    }

    /// As [`Strided::reaching`].
    ///
    /// # Panics
    /// As it.
    #[inline(always)]
    pub fn reaching(
        _: S,
        to: &'a mut [f32],
        first: usize,
        stride: usize,
        count: usize,
        reach: usize,
    ) -> Self {
        check::<S>(to.len(), first, stride, count, reach);
        // SAFETY: `first` is within the slice.
        Self { first: unsafe { to.as_mut_ptr().add(first) }, stride, count, reach, slice: PhantomData }
    }

    /// Writes vector `index`.
    ///
    /// # Panics
    /// As [`Strided::load`].
    #[inline(always)]
    pub fn store(&mut self, index: usize, value: S::F32) {
        self.store_after(index, 0, value);
    }

    /// Writes the vector `offset` numbers after vector `index`.
    ///
    /// # Panics
    /// As [`Strided::load_after`].
    #[inline(always)]
    pub fn store_after(&mut self, index: usize, offset: usize, value: S::F32) {
        assert!(index < self.count && offset <= self.reach);
        // SAFETY: every vector up to `count`, and what it reaches, was checked to be within the slice.
        unsafe { value.write(self.first.add(index * self.stride + offset)) }
    }

    /// The vector `offset` numbers after vector `index`.
    ///
    /// # Panics
    /// As [`Strided::load_after`].
    #[inline(always)]
    pub fn load_after(&self, simd: S, index: usize, offset: usize) -> S::F32 {
        assert!(index < self.count && offset <= self.reach);
        // SAFETY: every vector up to `count`, and what it reaches, was checked to be within the slice.
        unsafe { simd.read(self.first.add(index * self.stride + offset)) }
    }
}

/// Every number that may be read or written is within `len`; what overflows is not.
#[inline(always)]
fn check<S: Simd>(len: usize, first: usize, stride: usize, count: usize, reach: usize) {
    let end = count
        .checked_sub(1)
        .and_then(|last| last.checked_mul(stride))
        .and_then(|last| last.checked_add(first))
        .and_then(|last| last.checked_add(reach))
        .and_then(|last| last.checked_add(<S::F32 as Float>::LANES));
    assert!(end.is_some_and(|end| end <= len), "vectors beyond the end of a slice");
}
