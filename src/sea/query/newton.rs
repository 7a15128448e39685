//! Newton's method for a block of points side by side: what [`super::approach`] has come near to is found, and known to be
//! found.
//!
//! Every pass is a loop over arrays, long enough for the compiler to make vectors of it. No point sees another: an answer
//! has the same bits whatever is asked beside it. No product is fused with a sum: it has them on every instruction set.
#![expect(clippy::needless_range_loop, reason = "a point is one index into many arrays")]
use super::{
    Frame, Query, TOLERANCE,
    approach::{Approach, looks},
    grid::Grid,
};
use crate::sea::{
    settings::MAX_CASCADES,
    simd::{Float, Kernel, Simd},
};

/// Determinant of q + D(q), for a spacing of 1, below which its slope says nothing.
pub const NEARLY_FOLDED: f64 = 0.05;
/// Looks in doubles. A point that needs more is searched for.
const DOUBLES: u32 = 2;

/// `P` points that are looked for; a multiple of [`crate::sea::simd::MAX_LANES`].
///
/// Its arrays and those of its parts begin at cache lines: where vectors lie across them a query takes 7 % longer.
#[derive(Debug)]
#[repr(C, align(64))]
pub struct Block<'q, 'a, const P: usize> {
    approach: Approach<P>,
    cells: [Cells<P>; MAX_CASCADES],
    /// q - target, in texels of the first cascade, along its axes.
    offset: [[f64; P]; 2],
    /// Heights there, metres.
    heights: [f64; P],
    /// 1 for a point that has not been found.
    open: [f32; P],
    /// Looks taken in doubles.
    looks: [f32; P],
    sum: Sum<P>,
    view: View<P>,
    query: &'q Query<'a>,
}

/// What a look at a cascade shows.
#[derive(Debug)]
#[repr(align(64))]
struct View<const P: usize> {
    /// Where in their cells points are, (s, t), 0..=1.
    fraction: [[f64; P]; 2],
    /// The displacement along u and v, metres.
    fields: [Field<P>; 2],
}

/// (a, b, c, e) of bilinear fields a + b s + c t + e s t.
type Field<const P: usize> = [[f32; P]; 4];

/// Where points are in a cascade.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Cells<const P: usize> {
    /// The targets, in texels along u and v.
    target: [[f64; P]; 2],
    column: [u32; P],
    row: [u32; P],
    /// The height there, metres.
    heights: Field<P>,
}

/// The sum q - target + D(q), metres along the axes of the first cascade.
#[derive(Debug)]
#[repr(align(64))]
struct Sum<const P: usize> {
    miss: [[f64; P]; 2],
    /// (du/du, du/dv, dv/du, dv/dv), metres a texel of the first cascade. A step needs no more than singles: it is tried,
    /// and not believed.
    slope: [[f32; P]; 4],
    /// How far it may be from linear: the sum of all |e|, metres a square texel of the first cascade.
    bend: [f32; P],
}

impl<'q, 'a, const P: usize> Block<'q, 'a, P> {
    /// Nobody looked for yet.
    pub fn new(query: &'q Query<'a>) -> Self {
        let nowhere = Cells { target: [[0.0; P]; 2], column: [0; P], row: [0; P], heights: [[0.0; P]; 4] };
        Self {
            query,
            approach: Approach::new(),
            cells: [nowhere; MAX_CASCADES],
            offset: [[0.0; P]; 2],
            heights: [0.0; P],
            open: [0.0; P],
            looks: [0.0; P],
            sum: Sum { miss: [[0.0; P]; 2], slope: [[0.0; P]; 4], bend: [0.0; P] },
            view: View { fraction: [[0.0; P]; 2], fields: [[[0.0; P]; 4]; 2] },
        }
    }

    /// Whether a point was found, to [`TOLERANCE`].
    pub fn found(&self, point: usize) -> bool {
        self.open[point] == 0.0
    }

    /// Looks that were taken at a point.
    pub fn looks(&self, point: usize) -> u32 {
        looks(self.query.count) + self.looks[point] as u32
    }

    /// Where a point rests, less its target: world (x, z), metres.
    pub fn offset(&self, point: usize) -> [f64; 2] {
        let first = self.query.first();
        let ([u, v], [cos, sin]) = (self.offset.map(|offset| offset[point] / first.per_metre), first.turn);
        [u * cos + v * sin, v * cos - u * sin]
    }

    /// Heights of the points that were found, metres.
    pub fn heights(&self) -> &[f64; P] {
        &self.heights
    }
}

