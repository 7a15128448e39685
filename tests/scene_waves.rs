//! From a scene's keys to the water: `swell query --rest` gives the printed formulas for every kind of wave.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
#[path = "support/random.rs"]
mod random;
mod waves_common;

use random::Random;
use swell::commands::query::{Point, query};
use swell::scene::Scene;
use swell::sea::waves::Front;
use waves_common::{FOAM, Parts, Plane, circular, foam, octave};

/// A formula: offset and tangents at a rest point and a time, and the foam of them.
struct Formula {
    name: &'static str,
    scene: String,
    parts: Box<dyn Fn([f64; 2], f64) -> Parts>,
    foam: Box<dyn Fn(&Parts) -> f64>,
}

fn formula(
    name: &'static str,
    scene: impl Into<String>,
    parts: impl Fn([f64; 2], f64) -> Parts + 'static,
) -> Formula {
    Formula { name, scene: scene.into(), parts: Box::new(parts), foam: Box::new(|_| 0.0) }
}

const WAVES: &str = "[sea]\nmodel = 'waves'\n";
const RING: &str = "[[sea.wave]]\nkind = 'circular'\nwavelength = 7.5\ncentre = [40, -25]\nspeed = 2\n";

fn plane(wavelength: f64, degrees: f64, speed: Option<f64>, phase: f64) -> Plane {
    Plane { wavelength, degrees, speed, phase }
}

fn every_kind() -> Vec<Formula> {
    let a = plane(11.3, 37.0, None, 0.4);
    let b = plane(4.7, -150.0, Some(1.25), -2.5);
    let c = plane(23.0, 90.0, None, 0.0);
    let ring = plane(7.5, 0.0, Some(2.0), 0.0);
    let one = "[[sea.wave]]\nwavelength = 11.3\ndirection_deg = 37\nphase = 0.4\n";
    let two = "[[sea.wave]]\nwavelength = 4.7\ndirection_deg = -150\nspeed = 1.25\nphase = -2.5\n";
    let three = "[[sea.wave]]\nwavelength = 23\ndirection_deg = 90\n";
    let mut all = vec![
        formula("sine", format!("{WAVES}{one}amplitude = 0.6\n{two}amplitude = 0.2\n"), move |q, t| {
            sum([a.sine(0.6, q, t), b.sine(0.2, q, t)])
        }),
        formula(
            "peaked",
            format!(
                "{WAVES}{one}kind = 'peaked'\namplitude = 0.5\nsharpness = 3.5\n{two}kind = 'peaked'\namplitude = 0.1\nsharpness = 1\n"
            ),
            move |q, t| sum([a.peaked(0.5, 3.5, q, t), b.peaked(0.1, 1.0, q, t)]),
        ),
        formula(
            "gerstner, steepness",
            format!(
                "{WAVES}{one}kind = 'gerstner'\nsteepness = 0.4\n{two}kind = 'gerstner'\nsteepness = 0.3\n{three}kind = 'gerstner'\nsteepness = 0.25\n"
            ),
            move |q, t| sum([a.gerstner(0.4, q, t), b.gerstner(0.3, q, t), c.gerstner(0.25, q, t)]),
        ),
        formula(
            "gerstner, amplitude and q",
            format!(
                "{WAVES}{one}kind = 'gerstner'\namplitude = 0.7\nq = 0.9\n{two}kind = 'gerstner'\namplitude = 0.2\nq = 0.5\n"
            ),
            move |q, t| sum([a.gems(0.7, 0.9, 2.0, q, t), b.gems(0.2, 0.5, 2.0, q, t)]),
        ),
        formula("circular, sine", format!("{WAVES}{RING}amplitude = 0.3\n"), move |q, t| {
            circular(&ring, [40.0, -25.0], |f| [0.3 * f.sin(), 0.3 * f.cos()], q, t)
        }),
        formula(
            "circular, peaked",
            format!("{WAVES}{RING}amplitude = 0.3\nsharpness = 2.5\n"),
            move |q, t| {
                let profile = |f: f64| {
                    let base = (f.sin() + 1.0) / 2.0;
                    [0.6 * base.powf(2.5), 0.3 * 2.5 * base.powf(1.5) * f.cos()]
                };
                circular(&ring, [40.0, -25.0], profile, q, t)
            },
        ),
        formula(
            "two layers",
            format!("{WAVES}{one}amplitude = 0.6\n[[layer]]\n{}kind = 'gerstner'\nsteepness = 0.3\n", {
                two.replace("sea.", "layer.")
            }),
            move |q, t| sum([a.sine(0.6, q, t), b.gerstner(0.3, q, t)]),
        ),
    ];
    for (name, kernel, leaning) in [
        ("fbm, sine", "sine", false),
        ("fbm, exp-sine", "exp-sine", false),
        ("fbm, exp-sine, leaning foam", "exp-sine", true),
        ("fbm, gerstner", "gerstner", true),
    ] {
        all.push(fractal(name, kernel, leaning));
    }
    all
}

