//! Normals, the Jacobian and their packing, eqs (45)-(51) and (53).
use super::settings::NormalKind;

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
    let t = ((length - 2.0 / 3.0) * 3.0).clamp(0.0, 1.0);
    // The printed quadratic can end a rounding error below 0 at t = 1.
    let roughness = (1.0 - t * (0.85 + 0.15 * t)).max(0.0);
    1.0 - roughness.sqrt()
}

/// (n_u, n_v, J, smoothness) as bytes in memory order, eqs (50)(51), of an unnormalised normal and J `[n_u, n_y, n_v, J]`.
pub fn pack([u, y, v, jacobian]: [f32; 4]) -> [u8; 4] {
    let length = (u * u + y * y + v * v).sqrt();
    let scale = 1.0 / length.max(f32::MIN_POSITIVE);
    [
        to_byte(u * scale * 0.5 + 0.5),
        to_byte(v * scale * 0.5 + 0.5),
        to_byte(jacobian * 0.5 + 0.5),
        to_byte(smoothness(length)),
    ]
}

fn to_byte(value: f32) -> u8 {
    // The cast truncates, which is floor for what clamp lets through.
    (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

/// Normals times [`GradientParams::normal_length`] and J, `[n_u, n_y, n_v, J]`, of one row of the grid.
///
/// The exact normal is the cross product of the displaced surface's tangents (1 + dDu/du, dh/du, dDv/du) and
/// (dDu/dv, dh/dv, 1 + dDv/dv); its upward part is J itself. Where the surface has folded over (J < 0) it points down;
/// the map keeps no sign for n_y, so the upward part is stored as |J|, which is what a reader of the map reconstructs.
/// The sheet normal is eq (47)'s.
pub fn gradient_row(field: Field<'_>, n: usize, row: usize, params: &GradientParams, out: &mut [[f32; 4]]) {
    let rows = Neighbours::of(n, row);
    let out = &mut out[..n];
    out[0] = rows.texel(field, [n - 1, 0, 1], params);
    for c in 1..n - 1 {
        out[c] = rows.texel(field, [c - 1, c, c + 1], params);
    }
    out[n - 1] = rows.texel(field, [n - 2, n - 1, 0], params);
}

/// The Jacobian (48) alone, of one row: `visit` is given every column and its J.
pub fn jacobian_row(
    field: Field<'_>,
    n: usize,
    row: usize,
    per_difference: f32,
    mut visit: impl FnMut(usize, f32),
) {
    let rows = Neighbours::of(n, row);
    visit(0, jacobian(rows.tangents(field, [n - 1, 0, 1], per_difference)));
    for c in 1..n - 1 {
        visit(c, jacobian(rows.tangents(field, [c - 1, c, c + 1], per_difference)));
    }
    visit(n - 1, jacobian(rows.tangents(field, [n - 2, n - 1, 0], per_difference)));
}

/// Offsets of three rows on the torus, eq (46).
#[derive(Clone, Copy)]
struct Neighbours {
    here: usize,
    above: usize,
    below: usize,
}

impl Neighbours {
    fn of(n: usize, row: usize) -> Self {
        Self { here: row * n, above: (row + n - 1) % n * n, below: (row + 1) % n * n }
    }

    /// Derivatives of (Du, h, Dv) along u and along v.
    #[inline(always)]
    fn tangents(self, field: Field<'_>, [left, here, right]: [usize; 3], scale: f32) -> [[f32; 3]; 2] {
        let planes = [field.du, field.height, field.dv];
        [
            planes.map(|plane| (plane[self.here + right] - plane[self.here + left]) * scale),
            planes.map(|plane| (plane[self.below + here] - plane[self.above + here]) * scale),
        ]
    }

    #[inline(always)]
    fn texel(self, field: Field<'_>, columns: [usize; 3], params: &GradientParams) -> [f32; 4] {
        let tangents = self.tangents(field, columns, params.per_difference);
        let jacobian = jacobian(tangents);
        let [[u_u, h_u, v_u], [u_v, h_v, v_v]] = tangents;
        let [x, y, z] = match params.normals {
            NormalKind::Exact => {
                [h_v * v_u - (1.0 + v_v) * h_u, jacobian.abs(), u_v * h_u - h_v * (1.0 + u_u)]
            }
            NormalKind::Sheet => [-h_u, 1.0, -h_v],
        };
        let length = (x * x + y * y + z * z).sqrt();
        let scale = params.normal_length / length.max(f32::MIN_POSITIVE);
        [x * scale, y * scale, z * scale, jacobian]
    }
}

#[inline(always)]
fn jacobian([[u_u, _, v_u], [u_v, _, v_v]]: [[f32; 3]; 2]) -> f32 {
    (1.0 + u_u) * (1.0 + v_v) - u_v * v_u
}
