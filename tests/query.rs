//! Answers of `query`, as JSON.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
use swell::commands::query::{Coordinates, Point, query};
use swell::scene::Scene;

const SCENE: &str = "[sea]\nresolution = 64\nwind_speed = 9\nchoppiness = 0.8\n";

fn ask(time: f64, points: &[Point]) -> Vec<serde_json::Value> {
    let scene = Scene::parse(SCENE, "query.toml").unwrap();
    let mut out = Vec::new();
    query(&scene, time, points, &mut out).unwrap();
    String::from_utf8(out).unwrap().lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn numbers(value: &serde_json::Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

#[test]
fn a_line_for_each_point_in_order() {
    let points = [[1.0, 2.0], [-30.0, 4.5], [1e6, 7.0]].map(Point::At);
    let answers = ask(12.5, &points);
    assert_eq!(answers.len(), 3);
    for (answer, point) in answers.iter().zip([[1.0, 2.0], [-30.0, 4.5], [1e6, 7.0]]) {
        let position = numbers(&answer["position"]);
        let residual = answer["residual"].as_f64().unwrap();
        assert!((position[0] - point[0]).hypot(position[2] - point[1]) <= residual + 1e-6);
        assert!(residual < 1e-3, "{answer}");
        assert_eq!(answer["height"].as_f64().unwrap(), position[1]);
        assert_eq!(answer["time"], 12.5);
        let length = numbers(&answer["normal"]).iter().map(|n| n * n).sum::<f64>().sqrt();
        assert!((length - 1.0).abs() < 1e-9);
        assert!((0.0..=1.0).contains(&answer["foam"].as_f64().unwrap()));
    }
}

#[test]
fn the_point_at_rest_is_found_again_above_its_position() {
    let rest = ask(3.0, &[Point::Rest([11.0, -5.0])]).remove(0);
    assert_eq!(numbers(&rest["rest"]), [11.0, -5.0]);
    assert_eq!(rest["residual"], 0.0);
    let position = numbers(&rest["position"]);
    let displacement = numbers(&rest["displacement"]);
    // JSON is read back to the last bit but one.
    for (position, sum) in
        position.iter().zip([11.0 + displacement[0], displacement[1], -5.0 + displacement[2]])
    {
        assert!((position - sum).abs() < 1e-12);
    }
    let above = ask(3.0, &[Point::At([position[0], position[2]])]).remove(0);
    assert!((above["height"].as_f64().unwrap() - position[1]).abs() < 1e-3, "{above} {rest}");
}

#[test]
fn a_time_that_is_none_is_refused() {
    let scene = Scene::parse(SCENE, "query.toml").unwrap();
    assert!(query(&scene, f64::NAN, &[], Vec::new()).is_err());
}

#[test]
fn coordinates() {
    assert_eq!("1.5,-2".parse(), Ok(Coordinates([1.5, -2.0])));
    for wrong in ["", "1", "1,", "1,2,3", "a,b", "nan,0", "inf,0", "1e10,0"] {
        assert!(wrong.parse::<Coordinates>().unwrap_err().contains("X,Z"), "{wrong}");
    }
}
