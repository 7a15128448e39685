//! Pieces of patches, triangulated once: insides of 2^a cells a side, and strips that lead from an inside to an edge of 2^b
//! segments.
//!
//! A strip's triangles depend on its own edge and its own inside alone, and its outer vertices on the edge alone: whatever
//! patch is on the other side, it has the same ones. Patches whose edges all have half, the same or double the inside's
//! cells, nearly all of them, are also there as one piece.
use crate::lod::grid::{RING, z_curve};
use crate::lod::{Edge, Instance};
use glam::Vec2;
use std::ops::Range;

/// Places and slides are whole multiples of a patch's side over this.
pub const SCALE: u32 = 64;

/// Numbers of the pieces of patches with at most 2^`most` cells a side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pieces {
    most: usize,
}

/// Ways in which four edges can have half, the same or double the inside's cells.
const WAYS: usize = 81;

impl Pieces {
    /// The patch that is two triangles.
    pub const QUAD: usize = 0;

    /// Of patches with at most `cells` cells a side, a power of two; never more than [`SCALE`].
    pub const fn new(cells: u32) -> Self {
        let cells = if cells < SCALE { cells } else { SCALE };
        Self { most: cells.ilog2() as usize }
    }

    /// Binary logarithm of the most cells a side.
    pub const fn most(self) -> u8 {
        self.most as u8
    }

    /// How many numbers there are.
    pub const fn count(self) -> usize {
        1 + (WAYS + 1) * self.most + 4 * self.most * (self.most + 1)
    }

    /// The piece that is a whole patch of 2^`inside` cells a side, `inside` >= 1, and edges (E, N, W, S) of 2^`edges`
    /// segments; `None` where an edge has more than double or less than half of them.
    pub fn whole(self, inside: u8, edges: [u8; 4]) -> Option<usize> {
        let way = edges.iter().rev().try_fold(0, |way, &edge| {
            let step = usize::from((edge + 1).checked_sub(inside)?);
            (step <= 2).then_some(3 * way + step)
        })?;
        Some(1 + WAYS * (usize::from(inside) - 1) + way)
    }

    /// What remains of a patch of 2^`inside` cells a side without its outermost ones; `None` where that is nothing.
    pub fn inside(self, inside: u8) -> Option<usize> {
        (inside >= 2).then(|| 1 + WAYS * self.most + usize::from(inside) - 1)
    }

    /// The outermost cells along `edge`, of 2^`segments` segments, of a patch of 2^`inside` cells a side.
    pub fn strip(self, edge: Edge, inside: u8, segments: u8) -> usize {
        let row = edge as usize * self.most + usize::from(inside) - 1;
        1 + (WAYS + 1) * self.most + row * (self.most + 1) + usize::from(segments)
    }
}

/// What slides a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Weight {
    /// [`Instance::morph`].
    Inside,
    /// An entry of [`Instance::edge_morph`].
    Edge(Edge),
}

/// A vertex of a patch, in units of its side over [`SCALE`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Vertex {
    /// From the western and southern edges.
    pub place: [u8; 2],
    /// Where it slides to under full weight, less its place.
    pub slide: [i8; 2],
    /// Whose weight that is. Corners never slide.
    pub weight: Weight,
}

/// World (x, z) at rest, metres relative to the selection's origin, of a vertex of a patch.
pub fn vertex_position(instance: &Instance, vertex: Vertex) -> Vec2 {
    let weight = match vertex.weight {
        Weight::Inside => instance.morph,
        Weight::Edge(edge) => instance.edge_morph[edge as usize],
    };
    let along = |axis: usize| {
        let place = f32::from(vertex.place[axis]) / SCALE as f32 - 0.5;
        place + f32::from(vertex.slide[axis]) / SCALE as f32 * weight
    };
    Vec2::new(instance.centre_x, instance.centre_z) + Vec2::new(along(0), along(1)) * instance.size
}

