//! Laws of waves as formulas: where they run, what shape they have, when they close.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
#[path = "support/random.rs"]
mod random;

use random::Random;
use std::f64::consts::{PI, TAU};
use swell::scene::Scene;
use swell::sea::waves::{Front, Model, Sample, evaluate, loops, turns};

const WAVES: &str = "[sea]\nmodel = 'waves'\n";
/// One of each kind, and octaves of each kernel; what loops is allowed.
const ALL: [&str; 9] = [
    "[[sea.wave]]\nwavelength = 9\namplitude = 0.5\ndirection_deg = 25\n",
    "[[sea.wave]]\nkind = 'peaked'\nwavelength = 6\namplitude = 0.3\nsharpness = 4\ndirection_deg = 200\n",
    "[[sea.wave]]\nkind = 'gerstner'\nwavelength = 12\nsteepness = 0.8\ndirection_deg = -70\nphase = 1\n",
    "[[sea.wave]]\nkind = 'gerstner'\nwavelength = 12\namplitude = 0.4\nq = 0.7\ndirection_deg = 130\n",
    "[[sea.wave]]\nkind = 'circular'\nwavelength = 5\namplitude = 0.4\ncentre = [3, -8]\n",
    "[[sea.wave]]\nkind = 'circular'\nwavelength = 5\namplitude = 0.4\nsharpness = 3\ncentre = [3, -8]\n",
    "[[layer]]\nmodel = 'fbm'\nkernel = 'sine'\n",
    "[[layer]]\nmodel = 'fbm'\nkernel = 'exp-sine'\nseed = 3\n",
    "[[layer]]\nmodel = 'fbm'\nkernel = 'gerstner'\nchoppiness = 0.4\n",
];

fn models(text: &str) -> Vec<Model> {
    Scene::parse(&format!("{WAVES}{text}"), "x.toml").unwrap().sea.models
}

fn at(models: &[Model], rest: [f64; 2], time: f64) -> Sample {
    evaluate(models, rest, time)
}

/// The displaced point.
fn point(models: &[Model], [x, z]: [f64; 2], time: f64) -> [f64; 3] {
    let [dx, y, dz] = at(models, [x, z], time).displacement;
    [x + dx, y, z + dz]
}

#[test]
fn normals_and_tangents_are_those_of_finite_differences() {
    let mut random = Random(1);
    let step = 1e-4;
    let together = models(&format!("{}{}{}", ALL[0], ALL[2], ALL[7]));
    for models in ALL.iter().map(|text| models(text)).chain([together]) {
        for _ in 0..500 {
            let q = [random.between(-40.0, 40.0), random.between(-40.0, 40.0)];
            let time = random.between(0.0, 500.0);
            let sample = at(&models, q, time);
            let difference = |dx: f64, dz: f64| {
                let after = point(&models, [q[0] + dx, q[1] + dz], time);
                let before = point(&models, [q[0] - dx, q[1] - dz], time);
                std::array::from_fn::<f64, 3, _>(|i| (after[i] - before[i]) / (2.0 * step))
            };
            let (t, b) = (difference(step, 0.0), difference(0.0, step));
            let cross = [b[1] * t[2] - b[2] * t[1], b[2] * t[0] - b[0] * t[2], b[0] * t[1] - b[1] * t[0]];
            let length = cross.iter().map(|part| part * part).sum::<f64>().sqrt();
            let (tangent, binormal, normal) = (sample.tangent(), sample.binormal(), sample.normal());
            for i in 0..3 {
                assert!((tangent[i] - t[i]).abs() < 1e-5, "{q:?} {time}: {tangent:?} {t:?}");
                assert!((binormal[i] - b[i]).abs() < 1e-5, "{q:?} {time}: {binormal:?} {b:?}");
                assert!((normal[i] - cross[i] / length).abs() < 1e-4, "{q:?} {time}: {normal:?}");
            }
        }
    }
}

#[test]
fn crests_travel_along_their_direction_at_their_speed() {
    let mut random = Random(2);
    for text in &ALL[..6] {
        let models = models(text);
        let wave = models[0].waves()[0];
        assert!((wave.speed() - (9.81 / wave.k).sqrt()).abs() < 1e-12, "deep water's, where none is given");
        for _ in 0..200 {
            let (time, later) = (random.between(0.0, 100.0), random.between(0.0, 3.0));
            let angle = random.between(0.0, TAU);
            let (from, along) = match wave.front {
                Front::Plane { direction } => ([random.between(-50.0, 50.0); 2], direction),
                // From anywhere outside the first half wavelength, outwards.
                Front::Ring { centre: [x, z] } => {
                    let along = [angle.cos(), angle.sin()];
                    ([x + 3.0 * along[0], z + 3.0 * along[1]], along)
                }
            };
            let way = wave.speed() * later;
            let to = [from[0] + way * along[0], from[1] + way * along[1]];
            let (before, after) = (at(&models, from, time), at(&models, to, time + later));
            for i in 0..3 {
                assert!((before.displacement[i] - after.displacement[i]).abs() < 1e-10, "{text}");
            }
        }
    }
    // 90 degrees is -Z, and a speed below 0 runs the other way.
    for (keys, z) in [("direction_deg = 90\nspeed = 2", -2.0), ("direction_deg = 90\nspeed = -2", 2.0)] {
        let models = models(&format!("[[sea.wave]]\n{keys}\n"));
        let heights = [[0.0, 0.4], [0.0, 0.4 + z]].map(|q| at(&models, q, 0.0).displacement[1]);
        let later = at(&models, [0.0, 0.4 + z], 1.0).displacement[1];
        assert!((later - heights[0]).abs() < 1e-12 && (later - heights[1]).abs() > 0.01, "{keys}");
    }
}

