//! From half spectra to both maps, some rows at a time: the pass along rows, gradients, packing and mips in one go, so that
//! the planes of displacement never leave the cache.
use super::{
    fft::rows::{self, HalfSpectra, Window},
    foam::{self, FrameFoam},
    gradient::{GradientParams, Rows, Tangents, inverse_sqrt, jacobian_byte, smoothness, square, to_byte},
    mips::{Absorb, BandMaps, CHANNELS, Halved, Pyramid},
    settings::NormalKind,
    simd::{Float, Kernel, MAX_LANES, Simd},
};
use half::f16;
use std::ops::Range;

/// The largest grid that is transformed as a whole before it is shaded: its planes fit the second cache, and no row
/// is transformed twice.
const WHOLE: usize = 64;

/// Rows kept of a larger grid while it is transformed and shaded side by side.
const ROLLING_ROWS: usize = 8;

/// The rows of a grid that are in memory together, on vectors of `lanes` lanes.
#[inline(always)]
pub fn window(n: usize, lanes: usize) -> Window {
    let rows = if n <= WHOLE { n } else { ROLLING_ROWS.max(2 * rows::unit(n, lanes)).min(n) };
    Window { n, rows }
}

/// The least rows of a band: a unit on the widest vectors.
pub fn least_rows(n: usize) -> usize {
    if n <= WHOLE { n } else { rows::unit(n, MAX_LANES) }
}

/// What every band of a cascade has in common.
#[derive(Clone, Copy, Debug)]
pub struct Shading<'a> {
    /// The spectra, columns transformed.
    pub half: HalfSpectra<'a>,
    /// How gradients are taken.
    pub gradient: GradientParams,
    /// Share of the compression that becomes foam.
    pub breaking: f32,
}

/// What one job works with.
#[derive(Debug)]
pub struct Working<'a> {
    /// Planes of the [`Window`].
    pub planes: &'a mut [f32],
    /// [`rows::scratch_len`].
    pub rows: &'a mut [f32],
    /// [`Pyramid::scratch_len`].
    pub kept: &'a mut [f32],
}

/// Fills a band of the maps of a frame. N = `R1` x `R2` = 16 x `M`.
pub struct Frame<'a, 'm, const R1: usize, const R2: usize, const M: usize> {
    /// What bands have in common.
    pub shading: Shading<'a>,
    /// The band: from an even row, a power of two of them, at least a unit.
    pub range: Range<usize>,
    /// Its share of the maps.
    pub maps: &'a mut BandMaps<'m>,
    /// Its share of full-precision planes h, Du, Dv, where they are wanted.
    pub planes: Option<[&'a mut [f32]; 3]>,
    /// Its share of the foam's memory, and how it is read.
    pub memory: &'a mut [f32],
    /// `None` without memory.
    pub foam: Option<FrameFoam>,
    /// Where the band's row of its top level goes, see [`top_level`].
    pub top: &'a mut [f32],
    /// Working space.
    pub working: Working<'a>,
}

/// The highest level that a band of `rows` rows fills by itself: the one of which it has one row.
pub const fn top_level(rows: usize) -> usize {
    rows.ilog2() as usize
}

impl<const R1: usize, const R2: usize, const M: usize> Kernel for Frame<'_, '_, R1, R2, M> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) {
        let range = self.range.clone();
        // Made here, where its numbers are known to the compiler.
        let (shading, window) = (self.shading, window(R1 * R2, S::LANES));
        let pyramid = Pyramid::new(R1 * R2, &shading.gradient);
        let top = top_level(range.len());
        let mut steps = Steps::new(range.clone(), R1 * R2, rows::unit(R1 * R2, S::LANES), window);
        while let Some(step) = steps.next() {
            match step {
                Step::Transform(v) => transform::<S, R1, R2, M>(simd, &shading, window, v, &mut self.working),
                Step::Shade(v) => {
                    // A pair of the longest vectors may be longer than a row.
                    if R1 * R2 < 2 * <S::Wide as Simd>::LANES {
                        self.shade(simd, window, pyramid, v);
                    } else {
                        self.shade(simd.wide(), window, pyramid, v);
                    }
                    if v & 1 == 1 {
                        let row = (v - range.start) / 2;
                        let (kept, maps) = (&mut *self.working.kept, &mut *self.maps);
                        simd.wide().run(Absorb { pyramid, level: 1, row, top, kept, maps });
                    }
                }
            }
        }
        let row = pyramid.top(top, self.working.kept);
        self.top[..row.len()].copy_from_slice(row);
    }
}

