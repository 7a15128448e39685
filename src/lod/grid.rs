//! The grid that every patch is drawn with, and its 16 ways to be divided into triangles, eqs (65)-(68).
use super::{Edge, Pattern};

/// Vertices of a patch in the order of eq (68): (i, j) with i along x running fastest, each in 0..=cells.
///
/// Eq (67)'s unit coordinates are (i / V - 0.5, j / V - 0.5).
pub fn vertices(cells: u32) -> Vec<[u16; 2]> {
    (0..=cells).flat_map(|j| (0..=cells).map(move |i| [i as u16, j as u16])).collect()
}

/// Index of vertex (i, j), eq (68).
pub fn vertex_index(cells: u32, i: u32, j: u32) -> u16 {
    (j * (cells + 1) + i) as u16
}

/// Vertices around a cell of 3 x 3 vertices, counter-clockwise seen from above: along z first, as x cross z is -y.
pub(super) const RING: [(u32, u32); 8] = [(0, 0), (0, 1), (0, 2), (1, 2), (2, 2), (2, 1), (2, 0), (1, 0)];

/// The edge whose middle is at each place of [`RING`].
const RING_EDGE: [Option<Edge>; 8] =
    [None, Some(Edge::West), None, Some(Edge::North), None, Some(Edge::East), None, Some(Edge::South)];

/// Triangles of a patch of `cells` x `cells` (even, at most 254) with the edges of `pattern` stitched.
///
/// Cells of 3 x 3 vertices (65) are fans around their middle vertex, so diagonals run both ways alike: eight triangles,
/// and one less for each stitched edge (66), whose middle vertex is left out. Counter-clockwise seen from above (+y).
/// Cells follow each other along a Z curve, which keeps shared vertices in the GPU's cache.
pub fn indices(cells: u32, pattern: Pattern) -> Vec<u16> {
    let across = cells / 2;
    let mut indices = Vec::with_capacity((across * across * 24) as usize);
    for (x, y) in z_curve(across) {
        let cell = cell_pattern(across, pattern, x, y);
        let vertex = |(i, j)| vertex_index(cells, 2 * x + i, 2 * y + j);
        let kept = |place: &usize| RING_EDGE[*place].is_none_or(|edge| !cell.has(edge));
        let mut from = RING[7];
        if cell.has(Edge::South) {
            from = RING[6];
        }
        for to in (0..8).filter(kept).map(|place| RING[place]) {
            indices.extend([vertex((1, 1)), vertex(from), vertex(to)]);
            from = to;
        }
    }
    indices
}

/// The edges of a patch's pattern that a cell lies on, eq (65).
fn cell_pattern(across: u32, pattern: Pattern, x: u32, y: u32) -> Pattern {
    let borders = [
        (Edge::East, x + 1 == across),
        (Edge::North, y + 1 == across),
        (Edge::West, x == 0),
        (Edge::South, y == 0),
    ];
    borders
        .into_iter()
        .filter(|&(edge, on_border)| on_border && pattern.has(edge))
        .fold(Pattern::FULL, |cell, (edge, _)| cell.with(edge))
}

/// The cells of a square, `across` a side, along a Z curve (Morton order).
pub(super) fn z_curve(across: u32) -> impl Iterator<Item = (u32, u32)> {
    let width = across.next_power_of_two();
    (0..width * width)
        .map(|place| (even_bits(place), even_bits(place >> 1)))
        .filter(move |&(x, y)| x < across && y < across)
}

/// Bits 0, 2, 4, ... of `bits`, packed together.
fn even_bits(bits: u32) -> u32 {
    (0..16).fold(0, |packed, bit| packed | ((bits >> (2 * bit)) & 1) << bit)
}
