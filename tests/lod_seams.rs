//! No seam opens: neighbouring patches use the same vertices along the edge they share, bit for bit.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod lod_support;
use glam::Vec2;
use lod_support::{QUALITIES, Random, tree, trees};
use std::collections::HashMap;
use swell::lod::{Edge, Frustum, Instance, Leaf, Node, Pattern, Quadtree, Selection, grid, vertex_position};

/// Vertices along an edge that the index pattern uses, from low to high x or z: found in the indices themselves.
struct EdgeVertices(Vec<[Vec<(u32, u32)>; 4]>);

impl EdgeVertices {
    fn new(cells: u32) -> Self {
        let of_pattern = |pattern: Pattern| {
            let mut used = grid::indices(cells, pattern);
            used.sort_unstable();
            used.dedup();
            let used: Vec<(u32, u32)> =
                used.into_iter().map(|v| (u32::from(v) % (cells + 1), u32::from(v) / (cells + 1))).collect();
            Edge::ALL.map(|edge| {
                let on_edge = |&(i, j): &(u32, u32)| match edge {
                    Edge::East => i == cells,
                    Edge::North => j == cells,
                    Edge::West => i == 0,
                    Edge::South => j == 0,
                };
                let mut vertices: Vec<_> = used.iter().copied().filter(on_edge).collect();
                vertices.sort_unstable();
                vertices
            })
        };
        Self(Pattern::all().map(of_pattern).collect())
    }

    fn positions(&self, leaf: &Leaf, instance: &Instance, cells: u32, edge: Edge) -> Vec<Vec2> {
        let vertices = &self.0[leaf.pattern.index()][edge as usize];
        vertices.iter().map(|&(i, j)| vertex_position(instance, leaf.pattern, cells, i, j)).collect()
    }
}

fn instance_of<'a>(selection: &'a Selection, leaf: &Leaf) -> &'a Instance {
    &selection.instances()[leaf.instance.unwrap() as usize]
}

/// Compares every pair of leaves across an edge; `same` decides when two vertices are one.
fn check_seams(tree: &Quadtree, edges: &EdgeVertices, same: impl Fn(Vec2, Vec2) -> bool) -> (usize, usize) {
    let selection = tree.selection();
    let cells = tree.preset().cells;
    let by_node: HashMap<Node, &Leaf> = selection.leaves().iter().map(|leaf| (leaf.node, leaf)).collect();
    let (mut equal, mut stitched) = (0, 0);
    for leaf in selection.leaves() {
        for edge in Edge::ALL {
            let Some(across) = leaf.node.neighbour(edge) else {
                assert!(!leaf.pattern.has(edge), "nothing is across {leaf:?} {edge:?}");
                continue;
            };
            let coarser = across.parent().and_then(|node| by_node.get(&node));
            let Some(other) = by_node.get(&across).or(coarser) else {
                assert!(
                    tree.map().is_divided(across),
                    "{leaf:?} meets leaves two levels coarser across {edge:?}"
                );
                continue;
            };
            assert_eq!(leaf.pattern.has(edge), other.node.level < leaf.node.level);
            let mine = edges.positions(leaf, instance_of(selection, leaf), cells, edge);
            let mut theirs = edges.positions(other, instance_of(selection, other), cells, edge.opposite());
            if other.node.level < leaf.node.level {
                stitched += 1;
                let upper_half = match edge {
                    Edge::East | Edge::West => leaf.node.y % 2 == 1,
                    Edge::North | Edge::South => leaf.node.x % 2 == 1,
                };
                let middle = theirs.len() / 2;
                theirs = if upper_half { theirs.split_off(middle) } else { theirs[..=middle].to_vec() };
            } else {
                equal += 1;
            }
            assert_eq!(mine.len(), theirs.len(), "{leaf:?} {edge:?} {other:?}");
            for (a, b) in mine.into_iter().zip(theirs) {
                assert!(same(a, b), "{a} and {b}: {leaf:?} {edge:?} {other:?}");
            }
        }
    }
    (equal, stitched)
}

#[test]
fn neighbours_share_their_edge_vertices_bit_for_bit() {
    let mut random = Random(1);
    let (mut equal, mut stitched) = (0, 0);
    for mut tree in trees() {
        let edges = EdgeVertices::new(tree.preset().cells);
        for _ in 0..250 {
            tree.select(random.viewer(), &[Frustum::everywhere()]);
            let counts = check_seams(&tree, &edges, |a, b| a == b);
            equal += counts.0;
            stitched += counts.1;
        }
    }
    assert!(equal > 100_000 && stitched > 100_000, "{equal} {stitched}");
}

/// Sizes of many digits round: by no more than the last place of the quadtree's half side.
#[test]
fn any_size_is_watertight_to_the_last_place() {
    let mut random = Random(2);
    for quality in QUALITIES {
        for _ in 0..20 {
            let size = random.between(256.0, 8192.0);
            let mut tree = tree(size, quality, None);
            let edges = EdgeVertices::new(tree.preset().cells);
            let tolerance = 2.0 * f32::EPSILON * (size / 2.0) as f32;
            for _ in 0..25 {
                tree.select(random.viewer(), &[Frustum::everywhere()]);
                check_seams(&tree, &edges, |a, b| (a - b).abs().max_element() <= tolerance);
            }
        }
    }
}

/// The whole mesh: sides of triangles cancel against sides run the other way round, but for the border's.
/// (Triangles that the slide has closed to a line cancel against themselves.)
#[test]
fn the_mesh_is_a_sheet_without_holes() {
    let mut random = Random(3);
    for quality in QUALITIES {
        let mut tree = tree(2048.0, quality, None);
        let cells = tree.preset().cells;
        let patterns: Vec<Vec<u16>> = Pattern::all().map(|pattern| grid::indices(cells, pattern)).collect();
        for _ in 0..2 {
            let selection = tree.select(random.viewer(), &[Frustum::everywhere()]);
            let mut sides: HashMap<[[u32; 2]; 2], i32> = HashMap::new();
            let mut area = 0.0;
            for leaf in selection.leaves() {
                let instance = instance_of(selection, leaf);
                for triangle in patterns[leaf.pattern.index()].chunks_exact(3) {
                    let corners = [0, 1, 2].map(|k| {
                        let v = u32::from(triangle[k]);
                        vertex_position(instance, leaf.pattern, cells, v % (cells + 1), v / (cells + 1))
                    });
                    let [a, b, c] = corners.map(|p| p.as_dvec2());
                    let doubled = -(b - a).perp_dot(c - a);
                    assert!(doubled >= 0.0, "turned over: {leaf:?} {corners:?}");
                    area += doubled / 2.0;
                    for (from, to) in [(0, 1), (1, 2), (2, 0)] {
                        let key =
                            [corners[from], corners[to]].map(|p| (p + 0.0).to_array().map(f32::to_bits));
                        if key[0] != key[1] {
                            *sides.entry(key).or_default() += 1;
                        }
                    }
                }
            }
            assert!((area - tree.size() * tree.size()).abs() < 1e-6 * area, "{area}");
            let half = (tree.size() / 2.0) as f32;
            for (&[from, to], &count) in &sides {
                let back = sides.get(&[to, from]).copied().unwrap_or(0);
                let ends = [from, to].map(|p| p.map(f32::from_bits));
                let on_border = [0, 1]
                    .into_iter()
                    .any(|axis| ends[0][axis].abs() == half && ends[0][axis] == ends[1][axis]);
                assert_eq!((count - back).abs(), i32::from(on_border), "{ends:?}");
            }
        }
    }
}
