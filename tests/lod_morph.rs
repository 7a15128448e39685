//! Nothing pops: where a node is divided or joined, the drawn triangles before and after are the same ones.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod lod_support;
use glam::{DVec3, dvec3};
use lod_support::{QUALITIES, Random, tree};
use std::collections::BTreeSet;
use swell::lod::{
    Frustum, Instance, Node, Pattern, Quadtree, Ranges, SubdivisionMap, grid, snap_step, vertex_position,
};

type Triangle = [[u32; 2]; 3];

/// What one viewer draws, and which nodes were divided for balance alone.
struct Drawn {
    leaves: Vec<(Node, Pattern, Instance)>,
    divided: BTreeSet<Node>,
    forced: BTreeSet<Node>,
}

impl Drawn {
    fn new(tree: &mut Quadtree, viewer: DVec3) -> Self {
        tree.select(viewer, &[Frustum::everywhere()]);
        let ranges = Ranges::new(viewer, tree.size(), tree.preset().lod_scale);
        let selection = tree.selection();
        assert_eq!(selection.origin(), glam::DVec2::ZERO, "viewers stay within one step of the snap");
        let instance = |index: u32| selection.instances()[index as usize];
        let leaf = |leaf: &swell::lod::Leaf| Some((leaf.node, leaf.pattern, instance(leaf.instance?)));
        let map: &SubdivisionMap = tree.map();
        let divided: BTreeSet<Node> = map.divided().iter().copied().collect();
        let forced = divided.iter().copied().filter(|&node| !ranges.divides(node)).collect();
        Self { leaves: selection.leaves().iter().filter_map(leaf).collect(), divided, forced }
    }

    /// Triangles with an area, of the leaves that `other` does not draw alike, each starting at its lowest corner.
    fn triangles_unlike(&self, other: &Self, patterns: &[Vec<u16>], cells: u32) -> BTreeSet<Triangle> {
        let mut triangles = BTreeSet::new();
        for (node, pattern, instance) in self.leaves.iter().filter(|leaf| !other.leaves.contains(leaf)) {
            assert!(instance.size > 0.0, "{node:?}");
            for corners in patterns[pattern.index()].chunks_exact(3) {
                let mut triangle = [0, 1, 2].map(|k| {
                    let v = u32::from(corners[k]);
                    let p = vertex_position(instance, *pattern, cells, v % (cells + 1), v / (cells + 1));
                    (p + 0.0).to_array().map(f32::to_bits)
                });
                let [a, b, c] = triangle;
                if a != b && b != c && c != a {
                    let lowest = (0..3).min_by_key(|&k| triangle[k]).unwrap();
                    triangle.rotate_left(lowest);
                    triangles.insert(triangle);
                }
            }
        }
        triangles
    }
}

/// The two points on the way from `a` to `b`, as near as numbers allow, between which `node` is divided or joined.
fn crossing(tree: &Quadtree, node: Node, a: DVec3, b: DVec3) -> (DVec3, DVec3) {
    let divides = |p: DVec3| Ranges::new(p, tree.size(), tree.preset().lod_scale).divides(node);
    let at_start = divides(a);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if divides(a.lerp(b, middle)) == at_start { low = middle } else { high = middle }
    }
    (a.lerp(b, low), a.lerp(b, high))
}

/// True when nodes were forced near `node`: within its parent's reach.
fn forced_nearby(drawn: &Drawn, node: Node, size: f64) -> bool {
    drawn.forced.iter().any(|&forced| {
        let apart = (forced.centre(size) - node.centre(size)).abs().max_element();
        apart < 0.5 * forced.size(size) + 2.0 * node.size(size)
    })
}

#[test]
fn dividing_a_node_changes_no_triangle() {
    let mut random = Random(51);
    for quality in QUALITIES {
        let mut tree = tree(4096.0, quality, None);
        let (size, cells) = (tree.size(), tree.preset().cells);
        let patterns: Vec<Vec<u16>> = Pattern::all().map(|pattern| grid::indices(cells, pattern)).collect();
        let step = snap_step(size, cells);
        let (mut clean, mut beside_forced, mut popped) = (0, 0, 0);
        for _ in 0..(if cells == 64 { 300 } else { 60 }) {
            let height = 10.0_f64.powf(random.between(0.0, 2.5));
            let mut place = |height| dvec3(random.between(0.0, step), height, random.between(0.0, step));
            let (a, b) = (place(height), place(height * 1.2));
            let ends = [a, b].map(|viewer| Drawn::new(&mut tree, viewer).divided);
            for &node in ends[0].symmetric_difference(&ends[1]) {
                let (before, after) = crossing(&tree, node, a, b);
                let drawn = [before, after].map(|viewer| Drawn::new(&mut tree, viewer));
                let changed: Vec<_> = drawn[0].divided.symmetric_difference(&drawn[1].divided).collect();
                if changed.is_empty() {
                    continue;
                }
                let same = drawn[0].triangles_unlike(&drawn[1], &patterns, cells)
                    == drawn[1].triangles_unlike(&drawn[0], &patterns, cells);
                if changed == [&node] && !drawn.iter().any(|drawn| forced_nearby(drawn, node, size)) {
                    assert!(same, "{quality:?}: {node:?} pops at {before}");
                    clean += 1;
                } else {
                    beside_forced += 1;
                    popped += usize::from(!same);
                }
            }
        }
        println!(
            "{quality:?}: clean {clean}, beside forced splits {beside_forced}, of which change {popped}"
        );
        assert!(clean > 10 && clean + beside_forced > 60, "{quality:?}: {clean} {beside_forced}");
        assert_eq!(popped, 0, "{quality:?}: beside forced splits");
    }
}

/// A node's children do not slide while one of them is divided: the two slides never overlap.
#[test]
fn a_slide_is_over_before_the_next_begins() {
    let mut random = Random(52);
    let (mut divided_child, mut sliding) = (0, 0);
    for _ in 0..200_000 {
        let tau = [1.0, 1.2, 1.5, 2.0][random.below(4) as usize];
        let node = Node { level: 3, x: 4, y: 4 };
        let mut place = || random.between(-300.0, 300.0);
        let viewer = dvec3(place(), place().abs(), place());
        let ranges = Ranges::new(viewer, 1024.0, tau);
        let weight = ranges.morph(node);
        if node.children().into_iter().any(|child| ranges.divides(child)) {
            assert_eq!(weight, 0.0, "tau {tau}, viewer {viewer}");
            divided_child += 1;
        }
        if !ranges.divides(node) {
            assert_eq!(weight, 1.0);
        }
        sliding += usize::from(weight > 0.0 && weight < 1.0);
    }
    assert!(divided_child > 1_000 && sliding > 1_000, "{divided_child} {sliding}");
}

/// The weight follows the viewer without a jump of more than its own step.
#[test]
fn weights_follow_the_viewer() {
    let node = Node { level: 2, x: 2, y: 2 };
    for tau in [1.0, 1.2, 1.5, 2.0] {
        let weights: Vec<f32> = (0..40_000)
            .map(|k| Ranges::new(dvec3(f64::from(k) * 0.05, 3.0, 100.0), 4096.0, tau).morph(node))
            .collect();
        let largest = weights.windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f32::max);
        assert!(largest <= 1.0 / 256.0, "{largest}");
    }
}
