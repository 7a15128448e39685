//! What a headset lays over the sea: the hidden area and the vignette.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use glam::DVec3;
use support::picture::Picture;
use support::stage::{Stage, eye, ray, shipped};
use swell::draw::{Eye, Fov, HiddenMesh, Look};

const TIME: f64 = 12.5;
const SIZE: [u32; 2] = [160, 160];

/// A headset's eyes: each sees further to its own side.
fn eyes() -> [Eye; 2] {
    let both = eye(DVec3::new(5.0, 2.2, 9.0), [0.4, -0.2, 0.0], Fov::symmetric(1.0, 1.0));
    let right = both.axes.x_axis.as_dvec3();
    let fov = |left, right| Fov { left, right, up: 0.75, down: -0.85 };
    [(-0.0315, fov(-1.0, 0.6)), (0.0315, fov(-0.6, 1.0))].map(|(shift, fov)| Eye {
        position: both.position + right * shift,
        fov,
        ..both
    })
}

fn views(stage: &mut Stage) -> [Picture; 2] {
    let both = stage.picture(TIME, &eyes());
    [both.part(0, 2), both.part(1, 2)]
}

/// Two triangles over pixels `left..right` of a view of 160 pixels from -1 to 0.6 across, from 0.75 up to -0.85, all
/// rows: corners on the borders of pixels, where no sample lies.
fn columns(left: u32, right: u32) -> Vec<[f32; 2]> {
    let at = |pixel: u32| -1.0 + 0.01 * pixel as f32;
    vec![[at(left), -0.85], [at(right), -0.85], [at(right), 0.75], [at(left), 0.75]]
}

#[test]
fn the_hidden_area_is_black_in_its_view_alone() {
    let mut stage = Stage::new(&shipped("open_ocean"), SIZE, 2, Look::Water, TIME);
    let plain = views(&mut stage);
    let before = stage.counts;
    let vertices = columns(0, 40);
    let quad = HiddenMesh { vertices: &vertices, indices: &[0, 1, 2, 2, 3, 0] };
    stage.host.set_hidden_area([quad, HiddenMesh::default()]).unwrap();
    let hidden = views(&mut stage);
    assert_eq!((stage.counts.draws, stage.counts.triangles), (before.draws + 1, before.triangles + 2));
    assert!(hidden[1] == plain[1], "the other view has changed");
    for y in 0..SIZE[1] {
        for x in 0..SIZE[0] {
            let wanted = if x < 40 { [0; 3] } else { plain[0].pixel(x, y) };
            assert_eq!(hidden[0].pixel(x, y), wanted, "{x} {y}");
        }
    }
    // The runtime may change its mind: now the other view's, clockwise for a change, and then nothing.
    let vertices = columns(40, 100);
    let turned = HiddenMesh { vertices: &vertices, indices: &[0, 2, 1, 2, 0, 3] };
    stage.host.set_hidden_area([HiddenMesh::default(), turned]).unwrap();
    let hidden = views(&mut stage);
    assert!(hidden[0] == plain[0], "the other view has changed");
    // The right eye's view begins at -0.6.
    assert!(
        (0..SIZE[0]).all(|x| hidden[1].pixel(x, 80) == if x < 60 { [0; 3] } else { plain[1].pixel(x, 80) })
    );
    stage.host.set_hidden_area([HiddenMesh::default(); 2]).unwrap();
    assert!(views(&mut stage) == plain);
    assert_eq!(stage.counts, before);
}

#[test]
fn a_hidden_area_that_makes_no_sense_is_refused() {
    let mut stage = Stage::new(&shipped("calm"), SIZE, 2, Look::Water, TIME);
    let vertices = columns(0, 40);
    let mut refused = |indices: &[u32]| {
        let mesh = HiddenMesh { vertices: &vertices, indices };
        stage.host.set_hidden_area([HiddenMesh::default(), mesh]).unwrap_err().to_string()
    };
    assert_eq!(refused(&[0, 1]), "a hidden area of 2 indices, a multiple of 3 is needed");
    assert_eq!(refused(&[0, 1, 4]), "index 4 of a hidden area is not below 4, the number of its vertices");
}

#[test]
fn the_vignette_is_one_circle_about_the_axis_for_both_eyes() {
    let mut stage = Stage::new(&shipped("open_ocean"), SIZE, 2, Look::Water, TIME);
    let plain = views(&mut stage);
    let before = stage.counts;
    for nothing in [0.0, -1.0, f32::NAN] {
        stage.host.set_scenery(&[], nothing);
        assert!(views(&mut stage) == plain && stage.counts == before, "{nothing} draws something");
    }
    let mut clear_before = f64::MAX;
    for strength in [0.25, 0.5, 1.0] {
        stage.host.set_scenery(&[], strength);
        let dark = views(&mut stage);
        assert_eq!(stage.counts.draws, before.draws + 1);
        // For each view: the widest angle (radians) of an unchanged pixel, and the narrowest of a black one.
        let angles = [0, 1].map(|view| {
            let (mut clear, mut black) = (0.0_f64, f64::MAX);
            for y in 0..SIZE[1] {
                for x in 0..SIZE[0] {
                    let pixel = [f64::from(x) + 0.5, f64::from(y) + 0.5];
                    let eye = &eyes()[view];
                    let axis = -eye.axes.z_axis.as_dvec3();
                    let angle = ray(eye, SIZE, pixel).angle_between(axis);
                    let (now, then) = (dark[view].pixel(x, y), plain[view].pixel(x, y));
                    assert!(now.iter().zip(then).all(|(&now, then)| now <= then), "brighter at {pixel:?}");
                    if now == then {
                        clear = clear.max(angle);
                    }
                    if now.iter().all(|&channel| channel <= 2) && then.iter().any(|&channel| channel > 20) {
                        black = black.min(angle);
                    }
                }
            }
            [clear, black]
        });
        let [[clear, black], [other_clear, other_black]] = angles;
        println!("{strength}: {angles:?}");
        assert!((clear - other_clear).abs() < 0.02 && (black - other_black).abs() < 0.02, "{angles:?}");
        assert!(clear < clear_before - 0.05 && clear < black, "{clear} after {clear_before}");
        clear_before = clear;
    }
    assert!((0.34..0.42).contains(&clear_before), "fully closed it begins at {clear_before} radians");
}
