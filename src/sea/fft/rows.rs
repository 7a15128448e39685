//! The pass along rows: from half spectra to three real fields.
//!
//! A complex transform carries two real fields: h + i Du of one row, and Dv of two rows. N points are N/16 x 16: the first
//! transforms run across vectors, sixteen numbers in each block; squares are then transposed, so that the second
//! ones run across vectors too and their results lie in order.
use super::{
    butterfly::{Complex, Points, transform},
    layout::{FIELDS, Layout, ROW_RADIX, TILE},
};
use crate::sea::simd::{Float, Kernel, MAX_LANES, Simd, Strided, StridedMut};
use std::ops::Range;

/// Numbers kept free before and after a row of a [`Window`], for its neighbours around the patch.
const MARGIN: usize = 16;

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

/// Transforms some [`unit`]s of rows, N = `R1` x `R2` = 16 x `M`.
pub struct Rows<'a, const R1: usize, const R2: usize, const M: usize> {
    /// What is read.
    pub from: HalfSpectra<'a>,
    /// The rows, from a unit's first.
    pub rows: Range<usize>,
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
        // Longer vectors where a row fills them: groups and units are then the same.
        if M >= <S::Wide as Simd>::LANES { self.transform(simd.wide()) } else { self.transform(simd) }
    }
}

impl<const R1: usize, const R2: usize, const M: usize> Rows<'_, R1, R2, M> {
    #[inline(always)]
    fn transform<S: Simd>(self, simd: S) {
        let n = R1 * R2;
        let window = Window { n, ..self.window };
        // Lengths that the compiler knows, and row numbers within them: nothing is left to be checked below.
        let tiles = &self.from.tiles[..Layout::of(R1, R2).tiles() * FIELDS * Layout::of(R1, R2).tile_len()];
        let from = HalfSpectra { twiddles: &self.from.twiddles[..2 * n], tiles };
        for v in self.rows.step_by(unit(n, S::LANES)) {
            transform_unit::<S, R1, R2, M>(simd, from, v, window, self.planes, self.scratch);
        }
    }
}

/// Two groups of h + i Du, then one of Dv.
#[inline(always)]
fn transform_unit<S: Simd, const R1: usize, const R2: usize, const M: usize>(
    simd: S,
    from: HalfSpectra<'_>,
    v: usize,
    window: Window,
    planes: &mut [f32],
    scratch: &mut [f32],
) {
    let layout = Layout::of(R1, R2);
    let (n, tile_len, group) = (R1 * R2, layout.tile_len(), group(R1 * R2, S::LANES));
    let scratch = &mut scratch[..2 * n * group];
    for pass in 0..3 {
        let mut to = [[0; 2]; MAX_LANES];
        for r in 0..group {
            let row = &mut scratch[2 * n * r..2 * n * (r + 1)];
            if pass < 2 {
                let v = v + pass * group + r;
                let at = layout.transformed_row(v % n);
                first::<S, M>(simd, from, tile_len, [at, tile_len + at], row);
                to[r] = [window.row(0, v), window.row(1, v)];
            } else {
                let v = v + 2 * r;
                let at = [v, v + 1].map(|v| 2 * tile_len + layout.transformed_row(v % n));
                first::<S, M>(simd, from, tile_len, at, row);
                to[r] = [window.row(2, v), window.row(2, v + 1)];
            }
        }
        second::<S, M>(simd, scratch, to, planes);
    }
}

