//! Viewers and settings at the ends of their ranges, batches, and memory.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod lod_support;
use glam::{DVec2, DVec3, dvec3};
use lod_support::{QUALITIES, Random, settings, tree, trees};
use swell::lod::{
    Frustum, Instance, LodError, LodSettings, MAX_BATCH, Node, Quadtree, Quality, level_color, snap_origin,
    snap_step,
};

const ALL: [Frustum; 1] = [Frustum::everywhere()];

#[test]
fn levels_follow_equation_56() {
    let levels = |size| settings(size, Quality::High, None).level_count();
    let sizes = [256.0, 362.0, 363.0, 512.0, 1024.0, 2048.0, 4096.0, 5792.0, 5793.0, 8192.0];
    assert_eq!(sizes.map(levels), [2, 2, 3, 3, 4, 5, 6, 6, 7, 7]);
    assert_eq!(settings(256.0, Quality::High, Some(8)).level_count(), 8);
}

#[test]
fn settings_out_of_range_are_named() {
    let good = settings(1024.0, Quality::Low, None);
    let bad = [
        ("size", LodSettings { size: 255.0, ..good }),
        ("size", LodSettings { size: f64::NAN, ..good }),
        ("levels", LodSettings { levels: Some(0), ..good }),
        ("levels", LodSettings { levels: Some(11), ..good }),
        ("max_height", LodSettings { max_height: Some(-1.0), ..good }),
        ("reach", LodSettings { reach: f64::INFINITY, ..good }),
        ("skirt_extent", LodSettings { skirt_extent: 0.5, ..good }),
    ];
    for (name, settings) in bad {
        let LodError::OutOfRange { key, .. } = Quadtree::new(&settings).unwrap_err();
        assert_eq!(key, name);
    }
    let message = Quadtree::new(&LodSettings { size: 9000.0, ..good }).unwrap_err().to_string();
    assert_eq!(message, "building the quadtree: `size` is 9000; give a value in 256..=8192");
}

#[test]
fn the_origin_snaps_to_level_one() {
    let mut random = Random(61);
    for _ in 0..10_000 {
        let eye = random.viewer();
        let step = snap_step(8192.0, 64);
        assert_eq!(step, 64.0);
        let origin = snap_origin(eye, 8192.0, 64);
        assert_eq!(origin % step, DVec2::ZERO);
        let away = DVec2::new(eye.x, eye.z) - origin;
        assert!(away.min_element() >= 0.0 && away.max_element() < step);
    }
    assert_eq!(snap_origin(dvec3(-0.5, 9.0, 64.0), 8192.0, 64), DVec2::new(-64.0, 64.0));
}

/// A million metres out, a whole number of steps away, the same patches are drawn.
#[test]
fn selection_is_the_same_far_from_the_world_origin() {
    for quality in QUALITIES {
        let mut tree = tree(4096.0, quality, None);
        let step = snap_step(4096.0, tree.preset().cells);
        let far = dvec3(step * 31_250.0, 0.0, -step * 31_250.0);
        let eye = dvec3(3.25, 4.0, 1.5);
        let near = tree.select(eye, &ALL).clone();
        let there = tree.select(eye + far, &ALL);
        assert_eq!(near.instances(), there.instances());
        assert_eq!(there.origin() - near.origin(), DVec2::new(far.x, far.z));
    }
}

#[test]
fn from_high_above_the_root_is_one_patch() {
    let mut tree = tree(1024.0, Quality::Low, None);
    let selection = tree.select(dvec3(0.0, 1.0e6, 0.0), &ALL);
    let whole = Instance { size: 1024.0, ..Instance::default() };
    assert_eq!(selection.instances(), [whole]);
    assert_eq!(selection.leaves()[0].node, Node::ROOT);
    assert_eq!(tree.select(dvec3(0.0, 1.0e300, 0.0), &ALL).instances().len(), 1);
}

#[test]
fn a_viewer_on_a_node_centre_divides_it_to_the_finest() {
    for quality in QUALITIES {
        let mut tree = tree(2048.0, quality, None);
        tree.select(dvec3(0.0, 0.0, 0.0), &ALL);
        let finest = u32::from(tree.map().level_at(16, 16));
        assert_eq!((tree.levels(), finest), (5, 5));
    }
}

#[test]
fn an_eye_that_is_no_number_keeps_the_latest_view() {
    let mut tree = tree(1024.0, Quality::Medium, None);
    let good = tree.select(dvec3(1234.0, 3.0, -77.0), &ALL).clone();
    for bad in [DVec3::NAN, dvec3(f64::INFINITY, 0.0, 0.0), dvec3(0.0, f64::NAN, 0.0)] {
        let selection = tree.select(bad, &ALL);
        assert_eq!((selection.origin(), selection.instances()), (good.origin(), good.instances()));
    }
    let mut fresh = lod_support::tree(1024.0, Quality::Medium, None);
    assert!(!fresh.select(DVec3::NAN, &ALL).instances().is_empty());
}

/// Leaves tile the root, instances say what leaves say, and batches hold each instance once.
#[test]
fn batches_hold_every_leaf_once() {
    let mut random = Random(62);
    for mut tree in trees() {
        for _ in 0..20 {
            tree.select(random.viewer(), &ALL);
            let selection = tree.selection();
            let mut covered = 0.0;
            for leaf in selection.leaves() {
                let index = leaf.instance.unwrap();
                assert!(selection.range(leaf.pattern.index()).contains(&index));
                let instance = &selection.instances()[index as usize];
                let centre = leaf.node.centre(tree.size());
                assert_eq!((instance.centre_x, instance.centre_z), (centre.x as f32, centre.y as f32));
                assert_eq!(instance.size, leaf.node.size(tree.size()) as f32);
                covered += f64::from(instance.size).powi(2);
            }
            assert!((covered / tree.size().powi(2) - 1.0).abs() < 1e-9);
            let mut next = 0;
            for batch in selection.batches() {
                assert_eq!(batch.instances.start, next);
                assert!((1..=MAX_BATCH).contains(&(batch.instances.len() as u32)));
                next = batch.instances.end;
            }
            assert_eq!(next as usize, selection.instances().len());
        }
    }
}

/// What is reserved at first is enough for any viewer: nothing moves in memory.
#[test]
fn memory_is_reserved_once() {
    let mut random = Random(63);
    for mut tree in trees() {
        tree.select(DVec3::ZERO, &ALL);
        let places = |tree: &Quadtree| {
            let selection = tree.selection();
            (selection.instances().as_ptr(), selection.leaves().as_ptr(), tree.map().divided().as_ptr())
        };
        let first = places(&tree);
        for _ in 0..300 {
            tree.select(random.viewer(), &ALL);
            assert_eq!(places(&tree), first);
        }
    }
}

#[test]
fn levels_have_colours_of_their_own() {
    let colors: Vec<[f32; 3]> = (0..=8).map(level_color).collect();
    for (k, a) in colors.iter().enumerate() {
        assert!(a.iter().all(|c| (0.0..=1.0).contains(c)));
        for b in &colors[..k] {
            let apart: f32 = a.iter().zip(b).map(|(p, q)| (p - q).powi(2)).sum();
            assert!(apart > 0.02, "{a:?} {b:?}");
        }
    }
    assert_eq!(std::mem::size_of::<Instance>(), 32);
}
