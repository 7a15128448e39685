//! The pass along columns: two transforms of R1 and R2 points, in place, as many columns at a time as a vector has lanes.
use super::{
    butterfly::{Complex, Points, transform},
    layout::{Layout, ROW, TILE},
};
use crate::sea::simd::{Kernel, Simd, Strided, StridedMut};

/// Rows of a group that are asked for before they are needed: no hardware foresees sixteen streams.
const AHEAD: usize = 2;

/// Where the numbers of some columns come from.
pub trait Source: Copy {
    /// The rows kv = q + R2 p for p in 0..R1, of the lanes from `lane` on.
    fn rows<S: Simd, const R1: usize, const R2: usize>(self, simd: S, q: usize, lane: usize) -> impl Rows<S>;
}

/// Some rows of a column.
pub trait Rows<S: Simd>: Copy {
    /// Row q + R2 `p`.
    fn load(self, p: usize) -> Complex<S::F32>;
    /// Asks for what will be loaded a little later.
    fn prefetch(self, p: usize);
}

/// A tile that is stored as it is.
#[derive(Clone, Copy, Debug)]
pub struct Stored<'a> {
    /// The tile.
    pub tile: &'a [f32],
    /// Whether it lies in a cache that is far enough away to ask for it beforehand.
    pub far: bool,
}

impl Source for Stored<'_> {
    #[inline(always)]
    fn rows<S: Simd, const R1: usize, const R2: usize>(self, simd: S, q: usize, lane: usize) -> impl Rows<S> {
        StoredRows::new(simd, self.tile, q * ROW + lane, Layout::of(R1, R2).group_len(), R1, self.far)
    }
}

/// Complex numbers at regular distances in a tile.
#[derive(Clone, Copy, Debug)]
pub struct StoredRows<'a, S> {
    re: Strided<'a, S>,
    im: Strided<'a, S>,
    far: bool,
}

impl<'a, S: Simd> StoredRows<'a, S> {
    /// `count` of them, the first at `first`; `far` as in [`Stored`].
    #[inline(always)]
    pub fn new(simd: S, tile: &'a [f32], first: usize, stride: usize, count: usize, far: bool) -> Self {
        let re = Strided::new(simd, tile, first, stride, count);
        Self { re, im: Strided::new(simd, tile, first + TILE, stride, count), far }
    }
}

impl<S: Simd> Rows<S> for StoredRows<'_, S> {
    #[inline(always)]
    fn load(self, p: usize) -> Complex<S::F32> {
        Complex { re: self.re.load(p), im: self.im.load(p) }
    }

    #[inline(always)]
    fn prefetch(self, p: usize) {
        if self.far {
            self.re.prefetch_after(p, AHEAD * ROW);
        }
    }
}

/// Transforms the columns of a tile, N = `R1` x `R2`.
pub struct Columns<'a, T, const R1: usize, const R2: usize> {
    /// Where they come from.
    pub source: T,
    /// [`super::twiddles::Twiddles::columns`].
    pub twiddles: &'a [f32],
    /// Where they go.
    pub tile: &'a mut [f32],
}

impl<T: Source, const R1: usize, const R2: usize> Kernel for Columns<'_, T, R1, R2> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        const { assert!(TILE.is_multiple_of(S::LANES), "tiles of whole vectors") };
        let tile = &mut self.tile[..Layout::of(R1, R2).tile_len()];
        let twiddles = &self.twiddles[..2 * R1 * R2];
        for lane in (0..TILE).step_by(S::LANES) {
            for (q, twiddles) in twiddles.chunks_exact(2 * R1).enumerate() {
                first::<S, T, R1, R2>(simd, self.source, q, lane, twiddles, tile);
            }
            for p in 0..R1 {
                second::<S, R1, R2>(simd, p, lane, tile);
            }
        }
    }
}

/// R1 points, kv = `q` + R2 p over p, and the factors between the two transforms.
#[inline(always)]
fn first<S: Simd, T: Source, const R1: usize, const R2: usize>(
    simd: S,
    source: T,
    q: usize,
    lane: usize,
    twiddles: &[f32],
    tile: &mut [f32],
) {
    let from = source.rows::<S, R1, R2>(simd, q, lane);
    let to = StridedMut::reaching(simd, tile, q * ROW + lane, Layout::of(R1, R2).group_len(), R1, TILE);
    transform::<S, R1>(simd, &mut First { simd, from, twiddles: &twiddles[..2 * R1], to });
}

/// See [`first`].
struct First<'a, S, F> {
    simd: S,
    from: F,
    twiddles: &'a [f32],
    to: StridedMut<'a, S>,
}

impl<S: Simd, F: Rows<S>> Points<S> for First<'_, S, F> {
    #[inline(always)]
    fn read(&self, p: usize) -> Complex<S::F32> {
        self.from.prefetch(p);
        self.from.load(p)
    }

    #[inline(always)]
    fn write(&mut self, p: usize, mut value: Complex<S::F32>) {
        if p > 0 {
            let (re, im) = (self.twiddles[2 * p], self.twiddles[2 * p + 1]);
            value = value.times(Complex { re: self.simd.splat(re), im: self.simd.splat(im) });
        }
        self.to.store(p, value.re);
        self.to.store_after(p, TILE, value.im);
    }
}

/// R2 points, over q, in place.
#[inline(always)]
fn second<S: Simd, const R1: usize, const R2: usize>(simd: S, p: usize, lane: usize, tile: &mut [f32]) {
    let at = p * Layout::of(R1, R2).group_len() + lane;
    let rows = StridedMut::reaching(simd, tile, at, ROW, R2, TILE);
    transform::<S, R2>(simd, &mut Second { simd, rows });
}

/// See [`second`].
struct Second<'a, S> {
    simd: S,
    rows: StridedMut<'a, S>,
}

impl<S: Simd> Points<S> for Second<'_, S> {
    #[inline(always)]
    fn read(&self, q: usize) -> Complex<S::F32> {
        Complex { re: self.rows.load_after(self.simd, q, 0), im: self.rows.load_after(self.simd, q, TILE) }
    }

    #[inline(always)]
    fn write(&mut self, q: usize, value: Complex<S::F32>) {
        self.rows.store(q, value.re);
        self.rows.store_after(q, TILE, value.im);
    }
}