/// The spectrum of a + i b along ku from the halves ku >= 0 of the Hermitian a and b, of which every [`Self::PARTS`]th vector from
/// a certain one on is seen: what a first transform reads.
struct Pair<'a, S: Simd, const M: usize> {
    part: usize,
    /// From the first tile that a vector spans to the second.
    tile: usize,
    /// a and b at the same ku.
    ahead: [Strided<'a, S>; 2],
    /// a and b at the opposite of those of the upper half, which is stored backwards.
    mirror: [Strided<'a, S>; 2],
    /// Those one vector further: where lane 0 of the mirror image comes from.
    next: [Strided<'a, S>; 2],
    /// The last of those.
    edge: [Strided<'a, S>; 2],
}

/// Beyond the last ku is the Nyquist number, where the spectra are zero.
static NYQUIST: [f32; TILE + MAX_LANES] = [0.0; TILE + MAX_LANES];

impl<'a, S: Simd, const M: usize> Pair<'a, S, M> {
    /// Vectors in a block.
    const PARTS: usize = ROW_RADIX / S::LANES;

    /// Tiles that a vector spans.
    const TILES: usize = S::LANES.div_ceil(TILE);

    /// The vectors `part`, `part` + [`Self::PARTS`], ..; rows of a and b begin at `at` in the first of `tiles`.
    #[inline(always)]
    fn new(simd: S, tiles: &'a [f32], tile_len: usize, at: [usize; 2], part: usize) -> Self {
        let whole = |at: usize, vector: usize, count: usize| {
            // A grid of one block has half a block of ku.
            let vector = if M == 1 { vector % (Self::PARTS / 2) } else { vector };
            let ku = vector * S::LANES;
            let first = at + ku / TILE * FIELDS * tile_len + ku % TILE;
            let stride = ROW_RADIX / TILE * FIELDS * tile_len;
            let reach = TILE + (Self::TILES - 1) * FIELDS * tile_len;
            Strided::reaching(simd, tiles, first, stride, count, reach)
        };
        let count = (M / 2).max(1);
        let last = count - 1;
        let nyquist = part == if M == 1 { Self::PARTS / 2 } else { 0 };
        let at_edge = Strided::reaching(simd, &NYQUIST, 0, 0, 1, TILE);
        let (mut next, mut edge) = ([at_edge; 2], [at_edge; 2]);
        for side in 0..2 {
            if !nyquist {
                edge[side] = whole(at[side], last * Self::PARTS + Self::PARTS - part, 1);
            }
            if last > 0 {
                next[side] = whole(at[side], Self::PARTS - part, last);
            }
        }
        Self {
            part,
            tile: if Self::TILES > 1 { FIELDS * tile_len } else { 0 },
            ahead: [whole(at[0], part, count), whole(at[1], part, count)],
            mirror: [
                whole(at[0], Self::PARTS - 1 - part, count),
                whole(at[1], Self::PARTS - 1 - part, count),
            ],
            next,
            edge,
        }
    }

    /// Vector `j` of those that are seen.
    #[inline(always)]
    fn read(&self, j: usize) -> Complex<S::F32> {
        let ahead = if M == 1 { self.part < Self::PARTS / 2 } else { j < M / 2 };
        if ahead {
            let (a, b) = (load(self.ahead[0], j, self.tile), load(self.ahead[1], j, self.tile));
            return Complex { re: a.re - b.im, im: a.im + b.re };
        }
        let back = M - 1 - j;
        let here = conjugate(self.mirror, back, self.tile);
        // Of these only lane 0 matters.
        let next = if back == (M / 2).max(1) - 1 {
            conjugate(self.edge, 0, 0)
        } else {
            conjugate(self.next, back, 0)
        };
        Complex { re: here.re.mirrored(next.re), im: here.im.mirrored(next.im) }
    }
}

/// Vector `index`; where it spans two tiles, the second is `tile` numbers after the first.
#[inline(always)]
fn load<S: Simd>(from: Strided<'_, S>, index: usize, tile: usize) -> Complex<S::F32> {
    Complex { re: from.load_halves(index, 0, tile), im: from.load_halves(index, TILE, tile) }
}

/// conj a + i conj b.
#[inline(always)]
fn conjugate<S: Simd>(from: [Strided<'_, S>; 2], index: usize, tile: usize) -> Complex<S::F32> {
    let (a, b) = (load(from[0], index, tile), load(from[1], index, tile));
    Complex { re: a.re + b.im, im: b.re - a.im }
}

/// M points across blocks of sixteen, and the factors between the two transforms.
struct First<'a, S: Simd, const M: usize> {
    from: Pair<'a, S, M>,
    /// Real parts, and after sixteen imaginary ones.
    twiddles: Strided<'a, S>,
    to: StridedMut<'a, S>,
}

impl<S: Simd, const M: usize> Points<S> for First<'_, S, M> {
    #[inline(always)]
    fn read(&self, j: usize) -> Complex<S::F32> {
        self.from.read(j)
    }

    #[inline(always)]
    fn write(&mut self, k: usize, mut value: Complex<S::F32>) {
        if k > 0 {
            let (re, im) = (self.twiddles.load(k), self.twiddles.load_after(k, ROW_RADIX));
            value = value.times(Complex { re, im });
        }
        self.to.store(k, value.re);
        self.to.store_after(k, S::LANES, value.im);
    }
}

/// The first transforms of the row whose fields a and b begin at `at`.
#[inline(always)]
fn first<S: Simd, const M: usize>(
    simd: S,
    from: HalfSpectra<'_>,
    tile_len: usize,
    at: [usize; 2],
    row: &mut [f32],
) {
    const BLOCK: usize = 2 * ROW_RADIX;
    for part in 0..ROW_RADIX / S::LANES {
        let mut points = First {
            from: Pair::<S, M>::new(simd, from.tiles, tile_len, at, part),
            twiddles: Strided::reaching(simd, from.twiddles, part * S::LANES, BLOCK, M, ROW_RADIX),
            to: StridedMut::reaching(simd, row, 2 * S::LANES * part, BLOCK, M, S::LANES),
        };
        transform::<S, M>(simd, &mut points);
    }
}

/// Sixteen points within each block, for as many blocks at a time as a vector has lanes, all of one row.
struct Second<'a, S: Simd> {
    x: [Complex<S::F32>; ROW_RADIX],
    to: StridedMut<'a, S>,
    /// From the real part's row to the imaginary part's.
    im: usize,
}

impl<S: Simd> Points<S> for Second<'_, S> {
    const AT_HAND: bool = true;

    #[inline(always)]
    fn read(&self, n: usize) -> Complex<S::F32> {
        self.x[n]
    }

    #[inline(always)]
    fn write(&mut self, k: usize, value: Complex<S::F32>) {
        self.to.store(k, value.re);
        self.to.store_after(k, self.im, value.im);
    }
}

