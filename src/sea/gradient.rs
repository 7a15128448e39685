//! Normals, the Jacobian and their packing, eqs (45)-(51) and (53).
use super::{
    fft::{LANES, Lane},
    settings::NormalKind,
};

/// What the gradients of a cascade depend on besides its displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GradientParams {
    /// N/(2 L): a difference between the two neighbours times this is a derivative, eq (45), 1/m.
    pub per_difference: f32,
    /// Length given to normals, eq (49).
    pub normal_length: f32,
    /// Which normal.
    pub normals: NormalKind,
}

/// The displacement planes of a cascade, each N x N, metres.
#[derive(Clone, Copy, Debug)]
pub struct Field<'a> {
    /// Displacement along u.
    pub du: &'a [f32],
    /// Height.
    pub height: &'a [f32],
    /// Displacement along v.
    pub dv: &'a [f32],
}

/// Expected length of a normal over water of roughness `r`, 0..=1, eq (49): 1 when smooth, 0.5 when rough.
pub fn normal_length(r: f32) -> f32 {
    1.0 - r * (0.306 + r * (0.113 + r * 0.081))
}

/// Smoothness, 0..=1, of a normal's length, eq (53).
pub fn smoothness(length: f32) -> f32 {
    // 3 (length - 2/3), and the quadratic 1 - t (0.85 + 0.15 t) in factors: both then end exactly at smooth water.
    let t = (length * 3.0 - 2.0).clamp(0.0, 1.0);
    let roughness = (1.0 - t) * (1.0 + 0.15 * t);
    1.0 - roughness.sqrt()
}

/// (n_u, n_v, J, smoothness) as bytes in memory order, eqs (50)(51), of unnormalised normals and J `[n_u, n_y, n_v, J]`.
///
/// `out` is as long as `texels`.
pub fn pack(texels: &[[f32; 4]], out: &mut [[u8; 4]]) {
    let (blocks, rest) = texels.as_chunks::<LANES>();
    let (out_blocks, out_rest) = out.as_chunks_mut::<LANES>();
    for (block, out) in blocks.iter().zip(out_blocks) {
        *out = pack_block(block);
    }
    let mut block = [[0.0; 4]; LANES];
    block[..rest.len()].copy_from_slice(rest);
    out_rest.copy_from_slice(&pack_block(&block)[..rest.len()]);
}

#[inline(always)]
fn pack_block(texels: &[[f32; 4]; LANES]) -> [[u8; 4]; LANES] {
    let mut packed = [0_u32; LANES];
    for l in 0..LANES {
        let [u, y, v, jacobian] = texels[l];
        let length = (u * u + y * y + v * v).sqrt();
        let scale = 0.5 / length.max(f32::MIN_POSITIVE);
        packed[l] = to_byte(u * scale + 0.5)
            | to_byte(v * scale + 0.5) << 8
            | to_byte(jacobian * 0.5 + 0.5) << 16
            | to_byte(smoothness(length)) << 24;
    }
    std::array::from_fn(|l| packed[l].to_le_bytes())
}

/// floor(255 `value` + 1/2), clamped.
#[inline(always)]
fn to_byte(value: f32) -> u32 {
    // Between 256 and 512 the integer part's last eight bits are the mantissa's first: a floor without a conversion,
    // which the compiler would not vectorise.
    let shifted = value.clamp(0.0, 1.0) * 255.0 + 0.5 + 256.0;
    shifted.to_bits() >> 15 & 0xff
}

