//! Newton's method for several points side by side.
//!
//! A point's steps depend on each other, so that alone it would wait for every one of them; with lanes in arrays the
//! compiler fills vectors. No lane sees another: an answer has the same bits whatever is asked beside it.
#![expect(clippy::needless_range_loop, reason = "a lane is one index into many arrays")]
use super::{
    Query, TOLERANCE,
    grid::{Grid, single},
};
use crate::sea::settings::MAX_CASCADES;

/// Points side by side. Fewer leave vectors and waiting times empty; with 16 the compiler no longer uses vectors.
pub const LANES: usize = 8;
/// Most steps. Points that need more are searched for.
const STEPS: u32 = 12;
/// Determinant of q + D(q) below which its slope says nothing.
const NEARLY_FOLDED: f64 = 0.05;

/// Where the lanes are in a cascade, and the bilinear field there: a + b s + c t + e s t.
#[derive(Clone, Copy, Debug)]
struct Cells<const L: usize> {
    /// The targets, in texels along u and v.
    target: [[f64; L]; 2],
    column: [u64; L],
    row: [u64; L],
    /// (s, t), 0..=1.
    fraction: [[f64; L]; 2],
    /// The corners' texels, as [`Grid::bits`] and in its order.
    corners: [[u64; L]; 4],
    /// (a, b, c, e) of the displacement along u, metres.
    u: [[f32; L]; 4],
    /// The same along v.
    v: [[f32; L]; 4],
}

/// The sum q - target + D(q), and its derivatives along q. Lengths are metres along the axes of the first cascade, and
/// q is in its texels.
#[derive(Debug)]
struct Sum<const L: usize> {
    miss: [[f64; L]; 2],
    /// (du/du, du/dv, dv/du, dv/dv). A step needs no more than singles: it is tried, and not believed.
    slope: [[f32; L]; 4],
}

/// `L` points that are looked for.
#[derive(Debug)]
pub struct Newton<'q, 'a, const L: usize> {
    query: &'q Query<'a>,
    cells: [Cells<L>; MAX_CASCADES],
    /// q - target, in texels of the first cascade, along its axes.
    offset: [[f64; L]; 2],
    /// Square of what is missing, square metres.
    miss: [f64; L],
    /// Steps taken.
    steps: [f32; L],
}

impl<'q, 'a, const L: usize> Newton<'q, 'a, L> {
    pub fn new(query: &'q Query<'a>) -> Self {
        let nowhere = Cells {
            target: [[0.0; L]; 2],
            column: [0; L],
            row: [0; L],
            fraction: [[0.0; L]; 2],
            corners: [[0; L]; 4],
            u: [[0.0; L]; 4],
            v: [[0.0; L]; 4],
        };
        Self { query, cells: [nowhere; MAX_CASCADES], offset: [[0.0; L]; 2], miss: [0.0; L], steps: [0.0; L] }
    }

    /// Looks for the points above `targets`: world x of all, world z of all.
    #[inline(always)]
    pub fn solve(&mut self, [x, z]: &[[f64; L]; 2]) {
        for (grid, cells) in self.query.grids().iter().zip(&mut self.cells) {
            for l in 0..L {
                [cells.target[0][l], cells.target[1][l]] = grid.along([x[l], z[l]]);
            }
            // No such column: the first look is always a new one.
            cells.column = [u64::MAX; L];
        }
        self.offset = [[0.0; L]; 2];
        self.steps = [0.0; L];
        for _ in 0..STEPS {
            if self.step() {
                break;
            }
        }
    }

