//! `swell query`: one line of JSON a point, in the order asked.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use std::f64::consts::TAU;
use support::program::{run, swell_alone};
use support::random::Random;

#[test]
fn a_thousand_points_give_a_thousand_lines_in_order() {
    let mut random = Random(4);
    let points: Vec<(&str, [f64; 2])> = (0..1000)
        .map(|_| {
            let option = if random.bits().is_multiple_of(2) { "--at" } else { "--rest" };
            (option, [random.between(-5e3, 5e3), random.between(-5e3, 5e3)])
        })
        .collect();
    let mut command = swell_alone();
    command.args(["query", "--time", "33.25"]);
    for (option, [x, z]) in &points {
        command.arg(option).arg(format!("{x},{z}"));
    }
    let said = run(&mut command);
    assert_eq!((said.status, said.err.as_str()), (Some(0), ""));
    let lines: Vec<serde_json::Value> =
        said.out.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines.len(), points.len());
    for (line, (option, [x, z])) in lines.iter().zip(points) {
        let number = |key: &str, index: usize| line[key][index].as_f64().unwrap();
        let residual = line["residual"].as_f64().unwrap();
        let (found, most) = match option {
            "--at" => ([number("position", 0), number("position", 2)], residual + 1e-6),
            _ => ([number("rest", 0), number("rest", 1)], 1e-9),
        };
        assert!((found[0] - x).hypot(found[1] - z) <= most, "{option} {x},{z}: {line}");
        assert!(residual < 0.01, "{line}");
        assert_eq!(line["time"], 33.25);
        for key in ["height", "foam"] {
            assert!(line[key].as_f64().unwrap().is_finite(), "{line}");
        }
    }
}

#[test]
fn a_scene_of_formulas_gives_their_numbers_and_its_warnings() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("steep.toml");
    let wave = "[[sea.wave]]\nkind = 'gerstner'\nwavelength = 12\nsteepness = 0.75\n";
    std::fs::write(&scene, format!("[sea]\nmodel = 'waves'\n{wave}{wave}")).unwrap();
    let said = run(swell_alone().args(["query", "--time", "2", "--rest", "3,4", "--scene"]).arg(&scene));
    assert_eq!(said.status, Some(0));
    let warned = format!(
        "warning: {}:3:1: the steepness of sea.wave 1 (0.75), sea.wave 2 (0.75) sums to 1.5",
        scene.display()
    );
    assert!(said.err.starts_with(&warned) && said.err.lines().count() == 1, "{}", said.err);
    let answer: serde_json::Value = serde_json::from_str(&said.out).unwrap();
    let k = TAU / 12.0;
    let f = k * (3.0 - (9.81 / k).sqrt() * 2.0);
    for (i, wanted) in [1.5 / k * f.cos(), 1.5 / k * f.sin(), 0.0].into_iter().enumerate() {
        assert!((answer["displacement"][i].as_f64().unwrap() - wanted).abs() < 1e-9, "{answer}");
    }
}
