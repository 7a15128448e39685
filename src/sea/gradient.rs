//! Normals, the Jacobian and their packing, eqs (45)-(51) and (53).
use super::{
    fft::{layout::FIELDS, rows::Window},
    settings::{CascadeSettings, NormalKind},
    simd::{Float, Simd, Strided},
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

impl GradientParams {
    /// Those of a cascade.
    pub fn new(cascade: &CascadeSettings, normals: NormalKind) -> Self {
        Self {
            per_difference: (cascade.resolution as f64 / (2.0 * cascade.patch_size)) as f32,
            normal_length: normal_length(cascade.roughness as f32),
            normals,
        }
    }
}

/// Expected length of a normal over water of roughness `r`, 0..=1, eq (49): 1 when smooth, 0.5 when rough.
pub fn normal_length(r: f32) -> f32 {
    1.0 - r * (0.306 + r * (0.113 + r * 0.081))
}

/// Twice the cell's width times the derivatives of (h, Du, Dv) along u and along v: differences between neighbours, eq (45),
/// not yet divided. Normals have no length yet, and J takes one factor at the end.
#[derive(Clone, Copy, Debug)]
pub struct Tangents<V> {
    /// Of h.
    height: [V; 2],
    /// Of u + Du.
    u: [V; 2],
    /// Of v + Dv.
    v: [V; 2],
    /// The Jacobian (48) over [`GradientParams::per_difference`] squared.
    pub area: V,
}

/// A row of every plane and its neighbours above and below on the torus, eq (46), in steps of a vector.
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a, S> {
    above: Strided<'a, S>,
    here: Strided<'a, S>,
    below: Strided<'a, S>,
    window: Window,
}

impl<'a, S: Simd> Rows<'a, S> {
    /// Row `v`; the window holds its neighbours too.
    #[inline(always)]
    pub fn new(simd: S, window: Window, planes: &'a [f32], v: usize) -> Self {
        // From a vector before the row of the first plane to one after the row of the last.
        let reach = (FIELDS - 1) * window.field_stride() + 2 * S::LANES;
        let row = |v: usize| {
            let first = window.row(0, v) - S::LANES;
            Strided::reaching(simd, planes, first, S::LANES, window.n / S::LANES, reach)
        };
        Self { above: row(v.wrapping_sub(1)), here: row(v), below: row(v + 1), window }
    }

    /// Vectors in the row.
    #[inline(always)]
    pub const fn vectors(&self) -> usize {
        self.window.n / S::LANES
    }

    /// A vector of plane `field`: 0 is h, 1 is Du, 2 is Dv.
    #[inline(always)]
    pub fn value(&self, field: usize, vector: usize) -> S::F32 {
        self.here.load_after(vector, field * self.window.field_stride() + S::LANES)
    }

    /// What is ahead less what is behind, along u and along v.
    #[inline(always)]
    fn differences(&self, field: usize, vector: usize) -> [S::F32; 2] {
        let at = field * self.window.field_stride() + S::LANES;
        let [behind, ahead] = self.here.load_neighbours(vector, at);
        let along_v = self.below.load_after(vector, at) - self.above.load_after(vector, at);
        [ahead - behind, along_v]
    }
}

impl<V: Float> Tangents<V> {
    /// Central differences of one vector of a row; `width` is what u itself grows by between the two neighbours.
    #[inline(always)]
    pub fn new<S: Simd<F32 = V>>(rows: &Rows<'_, S>, vector: usize, width: V) -> Self {
        let height = rows.differences(0, vector);
        let u = rows.differences(1, vector);
        let v = rows.differences(2, vector);
        let (u, v) = ([u[0] + width, u[1]], [v[0], v[1] + width]);
        let area = u[1].neg_mul_add(v[0], u[0] * v[1]);
        Self { height, u, v, area }
    }

    /// A normal of no particular length.
    ///
    /// The exact one is the cross product of the displaced surface's tangents (1 + dDu/du, dh/du, dDv/du) and
    /// (dDu/dv, dh/dv, 1 + dDv/dv); its upward part is J itself. Where the surface has folded over (J < 0) it points down;
    /// the map keeps no sign for n_y, so the upward part is taken as |J|, which is what a reader of the map reconstructs.
    /// The sheet normal, [`NormalKind::Sheet`], is eq (47)'s.
    #[inline(always)]
    pub fn normal<const SHEET: bool>(&self, width: V) -> [V; 3] {
        let [h_u, h_v] = self.height;
        let up = upward::<V, SHEET>(self.area, width);
        if SHEET {
            return [-h_u, up, -h_v];
        }
        [self.v[1].neg_mul_add(h_u, h_v * self.v[0]), up, self.u[0].neg_mul_add(h_v, self.u[1] * h_u)]
    }
}

/// The upward part of [`Tangents::normal`].
#[inline(always)]
pub(super) fn upward<V: Float, const SHEET: bool>(area: V, width: V) -> V {
    if SHEET { width } else { area.abs() }
}

/// The length of a normal, at least 1e-19: it may be divided by.
///
/// Roots and quotients are made by a unit of their own, beside all that goes on, and are correctly rounded everywhere.
#[inline(always)]
pub fn length<S: Simd>(simd: S, [x, y, z]: [S::F32; 3]) -> S::F32 {
    x.mul_add(x, y.mul_add(y, z * z)).max(simd.splat(f32::MIN_POSITIVE)).sqrt()
}

/// 255 times the smoothness, 0..=1, of a normal's length, eq (53), up to rounding.
#[inline(always)]
pub fn smoothness<S: Simd>(simd: S, length: S::F32) -> S::F32 {
    let (zero, one, scale) = (simd.splat(0.0), simd.splat(1.0), simd.splat(255.0));
    // 3 (length - 2/3), and the quadratic 1 - t (0.85 + 0.15 t) in factors: both then end exactly at smooth water.
    let t = length.mul_add(simd.splat(3.0), simd.splat(-2.0)).max(zero).min(one);
    let roughness = (one - t) * t.mul_add(simd.splat(0.15), one);
    roughness.sqrt().neg_mul_add(scale, scale)
}

/// -1..=1 as 0..=255, eq (51).
#[inline(always)]
pub fn to_byte<S: Simd>(simd: S, value: S::F32) -> S::F32 {
    let half = simd.splat(127.5);
    value.mul_add(half, half)
}

/// J as at most 255, eq (51), to be cut off at 0: `area` times `scale` is 127.5 J.
#[inline(always)]
pub fn jacobian_byte<S: Simd>(simd: S, area: S::F32, scale: S::F32) -> S::F32 {
    area.mul_add(scale, simd.splat(127.5)).min(simd.splat(255.0))
}