/// Vertices and triangles of all pieces.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Corners, then edges of every number of segments, then insides.
    pub vertices: Vec<Vertex>,
    /// Three a triangle, counter-clockwise seen from above.
    pub indices: Vec<u16>,
    /// Where each piece's indices are, by its number; empty where patches have no such piece.
    pub pieces: Vec<Range<u32>>,
    /// How many vertices each piece uses.
    pub piece_vertices: Vec<u32>,
}

impl Mesh {
    /// For patches of at most `cells` cells a side, a power of two from 2 on; never more than [`SCALE`].
    pub fn new(cells: u32) -> Self {
        let pieces = Pieces::new(cells);
        let most = pieces.most();
        let mut mesh = Self {
            vertices: vertices(most),
            indices: Vec::new(),
            pieces: vec![0..0; pieces.count()],
            piece_vertices: vec![0; pieces.count()],
        };
        mesh.add(Pieces::QUAD, 4, |indices| indices.extend([0, 2, 3, 0, 3, 1]));
        for inside in 1..=most {
            let across = (1_u32 << inside) - 1;
            for way in 0..WAYS {
                let step = |edge: usize| (way / 3_usize.pow(edge as u32) % 3) as u8;
                let edges = [0, 1, 2, 3].map(|edge| inside - 1 + step(edge));
                let Some(number) = pieces.whole(inside, edges).filter(|_| edges.iter().all(|&e| e <= most))
                else {
                    continue;
                };
                let around: u32 = edges.iter().map(|&edge| 1 << edge).sum();
                mesh.add(number, across * across + around, |indices| {
                    add_inside(indices, most, inside);
                    for (edge, segments) in Edge::ALL.into_iter().zip(edges) {
                        add_strip(indices, most, edge, inside, segments);
                    }
                });
            }
            if let Some(number) = pieces.inside(inside) {
                mesh.add(number, across * across, |indices| add_inside(indices, most, inside));
            }
            for (edge, segments) in Edge::ALL.into_iter().flat_map(|e| (0..=most).map(move |s| (e, s))) {
                let number = pieces.strip(edge, inside, segments);
                mesh.add(number, across + (1 << segments) + 1, |indices| {
                    add_strip(indices, most, edge, inside, segments);
                });
            }
        }
        mesh
    }

    fn add(&mut self, piece: usize, vertices: u32, write: impl FnOnce(&mut Vec<u16>)) {
        let start = self.indices.len() as u32;
        write(&mut self.indices);
        self.pieces[piece] = start..self.indices.len() as u32;
        self.piece_vertices[piece] = vertices;
    }
}

/// Vertices of all pieces, in the order that [`on_edge`] and [`within`] count them.
fn vertices(most: u8) -> Vec<Vertex> {
    let scale = SCALE as u8;
    let corner = |x, y| Vertex { place: [x, y], slide: [0, 0], weight: Weight::Inside };
    let mut vertices = vec![corner(0, 0), corner(scale, 0), corner(0, scale), corner(scale, scale)];
    for edge in Edge::ALL {
        for level in 0..=most {
            let step = scale >> level;
            vertices.extend((1..1_u8 << level).map(|number| {
                let (place, slide) = (number * step, slide(number, step));
                let (place, slide) = match edge {
                    Edge::East => ([scale, place], [0, slide]),
                    Edge::West => ([0, place], [0, slide]),
                    Edge::North => ([place, scale], [slide, 0]),
                    Edge::South => ([place, 0], [slide, 0]),
                };
                Vertex { place, slide, weight: Weight::Edge(edge) }
            }));
        }
    }
    for level in 1..=most {
        let step = scale >> level;
        let numbers = || 1..1_u8 << level;
        vertices.extend(numbers().flat_map(|j| numbers().map(move |i| [i, j])).map(|number| Vertex {
            place: number.map(|number| number * step),
            slide: number.map(|number| slide(number, step)),
            weight: Weight::Inside,
        }));
    }
    vertices
}

