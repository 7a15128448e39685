//! Golden pictures of the shipped scenes, of every debug view, and of a stereo pair.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use glam::DVec3;
use std::collections::BTreeSet;
use support::golden;
use support::program::names;
use support::stage::{SCENES, Stage, eye, shipped};
use swell::draw::{Fov, Look};

/// Seconds: any moment but 0, where every harmonic begins.
const TIME: f64 = 12.5;
const SIZE: [u32; 2] = [320, 180];
const VIEWS: [&str; 6] = ["wireframe", "lod", "normal", "jacobian", "height", "holes"];

fn debug_view(word: &str) {
    let mut stage = Stage::new(&shipped("open_ocean"), SIZE, 1, word.parse().unwrap(), TIME);
    // Triangles and levels show from above, where borders of patches lie side by side.
    let mesh = ["wireframe", "lod"].contains(&word);
    let fov = Fov::symmetric(0.9, stage.aspect());
    let above = eye(DVec3::new(3.0, 30.0, 3.0), [0.5, -0.45, 0.0], fov);
    let picture = stage.picture(TIME, if mesh { std::slice::from_ref(&above) } else { &[] });
    golden::check(&format!("debug_{word}"), &picture);
}

fn scene(name: &str) {
    golden::check(name, &Stage::new(&shipped(name), SIZE, 1, Look::Water, TIME).picture(TIME, &[]));
}

#[test]
fn open_ocean() {
    scene("open_ocean");
}

#[test]
fn calm() {
    scene("calm");
}

#[test]
fn storm() {
    scene("storm");
}

#[test]
fn wireframe() {
    debug_view("wireframe");
}

#[test]
fn lod() {
    debug_view("lod");
}

#[test]
fn normal() {
    debug_view("normal");
}

#[test]
fn jacobian() {
    debug_view("jacobian");
}

#[test]
fn height() {
    debug_view("height");
}

#[test]
fn holes() {
    debug_view("holes");
}

#[test]
fn stereo() {
    let mut stage = Stage::new(&shipped("open_ocean"), [160, 160], 2, Look::Water, TIME);
    golden::check("stereo", &stage.picture(TIME, &[]));
}

#[test]
fn every_golden_picture_has_a_test_and_is_small() {
    let wanted = SCENES.map(str::to_owned).into_iter();
    let wanted = wanted.chain(VIEWS.map(|view| format!("debug_{view}"))).chain(["stereo".to_owned()]);
    let wanted: BTreeSet<String> = wanted.map(|name| format!("{name}.png")).collect();
    let found: BTreeSet<String> = names(&golden::folder()).into_iter().collect();
    assert_eq!(found, wanted);
    for name in found {
        let bytes = golden::folder().join(&name).metadata().unwrap().len();
        assert!(bytes <= golden::LARGEST, "{name}: {bytes} bytes");
    }
}
