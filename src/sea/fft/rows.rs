//! The pass along rows: from half spectra to three real fields.
//!
//! A complex transform carries two real fields: h + i Du of one row, and Dv of two rows. N points are N/16 x 16: the first
//! transforms run across vectors, sixteen numbers in each block; squares are then transposed, so that the second
//! ones run across vectors too and their results lie in order.
use super::{
    butterfly::{Complex, transform},
    layout::{FIELDS, Layout, ROW_RADIX, TILE},
};
use crate::sea::simd::{Float, Kernel, MAX_LANES, Simd, Strided, StridedMut};

/// Numbers kept free before and after a row of a [`Window`], for its neighbours around the patch.
const MARGIN: usize = 16;

/// The largest grid whose half spectra a processor's second cache keeps: to ask for them beforehand only costs.
const LARGEST_IN_CACHE: usize = 256;

/// Rows of the three planes that are in memory together: the row v is at v modulo `rows`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// N.
    pub n: usize,
    /// Rows kept, a power of two.
    pub rows: usize,
}

impl Window {
    /// Numbers from a row to the next.
    #[inline(always)]
    pub const fn stride(&self) -> usize {
        self.n + 2 * MARGIN
    }

    /// Numbers in all.
    #[inline(always)]
    pub const fn numbers(&self) -> usize {
        FIELDS * self.rows * self.stride()
    }

    /// Numbers from a row of a field to the same row of the next.
    #[inline(always)]
    pub const fn field_stride(&self) -> usize {
        self.rows * self.stride()
    }

    /// Index of the first number of row `v` of `field`: 0 is h, 1 is Du, 2 is Dv.
    #[inline(always)]
    pub const fn row(&self, field: usize, v: usize) -> usize {
        field * self.field_stride() + (v & (self.rows - 1)) * self.stride() + MARGIN
    }

    /// Continues row `v` of every field by one number on either side: the patch is periodic.
    #[inline(always)]
    pub fn wrap(&self, planes: &mut [f32], v: usize) {
        for field in 0..FIELDS {
            let row = self.row(field, v);
            planes[row - 1] = planes[row + self.n - 1];
            planes[row + self.n] = planes[row];
        }
    }
}

/// Complex rows that are transposed together: as many as fill a vector's lanes with first transforms.
#[inline(always)]
pub const fn group(n: usize, vector_lanes: usize) -> usize {
    let points = n / ROW_RADIX;
    if points < vector_lanes { vector_lanes / points } else { 1 }
}

/// Rows that are transformed together: two groups of h + i Du, one of Dv.
#[inline(always)]
pub const fn unit(n: usize, vector_lanes: usize) -> usize {
    2 * group(n, vector_lanes)
}

/// Numbers of working space that [`Rows`] wants.
pub const fn scratch_len(n: usize, vector_lanes: usize) -> usize {
    2 * n * group(n, vector_lanes)
}

/// What the pass reads.
#[derive(Clone, Copy, Debug)]
pub struct HalfSpectra<'a> {
    /// For each tile of ku: the three fields' tiles, columns transformed.
    pub tiles: &'a [f32],
    /// [`super::twiddles::Twiddles::rows`].
    pub twiddles: &'a [f32],
}

/// Transforms a [`unit`] of rows, N = `R1` x `R2` = 16 x `M`.
pub struct Rows<'a, const R1: usize, const R2: usize, const M: usize> {
    /// What is read.
    pub from: HalfSpectra<'a>,
    /// The unit's first row.
    pub v: usize,
    /// Where rows lie in `planes`.
    pub window: Window,
    /// What is written.
    pub planes: &'a mut [f32],
    /// Working space, [`scratch_len`].
    pub scratch: &'a mut [f32],
}

impl<const R1: usize, const R2: usize, const M: usize> Kernel for Rows<'_, R1, R2, M> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        const { assert!(TILE.is_multiple_of(S::LANES), "tiles of whole vectors") };
        let Self { from, v, window, planes, scratch } = self;
        let layout = Layout::of(R1, R2);
        let n = R1 * R2;
        let group = group(n, S::LANES);
        let scratch = &mut scratch[..2 * n * group];
        let twiddles = &from.twiddles[..2 * n];
        // Two groups of h + i Du, then one of Dv.
        for pass in 0..3 {
            let mut to = [[0; 2]; MAX_LANES];
            for r in 0..group {
                let row = &mut scratch[2 * n * r..2 * n * (r + 1)];
                if pass < 2 {
                    let v = v + pass * group + r;
                    let at = layout.transformed_row(v);
                    let ahead = layout.transformed_row((v + 2 * group) % n);
                    let next = layout.tile_len();
                    pair(simd, layout, from.tiles, [at, next + at], [ahead, next + ahead], row);
                    to[r] = [window.row(0, v), window.row(1, v)];
                } else {
                    let v = v + 2 * r;
                    let at = [v, v + 1].map(|v| 2 * layout.tile_len() + layout.transformed_row(v));
                    let ahead = [v, v + 1].map(|v| (v + 2 * group) % n);
                    let ahead = ahead.map(|v| 2 * layout.tile_len() + layout.transformed_row(v));
                    pair(simd, layout, from.tiles, at, ahead, row);
                    to[r] = [window.row(2, v), window.row(2, v + 1)];
                }
                first::<S, M>(simd, twiddles, row);
            }
            second::<S, M>(simd, scratch, to, planes);
        }
    }
}