#[test]
fn a_gerstner_wave_of_steepness_one_is_a_cusp_as_high_as_it_can_be() {
    let gerstner = |steepness: f64| {
        models(&format!("[[sea.wave]]\nkind = 'gerstner'\nwavelength = 12\nsteepness = {steepness}\n"))
    };
    let survey = |models: &[Model]| {
        let mut found = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY];
        for i in 0..=12_000 {
            let sample = at(models, [f64::from(i) * 1e-3, 0.0], 0.0);
            let height = sample.displacement[1];
            found = [found[0].min(height), found[1].max(height), found[2].min(sample.jacobian())];
        }
        found
    };
    for steepness in [0.1, 0.5, 1.0] {
        let [trough, crest, jacobian] = survey(&gerstner(steepness));
        let a = steepness * 12.0 / TAU;
        assert!((crest - a).abs() < 1e-6 && (trough + a).abs() < 1e-6, "{steepness}: {trough} {crest}");
        assert!((jacobian - (1.0 - steepness)).abs() < 1e-6, "{steepness}: {jacobian}");
    }
    // From trough to crest the steepest wave without a loop rises by its length over pi.
    let [trough, crest, _] = survey(&gerstner(1.0));
    assert!((crest - trough - 12.0 / PI).abs() < 1e-6);
    assert!(survey(&gerstner(1.2))[2] < -0.1, "and beyond that it loops");
}

#[test]
fn waves_whose_steepness_sums_to_one_never_fold() {
    let mut random = Random(3);
    let wave = |i: u32, keys: &str| {
        let wavelength = 3.0 + 2.5 * f64::from(i);
        // All along one line, the worst that can be.
        format!(
            "[[sea.wave]]\nkind = 'gerstner'\nwavelength = {wavelength}\nphase = 1.5707963267948966\n{keys}\n"
        )
    };
    let by_q: String = (0..4).map(|i| wave(i, "amplitude = 0.3\nq = 1")).collect();
    let limited: String = (0..4).map(|i| wave(i, "steepness = 0.7")).collect();
    for (text, least) in [(by_q, 0.0), (format!("loops = 'limit'\n{limited}"), 0.0)] {
        let models = models(&text);
        let sum: f64 = models[0].waves().iter().map(|wave| wave.steepness()).sum();
        assert!((sum - 1.0).abs() < 1e-12, "{sum}");
        let folded = (0..20_000)
            .map(|_| at(&models, [random.between(-500.0, 500.0), 0.0], random.between(0.0, 99.0)).jacobian())
            .fold(f64::INFINITY, f64::min);
        assert!(folded >= least - 1e-12, "{folded}");
        assert!(at(&models, [0.0, 0.0], 0.0).jacobian().abs() < 1e-9, "and all crests in one place touch 0");
    }
    let loose = models(&limited_free());
    assert!(at(&loose, [0.0, 0.0], 0.0).jacobian() < -1.0, "without the limit it folds there");
}

fn limited_free() -> String {
    (0..4)
        .map(|i| {
            let wavelength = 3.0 + 2.5 * f64::from(i);
            format!("[[sea.wave]]\nkind = 'gerstner'\nwavelength = {wavelength}\nphase = 1.5707963267948966\nsteepness = 0.7\n")
        })
        .collect()
}

#[test]
fn a_loop_closes() {
    let all = ALL[..6].concat();
    let mut random = Random(4);
    let open = models(&all);
    assert_eq!(loops::length(&open), None);
    let closed = models(&format!("loop_period = 37.5\n{all}{}", ALL[7]));
    let length = loops::length(&closed).unwrap();
    assert!((length - 37.5).abs() < 1e-9, "{length}");
    let mut moved = 0.0_f64;
    for _ in 0..500 {
        let q = [random.between(-200.0, 200.0), random.between(-200.0, 200.0)];
        let time = random.between(-50.0, 50.0);
        let now = at(&closed, q, time);
        for laps in [1.0, -3.0, 16_128.0] {
            // The last is a week.
            let later = at(&closed, q, time + laps * 37.5);
            for i in 0..3 {
                assert!((now.displacement[i] - later.displacement[i]).abs() < 1e-8, "{laps}");
            }
        }
        moved = moved.max((now.displacement[1] - at(&closed, q, time + 18.75).displacement[1]).abs());
    }
    assert!(moved > 0.5, "it moves meanwhile");
    // No frequency is further from its own than half a turn in the loop.
    for (own, closed) in open[0].waves().iter().zip(closed[0].waves()) {
        assert!((own.frequency - closed.frequency).abs() <= 0.5 / 37.5 + 1e-12);
        assert_eq!((own.k, own.amplitude), (closed.k, closed.amplitude));
    }
}

