//! Golden pictures of the shipped scenes, of every debug view, of a stereo pair, and of what a headset sees besides.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use glam::{DVec3, Mat3, Vec3};
use std::collections::BTreeSet;
use support::golden;
use support::program::names;
use support::stage::{SCENES, Stage, eye, shipped};
use swell::draw::{Buoy, Eye, Fov, Hand, Look, Pose, Raft, Shape, Solid, hand, ray};
use swell::scene::{Mirrored, Scene, Shading, Shadows};
use swell::sea::{Sea, SeaMaps, Surface};

/// Seconds: any moment but 0, where every harmonic begins.
const TIME: f64 = 12.5;
const SIZE: [u32; 2] = [320, 180];
/// Those whose waves are formulas.
const FORMULAS: [&str; 4] = ["pond", "gerstner", "sum_of_sines", "fbm_sea"];
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
fn pond() {
    scene("pond");
}

#[test]
fn gerstner() {
    scene("gerstner");
}

#[test]
fn sum_of_sines() {
    scene("sum_of_sines");
}

#[test]
fn fbm_sea() {
    scene("fbm_sea");
}

/// Formulas on a spectral sea: a swell, and rings around a place in front of the camera.
#[test]
fn layers() {
    let calm = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/calm.toml");
    let text = std::fs::read_to_string(calm).unwrap()
        + "\n[[layer]]\n[[layer.wave]]\nkind = 'gerstner'\nwavelength = 40\nsteepness = 0.2\ndirection_deg = 250\n\
           [[layer]]\n[[layer.wave]]\nkind = 'circular'\nwavelength = 1.5\namplitude = 0.05\ncentre = [1, -9]\n";
    let scene = Scene::parse(&text, calm).unwrap();
    golden::check("layers", &Stage::new(&scene, SIZE, 1, Look::Water, TIME).picture(TIME, &[]));
}

