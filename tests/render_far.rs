//! A thousand kilometres out the sea looks as it does at the origin.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use glam::DVec3;
use support::picture::Picture;
use support::stage::Stage;
use swell::draw::{Fov, Look};
use swell::scene::Scene;

/// 1 000 000 m are 8 000 patches of the sea and 31 250 steps of the quadtree's origin, S / (2 V) = 32 m. Foam is
/// everywhere, so its pattern is compared too.
const SCENE: &str = "
[sea]
patch_size = 125
resolution = 256
wind_speed = 9
[sea.foam]
threshold = 0.05
width = 0.5
[lod]
size = 2048
quality = 'medium'
";
const FAR: f64 = 1.0e6;
const TIME: f64 = 41.0;

fn seen_from(stage: &mut Stage, at: DVec3) -> Picture {
    let fov = Fov::symmetric(0.9, stage.aspect());
    stage.picture(TIME, &[support::stage::eye(at, [0.7, -0.15, 0.0], fov)])
}

#[test]
fn whole_patches_away_pixels_are_the_same() {
    let scene = Scene::parse(SCENE, "far.toml").unwrap();
    let mut stage = Stage::new(&scene, [320, 180], 1, Look::Water, TIME);
    // Binary fractions: an eye that is the same to the last bit out there.
    let near = DVec3::new(11.25, 5.5, 7.75);
    let there = seen_from(&mut stage, near);
    assert!(there.colours() > 1000, "{} colours are no sea", there.colours());
    for away in [DVec3::X, DVec3::NEG_X, DVec3::Z, DVec3::NEG_Z, DVec3::X + DVec3::Z] {
        let far = seen_from(&mut stage, near + FAR * away);
        let differing = far.rgb.iter().zip(&there.rgb).filter(|(a, b)| a != b).count();
        let difference = there.difference(&far);
        assert_eq!(differing, 0, "{away}: FLIP {} on average, {}", difference.mean, difference.high);
    }
    // Half a patch away it is another sea: the comparison can tell.
    let half = seen_from(&mut stage, near + DVec3::X * (FAR + 62.5));
    assert!(there.difference(&half).mean > 0.02);
}
