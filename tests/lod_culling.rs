//! Nothing that may be seen is culled; most of what cannot be seen is.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod lod_support;
use glam::{DVec3, Mat4, Quat, Vec3, Vec4, dvec3, vec3};
use lod_support::{QUALITIES, Random, settings};
use swell::lod::{Frustum, LodSettings, Quadtree};

/// An OpenXR-like projection: tangents of the four half angles, reverse-Z, infinite far plane, y down.
fn projection(left: f32, right: f32, down: f32, up: f32, near: f32) -> Mat4 {
    let (width, height) = (right - left, up - down);
    Mat4::from_cols(
        Vec4::new(2.0 / width, 0.0, 0.0, 0.0),
        Vec4::new(0.0, -2.0 / height, 0.0, 0.0),
        Vec4::new((right + left) / width, -(up + down) / height, 0.0, -1.0),
        Vec4::new(0.0, 0.0, near, 0.0),
    )
}

fn random_view(random: &mut Random, eye_offset: f32) -> Mat4 {
    let mut tangent = || random.between(0.3, 1.4) as f32;
    let projection = projection(-tangent(), tangent(), -tangent(), tangent(), 0.1);
    let yaw = Quat::from_rotation_y(random.between(-3.2, 3.2) as f32);
    let pitch = Quat::from_rotation_x(random.between(-1.5, 0.8) as f32);
    let roll = Quat::from_rotation_z(random.between(-0.4, 0.4) as f32);
    let pose = Mat4::from_rotation_translation(yaw * pitch * roll, yaw * vec3(eye_offset, 0.0, 0.0));
    projection * pose.inverse()
}

/// Inside by the rasteriser's own rule.
fn projects_inside(view_projection: Mat4, position: Vec3) -> bool {
    let clip = view_projection * position.extend(1.0);
    clip.w > 0.0 && clip.x.abs() <= clip.w && clip.y.abs() <= clip.w && (0.0..=clip.w).contains(&clip.z)
}

fn random_settings(random: &mut Random, case: usize) -> LodSettings {
    let base = settings([512.0, 4096.0, 8192.0][case % 3], QUALITIES[case % 4], None);
    LodSettings { max_height: Some(random.between(0.0, 25.0)), reach: random.between(0.0, 40.0), ..base }
}

#[test]
fn no_patch_with_a_visible_point_is_culled() {
    let mut random = Random(41);
    let (mut seen, mut drawn, mut leaves) = (0, 0, 0);
    for case in 0..240 {
        let settings = random_settings(&mut random, case);
        let mut tree = Quadtree::new(&settings).unwrap();
        for _ in 0..4 {
            let mut eye = random.viewer();
            eye.y = 10.0_f64.powf(random.between(0.0, 2.0));
            let views = [random_view(&mut random, -0.03), random_view(&mut random, 0.03)];
            tree.select(eye, &views.map(Frustum::from_view_projection));
            let selection = tree.selection();
            let origin = selection.origin();
            drawn += selection.instances().len();
            leaves += selection.leaves().len();
            for leaf in selection.leaves() {
                let (centre, size) = (leaf.node.centre(tree.size()), leaf.node.size(tree.size()));
                for _ in 0..60 {
                    // Corners and faces of what the patch may cover, where a wrong box shows first.
                    let mut extreme = |half: f64| match random.below(3) {
                        0 => half,
                        1 => -half,
                        _ => random.between(-half, half),
                    };
                    let point = dvec3(
                        origin.x + centre.x + extreme(0.5 * size) + extreme(settings.reach),
                        extreme(settings.height_bound()),
                        origin.y + centre.y + extreme(0.5 * size) + extreme(settings.reach),
                    );
                    let relative = (point - eye).as_vec3();
                    if views.iter().any(|&view| projects_inside(view, relative)) {
                        seen += 1;
                        assert!(
                            leaf.instance.is_some(),
                            "{leaf:?} culled though {point} is in view from {eye}"
                        );
                    }
                }
            }
        }
    }
    assert!(seen > 10_000, "{seen}");
    assert!(drawn * 10 < leaves * 7, "culling leaves {drawn} of {leaves}");
}

#[test]
fn a_patch_behind_both_eyes_is_dropped() {
    let mut tree = Quadtree::new(&settings(4096.0, QUALITIES[2], None)).unwrap();
    let ahead = Frustum::from_view_projection(projection(-1.0, 1.0, -1.0, 1.0, 0.1));
    let eye = dvec3(0.0, 2.0, 0.0);
    let selection = tree.select(eye, &[ahead, ahead]);
    for leaf in selection.leaves() {
        let nearest_row = leaf.node.centre(4096.0).y - leaf.node.size(4096.0);
        assert!(nearest_row < 10.0 || leaf.instance.is_none(), "{leaf:?} is behind");
    }
    assert!(selection.instances().len() < selection.leaves().len() / 2 + 8);
    assert!(tree.select(eye, &[]).instances().is_empty(), "no view sees anything");
}

#[test]
fn planes_agree_with_the_matrix() {
    let mut random = Random(42);
    for _ in 0..300 {
        let view = random_view(&mut random, 0.0);
        let frustum = Frustum::from_view_projection(view);
        for _ in 0..100 {
            let point = vec3(
                random.between(-500.0, 500.0) as f32,
                random.between(-50.0, 50.0) as f32,
                random.between(-500.0, 500.0) as f32,
            );
            let clip = view * point.extend(1.0);
            let margin = (clip.w - clip.x.abs()).min(clip.w - clip.y.abs()).min(clip.w - clip.z);
            if margin.abs() > 0.01 {
                assert_eq!(frustum.keeps(point, Vec3::ZERO), margin > 0.0, "{point}");
            }
        }
        assert!(Frustum::everywhere().keeps(DVec3::splat(1.0e9).as_vec3(), Vec3::ZERO));
    }
}
