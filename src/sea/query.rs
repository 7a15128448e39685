//! The surface at a point, from the very maps that are drawn. See `docs/query.md`.
use super::{
    foam::foam,
    maps::{CascadeMaps, SeaMaps},
};
use half::slice::HalfFloatSliceExt;
use std::ops::{Add, Mul};

/// Most steps of one inversion.
pub const MAX_ITERATIONS: u32 = 64;
/// Steps from one starting point; twice as many from the first.
const STEPS: u32 = 8;
/// Lengths tried in one step: whole, half, ... one eighth.
const HALVINGS: u32 = 4;
/// The angle of a sunflower's seeds, which spreads any number of starting points evenly: pi (3 - sqrt 5).
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
/// Horizontal error, metres, at which an inversion is content.
pub const TOLERANCE: f64 = 1e-7;

/// A point of the sea's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Where the point rests, world (x, z), metres.
    pub rest: [f64; 2],
    /// Where it is, world (x, y, z), metres.
    pub position: [f64; 3],
    /// Unit normal of the displaced surface, world (x, y, z).
    pub normal: [f64; 3],
    /// `position` less the rest position, metres.
    pub displacement: [f64; 3],
    /// Foam cover, 0..=1.
    pub foam: f64,
    /// Horizontal distance between `position` and the point asked for, metres; 0 for [`Surface::at_rest`].
    pub residual: f64,
    /// Steps that it took.
    pub iterations: u32,
}

impl Surface {
    /// Height above the sea at rest, metres.
    pub fn height(&self) -> f64 {
        self.position[1]
    }

    /// The point whose rest position is world (`x`, `z`), metres.
    pub fn at_rest(maps: &SeaMaps, x: f64, z: f64) -> Self {
        Self::of(maps, [x, z], [x, z], 1)
    }

    /// The point of the surface above or below world (`x`, `z`), metres: the q with q + D(q) = (x, z).
    ///
    /// Newton's method on the piecewise bilinear field that is drawn, with damped steps; where the sea is so steep that
    /// it stalls, it starts again from points around. At most [`MAX_ITERATIONS`] steps in all; `residual` says how well
    /// they went. Where the sea has folded over (J < 0) there are several such points and one of them is returned.
    pub fn above(maps: &SeaMaps, x: f64, z: f64) -> Self {
        let target = [x, z];
        let mut best = Guess::at(maps, target, target);
        let mut iterations = 1;
        let [dx, _, dz] = best.sample.value.displacement;
        // The nearest crest or trough is about a displacement away; the spiral goes twice as far.
        let reach = 2.0 * norm([dx, dz]).max(norm(best.miss));
        let mut guess = Guess::at(maps, [x - dx, z - dz], target);
        for start in 1_u32.. {
            iterations += 1;
            let steps = if start == 1 { 2 * STEPS } else { STEPS };
            for _ in 0..steps {
                if norm(guess.miss) < norm(best.miss) {
                    best = guess;
                }
                if norm(best.miss) <= TOLERANCE || iterations >= MAX_ITERATIONS {
                    return Self { residual: norm(best.miss), ..Self::of(maps, best.q, target, iterations) };
                }
                iterations += 1;
                match guess.improved(maps, target) {
                    Some(improved) => guess = improved,
                    None => break,
                }
            }
            let (sin, cos) = libm::sincos(GOLDEN_ANGLE * f64::from(start));
            let radius = reach * (f64::from(start) * f64::from(STEPS) / f64::from(MAX_ITERATIONS)).sqrt();
            let offset = [x - dx + radius * cos, z - dz + radius * sin];
            guess = Guess::at(maps, offset, target);
        }
        Self { residual: norm(best.miss), ..Self::of(maps, best.q, target, iterations) }
    }

    fn of(maps: &SeaMaps, q: [f64; 2], target: [f64; 2], iterations: u32) -> Self {
        let sample = Sample::at(maps, q);
        let [x, height, z] = sample.value.displacement;
        Self {
            rest: q,
            position: [q[0] + x, height, q[1] + z],
            normal: normal(maps, q),
            displacement: [x, height, z],
            foam: foam(&maps.foam, sample.value.compression),
            residual: if target == q { 0.0 } else { norm(sample.miss(q, target)) },
            iterations,
        }
    }
}

/// A rest position that may be the one sought.
#[derive(Clone, Copy, Debug)]
struct Guess {
    q: [f64; 2],
    sample: Sample,
    /// q + D(q) less the target.
    miss: [f64; 2],
}

impl Guess {
    fn at(maps: &SeaMaps, q: [f64; 2], target: [f64; 2]) -> Self {
        let sample = Sample::at(maps, q);
        Self { q, sample, miss: sample.miss(q, target) }
    }

    /// One step, halved until it helps.
    fn improved(&self, maps: &SeaMaps, target: [f64; 2]) -> Option<Self> {
        let step = self.sample.newton(self.miss);
        let mut share = 1.0;
        for _ in 0..HALVINGS {
            let tried = Self::at(maps, [self.q[0] - share * step[0], self.q[1] - share * step[1]], target);
            if norm(tried.miss) < norm(self.miss) {
                return Some(tried);
            }
            share *= 0.5;
        }
        None
    }
}

