//! Things that float: where they are drawn, what hides them, how they are lit.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use glam::{DVec3, Mat3, Vec3};
use support::picture::Picture;
use support::stage::{Stage, eye, seen_at, shipped};
use swell::draw::{Buoy, Eye, Fov, Look, MOST_SOLIDS, Pose, Raft, Shape, Solid};
use swell::host::marker;
use swell::raft::BuoySettings;
use swell::scene::Scene;
use swell::sea::Sea;

const TIME: f64 = 12.5;
const SIZE: [u32; 2] = [240, 160];
/// So little wind that the sea is a plane.
const STILL: &str =
    "[sea]\nwind_speed = 0.5\nresolution = 64\n[sky]\nsun_elevation_deg = 40\nsun_azimuth_deg = 0\n";

fn still() -> Scene {
    Scene::parse(STILL, "still.toml").unwrap()
}

fn ball(position: DVec3, diameter: f32) -> Solid {
    let size = Vec3::splat(diameter);
    Solid { shape: Shape::Sphere, position, axes: Mat3::IDENTITY, size, color: [0.7, 0.05, 0.02], lead: 0.0 }
}

/// Pixels of one view that the solids change, (x, y).
fn changed(before: &Picture, after: &Picture) -> Vec<(u32, u32)> {
    let pixels = (0..after.size[1]).flat_map(|y| (0..after.size[0]).map(move |x| (x, y)));
    pixels.filter(|&(x, y)| before.pixel(x, y) != after.pixel(x, y)).collect()
}

/// A headset's eyes at `middle`.
fn pair(middle: DVec3) -> [Eye; 2] {
    let both = eye(middle, [0.3, -0.1, 0.05], Fov::symmetric(1.0, 1.0));
    let right = both.axes.x_axis.as_dvec3();
    let fov = |left, right| Fov { left, right, up: 0.7, down: -0.8 };
    [(-0.0315, fov(-1.0, 0.75)), (0.0315, fov(-0.75, 1.0))].map(|(shift, fov)| Eye {
        position: middle + right * shift,
        fov,
        ..both
    })
}

#[test]
fn a_ball_is_where_its_position_says_in_both_views_and_far_away() {
    let mut stage = Stage::new(&shipped("open_ocean"), SIZE, 2, Look::Water, TIME);
    for away in [0.0, 1.0e6] {
        let eyes = pair(DVec3::new(2.0 + away, 9.0, 5.0 - away));
        stage.host.set_scenery(&[], 0.0);
        let without = stage.picture(TIME, &eyes);
        for distance in [5.0, 20.0, 50.0] {
            // High enough above the sea that nothing hides it.
            let centre = eyes[0].position + distance * DVec3::new(-0.25, 0.0, -1.0);
            let diameter = 0.1 * distance;
            stage.host.set_scenery(&[ball(centre, diameter as f32)], 0.0);
            let with = stage.picture(TIME, &eyes);
            for view in 0..2 {
                let pixels = changed(&without.part(view, 2), &with.part(view, 2));
                let count = pixels.len() as f64;
                let sum = pixels.iter().fold([0.0; 2], |sum, &(x, y)| {
                    [sum[0] + f64::from(x) + 0.5, sum[1] + f64::from(y) + 0.5]
                });
                let (wanted, depth) = seen_at(&eyes[view as usize], SIZE, centre);
                let error = (sum[0] / count - wanted[0]).hypot(sum[1] / count - wanted[1]);
                assert!(error < 0.6, "view {view}, {distance} m, {away} m out: {error} pixels off");
                let Fov { left, right, up, down } = eyes[view as usize].fov;
                let per_metre = [right - left, up - down].map(|tangents| 1.0 / (f64::from(tangents) * depth));
                let radii = [per_metre[0] * f64::from(SIZE[0]), per_metre[1] * f64::from(SIZE[1])];
                let area = 0.25 * std::f64::consts::PI * diameter * diameter * radii[0] * radii[1];
                // Pixels that are touched at the edge count whole, and a ball off the axis is an ellipse.
                assert!(count > area && count < 1.6 * area, "{count} pixels, {area} wanted");
            }
        }
    }
}

#[test]
fn water_hides_what_is_below_it_and_nothing_above() {
    let mut stage = Stage::new(&still(), SIZE, 1, Look::Water, TIME);
    let fov = Fov::symmetric(1.0, stage.aspect());
    let from = eye(DVec3::new(0.0, 1.6, 0.0), [0.0, -0.2, 0.0], fov);
    let without = stage.picture(TIME, &[from]);
    let mut seen = |y: f64| {
        stage.host.set_scenery(&[ball(DVec3::new(0.0, y, -5.0), 1.0)], 0.0);
        changed(&without, &stage.picture(TIME, &[from])).len() as f64
    };
    let [above, half, below] = [1.0, 0.0, -1.0].map(&mut seen);
    assert_eq!(below, 0.0);
    assert!(half > 0.45 * above && half < 0.75 * above, "{half} of {above} pixels");
}

#[test]
fn the_sun_lights_its_side() {
    let mut stage = Stage::new(&still(), SIZE, 1, Look::Water, TIME);
    let fov = Fov::symmetric(0.5, stage.aspect());
    let height = 20.0;
    stage.host.set_scenery(&[ball(DVec3::new(0.0, height, -10.0), 3.0)], 0.0);
    let side = eye(DVec3::new(0.0, height, 0.0), [0.0; 3], fov);
    let picture = stage.picture(TIME, &[side]);
    // The sun stands 40 degrees above +X: the ball's right is lit, and up more than down.
    let red = |x: u32, y: u32| picture.pixel(x, y)[0];
    let [left, right, up, down] = [(92, 80), (148, 80), (120, 52), (120, 108)].map(|(x, y)| red(x, y));
    assert!(right > left.saturating_add(60) && up > down.saturating_add(40), "{left} {right} {up} {down}");
}

