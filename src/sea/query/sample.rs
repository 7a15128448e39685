//! The summed maps at a rest position: values, derivatives, normal.
use super::{Query, grid::Grid, newton::NEARLY_FOLDED};
use crate::sea::waves;
use std::ops::{Add, Mul};

/// What a map holds at a point, in a cascade's axes or the world's.
#[derive(Clone, Copy, Debug, Default)]
pub struct Value {
    pub displacement: [f64; 3],
    pub compression: f64,
}

impl Add for Value {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            displacement: std::array::from_fn(|i| self.displacement[i] + other.displacement[i]),
            compression: self.compression + other.compression,
        }
    }
}

impl Mul<f64> for Value {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self {
            displacement: self.displacement.map(|part| part * factor),
            compression: self.compression * factor,
        }
    }
}

/// The summed displacement and its derivatives along world x and z.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sample {
    pub value: Value,
    along_x: Value,
    along_z: Value,
    /// Foam cover of the models, 0..=1.
    pub foam: f64,
}

impl Sample {
    /// Bilinear, as a sampler reads level 0.
    pub fn at(query: &Query<'_>, q: [f64; 2]) -> Self {
        let mut sum = Self::default();
        for grid in query.grids() {
            let cell = Cell::of(grid, q);
            let [a, b, c, d] = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[i, j]| cell.texel(grid, i, j));
            let [s, t] = cell.fraction;
            let (b, c, e) = (b + a * -1.0, c + a * -1.0, d + c * -1.0 + (b + a * -1.0) * -1.0);
            let value = a + c * t + (b + e * t) * s;
            sum.add(grid, value, (b + e * t) * grid.per_metre, (c + e * s) * grid.per_metre);
        }
        sum.add_models(query, q);
        sum
    }

    /// Adds what is in no map.
    fn add_models(&mut self, query: &Query<'_>, q: [f64; 2]) {
        if query.models.is_empty() {
            return;
        }
        let models = waves::evaluate(query.models, q, query.time);
        let value = |displacement| Value { displacement, compression: 0.0 };
        self.value = self.value + value(models.displacement);
        self.along_x = self.along_x + value(models.along_x);
        self.along_z = self.along_z + value(models.along_z);
        self.foam = models.foam;
    }

    /// Adds a cascade's values, turned from its axes into the world's.
    fn add(&mut self, grid: &Grid<'_>, value: Value, along_u: Value, along_v: Value) {
        let [cos, sin] = grid.turn;
        let [value, along_u, along_v] = [value, along_u, along_v].map(|v| {
            let [u, y, v_] = v.displacement;
            Value { displacement: [u * cos + v_ * sin, y, v_ * cos - u * sin], ..v }
        });
        self.value = self.value + value;
        // u = x cos - z sin and v = x sin + z cos.
        self.along_x = self.along_x + along_u * cos + along_v * sin;
        self.along_z = self.along_z + along_v * cos + along_u * -sin;
    }

    /// q + D(q) less the target.
    pub fn miss(&self, q: [f64; 2], target: [f64; 2]) -> [f64; 2] {
        let [x, _, z] = self.value.displacement;
        // Subtracted first: near 1 000 km the sum would round the displacement.
        [q[0] - target[0] + x, q[1] - target[1] + z]
    }

    /// The step that would bring a linear field's `miss` to 0; the miss itself where the field is nearly folded.
    pub fn newton(&self, miss: [f64; 2]) -> [f64; 2] {
        let [xx, _, zx] = self.along_x.displacement;
        let [xz, _, zz] = self.along_z.displacement;
        let [xx, zz] = [1.0 + xx, 1.0 + zz];
        let determinant = xx * zz - xz * zx;
        if determinant.abs() < NEARLY_FOLDED {
            return miss;
        }
        [(zz * miss[0] - xz * miss[1]) / determinant, (xx * miss[1] - zx * miss[0]) / determinant]
    }
}

impl Sample {
    /// The step of Levenberg and Marquardt: the one that would bring a linear field's `miss` to 0, held back by `damping`.
    pub fn damped_newton(&self, [x, z]: [f64; 2], damping: f64) -> [f64; 2] {
        let [xx, _, zx] = self.along_x.displacement;
        let [xz, _, zz] = self.along_z.displacement;
        let [xx, zz] = [1.0 + xx, 1.0 + zz];
        // (J^T J + damping) step = J^T miss.
        let right = [xx * x + zx * z, xz * x + zz * z];
        let [a, b, d] = [xx * xx + zx * zx + damping, xx * xz + zx * zz, xz * xz + zz * zz + damping];
        let determinant = a * d - b * b;
        if determinant <= 0.0 {
            return [0.0; 2];
        }
        [(d * right[0] - b * right[1]) / determinant, (a * right[1] - b * right[0]) / determinant]
    }
}

/// Where a point lies in a cascade's grid.
struct Cell {
    column: u64,
    row: u64,
    /// Position within the cell, 0..=1.
    fraction: [f64; 2],
}

impl Cell {
    fn of(grid: &Grid<'_>, q: [f64; 2]) -> Self {
        let [(column, s), (row, t)] = grid.along(q).map(|along| grid.cell(along));
        Self { column, row, fraction: [s, t] }
    }

    /// The texel `i` columns and `j` rows further; -1 is `u64::MAX`.
    fn texel(&self, grid: &Grid<'_>, i: u64, j: u64) -> Value {
        let texel = grid.texel(self.column.wrapping_add(i), self.row.wrapping_add(j));
        let [u, h, v, compression] = texel.map(f64::from);
        Value { displacement: [u, h, v], compression }
    }
}

/// Unit normal of the summed surface at rest position `q`: the cross product of its tangents, which are interpolated
/// between central differences, eq (45), so that the normal is continuous.
pub fn normal(query: &Query<'_>, q: [f64; 2]) -> [f64; 3] {
    const AROUND: [u64; 4] = [u64::MAX, 0, 1, 2];
    let mut sum = Sample::default();
    for grid in query.grids() {
        let cell = Cell::of(grid, q);
        let [s, t] = cell.fraction;
        let texels = AROUND.map(|j| AROUND.map(|i| cell.texel(grid, i, j)));
        // The mean of neighbouring points' differences is the difference of their means.
        let rows: [_; 4] = std::array::from_fn(|i| texels[1][i] * (1.0 - t) + texels[2][i] * t);
        let columns: [_; 4] = std::array::from_fn(|j| texels[j][1] * (1.0 - s) + texels[j][2] * s);
        let [along_u, along_v] = [(rows, s), (columns, t)].map(|([a, b, c, d], share)| {
            ((c + a * -1.0) * (1.0 - share) + (d + b * -1.0) * share) * (0.5 * grid.per_metre)
        });
        sum.add(grid, Value::default(), along_u, along_v);
    }
    sum.add_models(query, q);
    let [xx, hx, zx] = sum.along_x.displacement;
    let [xz, hz, zz] = sum.along_z.displacement;
    let [xx, zz] = [1.0 + xx, 1.0 + zz];
    let cross = [hz * zx - zz * hx, zz * xx - xz * zx, xz * hx - hz * xx];
    let length = cross.iter().map(|part| part * part).sum::<f64>().sqrt();
    if length > 0.0 { cross.map(|part| part / length) } else { [0.0, 1.0, 0.0] }
}

pub fn norm([x, z]: [f64; 2]) -> f64 {
    (x * x + z * z).sqrt()
}
