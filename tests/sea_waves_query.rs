//! The surface above a place where the sea is made of formulas: horizontal displacement is solved for exactly.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
#[path = "support/random.rs"]
mod random;

use random::Random;
use swell::scene::Scene;
use swell::sea::{Query, Sea, SeaMaps, Surface, waves::evaluate};

fn maps(text: &str, time: f64) -> SeaMaps {
    let mut sea = Sea::new(&Scene::parse(text, "x.toml").unwrap().sea).unwrap();
    let mut maps = sea.new_maps();
    sea.step(time, &mut maps).unwrap();
    maps
}

fn gerstner(count: u32, sum: f64) -> String {
    let mut text = "[sea]\nmodel = 'waves'\n".to_owned();
    for i in 0..count {
        let (wavelength, degrees) = (6.0 + 3.7 * f64::from(i), 50 * i);
        let steepness = sum / f64::from(count);
        text += &format!(
            "[[sea.wave]]\nkind = 'gerstner'\nwavelength = {wavelength}\ndirection_deg = {degrees}\nsteepness = {steepness}\n"
        );
    }
    text
}

/// Most that is missing, and most steps, over random places within `reach` metres of x.
fn survey(maps: &SeaMaps, x: f64, reach: f64) -> (f64, u32) {
    let mut random = Random(11);
    let query = Query::new(maps);
    let (mut missing, mut steps) = (0.0_f64, 0);
    for _ in 0..2000 {
        let target = [x + random.between(-reach, reach), random.between(-reach, reach)];
        let surface = query.above(target[0], target[1]);
        let [px, _, pz] = surface.position;
        assert!((px - target[0]).hypot(pz - target[1]) <= surface.residual + 1e-9 * target[0].abs().max(1.0));
        missing = missing.max(surface.residual);
        steps = steps.max(surface.iterations);
    }
    (missing, steps)
}

#[test]
fn points_above_a_place_are_exact_where_nothing_folds() {
    for (text, most_steps) in [(gerstner(1, 0.5), 12), (gerstner(3, 0.9), 20), (gerstner(5, 1.0), 64)] {
        for time in [0.0, 33.25] {
            let (missing, steps) = survey(&maps(&text, time), 0.0, 400.0);
            println!("{missing:.1e} m after at most {steps} steps");
            assert!(missing <= 1e-8 && steps <= most_steps, "{missing} m after {steps} steps");
        }
    }
    let (missing, _) = survey(&maps(&gerstner(3, 0.9), 604_800.0), 1e6, 400.0);
    assert!(missing <= 2e-9, "{missing} m a thousand kilometres out");
}

#[test]
fn the_cusp_of_the_steepest_wave_is_found() {
    // At time 0 the crest of the first wave is where f = pi/2; its point rests there.
    let maps = maps(&gerstner(1, 1.0), 0.0);
    for away in [0.0, 1e-9, 1e-6, 1e-3, -0.2, 0.5] {
        let surface = Surface::above(&maps, 1.5 + away, 0.0);
        assert!(surface.residual <= 1e-8, "{away}: {surface:?}");
    }
    let crest = Surface::above(&maps, 1.5, 0.0).height();
    assert!((crest - 6.0 / std::f64::consts::TAU).abs() < 1e-5, "{crest}");
}

#[test]
fn a_sea_that_loops_still_answers() {
    for (sum, most) in [(1.3, 1e-8), (2.4, 1e-8)] {
        let (missing, steps) = survey(&maps(&gerstner(3, sum), 5.0), 0.0, 400.0);
        println!("{missing:.1e} m after at most {steps} steps");
        assert!(missing < most && steps <= swell::sea::query::MAX_ITERATIONS, "{missing} m, {steps} steps");
    }
}

#[test]
fn what_is_found_rests_where_it_says() {
    let text =
        format!("{}[[layer]]\nmodel = 'fbm'\nkernel = 'gerstner'\nchoppiness = 0.2\n", gerstner(2, 0.5));
    let maps = maps(&text, 9.0);
    let mut random = Random(12);
    let points: Vec<[f64; 2]> =
        (0..100).map(|_| [random.between(-99.0, 99.0), random.between(-99.0, 99.0)]).collect();
    let query = Query::new(&maps);
    let mut surfaces = vec![query.at_rest(0.0, 0.0); points.len()];
    let mut heights = vec![0.0; points.len()];
    query.above_many(&points, &mut surfaces);
    query.heights(&points, &mut heights);
    for ((point, surface), height) in points.iter().zip(&surfaces).zip(heights) {
        assert_eq!(*surface, query.above(point[0], point[1]), "many are as one");
        assert_eq!(surface.height(), height);
        let sample = evaluate(&maps.models, surface.rest, 9.0);
        assert_eq!((surface.displacement, surface.foam), (sample.displacement, sample.foam));
        for (a, b) in surface.normal.iter().zip(sample.normal()) {
            assert!((a - b).abs() < 1e-14);
        }
    }
}

#[test]
fn on_a_spectral_sea_layers_are_solved_for_with_it() {
    let text = "[sea]\nresolution = 64\nwind_speed = 6\nchoppiness = 0.7\n[[layer]]\n[[layer.wave]]\nkind = 'gerstner'\nwavelength = 15\nsteepness = 0.4\n";
    let maps = maps(text, 4.0);
    let (missing, steps) = survey(&maps, 0.0, 300.0);
    println!("{missing:.1e} m after at most {steps} steps");
    assert!(missing < 1e-6, "{missing} m after {steps} steps");
}

#[test]
fn a_place_that_is_none_is_answered_with_none() {
    let maps = maps(&gerstner(2, 0.5), 1.0);
    let mut heights = [0.0; 3];
    Query::new(&maps).heights(&[[1.0, 2.0], [f64::NAN, 0.0], [3.0, f64::INFINITY]], &mut heights);
    assert!(heights[0].is_finite() && heights[1].is_nan() && heights[2].is_nan());
}