#[test]
fn no_water_lies_on_the_deck_of_who_is_aboard() {
    let mut stage = Stage::new(&still(), SIZE, 1, Look::Water, TIME);
    let fov = Fov::symmetric(1.6, stage.aspect());
    // As deep below the water as a wave may ever pass over it: 0.2 of the eye's height above the deck is hidden.
    let pose = Pose { position: DVec3::new(0.0, -0.28, 0.0), axes: Mat3::IDENTITY };
    let raft = Raft { pose, length: 2.4, width: 2.0, freeboard: 0.25 };
    let from = eye(pose.at(Vec3::Y * 1.6), [0.3, -1.0, 0.0], fov);
    let aboard = raft.solids(from.position);
    let mut flooded = |solids: &[Solid]| {
        stage.host.set_scenery(solids, 0.0);
        let picture = stage.picture(TIME, &[from]);
        let (mut wet, mut dry) = (0, 0);
        for plank in solids.iter().filter(|solid| solid.size.x == raft.width) {
            for across in [-0.8, -0.4, 0.0, 0.4, 0.8] {
                let (pixel, depth) = seen_at(&from, SIZE, plank.position + DVec3::X * across);
                let [x, y] = pixel.map(|side| side as u32);
                if depth > 0.2 && pixel[0] >= 0.0 && pixel[1] >= 0.0 && x < SIZE[0] && y < SIZE[1] {
                    let [red, _, blue] = picture.pixel(x, y);
                    if red > blue { dry += 1 } else { wet += 1 }
                }
            }
        }
        (wet, dry)
    };
    let (wet, dry) = flooded(&aboard);
    assert!(wet == 0 && dry > 20, "{wet} of {} places are under water", wet + dry);
    let (wet, dry) = flooded(&aboard.map(|solid| Solid { lead: 0.0, ..solid }));
    assert!(wet > 20 && dry == 0, "without the lead {wet} of {} places are under water", wet + dry);
    // From outside, water in front of the raft hides it.
    assert!(raft.solids(DVec3::new(0.0, 1.0, 9.0)).iter().all(|solid| solid.lead == 0.0));
}

#[test]
fn only_water_has_solids_and_there_are_not_too_many() {
    let scene = still();
    let pose = Pose { position: DVec3::new(0.0, 0.0, -5.0), axes: Mat3::IDENTITY };
    let buoy = Buoy { pose, diameter: 1.0, mast: 2.0, color: [0.7, 0.05, 0.02] };
    assert_eq!(buoy.solids().last().unwrap().position, buoy.top());
    let mut height = Stage::new(&scene, SIZE, 1, Look::Height, TIME);
    let plain = height.frame(TIME, &[]);
    height.host.set_scenery(&buoy.solids(), 0.0);
    assert!(height.frame(TIME, &[]) == plain);

    let mut stage = Stage::new(&scene, SIZE, 1, Look::Water, TIME);
    stage.frame(TIME, &[]);
    let before = stage.counts;
    stage.host.set_scenery(&buoy.solids(), 0.0);
    stage.frame(TIME, &[]);
    // Balls in one call, cylinders in another.
    assert_eq!(stage.counts.draws, before.draws + 2);
    assert!(stage.counts.triangles > before.triangles + 500 && stage.counts.vertices > before.vertices + 500);
    let full = vec![buoy.solids()[0]; MOST_SOLIDS + 1];
    stage.host.set_scenery(&full[1..], 0.0);
    stage.frame(TIME, &[]);
    stage.host.set_scenery(&full, 0.0);
    let error = stage.host.run([TIME], |_| Ok(())).unwrap_err().to_string();
    assert_eq!(error, format!("{} solids in a frame, at most {MOST_SOLIDS} are drawn", MOST_SOLIDS + 1));
    // After an error the next frame is drawn all the same.
    stage.host.set_scenery(&[], 0.0);
    stage.frame(TIME, &[]);
    assert_eq!(stage.counts, before);
}

#[test]
fn the_buoys_of_a_scene_float_in_its_pictures() {
    let plain = shipped("calm");
    let at = [plain.camera.eye[0] + 0.5, plain.camera.eye[2] - 6.0];
    let buoy = BuoySettings { at, radius: 0.5, color: [0.7, 0.05, 0.02], height: 1.5 };
    let mut scene = plain.clone();
    scene.buoys = vec![buoy];
    let mut sea = Sea::new(&scene.sea).unwrap();
    let mut maps = sea.new_maps();
    sea.step(TIME, &mut maps).unwrap();
    let from = eye(DVec3::from(plain.camera.eye), [0.0, -0.3, 0.0], Fov::symmetric(1.0, 1.0));
    let mut without = Stage::new(&plain, SIZE, 1, Look::Water, TIME);
    let empty = without.frame(TIME, &[from]);
    without.host.set_scenery(&marker(&buoy, &maps).solids(), 0.0);
    let placed = without.frame(TIME, &[from]);
    assert!(placed != empty, "the buoy is not in view");
    assert!(Stage::new(&scene, SIZE, 1, Look::Water, TIME).frame(TIME, &[from]) == placed);
}