/// Looks for the points above targets: world x of all, world z of all.
pub struct Solve<'s, 'q, 'a, const P: usize> {
    /// Who looks.
    pub block: &'s mut Block<'q, 'a, P>,
    /// What for.
    pub targets: &'s [[f64; P]; 2],
}

impl<const P: usize> Kernel for Solve<'_, '_, '_, P> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let block = self.block;
        for (grid, cells) in block.query.grids().iter().zip(&mut block.cells) {
            for i in 0..P {
                let [u, v] = grid.along([self.targets[0][i], self.targets[1][i]]);
                (cells.target[0][i], cells.target[1][i]) = (u, v);
            }
        }
        let targets = block.cells.each_ref().map(|cells| &cells.target);
        let near = block.approach.run(simd, block.query, targets);
        for (offset, near) in block.offset.iter_mut().zip(near) {
            for i in 0..P {
                offset[i] = f64::from(near[i]);
            }
        }
        block.open = [1.0; P];
        block.looks = [0.0; P];
        for _ in 0..DOUBLES {
            if block.step(simd) == 0.0 {
                break;
            }
        }
    }
}

impl<const P: usize> Block<'_, '_, P> {
    /// Takes a step with the points that are open; how many still are.
    #[inline(always)]
    fn step<S: Simd>(&mut self, simd: S) -> f32 {
        const LITTLE: f32 = 0.5 * TOLERANCE as f32;
        let spacing = 1.0 / self.query.first().per_metre;
        let folded = (NEARLY_FOLDED * spacing * spacing) as f32;
        let per_metre = self.query.first().per_metre as f32;
        self.add_up(simd, spacing);
        let Sum { miss: [u, v], slope: [uu, uv, vu, vv], bend } = &self.sum;
        let mut close = [0.0_f32; P];
        for i in 0..P {
            let (miss_u, miss_v) = (u[i] as f32, v[i] as f32);
            self.looks[i] += self.open[i];
            let determinant = uu[i] * vv[i] - uv[i] * vu[i];
            let share = self.open[i] / determinant;
            let newton_u = (vv[i] * miss_u - uv[i] * miss_v) * share;
            let newton_v = (uu[i] * miss_v - vu[i] * miss_u) * share;
            let nearly_folded = determinant.abs() < folded;
            let step_u = if nearly_folded { miss_u * per_metre * self.open[i] } else { newton_u };
            let step_v = if nearly_folded { miss_v * per_metre * self.open[i] } else { newton_v };
            self.offset[0][i] -= f64::from(step_u);
            self.offset[1][i] -= f64::from(step_v);
            // Within a cell nothing bends but e s t, so that is what a whole step can miss by; what singles round of it is
            // less by far.
            let bent = bend[i] * (step_u * step_u + step_v * step_v);
            close[i] = if bent <= LITTLE && !nearly_folded { 1.0 } else { 0.0 };
        }
        self.arrive(&close)
    }

    /// Goes where the steps lead: a point whose step was short and led out of no cell has been found.
    #[inline(always)]
    fn arrive(&mut self, close: &[f32; P]) -> f32 {
        let mut heights = [0.0; P];
        let mut moved = [0_u32; P];
        let cells = self.query.grids().iter().zip(&self.query.frames).zip(&self.cells);
        for ((grid, frame), cells) in cells {
            let [c, s] = frame.follow;
            for i in 0..P {
                let (u, v) = (self.offset[0][i], self.offset[1][i]);
                let (column, s_) = grid.cell(cells.target[0][i] + (u * c - v * s));
                let (row, t) = grid.cell(cells.target[1][i] + (u * s + v * c));
                moved[i] |= (column as u32 ^ cells.column[i]) | (row as u32 ^ cells.row[i]);
                heights[i] += value(&cells.heights, i, s_, t);
            }
        }
        let mut left = 0.0;
        for i in 0..P {
            let there = self.open[i] == 0.0 || (close[i] > 0.0 && moved[i] == 0);
            self.heights[i] = if self.open[i] == 0.0 { self.heights[i] } else { heights[i] };
            self.open[i] = if there { 0.0 } else { 1.0 };
            left += self.open[i];
        }
        left
    }

