//! The sea beyond the quadtree, to the true horizon (section 5.7), and how the waves end before it.
use bytemuck::{Pod, Zeroable};

/// A vertex in homogeneous coordinates, metres relative to the selection's origin; w = 0 is a direction.
///
/// In clip space it is `view_projection * vec4(position.xyz - position.w * eye, position.w)`: with an infinite far
/// plane a direction lands on the horizon, at the far depth 0.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SkirtVertex {
    /// (x, y, z, w), w 1 or 0.
    pub position: [f32; 4],
}

/// Vertices of the skirt: three pairs on each of four sides.
pub const SKIRT_VERTICES: usize = 24;
/// Indices of the skirt: four triangles on each side.
pub const SKIRT_INDICES: usize = 48;

/// The skirt's inner border lies this far out, as a share of S / 2: under the quadtree's own border.
pub const SKIRT_INNER: f64 = 0.97;
/// The skirt lies this far below rest, as a share of S, so that the quadtree covers it where both are.
pub const SKIRT_DROP: f64 = 1.0e-5;

/// Where the waves begin to fade, as a share of S / 2.
pub const FADE_START: f32 = 0.7;
/// Where they have faded out, as a share of S / 2.
pub const FADE_END: f32 = 0.98;

/// The skirt around a quadtree of side `size` (metres): a plane from its border through `extent` times `size` to infinity.
///
/// Sides E, N, W, S follow each other, six vertices each: inner, middle and outer pair. They meet in the diagonals, so
/// together they cover the plane outside the inner square once. Triangles are counter-clockwise seen from above.
pub fn skirt(size: f64, extent: f64) -> ([SkirtVertex; SKIRT_VERTICES], [u16; SKIRT_INDICES]) {
    let drop = (-SKIRT_DROP * size) as f32;
    let rows = [
        ((0.5 * SKIRT_INNER * size) as f32, drop, 1.0),
        ((extent * size) as f32, drop, 1.0),
        (1.0, 0.0, 0.0),
    ];
    let mut vertices = [SkirtVertex::default(); SKIRT_VERTICES];
    let mut indices = [0; SKIRT_INDICES];
    // (x, z) of the way out, in the order E, N, W, S; the way along a side is a quarter turn on.
    let sides = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
    for (side, (x, z)) in sides.into_iter().enumerate() {
        for (row, (far, y, w)) in rows.into_iter().enumerate() {
            let first = 6 * side + 2 * row;
            vertices[first].position = [far * (x + z), y, far * (z - x), w];
            vertices[first + 1].position = [far * (x - z), y, far * (z + x), w];
        }
        for row in 0..2 {
            let [a, b, c, d] = [0, 1, 2, 3].map(|place| (6 * side + 2 * row + place) as u16);
            let first = 12 * side + 6 * row;
            indices[first..first + 6].copy_from_slice(&[a, b, c, c, b, d]);
        }
    }
    (vertices, indices)
}

/// Factor on the waves' displacement at (x, z) relative to the origin, 0..=1: the CPU twin of the vertex shader's.
///
/// 1 up to [`FADE_START`], 0 from [`FADE_END`] on, of max(|x|, |z|) / (S / 2), smooth between: the quadtree's border is
/// flat where the skirt takes over.
pub fn border_fade(x: f32, z: f32, size: f32) -> f32 {
    let out = x.abs().max(z.abs()) / (0.5 * size);
    let t = ((out - FADE_START) / (FADE_END - FADE_START)).clamp(0.0, 1.0);
    1.0 - t * t * (3.0 - 2.0 * t)
}