/// The same where blocks are so few that a vector holds several rows.
struct SecondOfRows<'a, S: Simd, const M: usize> {
    x: [Complex<S::F32>; ROW_RADIX],
    /// Where each row's real and imaginary part begin.
    to: [[usize; 2]; MAX_LANES],
    planes: &'a mut [f32],
}

impl<S: Simd, const M: usize> Points<S> for SecondOfRows<'_, S, M> {
    const AT_HAND: bool = true;

    #[inline(always)]
    fn read(&self, n: usize) -> Complex<S::F32> {
        self.x[n]
    }

    #[inline(always)]
    fn write(&mut self, k: usize, value: Complex<S::F32>) {
        let (mut re, mut im) = ([0.0; MAX_LANES], [0.0; MAX_LANES]);
        value.re.store(&mut re);
        value.im.store(&mut im);
        for r in 0..S::LANES / M {
            let [to_re, to_im] = self.to[r].map(|to| to + M * k);
            self.planes[to_re..to_re + M].copy_from_slice(&re[M * r..M * (r + 1)]);
            self.planes[to_im..to_im + M].copy_from_slice(&im[M * r..M * (r + 1)]);
        }
    }
}

/// The second transforms; `to` says where each row's real and imaginary part begin in `planes`.
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
        if M >= S::LANES {
            let [re, im] = to[0];
            let im = im - re;
            let to = StridedMut::reaching(simd, planes, re + first_block, M, ROW_RADIX, im);
            transform::<S, ROW_RADIX>(simd, &mut Second { x, to, im });
        } else {
            transform::<S, ROW_RADIX>(simd, &mut SecondOfRows::<S, M> { x, to, planes });
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
