//! What one patch is drawn with.
use super::{Density, Factor, Pieces, Side};
use crate::lod::{Edge, Instance, Node, Pattern, SubdivisionMap};

/// Most pieces of one patch: its inside and four strips.
pub(in crate::lod) const MOST_PIECES: usize = 5;

/// The meshes of one patch, and the instance that all of them are drawn with.
#[derive(Clone, Copy, Debug)]
pub(in crate::lod) struct Plan {
    pub(in crate::lod) instance: Instance,
    meshes: [u16; MOST_PIECES],
    count: u8,
}

impl Plan {
    /// The plain grid, stitched by `pattern`.
    pub(in crate::lod) fn grid(instance: Instance, pattern: Pattern) -> Self {
        Self { instance, meshes: [pattern.index() as u16; MOST_PIECES], count: 1 }
    }

    /// Numbers of the meshes.
    pub(in crate::lod) fn meshes(&self) -> &[u16] {
        &self.meshes[..usize::from(self.count)]
    }

    /// Pieces by `density` for `leaf`, which the plain grid would draw as `instance`.
    pub(in crate::lod) fn signal(
        pieces: Pieces,
        density: &Density,
        map: &SubdivisionMap,
        (leaf, pattern): (Node, Pattern),
        mut instance: Instance,
    ) -> Self {
        let most = pieces.most();
        let mut total = 0.0;
        let mut edges = [Factor { level: 0, weight: 0.0 }; 4];
        for (edge, factor) in Edge::ALL.into_iter().zip(&mut edges) {
            let slid = instance.edge_morph[edge as usize];
            let real;
            (real, *factor) = if pattern.has(edge) {
                half_of_coarser(density, leaf, edge, most, slid)
            } else {
                let real = real_factor(density, Side::of(leaf, edge), is_halved(map, leaf, edge));
                (real, Factor::new(real, most).or_slid(most, slid))
            };
            total += real.min(f64::from(1_u32 << most));
        }
        let inside = inside(total, edges, most).or_slid(most, instance.morph);
        instance.morph = inside.weight;
        instance.edge_morph = edges.map(|factor| factor.weight);
        let (mut meshes, mut count) = ([0; MOST_PIECES], 0);
        let mut add = |piece: usize| {
            meshes[usize::from(count)] = piece as u16;
            count += 1;
        };
        let levels = edges.map(|factor| factor.level);
        if inside.level == 0 {
            add(Pieces::QUAD);
        } else if let Some(whole) = pieces.whole(inside.level, levels) {
            add(whole);
        } else {
            pieces.inside(inside.level).into_iter().for_each(&mut add);
            for (edge, segments) in Edge::ALL.into_iter().zip(levels) {
                add(pieces.strip(edge, inside.level, segments));
            }
        }
        Self { instance, meshes, count }
    }
}

/// A side's factor, at least 2 where squares across it are half as large: their corner is its middle.
fn real_factor(density: &Density, side: Side, halved: bool) -> f64 {
    let real = density.factor(side);
    if halved { real.max(2.0) } else { real }
}

/// True when squares half as large as `leaf` are across `edge`.
fn is_halved(map: &SubdivisionMap, leaf: Node, edge: Edge) -> bool {
    leaf.neighbour(edge).is_some_and(|across| map.is_divided(across))
}

/// An edge that is half of a coarser patch's: that one's factor decides.
fn half_of_coarser(density: &Density, leaf: Node, edge: Edge, most: u8, slid: f32) -> (f64, Factor) {
    let coarser = leaf.parent().unwrap_or(leaf);
    let real = real_factor(density, Side::of(coarser, edge), true);
    let mut factor = Factor::new(real, most).or_slid(most, slid);
    factor.level -= 1;
    let is_upper = match edge {
        Edge::East | Edge::West => leaf.y % 2 == 1,
        Edge::North | Edge::South => leaf.x % 2 == 1,
    };
    match factor.level {
        // The whole edge has two segments: its middle, a corner here, never slides.
        0 => factor.weight = 0.0,
        // Of four segments, the last two's middle slides to the whole edge's middle, here the lower end.
        1 if is_upper => factor.weight = -factor.weight,
        _ => {}
    }
    (0.5 * real, factor)
}

/// The inside's factor, 0.2 times the sum of the edges'. Where an edge is cut the inside has a vertex to join it to.
fn inside(total: f64, edges: [Factor; 4], most: u8) -> Factor {
    let inside = Factor::new(0.2 * total, most);
    let cut = edges.iter().filter(|edge| edge.level > 0);
    match cut.map(|edge| edge.weight.abs()).reduce(f32::min) {
        Some(weight) if inside.level == 0 => Factor { level: 1, weight },
        _ => inside,
    }
}