/// A spectral sea that mirrors one colour and the sun.
#[test]
fn blinn_phong() {
    let mut scene = shipped("open_ocean");
    scene.water.shading = Shading::BlinnPhong;
    scene.water.phong.mirrored = Mirrored::Ambient;
    scene.water.phong.ambient_color = [0.5, 0.7, 0.9];
    golden::check("blinn_phong", &Stage::new(&scene, SIZE, 1, Look::Water, TIME).picture(TIME, &[]));
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

/// Afloat at world (x, z), as level as the water `half` metres around.
fn afloat(maps: &SeaMaps, x: f64, z: f64, half: f64) -> Pose {
    let height = |dx, dz| Surface::above(maps, x + dx, z + dz).height();
    let [east, west, south, north] =
        [height(half, 0.0), height(-half, 0.0), height(0.0, half), height(0.0, -half)];
    let up =
        DVec3::new((west - east) / (2.0 * half), 1.0, (north - south) / (2.0 * half)).normalize().as_vec3();
    let right = Vec3::X.reject_from(up).normalize();
    let y = 0.25 * (east + west + south + north);
    Pose { position: DVec3::new(x, y, z), axes: Mat3::from_cols(right, up, right.cross(up)) }
}

/// A raft with a crate on it and a buoy towards a low sun, which throws the shadows of all of it this way, as golden `name`.
fn in_low_sun(name: &str, mut scene: Scene) {
    let mut sea = Sea::new(&scene.sea).unwrap();
    let mut maps = sea.new_maps();
    sea.step(TIME, &mut maps).unwrap();
    scene.sky.sun_elevation = 14_f64.to_radians();
    scene.sky.sun_azimuth = 125_f64.to_radians();
    scene.water.shadows.shadows = Shadows::On;
    scene.water.shadows.distance = 60.0;
    let raft = afloat(&maps, 0.6, -6.5, 1.0);
    let raft = Pose { position: raft.at(0.25 * Vec3::Y), ..raft };
    let from = DVec3::new(0.0, 2.4, 0.0);
    let mut solids = Raft { pose: raft, length: 2.4, width: 2.0, freeboard: 0.25 }.solids(from).to_vec();
    let crate_on_it = raft.at(Vec3::new(-0.4, 0.3, -0.3));
    let shape = Shape::Box;
    let size = Vec3::new(0.5, 0.6, 0.5);
    solids.push(Solid {
        shape,
        position: crate_on_it,
        axes: raft.axes,
        size,
        color: [0.5, 0.4, 0.3],
        lead: 0.0,
    });
    let pose = afloat(&maps, -2.6, -8.0, 0.4);
    solids.extend(Buoy { pose, diameter: 0.9, mast: 1.8, color: [0.70, 0.05, 0.02] }.solids());
    let mut stage = Stage::new(&scene, SIZE, 1, Look::Water, TIME);
    stage.host.set_scenery(&solids, 0.0);
    let fov = Fov::symmetric(0.9, stage.aspect());
    golden::check(name, &stage.picture(TIME, &[eye(from, [0.05, -0.3, 0.0], fov)]));
}

#[test]
fn shadows() {
    in_low_sun("shadows", shipped("calm"));
}

/// No maps but the sun's: waves and octaves cast the shadows and get them, on foam too.
#[test]
fn shadows_on_formulas() {
    let text = "[sea]\nmodel = 'waves'\nroughness = 0.06\n\
                [[sea.wave]]\nkind = 'gerstner'\nwavelength = 7\nsteepness = 0.2\ndirection_deg = 240\n\
                [[sea.wave]]\nkind = 'peaked'\nwavelength = 3\namplitude = 0.04\nsharpness = 3\ndirection_deg = 200\n\
                [[layer]]\nmodel = 'fbm'\namplitude = 0.04\nfrequency = 1.2\noctaves = 8\n[layer.foam]\nrange = [0.45, 0.8]\n\
                [lod]\nsize = 512\nlevels = 6\n[water]\ndeep_color = [0.08, 0.2, 0.22]\n";
    in_low_sun("shadows_on_formulas", Scene::parse(text, "shadows_on_formulas").unwrap());
}

/// Aboard a raft among buoys, a controller in each hand, the vignette half closed.
#[test]
fn raft() {
    let scene = shipped("calm");
    let mut sea = Sea::new(&scene.sea).unwrap();
    let mut maps = sea.new_maps();
    sea.step(TIME, &mut maps).unwrap();
    let mut pose = afloat(&maps, 0.0, 0.0, 1.0);
    pose.position = pose.at(0.25 * Vec3::Y);
    let head = pose.at(Vec3::new(0.0, 1.6, 0.3));
    let mut solids = Raft { pose, length: 2.4, width: 2.0, freeboard: 0.25 }.solids(head).to_vec();
    let places = [
        (-1.5, -5.0, [0.70, 0.05, 0.02]),
        (2.2, -9.0, [0.75, 0.50, 0.02]),
        (-4.0, -25.0, [0.02, 0.40, 0.10]),
    ];
    for (x, z, color) in places {
        solids.extend(Buoy { pose: afloat(&maps, x, z, 0.4), diameter: 0.9, mast: 1.8, color }.solids());
    }
    for (side, x) in [(Hand::Left, -0.2), (Hand::Right, 0.2)] {
        let grip =
            Pose { position: pose.at(Vec3::new(x, 1.2, -0.3)), axes: pose.axes * Mat3::from_rotation_x(0.5) };
        solids.extend(hand(grip, side));
        solids.push(ray(grip, 3.0, side));
    }
    let mut stage = Stage::new(&scene, [160, 180], 2, Look::Water, TIME);
    stage.host.set_scenery(&solids, 0.5);
    let middle = eye(head, [0.0, -0.45, 0.0], Fov::symmetric(1.0, 1.0));
    let fov = |left, right| Fov { left, right, up: 0.95, down: -1.05 };
    let eyes = [(-0.0315, fov(-1.0, 0.8)), (0.0315, fov(-0.8, 1.0))].map(|(shift, fov)| Eye {
        position: head + DVec3::X * shift,
        fov,
        ..middle
    });
    golden::check("raft", &stage.picture(TIME, &eyes));
}

#[test]
fn every_golden_picture_has_a_test_and_is_small() {
    let wanted = SCENES.into_iter().chain(FORMULAS).map(str::to_owned);
    let wanted = wanted.chain(VIEWS.map(|view| format!("debug_{view}"))).chain(
        ["stereo", "raft", "shadows", "shadows_on_formulas", "layers", "blinn_phong"].map(str::to_owned),
    );
    let wanted: BTreeSet<String> = wanted.map(|name| format!("{name}.png")).collect();
    let found: BTreeSet<String> = names(&golden::folder()).into_iter().collect();
    assert_eq!(found, wanted);
    for name in found {
        let bytes = golden::folder().join(&name).metadata().unwrap().len();
        assert!(bytes <= golden::LARGEST, "{name}: {bytes} bytes");
    }
}
