//! Two eyes: each layer shows what its eye sees.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use glam::DVec3;
use support::stage::{Stage, shipped};
use swell::draw::{Eye, Fov, Look};

const TIME: f64 = 20.0;
const SIZE: [u32; 2] = [160, 160];

/// The eyes of a headset: 63 mm apart, each seeing further to its own side.
fn eyes() -> [Eye; 2] {
    let look = [0.4, -0.25, 0.1];
    let middle = support::stage::eye(DVec3::new(5.0, 2.2, 9.0), look, Fov::symmetric(1.0, 1.0));
    let right = middle.axes.x_axis.as_dvec3();
    let fov = |left, right| Fov { left, right, up: 0.8, down: -0.9 };
    [(-0.0315, fov(-1.0, 0.75)), (0.0315, fov(-0.75, 1.0))].map(|(shift, fov)| Eye {
        position: middle.position + right * shift,
        fov,
        ..middle
    })
}

#[test]
fn each_layer_is_what_its_eye_alone_sees() {
    let scene = shipped("open_ocean");
    let both = Stage::new(&scene, SIZE, 2, Look::Water, TIME).picture(TIME, &eyes());
    let [left, right] = [0, 1].map(|view| both.part(view, 2));
    // Some drivers leave layer 1 with its clear colour.
    assert!(left.colours() > 1000 && right.colours() > 1000, "{} {}", left.colours(), right.colours());
    let apart = left.difference(&right).mean;
    assert!(apart > 0.02, "the eyes see the same: {apart}");

    let mut alone = Stage::new(&scene, SIZE, 1, Look::Water, TIME);
    for (name, view, eye) in [("left", left, eyes()[0]), ("right", right, eyes()[1])] {
        // Detail is chosen for the head in one case and for the eye in the other: 3 cm, which morphing makes nothing of.
        let difference = view.difference(&alone.picture(TIME, &[eye]));
        println!("{name}: mean {}, 99th percentile {}", difference.mean, difference.high);
        assert!(
            difference.mean < 0.002 && difference.high < 0.03,
            "{name}: {} {}",
            difference.mean,
            difference.high
        );
    }
}