/// Normals times [`GradientParams::normal_length`] and J, `[n_u, n_y, n_v, J]`, of one row of the grid.
///
/// The exact normal is the cross product of the displaced surface's tangents (1 + dDu/du, dh/du, dDv/du) and
/// (dDu/dv, dh/dv, 1 + dDv/dv); its upward part is J itself. Where the surface has folded over (J < 0) it points down;
/// the map keeps no sign for n_y, so the upward part is stored as |J|, which is what a reader of the map reconstructs.
/// The sheet normal is eq (47)'s.
pub fn gradient_row(field: Field<'_>, n: usize, row: usize, params: &GradientParams, out: &mut [[f32; 4]]) {
    let rows = Rows::of(field, n, row);
    let (blocks, _) = out[..n].as_chunks_mut::<LANES>();
    for (block, out) in blocks.iter_mut().enumerate() {
        let [[u_u, h_u, v_u], [u_v, h_v, v_v]] = rows.tangents(block * LANES, params.per_difference);
        for l in 0..LANES {
            let jacobian = jacobian(u_u[l], v_u[l], u_v[l], v_v[l]);
            let [x, y, z] = match params.normals {
                NormalKind::Exact => [
                    h_v[l] * v_u[l] - (1.0 + v_v[l]) * h_u[l],
                    jacobian.abs(),
                    u_v[l] * h_u[l] - h_v[l] * (1.0 + u_u[l]),
                ],
                NormalKind::Sheet => [-h_u[l], 1.0, -h_v[l]],
            };
            let length = (x * x + y * y + z * z).sqrt();
            let scale = params.normal_length / length.max(f32::MIN_POSITIVE);
            out[l] = [x * scale, y * scale, z * scale, jacobian];
        }
    }
}

/// The Jacobian (48) alone, of one row: `visit` is given the first column of every eight, and their J.
pub fn jacobian_row(
    field: Field<'_>,
    n: usize,
    row: usize,
    per_difference: f32,
    mut visit: impl FnMut(usize, Lane),
) {
    let rows = Rows::of(field, n, row);
    for column in (0..n).step_by(LANES) {
        let [[u_u, _, v_u], [u_v, _, v_v]] = rows.tangents(column, per_difference);
        let mut jacobians = [0.0; LANES];
        for l in 0..LANES {
            jacobians[l] = jacobian(u_u[l], v_u[l], u_v[l], v_v[l]);
        }
        visit(column, jacobians);
    }
}

/// Three neighbouring rows of each plane on the torus, eq (46): above, here, below.
#[derive(Clone, Copy)]
struct Rows<'a> {
    planes: [[&'a [f32]; 3]; 3],
}

/// Derivatives of (Du, h, Dv) along u and along v, of eight neighbouring columns.
type Tangents = [[Lane; 3]; 2];

impl<'a> Rows<'a> {
    fn of(field: Field<'a>, n: usize, row: usize) -> Self {
        let rows = [(row + n - 1) % n, row, (row + 1) % n];
        let planes = [field.du, field.height, field.dv];
        Self { planes: planes.map(|plane| rows.map(|row| &plane[row * n..(row + 1) * n])) }
    }

    /// Central differences, eq (45), at eight columns from `column`.
    #[inline(always)]
    fn tangents(&self, column: usize, scale: f32) -> Tangents {
        let n = self.planes[0][1].len();
        let mut tangents = [[[0.0; LANES]; 3]; 2];
        for (plane, [above, here, below]) in self.planes.iter().enumerate() {
            let (right, left) = (lane(here, column + 1), lane(here, (column + n - 1) % n));
            let (below, above) = (lane(below, column), lane(above, column));
            for l in 0..LANES {
                tangents[0][plane][l] = (right[l] - left[l]) * scale;
                tangents[1][plane][l] = (below[l] - above[l]) * scale;
            }
        }
        tangents
    }
}

/// Eight columns from `from`, around the end of the row.
#[inline(always)]
fn lane(row: &[f32], from: usize) -> Lane {
    match row.get(from..from + LANES).and_then(|columns| columns.first_chunk()) {
        Some(columns) => *columns,
        None => around_the_end(row, from),
    }
}

#[cold]
fn around_the_end(row: &[f32], from: usize) -> Lane {
    std::array::from_fn(|l| row[(from + l) % row.len()])
}

#[inline(always)]
fn jacobian(u_u: f32, v_u: f32, u_v: f32, v_v: f32) -> f32 {
    (1.0 + u_u) * (1.0 + v_v) - u_v * v_u
}
