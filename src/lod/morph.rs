//! Where a vertex of a patch stands at rest: the CPU twin of the ocean's vertex shader's first lines.
use super::{Edge, Instance, Pattern};
use glam::Vec2;

/// World (x, z) at rest, metres relative to the selection's origin, of vertex (i, j) of a patch of `cells` x `cells`.
///
/// Vertices of odd number k slide towards the coarser grid by the instance's weights, to the neighbour that is 2 more
/// than a multiple of 4: 1 and 3 to 2, 5 and 7 to 6. Fully slid, each cell's fan is two triangles divided along the
/// diagonal that the coarser grid's fans have there, and none of them leans on a border vertex, which may itself have
/// slid. On a stitched edge every second vertex is left out of the index pattern; the others are vertices of the
/// coarser patch and slide by its rule: numbers are halved first. Corners never move.
///
/// `i`, `j` are in 0..=cells, `cells` a multiple of 8. On a stitched edge odd numbers are rounded down to even ones.
pub fn vertex_position(instance: &Instance, pattern: Pattern, cells: u32, i: u32, j: u32) -> Vec2 {
    let edge = if i == cells {
        Some(Edge::East)
    } else if i == 0 {
        Some(Edge::West)
    } else if j == cells {
        Some(Edge::North)
    } else if j == 0 {
        Some(Edge::South)
    } else {
        None
    };
    let (weight, step) = match edge {
        Some(edge) => (instance.edge_morph[edge as usize], if pattern.has(edge) { 2 } else { 1 }),
        None => (instance.morph, 1),
    };
    let place = Vec2::new(slide(i, step, weight), slide(j, step, weight));
    let centre = Vec2::new(instance.centre_x, instance.centre_z);
    centre + instance.size * (place / cells as f32 - 0.5)
}

/// Vertex number `number` after sliding by `weight` on the grid of every `step`-th vertex.
fn slide(number: u32, step: u32, weight: f32) -> f32 {
    let number = number / step;
    let towards = match number & 3 {
        1 => weight,
        3 => -weight,
        _ => 0.0,
    };
    (number as f32 + towards) * step as f32
}