/// One unit of rows, into the window.
#[inline(always)]
fn transform<S: Simd, const R1: usize, const R2: usize, const M: usize>(
    simd: S,
    shading: &Shading<'_>,
    window: Window,
    v: usize,
    working: &mut Working<'_>,
) {
    let (planes, scratch) = (&mut *working.planes, &mut *working.rows);
    simd.run(rows::Rows::<R1, R2, M> { from: shading.half, v, window, planes, scratch });
    for row in v..v + rows::unit(R1 * R2, S::LANES) {
        window.wrap(working.planes, row);
    }
}

/// What is the same for all texels, in registers.
#[derive(Clone, Copy)]
struct Constants<V> {
    /// What u grows by between two neighbours of a texel, metres.
    width: V,
    /// Turns areas into 127.5 J.
    byte_scale: V,
    /// Turns areas into `breaking` J.
    breaking_scale: V,
    /// The last byte of a normal that has not been averaged.
    smoothness: V,
    breaking: V,
    lost: V,
}

impl<V: Float> Constants<V> {
    #[inline(always)]
    fn new<S: Simd<F32 = V>>(simd: S, shading: &Shading<'_>, foam: Option<FrameFoam>) -> Self {
        let unit = shading.gradient.per_difference * shading.gradient.per_difference;
        Self {
            width: simd.splat(1.0 / shading.gradient.per_difference),
            byte_scale: simd.splat(127.5 * unit),
            breaking_scale: simd.splat(shading.breaking * unit),
            smoothness: smoothness(simd, [simd.splat(shading.gradient.normal_length); 2])[0],
            breaking: simd.splat(shading.breaking),
            lost: simd.splat(foam.map_or(0.0, |foam| foam.lost)),
        }
    }
}

impl<const R1: usize, const R2: usize, const M: usize> Frame<'_, '_, R1, R2, M> {
    /// Level 0 of row `v`, and its share of level 1 into that row's slot.
    #[inline(always)]
    fn shade<S: Simd>(&mut self, simd: S, window: Window, pyramid: Pyramid, v: usize) {
        let n = R1 * R2;
        let constants = Constants::new(simd, &self.shading, self.foam);
        let at = (v - self.range.start) * n;
        let rows = Rows::new(simd, window, self.working.planes, v);
        let remembered = &mut self.memory[at..][..n];
        let mut out = TexelRow {
            displacement: &mut self.maps.displacement[0][at..][..n],
            gradient: &mut self.maps.gradient[0][at..][..n],
            // Compressions are not negative: a memory of nothing adds nothing.
            memory: if self.foam.is_some() { remembered } else { &NOTHING[..n] },
            halved: pyramid.first_level(simd, v - self.range.start, self.working.kept),
        };
        // No branches within: they would tear apart what goes side by side.
        match self.shading.gradient.normals {
            NormalKind::Exact => out.fill::<false>(simd, constants, &rows),
            NormalKind::Sheet => out.fill::<true>(simd, constants, &rows),
        }
        if self.foam.is_some_and(|foam| foam.keep) {
            remember(simd, &rows, constants, remembered);
        }
        if let Some(planes) = &mut self.planes {
            for (field, plane) in planes.iter_mut().enumerate() {
                let from = &self.working.planes[window.row(field, v)..][..n];
                plane[at..][..n].copy_from_slice(from);
            }
        }
    }
}

/// A row of memory without foam.
static NOTHING: [f32; 512] = [0.0; 512];

/// Where a row of level 0 goes.
struct TexelRow<'a, S> {
    displacement: &'a mut [[f16; 4]],
    gradient: &'a mut [[u8; 4]],
    memory: &'a [f32],
    halved: Halved<'a, S>,
}

