//! Newton's method in singles: from the sea at rest to where [`super::newton`] has little left to do.
//!
//! Nothing here is believed, only tried, so it needs no doubles, no test whether a point is there and no second reading of
//! what is the same. Products are rounded before they are added, so all instruction sets come to the same place.
use super::{Frame, Query, grid::Grid, newton::NEARLY_FOLDED};
use crate::sea::{
    settings::MAX_CASCADES,
    simd::{Float, MAX_LANES, Simd},
};

/// 1.5 * 2^23: what 1.5 * 2^52 is to doubles in [`Grid::cell`].
const ROUND: f32 = 12_582_912.0;
/// The longest step, texels of the first cascade along an axis: what is farther is found by nobody near.
const LONGEST: f32 = 64.0;

/// Where points probably rest.
#[derive(Debug)]
#[repr(align(64))]
pub struct Approach<const P: usize> {
    starts: [Start<P>; MAX_CASCADES],
    /// q - target, in texels of the first cascade, along its axes; some number where the target is none.
    offsets: [[f32; P]; 2],
}

/// Where the targets are in a cascade.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Start<const P: usize> {
    column: [u32; P],
    row: [u32; P],
    /// (s, t), 0..=1.
    fraction: [[f32; P]; 2],
}

impl<const P: usize> Approach<P> {
    /// Nobody looked for yet.
    pub fn new() -> Self {
        let nowhere = Start { column: [0; P], row: [0; P], fraction: [[0.0; P]; 2] };
        Self { starts: [nowhere; MAX_CASCADES], offsets: [[0.0; P]; 2] }
    }

    /// Approaches `targets`, in texels along u and v of each cascade.
    #[inline(always)]
    pub fn run<S: Simd>(
        &mut self,
        simd: S,
        query: &Query<'_>,
        targets: [&[[f64; P]; 2]; MAX_CASCADES],
    ) -> &[[f32; P]; 2] {
        for ((grid, start), target) in query.grids().iter().zip(&mut self.starts).zip(targets) {
            start.set(grid, target);
        }
        let simd = simd.wide();
        self.offsets = [[0.0; P]; 2];
        // Look by look, so that vectors that wait for nothing stand next to each other.
        for _ in 0..looks(query.count) {
            for first in (0..P).step_by(S::Wide::LANES) {
                let [u, v] = &mut self.offsets;
                let offset = [simd.load(&u[first..]), simd.load(&v[first..])];
                let mut points = Points { simd, query, starts: &self.starts, first, offset };
                points.step();
                points.offset[0].store(&mut u[first..]);
                points.offset[1].store(&mut v[first..]);
            }
        }
        &self.offsets
    }
}

impl<const P: usize> Start<P> {
    #[inline(always)]
    fn set(&mut self, grid: &Grid<'_>, [u, v]: &[[f64; P]; 2]) {
        for i in 0..P {
            let ((column, s), (row, t)) = (grid.cell(u[i]), grid.cell(v[i]));
            (self.column[i], self.row[i]) = (column as u32, row as u32);
            (self.fraction[0][i], self.fraction[1][i]) = (s as f32, t as f32);
        }
    }
}

/// As many points as a vector has lanes.
struct Points<'p, 'a, S: Simd, const P: usize> {
    simd: S,
    query: &'p Query<'a>,
    starts: &'p [Start<P>; MAX_CASCADES],
    first: usize,
    offset: [S::F32; 2],
}

/// Looks at the maps that are taken: most points are then so near that one more, in doubles, settles them. Several
/// cascades are rougher than one.
pub const fn looks(cascades: usize) -> u32 {
    if cascades == 1 { 3 } else { 4 }
}

/// The sum q - target + D(q) and its derivatives (du/du, du/dv, dv/du, dv/dv), as in [`super::newton`].
struct Sum<V> {
    miss: [V; 2],
    slope: [V; 4],
}

impl<S: Simd, const P: usize> Points<'_, '_, S, P> {
    #[inline(always)]
    fn step(&mut self) {
        let simd = self.simd;
        let spacing = 1.0 / self.query.first().per_metre as f32;
        let folded = simd.splat(NEARLY_FOLDED as f32 * spacing * spacing);
        let (longest, shortest) = (simd.splat(LONGEST), simd.splat(-LONGEST));
        let Sum { miss: [u, v], slope: [uu, uv, vu, vv] } = self.sum(spacing);
        let determinant = (uu * vv - uv * vu).max(folded);
        let share = simd.splat(1.0) / determinant;
        let newton_u = (vv * u - uv * v) * share;
        let newton_v = (uu * v - vu * u) * share;
        self.offset[0] = self.offset[0] - newton_u.min(longest).max(shortest);
        self.offset[1] = self.offset[1] - newton_v.min(longest).max(shortest);
    }

