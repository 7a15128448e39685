//! The drawn distance between vertices against what the shader is told.
mod lod_support;
use glam::{DVec3, dvec3};
use lod_support::{QUALITIES, Random, tree};
use swell::lod::{
    Edge, Frustum, Instance, Pattern, Quality, vertex_position, vertex_spacing, vertex_spacing_bound,
};

/// Least distance of vertex (i, j), i odd, and its neighbours along x from the viewer, and the extent along x of the edges between them.
fn edges_along_x(
    instance: &Instance,
    pattern: Pattern,
    cells: u32,
    at: (u32, u32),
    eye: DVec3,
) -> (f64, Vec<f64>) {
    let (i, j) = at;
    let stitched = (j == 0 && pattern.has(Edge::South)) || (j == cells && pattern.has(Edge::North));
    let numbers = if stitched { vec![i - 1, i + 1] } else { vec![i - 1, i, i + 1] };
    let points: Vec<_> = numbers.iter().map(|&i| vertex_position(instance, pattern, cells, i, j)).collect();
    let distance = |x: f32, z: f32| dvec3(f64::from(x) - eye.x, eye.y, f64::from(z) - eye.z).length();
    let nearest = points.iter().map(|p| distance(p.x, p.y)).fold(f64::INFINITY, f64::min);
    (nearest, points.windows(2).map(|pair| f64::from((pair[1].x - pair[0].x).abs())).collect())
}

#[test]
fn no_edge_exceeds_the_bound_and_few_the_estimate() {
    let mut random = Random(21);
    for quality in QUALITIES {
        let (mut edges, mut longer, mut far_shorter) = (0, 0, 0);
        for size in [1024.0, 8192.0] {
            let mut tree = tree(size, quality, None);
            let (preset, finest, coarsest) = (tree.preset(), tree.finest_spacing(), tree.coarsest_spacing());
            for _ in 0..500 {
                let eye = random.viewer();
                let selection = tree.select(eye, &[Frustum::everywhere()]);
                let origin = selection.origin();
                let eye = eye - dvec3(origin.x, 0.0, origin.y);
                for leaf in selection.leaves() {
                    let Some(index) = leaf.instance else { continue };
                    let instance = &selection.instances()[index as usize];
                    let cells = u64::from(preset.cells);
                    let at = (random.below(cells / 2) as u32 * 2 + 1, random.below(cells + 1) as u32);
                    let (distance, lengths) = edges_along_x(instance, leaf.pattern, preset.cells, at, eye);
                    let bound = vertex_spacing_bound(distance, preset, finest, coarsest);
                    let estimate = vertex_spacing(distance, preset, finest, coarsest);
                    for &length in &lengths {
                        assert!(length <= bound * 1.0001, "{quality:?} {length} > {bound} at {distance}");
                        edges += 1;
                        longer += usize::from(length > estimate * 1.0001);
                    }
                    // The longer one: the other may have closed.
                    let longest = lengths.into_iter().fold(0.0, f64::max);
                    far_shorter += usize::from(longest < estimate / 4.0);
                }
            }
        }
        assert!(longer * 100 <= edges * 3, "{quality:?}: {longer} of {edges} edges are longer");
        assert!(far_shorter * 10 <= edges, "{quality:?}: {far_shorter} of {edges} edges are far shorter");
    }
}

#[test]
fn spacing_grows_with_distance_between_its_limits() {
    let preset = Quality::Ultra.preset();
    for spacing in [vertex_spacing, vertex_spacing_bound] {
        assert_eq!(spacing(0.0, preset, 0.5, 64.0), 0.5);
        assert_eq!(spacing(1.0e9, preset, 0.5, 64.0), 64.0);
        let values: Vec<f64> = (0..1000).map(|d| spacing(f64::from(d * 10), preset, 0.5, 64.0)).collect();
        assert!(values.is_sorted());
    }
    assert_eq!(vertex_spacing(640.0, preset, 0.5, 64.0), 10.0);
}
