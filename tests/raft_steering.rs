//! Thumbsticks, turns and the vignette.
mod raft_common;
use glam::{DVec2, Quat, Vec3};
use proptest::prelude::*;
use raft_common::settings;
use std::f64::consts::{FRAC_PI_2, PI};
use swell::raft::{RaftSettings, Steering, Stick, Vignette, yaw_of};

const FORWARD: Stick = Stick { x: 0.0, y: 1.0 };

fn side(x: f64) -> Stick {
    Stick { x, y: 0.0 }
}

#[test]
fn the_dead_zone_is_round_and_the_rest_starts_at_nothing() {
    for turn in 0..16 {
        let (sin, cos) = (f64::from(turn) * PI / 8.0).sin_cos();
        let deflection = |length: f64| Stick { x: length * cos, y: length * sin }.deflection(0.2);
        for (length, left) in
            [(0.0, 0.0), (0.199, 0.0), (0.2001, 0.000_125), (0.6, 0.5), (1.0, 1.0), (1.4, 1.0)]
        {
            let wanted = DVec2::new(cos, sin) * left;
            assert!(
                (deflection(length) - wanted).length() < 1e-9,
                "{turn}, {length}: {}",
                deflection(length)
            );
        }
    }
    for none in [f64::NAN, f64::INFINITY] {
        assert_eq!(Stick { x: none, y: 0.3 }.deflection(0.1), DVec2::ZERO);
    }
    assert_eq!(side(0.5).deflection(0.0), DVec2::new(0.5, 0.0));
}

#[test]
fn the_way_is_the_integral_of_a_velocity_that_ramps() {
    let given = settings();
    let mut steering = Steering::default();
    // 0 to 3 m/s at 6 m/s^2 takes 0.5 s and 0.75 m; the rest of 2 s is at full speed; stopping takes 0.75 m again.
    let way = steering.glide(&given, FORWARD, 0.0, 2.0);
    assert!((way - DVec2::new(0.0, -0.75 - 1.5 * 3.0)).length() < 1e-12, "{way}");
    assert!((steering.velocity() - DVec2::new(0.0, -3.0)).length() < 1e-12);
    let way = steering.glide(&given, Stick::default(), 0.0, 2.0);
    assert!((way - DVec2::new(0.0, -0.75)).length() < 1e-12, "{way}");
    assert_eq!(steering.velocity(), DVec2::ZERO);
    assert_eq!(steering.glide(&given, Stick { x: 0.1, y: 0.15 }, 0.0, 5.0), DVec2::ZERO);
    // Half of what is left beyond the dead zone is half the speed.
    steering.glide(&given, Stick { x: 0.0, y: 0.6 }, 0.0, 2.0);
    assert!((steering.velocity() - DVec2::new(0.0, -1.5)).length() < 1e-12);
}

#[test]
fn forward_is_where_the_yaw_points() {
    for (yaw, stick, way) in [
        (0.0, FORWARD, [0.0, -1.0]),
        (0.0, side(1.0), [1.0, 0.0]),
        (FRAC_PI_2, FORWARD, [-1.0, 0.0]),
        (FRAC_PI_2, side(1.0), [0.0, -1.0]),
        (PI, FORWARD, [0.0, 1.0]),
    ] {
        let mut steering = Steering::default();
        steering.glide(&settings(), stick, yaw, 1.0);
        assert!((steering.velocity() - 3.0 * DVec2::from(way)).length() < 1e-12, "{yaw} {stick:?}");
    }
}

#[test]
fn one_flick_is_one_turn() {
    let given = RaftSettings { snap_turn: 0.5, ..settings() };
    let mut steering = Steering::default();
    // Deflection and what it turns by. Held from the start: nothing. Again only after it was below 0.4.
    for (x, turned) in [
        (1.0, 0.0),
        (0.5, 0.0),
        (1.0, 0.0),
        (0.0, 0.0),
        (0.69, 0.0),
        (0.7, -0.5),
        (1.0, 0.0),
        (0.41, 0.0),
        (0.9, 0.0),
        (f64::NAN, 0.0),
        (0.39, 0.0),
        (0.9, -0.5),
        (-0.9, 0.0),
        (0.3, 0.0),
        (-0.8, 0.5),
        (0.0, 0.0),
        (0.0, 0.0),
    ] {
        assert_eq!(steering.turn(&given, side(x), 0.01), turned, "{x}");
    }
    steering.turn(&given, side(0.0), 0.01);
    steering.stop();
    assert_eq!(steering.turn(&given, side(1.0), 0.01), 0.0);
}

#[test]
fn a_turn_takes_the_velocity_along() {
    let given = RaftSettings { snap_turn: FRAC_PI_2, ..settings() };
    let mut steering = Steering::default();
    steering.glide(&given, FORWARD, 0.0, 1.0);
    steering.turn(&given, side(0.0), 0.01);
    assert_eq!(steering.turn(&given, side(1.0), 0.01), -FRAC_PI_2);
    // To the right of -Z is +X.
    assert!((steering.velocity() - DVec2::new(3.0, 0.0)).length() < 1e-12);
}