/// What a map holds at a point, in a cascade's axes or the world's.
#[derive(Clone, Copy, Debug, Default)]
struct Value {
    displacement: [f64; 3],
    compression: f64,
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
struct Sample {
    value: Value,
    along_x: Value,
    along_z: Value,
}

impl Sample {
    /// Bilinear, as a sampler reads level 0.
    fn at(maps: &SeaMaps, q: [f64; 2]) -> Self {
        let mut sum = Self::default();
        for cascade in &maps.cascades {
            let cell = Cell::of(cascade, q);
            let [[a, b], [c, d]] = [0, 1].map(|j| [0, 1].map(|i| cell.texel(cascade, i, j)));
            let [s, t] = cell.fraction;
            let value = (a * (1.0 - s) + b * s) * (1.0 - t) + (c * (1.0 - s) + d * s) * t;
            let along_u = ((b + a * -1.0) * (1.0 - t) + (d + c * -1.0) * t) * cell.per_metre;
            let along_v = ((c + a * -1.0) * (1.0 - s) + (d + b * -1.0) * s) * cell.per_metre;
            sum.add(&cell, value, along_u, along_v);
        }
        sum
    }

    /// Adds a cascade's values, turned from its axes into the world's.
    fn add(&mut self, cell: &Cell, value: Value, along_u: Value, along_v: Value) {
        let [sin, cos] = cell.turn;
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
    fn miss(&self, q: [f64; 2], target: [f64; 2]) -> [f64; 2] {
        let [x, _, z] = self.value.displacement;
        // Subtracted first: near 1 000 km the sum would round the displacement.
        [q[0] - target[0] + x, q[1] - target[1] + z]
    }

    /// The step that would bring a linear field's `miss` to 0; the miss itself where the field is nearly folded.
    fn newton(&self, miss: [f64; 2]) -> [f64; 2] {
        const NEARLY_FOLDED: f64 = 0.05;
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

/// Where a point lies in a cascade's grid.
struct Cell {
    column: usize,
    row: usize,
    /// Position within the cell, 0..1.
    fraction: [f64; 2],
    /// N / L.
    per_metre: f64,
    /// Sine and cosine of the cascade's rotation.
    turn: [f64; 2],
}

impl Cell {
    fn of(maps: &CascadeMaps, [x, z]: [f64; 2]) -> Self {
        let n = maps.resolution;
        let (sin, cos) = libm::sincos(maps.rotation);
        let per_metre = n as f64 / maps.patch_size;
        let [(column, s), (row, t)] = [x * cos - z * sin, x * sin + z * cos].map(|along| {
            let texels = along.rem_euclid(maps.patch_size) * per_metre;
            // rem_euclid may round up to the patch itself.
            (texels.floor() as usize % n, texels.fract())
        });
        Self { column, row, fraction: [s, t], per_metre, turn: [sin, cos] }
    }

    /// The texel `i` columns and `j` rows further, on the torus.
    fn texel(&self, maps: &CascadeMaps, i: usize, j: usize) -> Value {
        let n = maps.resolution;
        let at = (self.row + j) % n * n + (self.column + i) % n;
        // Four at once: the conversion's choice of instructions costs more than the conversion.
        let mut texel = [0.0_f32; 4];
        maps.displacement[at].as_slice().convert_to_f32_slice(&mut texel);
        let [u, h, v, compression] = texel.map(f64::from);
        Value { displacement: [u, h, v], compression }
    }

    /// Central differences at a texel, along u and v, eq (45).
    fn differences(&self, maps: &CascadeMaps, i: usize, j: usize) -> [Value; 2] {
        let n = maps.resolution;
        let back = n - 1;
        [([i + 1, j], [i + back, j]), ([i, j + 1], [i, j + back])].map(|([i, j], [i_, j_])| {
            (self.texel(maps, i, j) + self.texel(maps, i_, j_) * -1.0) * (0.5 * self.per_metre)
        })
    }
}

/// Unit normal of the summed surface at rest position `q`: the cross product of its tangents, which are interpolated
/// between central differences so that the normal is continuous.
fn normal(maps: &SeaMaps, q: [f64; 2]) -> [f64; 3] {
    let mut sum = Sample::default();
    for cascade in &maps.cascades {
        let cell = Cell::of(cascade, q);
        let corners = [0, 1].map(|j| [0, 1].map(|i| cell.differences(cascade, i, j)));
        let [s, t] = cell.fraction;
        let [along_u, along_v] = [0, 1].map(|axis| {
            let [[a, b], [c, d]] = corners.map(|row| row.map(|differences| differences[axis]));
            (a * (1.0 - s) + b * s) * (1.0 - t) + (c * (1.0 - s) + d * s) * t
        });
        sum.add(&cell, Value::default(), along_u, along_v);
    }
    let [xx, hx, zx] = sum.along_x.displacement;
    let [xz, hz, zz] = sum.along_z.displacement;
    let [xx, zz] = [1.0 + xx, 1.0 + zz];
    let cross = [hz * zx - zz * hx, zz * xx - xz * zx, xz * hx - hz * xx];
    let length = cross.iter().map(|part| part * part).sum::<f64>().sqrt();
    if length > 0.0 { cross.map(|part| part / length) } else { [0.0, 1.0, 0.0] }
}

fn norm([x, z]: [f64; 2]) -> f64 {
    (x * x + z * z).sqrt()
}