    #[inline(always)]
    fn sum(&self, spacing: f32) -> Sum<S::F32> {
        let simd = self.simd;
        let own = simd.splat(spacing);
        let mut sum = look(simd, self.query.first(), &self.starts[0], self.first, self.offset);
        sum.miss[0] = sum.miss[0] + self.offset[0] * own;
        sum.miss[1] = sum.miss[1] + self.offset[1] * own;
        sum.slope[0] = sum.slope[0] + own;
        sum.slope[3] = sum.slope[3] + own;
        for ((grid, frame), start) in self.query.others().zip(&self.starts[1..]) {
            self.add(&mut sum, grid, frame, start);
        }
        sum
    }

    /// Adds a cascade that may be turned and scaled against the first.
    #[inline(always)]
    fn add(&self, sum: &mut Sum<S::F32>, grid: &Grid<'_>, frame: &Frame, start: &Start<P>) {
        let simd = self.simd;
        let [c, s] = [simd.splat(frame.follow[0] as f32), simd.splat(frame.follow[1] as f32)];
        let [u, v] = self.offset;
        let Sum { miss, slope: [uu, uv, vu, vv] } =
            look(simd, grid, start, self.first, [u * c - v * s, u * s + v * c]);
        let [turn_c, turn_s] = [simd.splat(frame.turn[0] as f32), simd.splat(frame.turn[1] as f32)];
        sum.miss[0] = sum.miss[0] + (miss[0] * turn_c + miss[1] * turn_s);
        sum.miss[1] = sum.miss[1] + (miss[1] * turn_c - miss[0] * turn_s);
        let [u_u, v_u] = [uu * turn_c + vu * turn_s, vu * turn_c - uu * turn_s];
        let [u_v, v_v] = [uv * turn_c + vv * turn_s, vv * turn_c - uv * turn_s];
        sum.slope[0] = sum.slope[0] + (u_u * c + u_v * s);
        sum.slope[1] = sum.slope[1] + (u_v * c - u_u * s);
        sum.slope[2] = sum.slope[2] + (v_u * c + v_v * s);
        sum.slope[3] = sum.slope[3] + (v_v * c - v_u * s);
    }
}

/// D and its derivatives `offset` texels from the targets.
#[inline(always)]
fn look<S: Simd, const P: usize>(
    simd: S,
    grid: &Grid<'_>,
    start: &Start<P>,
    first: usize,
    [u, v]: [S::F32; 2],
) -> Sum<S::F32> {
    let (columns, s) = cells(simd, &start.column[first..], u + simd.load(&start.fraction[0][first..]));
    let (rows, t) = cells(simd, &start.row[first..], v + simd.load(&start.fraction[1][first..]));
    let [[au, _, av], [bu, _, bv], [cu, _, cv], [du, _, dv]] = grid.corners(simd, &columns, &rows);
    // a + b s + c t + e s t, and its derivatives.
    let (bu, cu, eu) = (bu - au, cu - au, (du - cu) - (bu - au));
    let (bv, cv, ev) = (bv - av, cv - av, (dv - cv) - (bv - av));
    let (uu, vu) = (bu + eu * t, bv + ev * t);
    Sum { miss: [au + cu * t + uu * s, av + cv * t + vu * s], slope: [uu, cu + eu * s, vu, cv + ev * s] }
}

/// The columns or rows that are `along` from `start`, modulo any power of two up to 2^22, and where in them, 0..=1.
#[inline(always)]
fn cells<S: Simd>(simd: S, start: &[u32], along: S::F32) -> ([u32; MAX_LANES], S::F32) {
    let nearest = (along - simd.splat(0.5)) + simd.splat(ROUND);
    let mut sums = [0.0_f32; MAX_LANES];
    nearest.store(&mut sums);
    let mut cells = [0; MAX_LANES];
    let start = &start[..S::LANES];
    for l in 0..S::LANES {
        cells[l] = start[l].wrapping_add(sums[l].to_bits());
    }
    (cells, along - (nearest - simd.splat(ROUND)))
}
