//! Vectors of several channels that lie at regular distances, whose bounds are checked once for all.
use super::{Float, Simd};
use std::marker::PhantomData;

/// `C` channels to read, each of some vectors in a row.
#[derive(Clone, Copy, Debug)]
pub struct Channels<'a, S, const C: usize> {
    simd: S,
    first: *const f32,
    step: usize,
    vectors: usize,
    slice: PhantomData<&'a [f32]>,
}

impl<'a, S: Simd, const C: usize> Channels<'a, S, C> {
    /// Those of `vectors` each whose first begins at `first`, each of the others `step` after the one before.
    ///
    /// # Panics
    /// When they are not all within the slice.
    #[inline(always)]
    pub fn new(simd: S, from: &'a [f32], first: usize, step: usize, vectors: usize) -> Self {
        check::<S, C>(from.len(), first, step, vectors);
        // SAFETY: `first` is within the slice.
        Self { simd, first: unsafe { from.as_ptr().add(first) }, step, vectors, slice: PhantomData }
    }

    /// Vector `index` of `channel`.
    ///
    /// # Panics
    /// When there is none.
    #[inline(always)]
    pub fn load(self, index: usize, channel: usize) -> S::F32 {
        assert!(index < self.vectors && channel < C);
        // SAFETY: all vectors of all channels were checked to be within the slice.
        unsafe { self.simd.read(self.first.add(channel * self.step + index * <S::F32 as Float>::LANES)) }
    }
}

/// `C` channels to write.
#[derive(Debug)]
pub struct ChannelsMut<'a, S, const C: usize> {
    first: *mut f32,
    step: usize,
    vectors: usize,
    slice: PhantomData<(&'a mut [f32], S)>,
}

impl<'a, S: Simd, const C: usize> ChannelsMut<'a, S, C> {
    /// As [`Channels::new`].
    ///
    /// # Panics
    /// As it.
    #[inline(always)]
    pub fn new(_: S, to: &'a mut [f32], first: usize, step: usize, vectors: usize) -> Self {
        check::<S, C>(to.len(), first, step, vectors);
        // SAFETY: `first` is within the slice.
        Self { first: unsafe { to.as_mut_ptr().add(first) }, step, vectors, slice: PhantomData }
    }

    /// Writes vector `index` of `channel`.
    ///
    /// # Panics
    /// When there is none.
    #[inline(always)]
    pub fn store(&mut self, index: usize, channel: usize, value: S::F32) {
        assert!(index < self.vectors && channel < C);
        // SAFETY: all vectors of all channels were checked to be within the slice.
        unsafe { value.write(self.first.add(channel * self.step + index * <S::F32 as Float>::LANES)) }
    }
}

/// Every number that may be read or written is within `len`; what overflows is not.
#[inline(always)]
fn check<S: Simd, const C: usize>(len: usize, first: usize, step: usize, vectors: usize) {
    let end = step
        .checked_mul(C - 1)
        .and_then(|last| last.checked_add(first))
        .and_then(|last| vectors.checked_mul(<S::F32 as Float>::LANES)?.checked_add(last));
    assert!(end.is_some_and(|end| end <= len), "vectors beyond the end of a slice");
}