    /// Looks where the lanes are, and takes a step with those that are not there yet; whether none is left.
    #[inline(always)]
    fn step(&mut self) -> bool {
        let spacing = 1.0 / self.query.first().per_metre;
        let folded = (NEARLY_FOLDED * spacing * spacing) as f32;
        let per_metre = self.query.first().per_metre as f32;
        let Sum { miss: [u, v], slope: [uu, uv, vu, vv] } = self.sum(spacing);
        let mut step = [[0.0_f32; L]; 2];
        let mut open = 0;
        for l in 0..L {
            self.miss[l] = u[l] * u[l] + v[l] * v[l];
            let more: f32 = if self.miss[l] > TOLERANCE * TOLERANCE { 1.0 } else { 0.0 };
            let (miss_u, miss_v) = (u[l] as f32, v[l] as f32);
            let determinant = uu[l] * vv[l] - uv[l] * vu[l];
            let share = more / determinant;
            let newton_u = (vv[l] * miss_u - uv[l] * miss_v) * share;
            let newton_v = (uu[l] * miss_v - vu[l] * miss_u) * share;
            let nearly_folded = determinant.abs() < folded;
            step[0][l] = if nearly_folded { miss_u * more * per_metre } else { newton_u };
            step[1][l] = if nearly_folded { miss_v * more * per_metre } else { newton_v };
            self.steps[l] += more;
            open |= more.to_bits();
        }
        for (offset, step) in self.offset.iter_mut().zip(&step) {
            for l in 0..L {
                offset[l] -= f64::from(step[l]);
            }
        }
        open == 0
    }

    #[inline(always)]
    fn sum(&mut self, spacing: f64) -> Sum<L> {
        let mut sum = Sum { miss: [[0.0; L]; 2], slope: [[0.0; L]; 4] };
        let offset = &self.offset;
        let (first, others) = self.cells.split_at_mut(1);
        for (grid, cells) in self.query.grids().iter().zip(first) {
            cells.look(grid, offset);
            let [u, v] = cells.displacement();
            let [uu, uv, vu, vv] = cells.slope();
            let own = spacing as f32;
            for l in 0..L {
                sum.miss[0][l] = u[l] + offset[0][l] * spacing;
                sum.miss[1][l] = v[l] + offset[1][l] * spacing;
                sum.slope[0][l] = uu[l] + own;
                sum.slope[1][l] = uv[l];
                sum.slope[2][l] = vu[l];
                sum.slope[3][l] = vv[l] + own;
            }
        }
        for ((grid, frame), cells) in self.query.others().zip(others) {
            let [c, s] = frame.follow;
            let mut turned = [[0.0; L]; 2];
            for l in 0..L {
                turned[0][l] = offset[0][l] * c - offset[1][l] * s;
                turned[1][l] = offset[0][l] * s + offset[1][l] * c;
            }
            cells.look(grid, &turned);
            let [u, v] = cells.displacement();
            let [c, s] = frame.turn;
            for l in 0..L {
                sum.miss[0][l] += u[l] * c + v[l] * s;
                sum.miss[1][l] += v[l] * c - u[l] * s;
            }
            let [uu, uv, vu, vv] = cells.slope();
            let [c, s] = frame.turn.map(|part| part as f32);
            let [follow_c, follow_s] = frame.follow.map(|part| part as f32);
            for l in 0..L {
                let [u_u, v_u] = [uu[l] * c + vu[l] * s, vu[l] * c - uu[l] * s];
                let [u_v, v_v] = [uv[l] * c + vv[l] * s, vv[l] * c - uv[l] * s];
                sum.slope[0][l] += u_u * follow_c + u_v * follow_s;
                sum.slope[1][l] += u_v * follow_c - u_u * follow_s;
                sum.slope[2][l] += v_u * follow_c + v_v * follow_s;
                sum.slope[3][l] += v_v * follow_c - v_u * follow_s;
            }
        }
        sum
    }

    /// Whether a lane has found its point, to [`TOLERANCE`].
    #[inline(always)]
    pub fn found(&self, lane: usize) -> bool {
        self.miss[lane] <= TOLERANCE * TOLERANCE
    }

    /// Looks a lane has taken.
    pub fn iterations(&self, lane: usize) -> u32 {
        1 + self.steps[lane] as u32
    }

