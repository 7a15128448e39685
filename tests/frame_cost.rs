//! The numbers in docs/frame-cost.md are those of the shaders and of frames that are drawn.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use glam::{DVec3, Mat3, Vec3};
use support::stage::{SCENES, Stage, eye, shipped};
use swell::draw::{Buoy, Eye, Fov, Hand, Look, Pose, Raft, hand, ray, shaders as s};
use swell::lod::Quality;

/// `table` stands in the page word for word.
fn is_documented(table: &str) {
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/frame-cost.md");
    let text = std::fs::read_to_string(page).unwrap();
    assert!(text.contains(table), "docs/frame-cost.md ought to have:\n{table}");
}

#[test]
fn fetches_are_documented() {
    let mut table = String::from("| stage | 1 cascade | 2 | 3 | 4 |\n|---|---:|---:|---:|---:|\n");
    let rows = [
        ("vertex of a patch", s::OCEAN_VERTEX_MAIN_FETCHES),
        ("vertex of the skirt", [s::SKIRT_VERTEX_MAIN_FETCHES[0]; 4]),
        ("pixel of the sea", s::OCEAN_FRAGMENT_MAIN_FETCHES),
        ("vertex of a solid", [s::SOLID_VERTEX_MAIN_FETCHES; 4]),
        ("pixel of a solid", [s::SOLID_FRAGMENT_MAIN_FETCHES; 4]),
        ("pixel of the sky", [s::SKY_FRAGMENT_MAIN_FETCHES; 4]),
        ("pixel of the hidden area", [s::HIDDEN_AREA_FRAGMENT_MAIN_FETCHES; 4]),
        ("vertex of a patch, motion pass", s::MOTION_PATCH_MAIN_FETCHES),
        ("pixel of the motion pass", [s::MOTION_FRAGMENT_MAIN_FETCHES; 4]),
        ("vertex of a patch that casts a shadow", s::SUN_MAP_PATCH_MAIN_FETCHES),
        ("pixel of the sea with shadows", s::SHADOWED_WATER_MAIN_FETCHES),
        ("pixel of a solid with shadows", [s::SHADOWED_MATT_MAIN_FETCHES; 4]),
        ("pixel of the vignette's rim", [s::VIGNETTE_FRAGMENT_MAIN_FETCHES; 4]),
    ];
    for (what, [one, two, three, four]) in rows {
        table.push_str(&format!("| {what} | {one} | {two} | {three} | {four} |\n"));
    }
    is_documented(&table);
}

#[test]
fn counts_are_documented() {
    let mut table = String::from(
        "| scene | draws | patches | triangles a view | vertices a view | bytes uploaded |\n\
         |---|---:|---:|---:|---:|---:|\n",
    );
    for name in SCENES {
        let mut stage = Stage::new(&shipped(name), [320, 180], 2, Look::Water, 12.5);
        stage.frame(12.5, &[]);
        let (c, bytes) = (stage.counts, stage.host.uploaded());
        table.push_str(&format!(
            "| `{name}` | {} | {} | {} | {} | {bytes} |\n",
            c.draws, c.patches, c.triangles, c.vertices
        ));
        if name != SCENES[0] {
            continue;
        }
        let before = c;
        let pose = Pose { position: DVec3::new(0.0, 1.0, 0.0), axes: Mat3::IDENTITY };
        let mut solids =
            Raft { pose, length: 2.4, width: 2.0, freeboard: 0.25 }.solids(pose.position).to_vec();
        for _ in 0..4 {
            solids.extend(Buoy { pose, diameter: 0.9, mast: 1.8, color: Vec3::X.into() }.solids());
        }
        for side in [Hand::Left, Hand::Right] {
            solids.extend(hand(pose, side));
        }
        solids.push(ray(pose, 4.0, Hand::Right));
        stage.host.set_scenery(&solids, 1.0);
        stage.frame(12.5, &[]);
        let c = stage.counts;
        table.push_str(&format!(
            "| the same with raft, 4 buoys, hands, ray and vignette: more | {} | 0 | {} | {} | {} |\n",
            c.draws - before.draws,
            c.triangles - before.triangles,
            c.vertices - before.vertices,
            stage.host.uploaded() - bytes
        ));
    }
    is_documented(&table);
}

/// Directions that a rider looks in, level and all around: the most of them counts.
const HEADINGS: u32 = 12;

#[test]
fn a_headsets_frame_is_documented_for_each_quality() {
    let mut table = String::from(
        "| quality | draws | patches | triangles a view | vertices a view | fetches a vertex | bytes uploaded |\n\
         |---|---:|---:|---:|---:|---:|---:|\n",
    );
    for (word, quality) in [
        ("low", Quality::Low),
        ("medium", Quality::Medium),
        ("high", Quality::High),
        ("ultra", Quality::Ultra),
    ] {
        let mut scene = shipped("open_ocean");
        scene.lod.quality = quality;
        let mut stage = Stage::new(&scene, [160, 160], 2, Look::Water, 12.5);
        let deck = Pose { position: DVec3::new(0.0, 0.25, 0.0), axes: Mat3::IDENTITY };
        let head = deck.position + DVec3::Y * 1.6;
        let mut solids = Raft { pose: deck, length: 2.4, width: 2.4, freeboard: 0.25 }.solids(head).to_vec();
        for side in [Hand::Left, Hand::Right] {
            solids.extend(hand(Pose { position: head, axes: Mat3::IDENTITY }, side));
        }
        stage.host.set_scenery(&solids, 0.0);
        let (mut most, mut bytes) = (stage.counts, 0);
        for heading in 0..HEADINGS {
            let yaw = std::f64::consts::TAU * f64::from(heading) / f64::from(HEADINGS);
            stage.frame(12.5, &wide_pair(head, yaw));
            let c = stage.counts;
            most.draws = most.draws.max(c.draws);
            most.patches = most.patches.max(c.patches);
            most.triangles = most.triangles.max(c.triangles);
            most.vertices = most.vertices.max(c.vertices);
            bytes = bytes.max(stage.host.uploaded());
        }
        let fetches = s::OCEAN_VERTEX_MAIN_FETCHES[scene.sea.cascades.len() - 1];
        table.push_str(&format!(
            "| {word} | {} | {} | {} | {} | {fetches} | {bytes} |\n",
            most.draws, most.patches, most.triangles, most.vertices
        ));
    }
    is_documented(&table);
}

/// Eyes 63 mm apart whose views reach 54 degrees outwards, 40 inwards, 44 up and 55 down.
fn wide_pair(head: DVec3, yaw: f64) -> [Eye; 2] {
    let [out, inwards, up, down] = [54.0_f32, 40.0, 44.0, 55.0].map(|angle| angle.to_radians().tan());
    let fov = |left, right| Fov { left, right, up, down: -down };
    let middle = eye(head, [yaw, 0.0, 0.0], fov(-out, out));
    let right = middle.axes.x_axis.as_dvec3();
    [(-0.0315, fov(-out, inwards)), (0.0315, fov(-inwards, out))].map(|(shift, fov)| Eye {
        position: head + right * shift,
        fov,
        ..middle
    })
}
