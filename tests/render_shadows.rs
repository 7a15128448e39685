//! Shadows fall where rays towards the sun meet something, and change nothing elsewhere.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use glam::{DVec3, Mat3, Vec3};
use support::picture::Picture;
use support::stage::{Stage, eye, seen_at, shipped};
use swell::draw::{Eye, Fov, Look, Shape, Solid};
use swell::lod::Quality;
use swell::scene::{Scene, Shadows};
use swell::sea::{Query, Sea};

const TIME: f64 = 12.5;
const SIZE: [u32; 2] = [240, 160];
/// So little wind that the sea is a plane.
const STILL: &str = "[sea]\nwind_speed = 0.5\nresolution = 64\n";
/// Waves that the mesh carries whole, under water as white as paper, which shows light as it falls.
const WHITE: &str = "[sea]\nwind_speed = 14\nresolution = 64\npatch_size = 160\nseed = 2\namplitude = 1.5\n[sea.foam]\nthreshold = 4\n\
                     [lod]\nsize = 512\nlevels = 5\nquality = \"high\"\n[water]\ndeep_color = [0.7, 0.7, 0.7]\n";
/// The same of formulas: waves that run towards the sun and across it.
const WHITE_FORMULAS: &str = "[sea]\nmodel = 'waves'\n[[sea.wave]]\nkind = 'gerstner'\nwavelength = 26\nsteepness = 0.3\n\
                              direction_deg = 50\n[[sea.wave]]\nkind = 'peaked'\nwavelength = 19\namplitude = 0.4\n\
                              direction_deg = -40\nsharpness = 2\n[[layer]]\n[[layer.wave]]\nwavelength = 11\namplitude = 0.2\n\
                              [lod]\nsize = 512\nlevels = 5\nquality = \"high\"\n[water]\ndeep_color = [0.7, 0.7, 0.7]\n";

/// `text` under a sun at these angles, degrees, without and with shadows.
fn both(text: &str, azimuth: f64, elevation: f64) -> [Scene; 2] {
    let text = format!("{text}[sky]\nsun_azimuth_deg = {azimuth}\nsun_elevation_deg = {elevation}\n");
    let off = Scene::parse(&text, "test.toml").unwrap();
    let mut on = off.clone();
    on.water.shadows.shadows = Shadows::On;
    [off, on]
}

fn towards_sun(scene: &Scene) -> DVec3 {
    let (azimuth, elevation) = (scene.sky.sun_azimuth, scene.sky.sun_elevation);
    DVec3::new(azimuth.cos() * elevation.cos(), elevation.sin(), -azimuth.sin() * elevation.cos())
}

/// All channels of a pixel together.
fn light(picture: &Picture, [x, y]: [f64; 2]) -> i32 {
    picture.pixel(x as u32, y as u32).iter().map(|&channel| i32::from(channel)).sum()
}

fn solid(shape: Shape, position: DVec3, size: Vec3) -> Solid {
    Solid { shape, position, axes: Mat3::IDENTITY, size, color: [0.6; 3], lead: 0.0 }
}

#[test]
fn water_is_dark_where_a_ray_to_the_sun_meets_a_crest_and_as_before_elsewhere() {
    follows_rays(&both(WHITE, 65.0, 4.0));
}

#[test]
fn formulas_shade_each_other_as_spectral_waves_do() {
    follows_rays(&both(WHITE_FORMULAS, 65.0, 4.0));
}

/// Without and with shadows.
fn follows_rays(scenes: &[Scene; 2]) {
    let mut scenes = scenes.clone();
    for scene in &mut scenes {
        (scene.sky.sun_intensity, scene.sky.exposure) = (8.0, -1.0);
    }
    let mut sea = Sea::new(&scenes[0].sea).unwrap();
    let mut maps = sea.new_maps();
    sea.step(TIME, &mut maps).unwrap();
    let query = Query::new(&maps);
    let sun = towards_sun(&scenes[0]);
    let size = [480, 320];
    let [off, on] = scenes.map(|scene| {
        let mut stage = Stage::new(&scene, size, 1, Look::Water, TIME);
        let fov = Fov::symmetric(1.0, stage.aspect());
        let from = eye(DVec3::new(0.0, 45.0, 30.0), [0.0, -1.1, 0.0], fov);
        (stage.picture(TIME, &[from]), from)
    });
    let (from, mut shaded, mut lit) = (on.1, [0; 2], [0; 2]);
    for row in 0..40 {
        for column in 0..40 {
            let surface = query.above(f64::from(column) - 20.0, f64::from(row) - 20.0);
            let point = DVec3::from(surface.position);
            let pixel = seen_at(&from, size, point).0;
            assert!((0.0..480.0).contains(&pixel[0]) && (0.0..320.0).contains(&pixel[1]), "{pixel:?}");
            // By how much the highest wave on the way stands above the ray; the point's own slope is not meant.
            let above = (8..400).map(|step| {
                let ray = point + sun * 0.25 * f64::from(step);
                query.above(ray.x, ray.z).height() - ray.y
            });
            let most = above.fold(f64::NEG_INFINITY, f64::max);
            let (before, after) = (light(&off.0, pixel), light(&on.0, pixel));
            // Faces turned away from the sun have nothing to lose.
            if DVec3::from(surface.normal).dot(sun) < 0.05 {
                continue;
            }
            if most > 0.15 {
                shaded[usize::from(after < before - 8)] += 1;
            } else if most < -0.15 {
                lit[usize::from((after - before).abs() <= 3)] += 1;
            }
        }
    }
    assert!(shaded[1] > 50 && shaded[0] * 50 < shaded[1], "in shadow: {shaded:?} as bright, darker");
    assert!(lit[1] > 300 && lit[0] * 50 < lit[1], "in the sun: {lit:?} changed, as before");
}