/// Odd numbers slide to the even one between multiples of four: 1 and 3 to 2. Of two segments, the middle to the end.
fn slide(number: u8, step: u8) -> i8 {
    match number & 3 {
        1 => step.cast_signed(),
        3 => -step.cast_signed(),
        _ => 0,
    }
}

/// The number of segments' vertices, corners left out, at all levels below `level`.
const fn inner_vertices_below(level: u8) -> u32 {
    (1 << level) - 1 - level as u32
}

/// Index of vertex `number`, 0..=2^`level`, along an edge of 2^`level` segments, from low to high x or z.
fn on_edge(most: u8, edge: Edge, level: u8, number: u32) -> u16 {
    if number == 0 || number == 1 << level {
        let high = u16::from(number > 0);
        return match edge {
            Edge::East => 1 + 2 * high,
            Edge::West => 2 * high,
            Edge::North => 2 + high,
            Edge::South => high,
        };
    }
    let first = 4 + edge as u32 * inner_vertices_below(most + 1) + inner_vertices_below(level);
    (first + number - 1) as u16
}

/// Index of vertex (i, j), 1..2^`level` each, inside a patch of 2^`level` cells a side.
fn within(most: u8, level: u8, i: u32, j: u32) -> u16 {
    let across = |level: u8| (1_u32 << level) - 1;
    let first = 4 + 4 * inner_vertices_below(most + 1) + (1..level).map(|l| across(l).pow(2)).sum::<u32>();
    (first + (j - 1) * across(level) + i - 1) as u16
}

/// The cells that touch no edge: those triangles of the grid's fans (65) whose corners are all inside.
fn add_inside(indices: &mut Vec<u16>, most: u8, level: u8) {
    let cells = 1_u32 << level;
    let kept = |(i, j): (u32, u32)| (1..cells).contains(&i) && (1..cells).contains(&j);
    for (x, y) in z_curve(cells / 2) {
        let place = |(i, j): (u32, u32)| (2 * x + i, 2 * y + j);
        for (from, to) in (0..8).map(|at| (place(RING[(at + 7) % 8]), place(RING[at]))) {
            if kept(from) && kept(to) {
                let triangle = [place((1, 1)), from, to];
                indices.extend(triangle.map(|(i, j)| within(most, level, i, j)));
            }
        }
    }
}

/// Triangles between the row of vertices one cell inside an edge and the edge's own vertices.
///
/// Each of the row's sides has one even vertex; the outer vertex that it would be joined to on a fan of the plain grid is
/// the third corner, slid as often as the edge has been halved since. So nothing turns when a slide ends.
fn add_strip(indices: &mut Vec<u16>, most: u8, edge: Edge, inside: u8, segments: u8) {
    let (cells, ends) = (1_u32 << inside, 1_u32 << segments);
    let row = |number: u32| match edge {
        Edge::East => within(most, inside, cells - 1, number),
        Edge::West => within(most, inside, 1, number),
        Edge::North => within(most, inside, number, cells - 1),
        Edge::South => within(most, inside, number, 1),
    };
    let outer = |number| on_edge(most, edge, segments, number);
    let mut triangle = |a, b, c| match edge {
        Edge::West | Edge::North => indices.extend([a, b, c]),
        Edge::East | Edge::South => indices.extend([a, c, b]),
    };
    let mut at = 1;
    for end in 0..=ends {
        while at + 1 < cells && apex(at + at % 2, inside, segments) == end {
            triangle(row(at + 1), row(at), outer(end));
            at += 1;
        }
        if end < ends {
            triangle(outer(end), outer(end + 1), row(at));
        }
    }
}

/// The vertex on an edge of 2^`segments` segments that even vertex `number` of a row of 2^`inside` is joined to.
fn apex(number: u32, inside: u8, segments: u8) -> u32 {
    if segments >= inside {
        return number << (segments - inside);
    }
    (segments..inside).fold(number, |number, _| match number & 3 {
        1 => number.div_ceil(2),
        _ => number / 2,
    })
}