/// A fractal sum of 24 octaves; their directions are the one thing that is asked of the code under test.
fn fractal(name: &'static str, kernel: &'static str, leaning: bool) -> Formula {
    let angle = if leaning { "leaning" } else { "upright" };
    let scene = format!(
        "[sea]\nmodel = 'fbm'\namplitude = 0.4\nfrequency = 0.25\nspeed = 1.5\namplitude_ramp = 0.8\nfrequency_ramp = 1.2\n\
         speed_ramp = 1.1\noctaves = 24\nkernel = '{kernel}'\nchoppiness = 0.5\nseed = 7\nloops = 'allow'\n[sea.foam]\n{FOAM}angle = '{angle}'\n"
    );
    let directions: Vec<[f64; 2]> = (Scene::parse(&scene, "fbm").unwrap().sea.models[0].waves().iter())
        .map(|octave| match octave.front {
            Front::Plane { direction } => direction,
            Front::Ring { .. } => panic!("an octave is no ring"),
        })
        .collect();
    assert_eq!(directions.len(), 24);
    let parts = move |[x, z]: [f64; 2], t: f64| {
        let mut sum = Parts::default();
        for (i, d) in directions.iter().enumerate() {
            let i = i as i32;
            let (a, k, p) = (0.4 * 0.8_f64.powi(i), 0.25 * 1.2_f64.powi(i), 1.5 * 1.1_f64.powi(i));
            sum.add(octave(kernel, 0.5, a, k, *d, k * (d[0] * x + d[1] * z) - p * t));
        }
        sum
    };
    let most = 0.4 * (1.0 - 0.8_f64.powi(24)) / (1.0 - 0.8);
    Formula {
        foam: Box::new(move |parts| foam(parts.offset[1], most, parts.normal()[1], leaning)),
        ..formula(name, scene, parts)
    }
}

fn sum<const N: usize>(parts: [Parts; N]) -> Parts {
    let mut sum = Parts::default();
    parts.into_iter().for_each(|part| sum.add(part));
    sum
}

#[test]
fn query_at_rest_equals_the_printed_formulas() {
    let mut random = Random(6);
    println!("| kind | points | displacement, m | normal | foam |\n|---|---|---|---|---|");
    for formula in every_kind() {
        let scene = Scene::parse(&formula.scene, formula.name).unwrap();
        let (mut most, mut foamy, mut count) = ([0.0_f64; 3], 0, 0);
        for _ in 0..50 {
            let time = random.between(-100.0, 1000.0);
            let points: Vec<[f64; 2]> = (0..40)
                .map(|i| {
                    // Some within the first ring, most anywhere.
                    let ([x, z], reach) = if i < 8 { ([40.0, -25.0], 5.0) } else { ([0.0; 2], 1000.0) };
                    [x + random.between(-reach, reach), z + random.between(-reach, reach)]
                })
                .collect();
            let mut out = Vec::new();
            query(&scene, time, &points.iter().copied().map(Point::Rest).collect::<Vec<_>>(), &mut out)
                .unwrap();
            for (line, rest) in String::from_utf8(out).unwrap().lines().zip(points) {
                let answer: serde_json::Value = serde_json::from_str(line).unwrap();
                let got = |key: &str, i: usize| answer[key][i].as_f64().unwrap();
                let wanted = (formula.parts)(rest, time);
                let normal = wanted.normal();
                for (i, (offset, normal)) in wanted.offset.into_iter().zip(normal).enumerate() {
                    most[0] = most[0].max((got("displacement", i) - offset).abs());
                    most[1] = most[1].max((got("normal", i) - normal).abs());
                }
                let foam = (formula.foam)(&wanted);
                most[2] = most[2].max((answer["foam"].as_f64().unwrap() - foam).abs());
                foamy += u32::from(foam > 0.01 && foam < 0.99);
                count += 1;
            }
        }
        let [displacement, normal, foam] = most;
        println!("| {} | {count} | {displacement:.1e} | {normal:.1e} | {foam:.1e} |", formula.name);
        assert!(displacement < 1e-9 && normal < 1e-9 && foam < 1e-8, "{}: {most:?}", formula.name);
        // A formula for foam that says the same everywhere would prove nothing.
        assert_eq!(foamy > 100, formula.name.starts_with("fbm"), "{}: {foamy} of {count}", formula.name);
    }
}

#[test]
fn layers_add_to_the_spectral_sea() {
    let spectral = "[sea]\nresolution = 64\nwind_speed = 9\nseed = 4\n";
    let layer = "[[layer]]\n[[layer.wave]]\nkind = 'gerstner'\nwavelength = 11.3\ndirection_deg = 37\nsteepness = 0.4\n";
    let ask = |text: &str, q: [f64; 2]| {
        let mut out = Vec::new();
        query(&Scene::parse(text, "x").unwrap(), 7.5, &[Point::Rest(q)], &mut out).unwrap();
        serde_json::from_slice::<serde_json::Value>(&out).unwrap()
    };
    let wave = plane(11.3, 37.0, None, 0.0);
    let mut normals_differ = 0.0_f64;
    for q in [[0.0, 0.0], [12.5, -7.25], [-300.0, 81.0]] {
        let (alone, both) = (ask(spectral, q), ask(&format!("{spectral}{layer}"), q));
        let wave = wave.gerstner(0.4, q, 7.5);
        for i in 0..3 {
            let sum = alone["displacement"][i].as_f64().unwrap() + wave.offset[i];
            assert!((both["displacement"][i].as_f64().unwrap() - sum).abs() < 1e-9);
            let change = both["normal"][i].as_f64().unwrap() - alone["normal"][i].as_f64().unwrap();
            normals_differ = normals_differ.max(change.abs());
        }
    }
    assert!(normals_differ > 0.05);
}

#[test]
fn a_spectral_sea_is_what_it_was() {
    let ask = |text: &str| {
        let mut out = Vec::new();
        let points = [[0.0, 0.0], [12.5, -7.25], [1e6, 81.0]].map(Point::At);
        query(&Scene::parse(text, "x").unwrap(), 7.5, &points, &mut out).unwrap();
        out
    };
    let plain = ask("[sea]\nresolution = 64\n");
    // Keys that say what holds anyway, and a layer of no waves, change no byte.
    assert_eq!(plain, ask("[sea]\nmodel = 'fft'\nresolution = 64\nloops = 'refuse'\nloop_period = 9\n"));
    assert_ne!(plain, ask("[sea]\nresolution = 64\n[[layer]]\nmodel = 'fbm'\n"));
}