#[test]
fn a_ball_throws_its_shadow_along_the_suns_rays_in_both_views_and_far_away() {
    let sun = towards_sun(&both(STILL, 200.0, 40.0)[0]);
    for away in [0.0, 1.0e6] {
        let deck = solid(Shape::Box, DVec3::new(away, 1.0, -20.0 - away), Vec3::new(16.0, 1.0, 16.0));
        let spot = deck.position + DVec3::new(1.0, 0.5, 2.0);
        let ball = solid(Shape::Sphere, spot + 4.0 * sun, Vec3::splat(1.5));
        let middle = eye(spot + DVec3::new(0.0, 9.0, 12.0), [0.0, -0.7, 0.0], Fov::symmetric(0.9, 1.5));
        let eyes =
            [-0.0315, 0.0315].map(|shift| Eye { position: middle.position + DVec3::X * shift, ..middle });
        let [off, on] = both(STILL, 200.0, 40.0).map(|scene| {
            let mut stage = Stage::new(&scene, SIZE, 2, Look::Water, TIME);
            stage.host.set_scenery(&[deck, ball], 0.0);
            stage.picture(TIME, &eyes)
        });
        for view in 0..2 {
            let (off, on) = (off.part(view, 2), on.part(view, 2));
            let (mut sum, mut count) = ([0.0; 2], 0.0);
            for y in 0..SIZE[1] {
                for x in 0..SIZE[0] {
                    let place = [f64::from(x) + 0.5, f64::from(y) + 0.5];
                    let near = (0..2).all(|axis| {
                        (place[axis] - seen_at(&eyes[view as usize], SIZE, spot).0[axis]).abs() < 25.0
                    });
                    if near && light(&on, place) < light(&off, place) - 30 {
                        sum = [sum[0] + place[0], sum[1] + place[1]];
                        count += 1.0;
                    }
                }
            }
            let (wanted, depth) = seen_at(&eyes[view as usize], SIZE, spot);
            let error = (sum[0] / count - wanted[0]).hypot(sum[1] / count - wanted[1]);
            assert!(count > 50.0 && error < 1.0, "view {view}, {depth} m: {count} pixels, {error} off");
        }
    }
}

#[test]
fn nothing_changes_under_a_sun_in_the_zenith() {
    let [off, on] = both(STILL, 0.0, 90.0).map(|scene| {
        let mut stage = Stage::new(&scene, SIZE, 1, Look::Water, TIME);
        let fov = Fov::symmetric(1.0, stage.aspect());
        stage.picture(TIME, &[eye(DVec3::new(0.0, 2.0, 0.0), [0.3, -0.3, 0.0], fov)])
    });
    let most = off.rgb.iter().zip(&on.rgb).map(|(a, b)| a.abs_diff(*b)).max();
    assert!(most <= Some(1), "{most:?} levels");
}

#[test]
fn shadows_end_at_their_distance() {
    let [off, on] = both(STILL, 200.0, 40.0).map(|mut scene| {
        scene.water.shadows.distance = 10.0;
        let mut stage = Stage::new(&scene, SIZE, 1, Look::Water, TIME);
        let fov = Fov::symmetric(1.0, stage.aspect());
        let deck = solid(Shape::Box, DVec3::new(0.0, 1.0, -16.0), Vec3::new(8.0, 1.0, 8.0));
        let ball = solid(Shape::Sphere, deck.position + DVec3::Y * 1.5, Vec3::ONE);
        stage.host.set_scenery(&[deck, ball], 0.0);
        stage.picture(TIME, &[eye(DVec3::new(0.0, 4.0, 0.0), [0.0, -0.2, 0.0], fov)])
    });
    let most = off.rgb.iter().zip(&on.rgb).map(|(a, b)| a.abs_diff(*b)).max();
    assert!(most <= Some(1), "{most:?} levels");
}

#[test]
fn only_water_by_day_has_a_map_and_another_quality_keeps_it() {
    let draws = |scene: &Scene, look| {
        let mut stage = Stage::new(scene, SIZE, 1, look, TIME);
        stage.frame(TIME, &[]);
        (stage.counts.draws, stage.counts.triangles)
    };
    let mut scene = shipped("calm");
    let plain = draws(&scene, Look::Water);
    let height = draws(&scene, Look::Height);
    scene.water.shadows.shadows = Shadows::On;
    assert_eq!(draws(&scene, Look::Height), height);
    let shadowed = draws(&scene, Look::Water);
    assert!(shadowed.0 > plain.0 && shadowed.1 > plain.1, "{shadowed:?} after {plain:?}");
    let coarse =
        Scene { lod: swell::lod::LodSettings { quality: Quality::Low, ..scene.lod }, ..scene.clone() };
    assert!(draws(&coarse, Look::Water).1 < shadowed.1);
    scene.sky.sun_elevation = -0.08;
    assert_eq!(draws(&scene, Look::Water).0, plain.0, "there is no sun that could cast shadows");
}
