//! The grid of a patch as vertex shaders take it: where each vertex is, which way it slides, by which weight.
//!
//! All that [`lod::vertex_position`] decides for a vertex without knowing the patch is decided here, once. A vertex on a
//! stitched edge slides otherwise than on one that is not: it is there twice, and each pattern's indices name the one
//! that it means. Twin: `Patch` in `shaders/patch.wgsl`.

use crate::lod::tessellation::{self, SCALE, Weight};
use crate::lod::{self, Edge, Pattern};
use bytemuck::{Pod, Zeroable};
use half::f16;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// A vertex. Halves are exact for grids whose cells are a power of two: multiples of 1 / cells up to 1/2.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct GridVertex {
    /// Place in a patch of side 1 about its centre.
    place: [f16; 2],
    /// Where it slides to under full weight, less its place.
    slide: [f16; 2],
    /// 255 where the weight is that of the edge: east, north, west, south.
    on_edge: [u8; 4],
    /// 255 where it is the weight inside.
    inside: u8,
    unused: [u8; 3],
}

/// Vertices, and the indices of all patterns, or of all pieces, one after the other.
#[derive(Debug, Default)]
pub struct PatchGrid {
    /// Of all of them together.
    pub vertices: Vec<GridVertex>,
    /// Three a triangle.
    pub indices: Vec<u16>,
    /// Where the indices of each are.
    pub patterns: Vec<Range<u32>>,
    /// How many vertices each uses.
    pub pattern_vertices: Vec<u32>,
}

impl PatchGrid {
    /// The pieces of patches of at most `cells` x `cells`, whose density the wave signal chooses.
    pub fn pieces(cells: u32) -> Self {
        let mesh = tessellation::Mesh::new(cells);
        Self {
            vertices: mesh.vertices.into_iter().map(GridVertex::from).collect(),
            indices: mesh.indices,
            patterns: mesh.pieces,
            pattern_vertices: mesh.piece_vertices,
        }
    }

    /// For patches of `cells` x `cells`.
    pub fn new(cells: u32) -> Self {
        let plain = lod::grid::vertices(cells);
        let mut grid = Self::default();
        let mut known = BTreeMap::new();
        for pattern in Pattern::all() {
            let start = grid.indices.len();
            for index in lod::grid::indices(cells, pattern) {
                let [i, j] = plain[usize::from(index)].map(u32::from);
                let edge = edge(cells, i, j);
                let stitched = edge.is_some_and(|edge| pattern.has(edge));
                let vertices = &mut grid.vertices;
                grid.indices.push(*known.entry((index, stitched)).or_insert_with(|| {
                    vertices.push(GridVertex::new(cells, [i, j], edge, stitched));
                    vertices.len() as u16 - 1
                }));
            }
            grid.patterns.push(start as u32..grid.indices.len() as u32);
            let used: BTreeSet<u16> = grid.indices[start..].iter().copied().collect();
            grid.pattern_vertices.push(used.len() as u32);
        }
        grid
    }
}

/// The edge whose weight moves a vertex; that of a corner does not matter, as corners never move.
fn edge(cells: u32, i: u32, j: u32) -> Option<Edge> {
    match (i, j) {
        (i, _) if i == cells => Some(Edge::East),
        (0, _) => Some(Edge::West),
        (_, j) if j == cells => Some(Edge::North),
        (_, 0) => Some(Edge::South),
        _ => None,
    }
}

impl GridVertex {
    fn new(cells: u32, number: [u32; 2], edge: Option<Edge>, stitched: bool) -> Self {
        let step = if stitched { 2 } else { 1 };
        let share = |cells_from_corner: i32| cells_from_corner as f32 / cells as f32;
        // Odd numbers slide to the even one between multiples of four: 1 and 3 to 2.
        let slide = |number: u32| match (number / step) & 3 {
            1 => step.cast_signed(),
            3 => -step.cast_signed(),
            _ => 0,
        };
        let mut on_edge = [0; 4];
        if let Some(edge) = edge {
            on_edge[edge as usize] = 255;
        }
        Self {
            place: number.map(|number| f16::from_f32(share(number.cast_signed()) - 0.5)),
            slide: number.map(|number| f16::from_f32(share(slide(number)))),
            on_edge,
            inside: if edge.is_none() { 255 } else { 0 },
            unused: [0; 3],
        }
    }
}

impl From<tessellation::Vertex> for GridVertex {
    fn from(vertex: tessellation::Vertex) -> Self {
        let share = |units: i16| f32::from(units) / SCALE as f32;
        let (mut on_edge, mut inside) = ([0; 4], 0);
        match vertex.weight {
            Weight::Inside => inside = 255,
            Weight::Edge(edge) => on_edge[edge as usize] = 255,
        }
        Self {
            place: vertex.place.map(|units| f16::from_f32(share(units.into()) - 0.5)),
            slide: vertex.slide.map(|units| f16::from_f32(share(units.into()))),
            on_edge,
            inside,
            unused: [0; 3],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lod::{Instance, Quality};

    const INSTANCE: Instance = Instance {
        centre_x: 96.0,
        centre_z: -32.0,
        size: 64.0,
        morph: 0.25,
        edge_morph: [0.5, 0.75, 0.125, 1.0],
    };

    /// What the shader computes for a vertex.
    fn position(vertex: &GridVertex) -> [f32; 2] {
        let mut weight = f32::from(vertex.inside / 255) * INSTANCE.morph;
        for (share, edge) in vertex.on_edge.iter().zip(INSTANCE.edge_morph) {
            weight += f32::from(share / 255) * edge;
        }
        let along = |axis: usize, centre: f32| {
            let place = vertex.place[axis].to_f32() + vertex.slide[axis].to_f32() * weight;
            centre + place * INSTANCE.size
        };
        [along(0, INSTANCE.centre_x), along(1, INSTANCE.centre_z)]
    }

    /// The same for pieces.
    #[test]
    fn vertices_of_pieces_are_where_the_level_of_detail_puts_them() {
        let mesh = tessellation::Mesh::new(64);
        for (&vertex, own) in mesh.vertices.iter().zip(&PatchGrid::pieces(64).vertices) {
            assert_eq!(position(own), tessellation::vertex_position(&INSTANCE, vertex).to_array());
        }
    }

    /// What the shader computes is what the level of detail says, for every vertex that any pattern draws.
    #[test]
    fn vertices_are_where_the_level_of_detail_puts_them() {
        for quality in [Quality::Low, Quality::Medium, Quality::High, Quality::Ultra] {
            let cells = quality.preset().cells;
            let grid = PatchGrid::new(cells);
            for pattern in Pattern::all() {
                let plain = lod::grid::indices(cells, pattern);
                let range = &grid.patterns[pattern.index()];
                let ours = &grid.indices[range.start as usize..range.end as usize];
                assert_eq!(plain.len(), ours.len());
                for (&index, &own) in plain.iter().zip(ours) {
                    let vertex = grid.vertices[usize::from(own)];
                    let (i, j) = (u32::from(index) % (cells + 1), u32::from(index) / (cells + 1));
                    let wanted = lod::vertex_position(&INSTANCE, pattern, cells, i, j);
                    assert_eq!(position(&vertex), wanted.to_array());
                }
            }
        }
    }
}
