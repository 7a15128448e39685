//! From half spectra to both maps, some rows at a time: the pass along rows, gradients, packing and mips in one go, so that
//! the planes of displacement never leave the cache.
use super::{
    fft::rows::{self, HalfSpectra, Window},
    foam::FrameFoam,
    gradient::{GradientParams, Rows},
    mips::{Absorb, BandMaps, Pyramid},
    settings::NormalKind,
    shade::{self, Constants, TexelRow, remember},
    simd::{Kernel, MAX_LANES, Simd},
};
use std::ops::Range;

/// The largest grid that is transformed as a whole before it is shaded: its planes fit the second cache, and no row
/// is transformed twice.
const WHOLE: usize = 64;

/// Rows kept of a larger grid while it is transformed and shaded side by side: two that are shaded, their neighbours, and
/// the rest of the last one's unit.
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
        let pyramid = &Pyramid::of(R1 * R2, &shading.gradient);
        let top = top_level(range.len());
        let mut steps = Steps::new(range.clone(), R1 * R2, rows::unit(R1 * R2, S::LANES), window);
        while let Some(step) = steps.next() {
            match step {
                Step::Transform(rows) => {
                    transform::<S, R1, R2, M>(simd, &shading, window, rows, &mut self.working)
                }
                Step::Shade(v) => {
                    // A pair of the longest vectors may be longer than a row.
                    if R1 * R2 < 2 * <S::Wide as Simd>::LANES {
                        self.shade(simd, window, pyramid, v);
                    } else {
                        self.shade(simd.wide(), window, pyramid, v);
                    }
                    let row = (v - range.start) / 2;
                    let (kept, maps) = (&mut *self.working.kept, &mut *self.maps);
                    simd.wide().run(Absorb { pyramid, level: 1, row, top, kept, maps });
                }
            }
        }
        pyramid.copy_top(top, self.working.kept, self.top);
    }
}

/// Some rows, into the window.
#[inline(always)]
fn transform<S: Simd, const R1: usize, const R2: usize, const M: usize>(
    simd: S,
    shading: &Shading<'_>,
    window: Window,
    rows: Range<usize>,
    working: &mut Working<'_>,
) {
    let (planes, scratch) = (&mut *working.planes, &mut *working.rows);
    simd.run(rows::Rows::<R1, R2, M> { from: shading.half, rows: rows.clone(), window, planes, scratch });
    for row in rows {
        window.wrap(working.planes, row);
    }
}

impl<const R1: usize, const R2: usize, const M: usize> Frame<'_, '_, R1, R2, M> {
    /// Level 0 of the rows `v` and `v` + 1, and what they become on level 1.
    #[inline(always)]
    fn shade<S: Simd>(&mut self, simd: S, window: Window, pyramid: &Pyramid, v: usize) {
        let n = R1 * R2;
        let constants = Constants::new(simd, &self.shading, self.foam);
        let upper = Rows::new(simd, window, self.working.planes, v);
        let lower = Rows::new(simd, window, self.working.planes, v + 1);
        let rows = [upper, lower];
        let at = (v - self.range.start) * n..(v + 2 - self.range.start) * n;
        let remembered = &mut self.memory[at.clone()];
        // Compressions are not negative: a memory of nothing adds nothing.
        let memory = if self.foam.is_some() { &*remembered } else { &NOTHING[..2 * n] };
        let displacement = self.maps.displacement[0][at.clone()].split_at_mut(n);
        let gradient = self.maps.gradient[0][at.clone()].split_at_mut(n);
        let out = [
            TexelRow { displacement: displacement.0, gradient: gradient.0, memory: &memory[..n] },
            TexelRow { displacement: displacement.1, gradient: gradient.1, memory: &memory[n..] },
        ];
        let (scratch, level_1) = pyramid.level_1(simd, (v - self.range.start) / 2, self.working.kept);
        // No branches within: they would tear apart what goes side by side.
        match self.shading.gradient.normals {
            NormalKind::Exact => {
                shade::shade::<S, false>(simd, n, constants, rows, out, scratch, level_1);
            }
            NormalKind::Sheet => {
                shade::shade::<S, true>(simd, n, constants, rows, out, scratch, level_1);
            }
        }
        if self.foam.is_some_and(|foam| foam.keep) {
            let memory = remembered.split_at_mut(n);
            remember(simd, upper, constants, memory.0);
            remember(simd, lower, constants, memory.1);
        }
        if let Some(planes) = &mut self.planes {
            for (field, plane) in planes.iter_mut().enumerate() {
                for (to, v) in plane[at.clone()].chunks_exact_mut(n).zip(v..) {
                    to.copy_from_slice(&self.working.planes[window.row(field, v)..][..n]);
                }
            }
        }
    }
}

/// Two rows of memory without foam.
static NOTHING: [f32; 2 * 512] = [0.0; 2 * 512];

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
                Step::Transform(rows) => {
                    transform::<S, R1, R2, M>(simd, &self.shading, window, rows, &mut self.working)
                }
                Step::Shade(v) => {
                    for v in [v, v + 1] {
                        let rows = Rows::new(simd, window, self.working.planes, v);
                        let memory = &mut self.memory[(v - self.range.start) * n..][..n];
                        remember(simd, rows, constants, memory);
                    }
                }
            }
        }
    }
}

/// What a band does next.
enum Step {
    /// Transform these rows: a unit, or all.
    Transform(Range<usize>),
    /// Shade this even row and the next.
    Shade(usize),
}

/// The order of work in a band: two rows are shaded as soon as their neighbours are in the window.
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
        let wanted = if self.whole { 2 * self.n } else { self.n + self.shaded + 3 };
        if self.ready < wanted {
            let v = self.ready % self.n;
            let count = if self.whole { self.n } else { self.unit };
            self.ready += count;
            return Some(Step::Transform(v..v + count));
        }
        let v = self.shaded;
        self.shaded += 2;
        Some(Step::Shade(v))
    }
}