/// The spectrum of a + i b along ku, from the halves ku >= 0 of the Hermitian a and b, whose rows begin at `at` in
/// the first tile. Those that come after them begin at `ahead`: no hardware foresees where that is.
#[inline(always)]
fn pair<S: Simd>(simd: S, layout: Layout, tiles: &[f32], at: [usize; 2], ahead: [usize; 2], row: &mut [f32]) {
    let half = layout.n / 2 / S::LANES;
    let vectors = 2 * half;
    let row = &mut row[..2 * layout.n];
    // Beyond the last ku is the Nyquist number, where the spectra are zero.
    let mut next = [simd.splat(0.0); 2];
    for vector in (0..half).rev() {
        let ku = vector * S::LANES;
        let offset = ku / TILE * FIELDS * layout.tile_len() + ku % TILE;
        let (a, b) = (&tiles[at[0] + offset..], &tiles[at[1] + offset..]);
        if layout.n > LARGEST_IN_CACHE {
            simd.prefetch(&tiles[ahead[0] + offset..]);
            simd.prefetch(&tiles[ahead[1] + offset..]);
        }
        let (a_re, a_im) = (simd.load(a), simd.load(&a[TILE..]));
        let (b_re, b_im) = (simd.load(b), simd.load(&b[TILE..]));
        let to = &mut row[2 * S::LANES * vector..];
        (a_re - b_im).store(to);
        (a_im + b_re).store(&mut to[S::LANES..]);
        // conj a + i conj b, at -ku.
        let mirror = [a_re + b_im, b_re - a_im];
        let to = &mut row[2 * S::LANES * (vectors - 1 - vector)..];
        mirror[0].mirrored(next[0]).store(to);
        mirror[1].mirrored(next[1]).store(&mut to[S::LANES..]);
        next = mirror;
    }
}

/// M points across blocks of sixteen, and the factors between the two transforms, in place.
#[inline(always)]
fn first<S: Simd, const M: usize>(simd: S, twiddles: &[f32], row: &mut [f32]) {
    const BLOCK: usize = 2 * ROW_RADIX;
    let row = &mut row[..BLOCK * M];
    for part in 0..ROW_RADIX / S::LANES {
        let mut x = [Complex { re: simd.splat(0.0), im: simd.splat(0.0) }; M];
        let at = 2 * S::LANES * part;
        let re = Strided::new(simd, row, at, BLOCK, M);
        let im = Strided::new(simd, row, at + S::LANES, BLOCK, M);
        for (j, x) in x.iter_mut().enumerate() {
            *x = Complex { re: re.load(j), im: im.load(j) };
        }
        transform(simd, &mut x);
        let factor = part * S::LANES;
        let re = Strided::new(simd, twiddles, factor, BLOCK, M);
        let im = Strided::new(simd, twiddles, factor + ROW_RADIX, BLOCK, M);
        for (k, x) in x.iter_mut().enumerate().skip(1) {
            *x = x.times(Complex { re: re.load(k), im: im.load(k) });
        }
        let mut re = StridedMut::new(simd, row, at, BLOCK, M);
        for (k, x) in x.iter().enumerate() {
            re.store(k, x.re);
        }
        let mut im = StridedMut::new(simd, row, at + S::LANES, BLOCK, M);
        for (k, x) in x.iter().enumerate() {
            im.store(k, x.im);
        }
    }
}

/// Sixteen points within each block, for as many blocks at a time as a vector has lanes; `to` says where each
/// row's real and imaginary part begin in `planes`.
#[inline(always)]
fn second<S: Simd, const M: usize>(
    simd: S,
    scratch: &[f32],
    to: [[usize; 2]; MAX_LANES],
    planes: &mut [f32],
) {
    const BLOCK: usize = 2 * ROW_RADIX;
    for first_block in (0..M.max(S::LANES)).step_by(S::LANES) {
        let mut x = [Complex { re: simd.splat(0.0), im: simd.splat(0.0) }; ROW_RADIX];
        for part in 0..ROW_RADIX / S::LANES {
            let at = first_block * BLOCK + 2 * S::LANES * part;
            let re = square(simd, scratch, at);
            let im = square(simd, scratch, at + S::LANES);
            for lane in 0..S::LANES {
                x[part * S::LANES + lane] = Complex { re: re[lane], im: im[lane] };
            }
        }
        transform(simd, &mut x);
        if M >= S::LANES {
            let mut re = StridedMut::new(simd, planes, to[0][0] + first_block, M, ROW_RADIX);
            for (k, x) in x.iter().enumerate() {
                re.store(k, x.re);
            }
            let mut im = StridedMut::new(simd, planes, to[0][1] + first_block, M, ROW_RADIX);
            for (k, x) in x.iter().enumerate() {
                im.store(k, x.im);
            }
        } else {
            for (k, x) in x.iter().enumerate() {
                let (mut re, mut im) = ([0.0; MAX_LANES], [0.0; MAX_LANES]);
                x.re.store(&mut re);
                x.im.store(&mut im);
                for r in 0..S::LANES / M {
                    let (to_re, to_im) = (to[r][0] + M * k, to[r][1] + M * k);
                    planes[to_re..to_re + M].copy_from_slice(&re[M * r..M * (r + 1)]);
                    planes[to_im..to_im + M].copy_from_slice(&im[M * r..M * (r + 1)]);
                }
            }
        }
    }
}

/// As many vectors as they have lanes, one from each block from `at` on, transposed.
#[inline(always)]
fn square<S: Simd>(simd: S, scratch: &[f32], at: usize) -> [S::F32; MAX_LANES] {
    let from = Strided::new(simd, scratch, at, 2 * ROW_RADIX, S::LANES);
    let mut square = [simd.splat(0.0); MAX_LANES];
    for (lane, row) in square[..S::LANES].iter_mut().enumerate() {
        *row = from.load(lane);
    }
    simd.transpose(&mut square);
    square
}
