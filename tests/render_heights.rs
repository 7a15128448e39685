//! The height that is drawn is the height that a query tells.
//!
//! Texels are 16 m wide and vertices at most 0.5 m apart, and lie on the texels' borders: 16 m is a whole number of
//! vertex spacings, and the quadtree's origin snaps by S / (2 V) = 16 m. Between borders the surface of the query is
//! bilinear, f = a + b u + c v + d u v, so a triangle of side s, flat through three of its points, is off by at most
//! |d| s^2 / 4: only the twist d is left. Waves shorter than four texels carry nothing here, so k < 0.1 / m and |d| <=
//! k^2 |D| / 2; with s = 0.5 m the error is below 3.2e-4 of the displacement: a third of the 1e-3 allowed. The 1 mm is for
//! `f32` positions and for the rasteriser's pixels of 1/256: 60 m away, seen under 5 degrees or more, these are 0.3 mm.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use glam::DVec3;
use support::stage::{Stage, eye, ray};
use swell::draw::{Fov, Look};
use swell::scene::Scene;
use swell::sea::{Sea, Surface};

const SCENE: &str = "
[sea]
patch_size = 1024
resolution = 64
wind_speed = 17
choppiness = 0.9
wind_direction_deg = 30
seed = 5
[lod]
size = 2048
quality = 'high'
levels = 7
";
const TIME: f64 = 77.0;
/// Metres from the eye within which the mesh is as fine as the argument wants.
const REACH: f64 = 60.0;

/// Formulas of waves so long that triangles, flat through three of a wave's points, are off by less than s^2 k^2 / 8, 2e-4,
/// of what is displaced; vertices are so near each other that the mesh shows all of them.
const FORMULAS: &str = "
model = 'waves'
[[layer.wave]]
kind = 'gerstner'
wavelength = 120
steepness = 0.3
direction_deg = 200
[[layer.wave]]
kind = 'circular'
wavelength = 90
amplitude = 1.5
centre = [40, -300]
";

#[test]
fn drawn_heights_are_the_querys() {
    compare(SCENE);
}

#[test]
fn drawn_heights_of_formulas_are_the_querys() {
    let [_, lod] = SCENE.split("[lod]").collect::<Vec<_>>()[..] else { panic!("no [lod]") };
    compare(&format!("[sea]\n{}[lod]{lod}", FORMULAS.replace("layer", "sea")));
}

#[test]
fn drawn_heights_of_layers_are_the_querys() {
    compare(&format!("{SCENE}\n[[layer]]\n{FORMULAS}"));
}

fn compare(scene: &str) {
    let scene = Scene::parse(scene, "heights.toml").unwrap();
    let mut sea = Sea::new(&scene.sea).unwrap();
    let mut maps = sea.new_maps();
    sea.step(TIME, &mut maps).unwrap();
    let size = [160, 120];
    let mut stage = Stage::new(&scene, size, 1, Look::Metres, TIME);
    let fov = Fov::symmetric(1.2, stage.aspect());
    let (mut compared, mut worst, mut highest) = (0, 0.0_f64, [f64::MAX, f64::MIN]);
    for (x, z, yaw) in
        [(3.0, 8.0, 0.3), (-207.0, 330.0, 2.0), (401.5, -77.25, 4.0), (1.0e6 + 90.0, 55.0, 5.5)]
    {
        let above = Surface::above(&maps, x, z).height() + 9.0;
        let eye = eye(DVec3::new(x, above, z), [yaw, -0.6, 0.0], fov);
        let frame = stage.frame(TIME, &[eye]);
        for (index, bytes) in (0_u32..).zip(frame.chunks_exact(4)) {
            let height = f64::from(f32::from_ne_bytes(bytes.try_into().unwrap()));
            let pixel = [index % size[0], index / size[0]].map(|side| f64::from(side) + 0.5);
            let direction = ray(&eye, size, pixel);
            if height.is_nan() {
                assert!(direction.y > -0.05 * direction.length(), "no sea at pixel {pixel:?}");
                continue;
            }
            // Where the pixel's ray is at that height, the drawn surface is.
            let along = (height - eye.position.y) / direction.y;
            let point = eye.position + along * direction;
            if along * direction.length() > REACH {
                continue;
            }
            let surface = Surface::above(&maps, point.x, point.z);
            assert!(surface.residual < 1e-6, "{surface:?}");
            let size = DVec3::from(surface.displacement).length();
            let error = (surface.height() - height).abs();
            let allowed = 1e-3 + 1e-3 * size;
            assert!(error <= allowed, "pixel {pixel:?}, {point}: drawn {height}, {surface:?}");
            (compared, worst) = (compared + 1, worst.max(error / allowed));
            highest = [highest[0].min(height), highest[1].max(height)];
        }
    }
    println!("{compared} pixels, worst {worst:.3} of what is allowed, heights {highest:?}");
    assert!(compared > 40_000, "{compared} pixels compared");
    assert!(highest[1] - highest[0] > 1.0, "waves are wanted: {highest:?}");
}
