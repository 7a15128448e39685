//! The sea has no holes: from wherever one looks, something is drawn below the horizon.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use glam::DVec3;
use std::f64::consts::TAU;
use support::picture::Picture;
use support::random::Random;
use support::stage::{SCENES, Stage, eye, ray, shipped};
use swell::draw::{Eye, Fov, Look};
use swell::lod::{Quality, SignalSettings, Tessellation};
use swell::sea::{Sea, SeaMaps, Surface};

const SIZE: [u32; 2] = [160, 90];
const QUALITIES: [Quality; 4] = [Quality::Low, Quality::Medium, Quality::High, Quality::Ultra];
/// Metres between the eye and the water below it: the near plane at 0.1 m must not reach the waves around.
const CLEARANCE: f64 = 0.4;

/// How many views: `SWELL_HOLE_VIEWS`, or enough for every day.
fn views() -> usize {
    std::env::var("SWELL_HOLE_VIEWS").map_or(200, |number| number.parse().unwrap())
}

/// An eye above the highest water within arm's length, and at least `lowest` metres above rest.
fn random_eye(random: &mut Random, maps: &SeaMaps, aspect: f32, lowest: f64) -> Eye {
    let far = 10_f64.powf(random.between(0.0, 7.0));
    let [x, z] = [0; 2].map(|_| random.between(-far, far));
    let around = [[0.0, 0.0], [0.4, 0.0], [-0.4, 0.0], [0.0, 0.4], [0.0, -0.4]];
    let water = around
        .map(|[dx, dz]| Surface::above(maps, x + dx, z + dz).height())
        .into_iter()
        .fold(lowest, f64::max);
    let clearance = (CLEARANCE.ln() + (300.0 / CLEARANCE).ln() * random.between(0.0, 1.0)).exp();
    let angles = [random.between(0.0, TAU), random.between(-1.5, 0.7), random.between(-0.5, 0.5)];
    let fov = Fov::symmetric(random.between(0.3, 1.8) as f32, aspect);
    // Headsets' views are not symmetric.
    let fov = Fov { left: fov.left * 1.2, right: fov.right * 0.9, up: fov.up * 0.8, ..fov };
    eye(DVec3::new(x, water + clearance, z), angles, fov)
}

/// Whether a pixel, and all around it, looks below the horizon.
fn below_horizon(eye: &Eye, x: u32, y: u32) -> bool {
    let corners = [(-1.0, -1.0), (2.0, -1.0), (-1.0, 2.0), (2.0, 2.0)];
    corners.iter().all(|(dx, dy)| ray(eye, SIZE, [f64::from(x) + dx, f64::from(y) + dy]).y < 0.0)
}

/// Whether one of a pixel's four samples shows the magenta behind the sea. Water and foam never have more red and
/// blue than green by as much: a quarter of the light.
fn is_hole([r, g, b]: [u8; 3]) -> bool {
    let linear = |byte: u8| (f64::from(byte) / 255.0).powf(2.2);
    linear(r).min(linear(b)) - linear(g) > 0.15
}

/// Which density: the grid's, or that of any signal.
#[derive(Clone, Copy, PartialEq)]
enum By {
    Grid,
    Signal,
}

/// From two triangles a patch to the most there are.
fn random_signal(random: &mut Random) -> Tessellation {
    let (least, near) = (random.between(0.0, 1.0), random.between(0.0, 100.0));
    Tessellation::Signal(SignalSettings {
        frequency: 10_f64.powf(random.between(-2.5, 0.7)),
        density: 1.0,
        fresnel: [least, 1.0],
        distance: [near, near + 10_f64.powf(random.between(1.0, 4.0))],
    })
}

/// Views with a hole, described, of `count` random ones; and the number of pixels looked at.
fn holes(scene: &str, quality: Quality, by: By, count: usize, seed: u64) -> (Vec<String>, usize) {
    let mut scene = shipped(scene);
    scene.lod.quality = quality;
    let mut random = Random(seed);
    // A coarse mesh leads from crest to crest, above the troughs: the eye is above all crests.
    let mut lowest = f64::MIN;
    if by == By::Signal {
        scene.lod.tessellation = random_signal(&mut random);
        lowest = scene.lod.height_bound();
    }
    // Foam's memory takes long to step to a random time, and has no shape.
    scene.sea.foam.fade_time = 0.0;
    let mut sea = Sea::new(&scene.sea).unwrap();
    let mut maps = sea.new_maps();
    let mut time = random.between(0.0, 200.0);
    let mut stage = Stage::new(&scene, SIZE, 1, Look::Holes, time);
    let (mut found, mut looked) = (Vec::new(), 0);
    for _ in 0..count {
        sea.step(time, &mut maps).unwrap();
        let eye = random_eye(&mut random, &maps, stage.aspect(), lowest);
        let picture: Picture = stage.picture(time, &[eye]);
        let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
        let below: Vec<(u32, u32)> = pixels.filter(|&(x, y)| below_horizon(&eye, x, y)).collect();
        looked += below.len();
        let through: Vec<_> = below.into_iter().filter(|&(x, y)| is_hole(picture.pixel(x, y))).collect();
        if let Some(first) = through.first() {
            found.push(format!("{} pixels, {first:?} first, at {time} s seen by {eye:?}", through.len()));
        }
        time = random.between(0.0, 200.0);
    }
    (found, looked)
}

fn no_holes(scene: &str, by: By, seeds: u64) {
    let each = views().div_ceil(SCENES.len() * QUALITIES.len());
    let (mut found, mut looked) = (Vec::new(), 0);
    for (seed, quality) in (seeds..).zip(QUALITIES) {
        let (views, pixels) = holes(scene, quality, by, each, seed);
        found.extend(views.into_iter().map(|view| format!("{quality:?}: {view}")));
        looked += pixels;
    }
    println!("{scene}: {} views, {looked} pixels below the horizon", each * QUALITIES.len());
    assert!(looked > each * 10_000, "{looked} pixels are too few");
    assert!(found.is_empty(), "holes in {} views of {scene}:\n{}", found.len(), found.join("\n"));
}

#[test]
fn open_ocean_has_no_holes() {
    no_holes("open_ocean", By::Grid, 100);
}

#[test]
fn open_ocean_has_no_holes_by_the_signal() {
    no_holes("open_ocean", By::Signal, 400);
}

#[test]
fn calm_has_no_holes() {
    no_holes("calm", By::Grid, 200);
}

#[test]
fn calm_has_no_holes_by_the_signal() {
    no_holes("calm", By::Signal, 500);
}

#[test]
fn storm_has_no_holes() {
    no_holes("storm", By::Grid, 300);
}

#[test]
fn storm_has_no_holes_by_the_signal() {
    no_holes("storm", By::Signal, 600);
}

#[test]
fn magenta_is_a_hole_and_water_is_none() {
    // One sample of four, over dark water: sRGB 137 is a quarter of the light.
    assert!(is_hole([255, 0, 255]) && is_hole([137, 20, 140]));
    for water in [[255, 255, 255], [30, 60, 80], [120, 110, 120], [0, 0, 0], [200, 180, 220]] {
        assert!(!is_hole(water), "{water:?}");
    }
}