    /// Where a lane's point rests, less its target: world (x, z), metres.
    pub fn offset(&self, lane: usize) -> [f64; 2] {
        let first = self.query.first();
        let ([u, v], [cos, sin]) = (self.offset.map(|offset| offset[lane] / first.per_metre), first.turn);
        [u * cos + v * sin, v * cos - u * sin]
    }

    /// Heights of the lanes' points, metres.
    #[inline(always)]
    pub fn heights(&self) -> [f64; L] {
        let mut heights = [0.0; L];
        for cells in &self.cells[..self.query.grids().len()] {
            for l in 0..L {
                let [a, b, c, d] = [0, 1, 2, 3].map(|corner| single((cells.corners[corner][l] as u32) >> 16));
                let [s, t] = [cells.fraction[0][l], cells.fraction[1][l]];
                let [a, b, c, e] = [a, b - a, c - a, (d - c) - (b - a)].map(f64::from);
                heights[l] += a + c * t + (b + e * t) * s;
            }
        }
        heights
    }
}

impl<const L: usize> Cells<L> {
    /// Goes to `offset` texels from the targets, and reads the corners there where any lane is in a new cell.
    #[inline(always)]
    fn look(&mut self, grid: &Grid<'_>, offset: &[[f64; L]; 2]) {
        let mut moved = 0;
        for l in 0..L {
            let (column, s) = grid.cell(self.target[0][l] + offset[0][l]);
            let (row, t) = grid.cell(self.target[1][l] + offset[1][l]);
            moved |= (column ^ self.column[l]) | (row ^ self.row[l]);
            (self.column[l], self.row[l]) = (column, row);
            (self.fraction[0][l], self.fraction[1][l]) = (s, t);
        }
        if moved != 0 {
            self.read(grid);
        }
    }

    #[inline(always)]
    fn read(&mut self, grid: &Grid<'_>) {
        let mut at = [[0; L]; 4];
        for l in 0..L {
            [at[0][l], at[1][l], at[2][l], at[3][l]] = grid.corners(self.column[l], self.row[l]);
        }
        for (corner, at) in self.corners.iter_mut().zip(&at) {
            for l in 0..L {
                corner[l] = grid.bits(at[l]);
            }
        }
        let corners = &self.corners;
        field(&mut self.u, |corner, l| single(corners[corner][l] as u32));
        field(&mut self.v, |corner, l| single((corners[corner][l] >> 32) as u32));
    }

    /// Along u and v, metres.
    #[inline(always)]
    fn displacement(&self) -> [[f64; L]; 2] {
        let mut parts = [[0.0; L]; 2];
        for (part, field) in parts.iter_mut().zip([&self.u, &self.v]) {
            for l in 0..L {
                let [a, b, c, e] = [field[0][l], field[1][l], field[2][l], field[3][l]].map(f64::from);
                let [s, t] = [self.fraction[0][l], self.fraction[1][l]];
                part[l] = a + c * t + (b + e * t) * s;
            }
        }
        parts
    }

    /// (du/du, du/dv, dv/du, dv/dv), metres a texel.
    #[inline(always)]
    fn slope(&self) -> [[f32; L]; 4] {
        let mut slope = [[0.0; L]; 4];
        for l in 0..L {
            let [s, t] = [self.fraction[0][l] as f32, self.fraction[1][l] as f32];
            slope[0][l] = self.u[1][l] + self.u[3][l] * t;
            slope[1][l] = self.u[2][l] + self.u[3][l] * s;
            slope[2][l] = self.v[1][l] + self.v[3][l] * t;
            slope[3][l] = self.v[2][l] + self.v[3][l] * s;
        }
        slope
    }
}

/// The bilinear field through the corners' values. Differences of neighbouring halves fit into singles.
#[inline(always)]
fn field<const L: usize>(field: &mut [[f32; L]; 4], value: impl Fn(usize, usize) -> f32) {
    for l in 0..L {
        let [a, b, c, d] = [0, 1, 2, 3].map(|corner| value(corner, l));
        [field[0][l], field[1][l], field[2][l], field[3][l]] = [a, b - a, c - a, (d - c) - (b - a)];
    }
}