#[test]
fn octaves_stay_within_their_geometric_sum() {
    let mut random = Random(5);
    for kernel in ["sine", "exp-sine", "gerstner"] {
        for (ramp, octaves) in [(0.5_f64, 3), (0.82, 32), (1.0, 64), (0.0, 5)] {
            let text = format!(
                "[[layer]]\nmodel = 'fbm'\nkernel = '{kernel}'\namplitude = 0.7\namplitude_ramp = {ramp}\noctaves = {octaves}\n\
                 frequency_ramp = 1.05\nchoppiness = 1\nseed = {octaves}\n"
            );
            let models = models(&text);
            let Model::Fbm(fbm) = &models[1] else { panic!("a fractal sum") };
            let sum = match ramp {
                1.0 => 0.7 * f64::from(octaves),
                _ => 0.7 * (1.0 - ramp.powi(octaves)) / (1.0 - ramp),
            };
            assert!((fbm.max_height() - sum).abs() < 1e-12 * sum, "{}", fbm.max_height());
            let mut highest = 0.0_f64;
            for _ in 0..2000 {
                let q = [random.between(-1e3, 1e3), random.between(-1e3, 1e3)];
                let sample = at(&models, q, random.between(0.0, 1e3));
                let [x, height, z] = sample.displacement;
                let lowest = if kernel == "exp-sine" { 0.0 } else { -sum };
                assert!((lowest..=sum).contains(&height), "{kernel} {height} of {sum}");
                assert!(x.hypot(z) <= if kernel == "gerstner" { sum } else { 0.0 });
                assert!((0.0..=1.0).contains(&sample.foam));
                highest = highest.max(height);
            }
            // A bound that is far from what happens would bound nothing.
            assert!(highest > sum * if octaves > 8 { 0.25 } else { 0.8 }, "{kernel} {highest} of {sum}");
        }
    }
}

#[test]
fn directions_of_octaves_are_even_and_their_own_for_each_seed() {
    let directions = |seed: u32| -> Vec<[f64; 2]> {
        let models = models(&format!(
            "[[layer]]\nmodel = 'fbm'\noctaves = 64\nfrequency_ramp = 1.05\nseed = {seed}\n"
        ));
        let waves = models[1].waves().iter();
        waves
            .map(|wave| match wave.front {
                Front::Plane { direction } => direction,
                Front::Ring { .. } => panic!("an octave is no ring"),
            })
            .collect()
    };
    let mut sum = [0.0; 2];
    for seed in 0..50 {
        for [x, z] in directions(seed) {
            assert!((x.hypot(z) - 1.0).abs() < 1e-12);
            sum = [sum[0] + x, sum[1] + z];
        }
    }
    // The sum of 3200 random unit vectors has a standard deviation of 40 along each axis.
    assert!(sum[0].hypot(sum[1]) < 200.0, "{sum:?}");
    assert_eq!(directions(1), directions(1));
    assert_ne!(directions(1), directions(2));
}

#[test]
fn rings_are_smooth_at_their_centre() {
    for text in &ALL[4..6] {
        let models = models(text);
        for time in [0.0, 0.3, 0.9, 1.7] {
            let centre = at(&models, [3.0, -8.0], time);
            assert_eq!((centre.displacement, centre.normal()), ([0.0; 3], [0.0, 1.0, 0.0]));
            for angle in [0.0_f64, 1.0, 2.0, 4.0] {
                let near = at(&models, [3.0 + 1e-4 * angle.cos(), -8.0 + 1e-4 * angle.sin()], time);
                assert!(near.normal()[1] > 1.0 - 1e-6 && near.displacement[1].abs() < 1e-6, "no point there");
            }
        }
    }
}

#[test]
fn the_sea_is_as_smooth_far_out_and_after_a_week() {
    // A micrometre along x the height has changed by its slope: rounding a phase would show.
    let step = 2.0_f64.powi(-20);
    let (plane, rings) = (format!("{}{}", ALL[0], ALL[2]), ALL[5]);
    for (text, x, time, most) in [
        (plane.as_str(), 0.0, 0.0, 1e-11),
        (&plane, 1e6, 604_800.0, 1e-11),
        (&plane, -1e9, 1e9, 1e-11),
        (rings, 0.0, 0.0, 1e-11),
        // Here the distance to the centre itself has no more digits.
        (rings, 1e6, 604_800.0, 1e-9),
    ] {
        let models = models(text);
        for i in 0..1000 {
            let x = x + f64::from(i) * 0.125;
            let [before, after] = [x, x + step].map(|x| at(&models, [x, 5.0], time));
            let change = after.displacement[1] - before.displacement[1];
            let off = change - step * 0.5 * (before.along_x[1] + after.along_x[1]);
            assert!(off.abs() < most, "{x} {time}: {off}");
        }
    }
    // The phase of a whole number of wavelengths and periods is none.
    assert_eq!(turns(1.0 / 8.0, 8e9), 0.0);
}