impl<S: Simd> TexelRow<'_, S> {
    #[inline(always)]
    fn fill<const SHEET: bool>(&mut self, simd: S, constants: Constants<S::F32>, rows: &Rows<'_, S>) {
        for pair in 0..rows.vectors() / 2 {
            let left = Tangents::new(rows, 2 * pair, constants.width);
            let right = Tangents::new(rows, 2 * pair + 1, constants.width);
            let normals = [left.normal::<SHEET>(constants.width), right.normal::<SHEET>(constants.width)];
            let inverse = inverse_sqrt(simd, [square(normals[0]), square(normals[1])]);
            let areas = [left.area, right.area];
            let mut texels = [[simd.splat(0.0); CHANNELS]; 2];
            for side in 0..2 {
                let [x, y, z] = normals[side];
                let [x, y, z] = [x * inverse[side], y * inverse[side], z * inverse[side]];
                let (vector, area) = (2 * pair + side, areas[side]);
                let column = vector * S::LANES;
                let j_byte = jacobian_byte(simd, area, constants.byte_scale);
                let bytes = [to_byte(simd, x), to_byte(simd, z), j_byte, constants.smoothness];
                S::F32::store_bytes(bytes, &mut self.gradient[column..]);

                let now = foam::compression(simd, area, constants.breaking_scale, constants.breaking);
                let compression = foam::fade(simd.load(&self.memory[column..]), constants.lost, now);
                let (height, du, dv) = (rows.value(0, vector), rows.value(1, vector), rows.value(2, vector));
                S::F32::store_halves([du, height, dv, compression], &mut self.displacement[column..]);
                texels[side] = [x, y, z, area, du, height, dv, compression];
            }
            self.halved.add(simd, pair, texels[0], texels[1]);
        }
    }
}

/// A tick of the memory of one row.
#[inline(always)]
fn remember<S: Simd>(simd: S, rows: &Rows<'_, S>, constants: Constants<S::F32>, memory: &mut [f32]) {
    for vector in 0..rows.vectors() {
        let tangents = Tangents::new(rows, vector, constants.width);
        let (scale, breaking) = (constants.breaking_scale, constants.breaking);
        let now = foam::compression(simd, tangents.area, scale, breaking);
        let memory = &mut memory[vector * S::LANES..];
        foam::fade(simd.load(memory), constants.lost, now).store(memory);
    }
}

/// One tick of the foam's memory over a band. N = `R1` x `R2` = 16 x `M`.
pub struct Tick<'a, const R1: usize, const R2: usize, const M: usize> {
    /// What bands have in common.
    pub shading: Shading<'a>,
    /// The band, as [`Frame::range`].
    pub range: Range<usize>,
    /// Its share of the foam's memory.
    pub memory: &'a mut [f32],
    /// Compression forgotten in a tick.
    pub decay: f32,
    /// Working space.
    pub working: Working<'a>,
}

impl<const R1: usize, const R2: usize, const M: usize> Kernel for Tick<'_, R1, R2, M> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) {
        let n = R1 * R2;
        let window = window(n, S::LANES);
        let foam = FrameFoam { lost: self.decay, keep: true };
        let constants = Constants::new(simd, &self.shading, Some(foam));
        let mut steps = Steps::new(self.range.clone(), n, rows::unit(n, S::LANES), window);
        while let Some(step) = steps.next() {
            match step {
                Step::Transform(v) => {
                    transform::<S, R1, R2, M>(simd, &self.shading, window, v, &mut self.working)
                }
                Step::Shade(v) => {
                    let rows = Rows::new(simd, window, self.working.planes, v);
                    let memory = &mut self.memory[(v - self.range.start) * n..][..n];
                    remember(simd, &rows, constants, memory);
                }
            }
        }
    }
}

/// What a band does next.
enum Step {
    /// Transform the unit of rows that begins here.
    Transform(usize),
    /// Shade this row.
    Shade(usize),
}

/// The order of work in a band: a row is shaded as soon as its neighbours are in the window.
struct Steps {
    n: usize,
    unit: usize,
    range: Range<usize>,
    /// Rows that are there: as if the patch went on beyond its edges, N added so that none is negative.
    ready: usize,
    /// Whether all rows of the grid are in the window, so that none is transformed twice.
    whole: bool,
    shaded: usize,
}

impl Steps {
    fn new(range: Range<usize>, n: usize, unit: usize, window: Window) -> Self {
        let whole = window.rows == n && range.len() == n;
        // Without the row above its first, nothing can be shaded.
        let ready = if whole { n } else { n + range.start - unit };
        Self { n, unit, ready, whole, shaded: range.start, range }
    }

    fn next(&mut self) -> Option<Step> {
        if self.shaded == self.range.end {
            return None;
        }
        let wanted = if self.whole { 2 * self.n } else { self.n + self.shaded + 2 };
        if self.ready < wanted {
            let v = self.ready % self.n;
            self.ready += self.unit;
            return Some(Step::Transform(v));
        }
        let v = self.shaded;
        self.shaded += 1;
        Some(Step::Shade(v))
    }
}
