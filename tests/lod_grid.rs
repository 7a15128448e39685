//! The patch's 16 triangulations as geometry.
use std::collections::HashMap;
use swell::lod::grid::{indices, vertex_index, vertices};
use swell::lod::{Edge, Pattern};

type Vertex = (i32, i32);

fn triangles(cells: u32, pattern: Pattern) -> Vec<[Vertex; 3]> {
    let grid = vertices(cells);
    let vertex =
        |index: &u16| (i32::from(grid[usize::from(*index)][0]), i32::from(grid[usize::from(*index)][1]));
    indices(cells, pattern).chunks_exact(3).map(|t| [vertex(&t[0]), vertex(&t[1]), vertex(&t[2])]).collect()
}

/// Twice the area, positive when counter-clockwise seen from above: y of (b - a) x (c - a) with x = i, z = j.
fn doubled_area([a, b, c]: [Vertex; 3]) -> i32 {
    (b.1 - a.1) * (c.0 - a.0) - (b.0 - a.0) * (c.1 - a.1)
}

#[test]
fn vertices_stand_where_the_index_formula_looks_for_them() {
    for cells in [16, 32, 64] {
        let grid = vertices(cells);
        assert_eq!(grid.len(), ((cells + 1) * (cells + 1)) as usize);
        for (i, j) in [(0, 0), (cells, 0), (3, 5), (cells, cells)] {
            assert_eq!(grid[usize::from(vertex_index(cells, i, j))], [i as u16, j as u16]);
        }
    }
}

#[test]
fn a_single_cell_has_eight_triangles_less_one_for_each_stitched_edge() {
    for pattern in Pattern::all() {
        assert_eq!(triangles(2, pattern).len() as u32, 8 - pattern.bits().count_ones());
    }
}

#[test]
fn triangles_face_up_and_cover_the_patch_once() {
    for cells in [2, 6, 16, 32, 64] {
        for pattern in Pattern::all() {
            let triangles = triangles(cells, pattern);
            assert!(triangles.iter().all(|&t| doubled_area(t) > 0), "{pattern:?} of {cells}");
            let area: i32 = triangles.iter().map(|&t| doubled_area(t)).sum();
            assert_eq!(area, 2 * (cells * cells) as i32, "{pattern:?} of {cells}");
        }
    }
}

#[test]
fn inner_sides_are_shared_by_two_and_stitched_sides_are_twice_as_long() {
    for cells in [2, 16, 64] {
        let end = cells as i32;
        for pattern in Pattern::all() {
            let mut sides: HashMap<(Vertex, Vertex), u32> = HashMap::new();
            for [a, b, c] in triangles(cells, pattern) {
                for side in [(a, b), (b, c), (c, a)] {
                    *sides.entry(side).or_default() += 1;
                }
            }
            let mut on_edge = [0; 4];
            for (&(a, b), &count) in &sides {
                assert_eq!(count, 1, "{pattern:?}: side {a:?} {b:?} run twice the same way");
                if sides.contains_key(&(b, a)) {
                    continue;
                }
                let edge = match (a, b) {
                    ((i, _), (k, _)) if i == end && k == end => Edge::East,
                    ((_, j), (_, l)) if j == end && l == end => Edge::North,
                    ((0, _), (0, _)) => Edge::West,
                    ((_, 0), (_, 0)) => Edge::South,
                    _ => panic!("{pattern:?}: a hole at {a:?} {b:?}"),
                };
                let length = (a.0 - b.0).abs() + (a.1 - b.1).abs();
                assert_eq!(length, if pattern.has(edge) { 2 } else { 1 }, "{pattern:?} {edge:?}");
                on_edge[edge as usize] += length;
            }
            assert_eq!(on_edge, [end; 4], "{pattern:?}");
        }
    }
}

/// Diagonals run both ways equally often, so waves have no favoured direction.
#[test]
fn diagonals_are_balanced() {
    let mut lean = 0;
    for [a, b, c] in triangles(16, Pattern::FULL) {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            lean += (to.0 - from.0) * (to.1 - from.1);
        }
    }
    assert_eq!(lean, 0);
}

#[test]
fn flags_are_e_1_n_2_w_4_s_8() {
    let bits = Edge::ALL.map(|edge| Pattern::FULL.with(edge).bits());
    assert_eq!(bits, [1, 2, 4, 8]);
    for pattern in Pattern::all() {
        let rebuilt = Edge::ALL.into_iter().filter(|&e| pattern.has(e)).fold(Pattern::FULL, Pattern::with);
        assert_eq!(rebuilt, pattern);
    }
}