    #[inline(always)]
    fn add_up<S: Simd>(&mut self, simd: S, spacing: f64) {
        let own = spacing as f32;
        for i in 0..P {
            self.sum.miss[0][i] = self.offset[0][i] * spacing;
            self.sum.miss[1][i] = self.offset[1][i] * spacing;
            self.sum.slope[0][i] = own;
            self.sum.slope[1][i] = 0.0;
            self.sum.slope[2][i] = 0.0;
            self.sum.slope[3][i] = own;
            self.sum.bend[i] = 0.0;
        }
        let cascades = self.query.grids().iter().zip(&self.query.frames).zip(&mut self.cells);
        for ((grid, frame), cells) in cascades {
            self.view.look(simd, cells, grid, &self.offset, frame.follow);
            self.sum.add(frame, &self.view);
        }
    }
}

impl<const P: usize> View<P> {
    /// Goes `offset` texels of the first cascade away from the targets.
    #[inline(always)]
    fn look<S: Simd>(
        &mut self,
        simd: S,
        cells: &mut Cells<P>,
        grid: &Grid<'_>,
        offset: &[[f64; P]; 2],
        [c, s]: [f64; 2],
    ) {
        for i in 0..P {
            let (u, v) = (offset[0][i], offset[1][i]);
            let (column, s_) = grid.cell(cells.target[0][i] + (u * c - v * s));
            let (row, t) = grid.cell(cells.target[1][i] + (u * s + v * c));
            (cells.column[i], cells.row[i]) = (column as u32, row as u32);
            (self.fraction[0][i], self.fraction[1][i]) = (s_, t);
        }
        let [u, v] = &mut self.fields;
        for first in (0..P).step_by(S::LANES) {
            let [a, b, c, d] = grid.corners(simd, &cells.column[first..], &cells.row[first..]);
            field::<S, P>(u, first, [a[0], b[0], c[0], d[0]]);
            field::<S, P>(&mut cells.heights, first, [a[1], b[1], c[1], d[1]]);
            field::<S, P>(v, first, [a[2], b[2], c[2], d[2]]);
        }
    }
}

/// The bilinear field through the corners' values. Differences of neighbouring halves fit into singles.
#[inline(always)]
fn field<S: Simd, const P: usize>(to: &mut Field<P>, first: usize, [a, b, c, d]: [S::F32; 4]) {
    a.store(&mut to[0][first..]);
    (b - a).store(&mut to[1][first..]);
    (c - a).store(&mut to[2][first..]);
    ((d - c) - (b - a)).store(&mut to[3][first..]);
}

/// A field at point `i`.
#[inline(always)]
fn value<const P: usize>(field: &Field<P>, i: usize, s: f64, t: f64) -> f64 {
    let (a, b) = (f64::from(field[0][i]), f64::from(field[1][i]));
    let (c, e) = (f64::from(field[2][i]), f64::from(field[3][i]));
    a + c * t + (b + e * t) * s
}

impl<const P: usize> Sum<P> {
    /// Adds a cascade, turned and scaled as it lies to the first.
    #[inline(always)]
    fn add(&mut self, frame: &Frame, view: &View<P>) {
        let ([s, t], fields) = (&view.fraction, &view.fields);
        let ([turn_c, turn_s], [follow_c, follow_s]) = (frame.turn, frame.follow);
        for i in 0..P {
            let (u, v) = (value(&fields[0], i, s[i], t[i]), value(&fields[1], i, s[i], t[i]));
            self.miss[0][i] += u * turn_c + v * turn_s;
            self.miss[1][i] += v * turn_c - u * turn_s;
        }
        let (turn_c, turn_s) = (turn_c as f32, turn_s as f32);
        let (follow_c, follow_s) = (follow_c as f32, follow_s as f32);
        let scale = follow_c * follow_c + follow_s * follow_s;
        let [u, v] = fields;
        for i in 0..P {
            let (s, t) = (s[i] as f32, t[i] as f32);
            let (uu, uv) = (u[1][i] + u[3][i] * t, u[2][i] + u[3][i] * s);
            let (vu, vv) = (v[1][i] + v[3][i] * t, v[2][i] + v[3][i] * s);
            let [u_u, v_u] = [uu * turn_c + vu * turn_s, vu * turn_c - uu * turn_s];
            let [u_v, v_v] = [uv * turn_c + vv * turn_s, vv * turn_c - uv * turn_s];
            self.slope[0][i] += u_u * follow_c + u_v * follow_s;
            self.slope[1][i] += u_v * follow_c - u_u * follow_s;
            self.slope[2][i] += v_u * follow_c + v_v * follow_s;
            self.slope[3][i] += v_v * follow_c - v_u * follow_s;
            self.bend[i] += (u[3][i].abs() + v[3][i].abs()) * scale;
        }
    }
}