#[test]
fn a_smooth_turn_is_a_rate() {
    let given = RaftSettings { smooth_turn: 2.0, ..settings() };
    let mut steering = Steering::default();
    assert!((steering.turn(&given, side(1.0), 0.25) + 0.5).abs() < 1e-12);
    assert!((steering.turn(&given, side(-0.6), 0.5) - 0.5).abs() < 1e-12);
    assert_eq!(steering.turn(&given, side(0.19), 0.5), 0.0);
}

#[test]
fn yaw_is_where_one_looks_seen_from_above() {
    for yaw in [-3.0, -1.0, 0.0, 0.5, 2.0] {
        for pitch in [-FRAC_PI_2, -1.0, 0.0, 0.7, FRAC_PI_2] {
            let orientation = Quat::from_rotation_y(yaw as f32) * Quat::from_rotation_x(pitch as f32);
            assert!((yaw_of(orientation) - yaw).abs() < 1e-6, "{yaw} {pitch}: {}", yaw_of(orientation));
        }
        let rolled = Quat::from_rotation_y(yaw as f32) * Quat::from_rotation_z(1.2);
        assert!((yaw_of(rolled) - yaw).abs() < 1e-6);
    }
    assert!(yaw_of(Quat::from_xyzw(f32::NAN, 0.0, 0.0, 1.0)) == 0.0);
    assert!((yaw_of(Quat::from_axis_angle(Vec3::Y, 0.3)) - 0.3).abs() < 1e-6);
}

#[test]
fn the_vignette_closes_fast_and_opens_slowly() {
    let given = RaftSettings { vignette: 0.8, ..settings() };
    let mut vignette = Vignette::default();
    let mut frames = |speed: f64, turn: f64, count: u32| {
        let mut strengths = vec![vignette.strength()];
        for _ in 0..count {
            vignette.step(&given, speed, turn, 0.01);
            strengths.push(vignette.strength());
        }
        strengths
    };
    let still = frames(0.0, 0.0, 10);
    assert_eq!(still, [0.0; 11]);
    let closing = frames(3.0, 0.0, 13);
    assert!(closing.is_sorted() && closing[5] > 0.3 && closing[13] == 0.8, "{closing:?}");
    let opening = frames(0.0, 0.0, 49);
    assert!(opening.is_sorted_by(|a, b| a >= b) && opening[24] > 0.35 && opening[49] == 0.0, "{opening:?}");
    // Half the speed is half the strength; a smooth turn of 90 degrees a second is all of it; the larger counts.
    assert_eq!(frames(1.5, 0.0, 100)[100], 0.4);
    assert_eq!(frames(1.5, -FRAC_PI_2, 100)[100], 0.8);
    let none = RaftSettings { vignette: 0.0, ..given };
    let mut vignette = Vignette::default();
    vignette.step(&none, 3.0, 3.0, 1.0);
    assert_eq!(vignette.strength(), 0.0);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_way_is_the_same_at_any_frame_rate(
        sticks in proptest::collection::vec(([-1.0..1.0f64, -1.0..1.0], -4.0..4.0f64, 0.01..1.0f64, 1..20u32), 1..5),
    ) {
        let given = settings();
        let mut steerings = [Steering::default(); 2];
        let mut at = [DVec2::ZERO; 2];
        for ([x, y], yaw, seconds, parts) in sticks {
            let stick = Stick { x, y };
            at[0] += steerings[0].glide(&given, stick, yaw, seconds);
            for _ in 0..parts {
                at[1] += steerings[1].glide(&given, stick, yaw, seconds / f64::from(parts));
            }
            prop_assert!((at[0] - at[1]).length() < 1e-9, "{at:?}");
            prop_assert!((steerings[0].velocity() - steerings[1].velocity()).length() < 1e-9);
            prop_assert!(steerings[0].velocity().length() <= given.glide_speed + 1e-9);
        }
    }

    #[test]
    fn the_velocity_changes_no_faster_than_allowed(
        sticks in proptest::collection::vec([-1.5..1.5f64, -1.5..1.5], 1..40),
        seconds in 0.0..0.1f64,
    ) {
        let given = settings();
        let mut steering = Steering::default();
        for [x, y] in sticks {
            let before = steering.velocity();
            steering.glide(&given, Stick { x, y }, 0.3, seconds);
            prop_assert!((steering.velocity() - before).length() <= given.glide_acceleration * seconds + 1e-12);
        }
    }

    #[test]
    fn the_vignette_keeps_its_bounds(
        steps in proptest::collection::vec(
            (
                prop_oneof![0.0..10.0f64, Just(f64::NAN)],
                prop_oneof![-10.0..10.0f64, Just(f64::INFINITY)],
                prop_oneof![0.0..1.0f64, Just(f64::NAN), Just(0.0)],
            ),
            1..20,
        ),
        strength in 0.0..=1.0f64,
        glide_speed in 0.0..5.0f64,
    ) {
        let given = RaftSettings { vignette: strength, glide_speed, ..settings() };
        let mut vignette = Vignette::default();
        for (speed, turn, seconds) in steps {
            let before = vignette.strength();
            vignette.step(&given, speed, turn, seconds);
            let now = vignette.strength();
            prop_assert!((0.0..=strength).contains(&now), "{now}");
            prop_assert!(seconds > 0.0 || now == before);
        }
    }
}
