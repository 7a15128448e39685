//! The numbers in docs/frame-cost.md are those of the shaders and of frames that are drawn.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use glam::{DVec3, Mat3, Vec3};
use support::stage::{SCENES, Stage, shipped};
use swell::draw::{Buoy, Hand, Look, Pose, Raft, hand, ray, shaders as s};

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
        ("vertex of the skirt", [s::SKIRT_VERTEX_MAIN_FETCHES; 4]),
        ("pixel of the sea", s::OCEAN_FRAGMENT_MAIN_FETCHES),
        ("vertex of a solid", [s::SOLID_VERTEX_MAIN_FETCHES; 4]),
        ("pixel of a solid", [s::SOLID_FRAGMENT_MAIN_FETCHES; 4]),
        ("pixel of the sky", [s::SKY_FRAGMENT_MAIN_FETCHES; 4]),
        ("pixel of the hidden area", [s::HIDDEN_AREA_FRAGMENT_MAIN_FETCHES; 4]),
        ("vertex of a patch, motion pass", s::MOTION_PATCH_MAIN_FETCHES),
        ("pixel of the motion pass", [s::MOTION_FRAGMENT_MAIN_FETCHES; 4]),
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
