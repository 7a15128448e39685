//! Play space in the world: where a rider is, whatever they and the sea do.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod raft_common;
use glam::{DVec2, DVec3, Mat3, Quat, Vec3};
use proptest::prelude::*;
use raft_common::{Wave, breeze, flat, settings};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use swell::raft::{Head, Horizon, Input, RaftSettings, Rider, Stick};
use swell::sea::SeaMaps;

const EYES: DVec3 = DVec3::new(0.4, 1.7, -0.3);

fn held(held_heave: f64) -> RaftSettings {
    RaftSettings { horizon: Horizon::Still, held_heave, ..settings() }
}

fn input(position: DVec3, yaw: f64, turn: f64) -> Input {
    Input { turn: Stick { x: turn, y: 0.0 }, head: Head { position, yaw }, forward: yaw, ..Input::default() }
}

/// A rider who has ridden a wave for a while and stands tilted.
fn tilted(given: &RaftSettings, at: [f64; 2]) -> (Rider, SeaMaps, f64) {
    let wave = Wave { length: 20.0, amplitude: 1.0, towards: 0.7 };
    let mut rider = Rider::new(given, DVec2::from(at), 0.3).unwrap();
    let mut maps = wave.maps();
    let mut time = 0.0;
    for frame in 0..100 {
        time = f64::from(frame) / 72.0;
        wave.fill(&mut maps, time);
        rider.step(&maps, time, &input(EYES, 0.2, 0.0));
    }
    assert!(rider.raft().pose().axes.y_axis.y < 0.99, "{:?}", rider.raft().pose());
    (rider, maps, time)
}

#[test]
fn play_space_stands_on_the_deck_and_looks_along_the_heading() {
    let mut rider = Rider::new(&settings(), DVec2::new(10.0, 20.0), FRAC_PI_2).unwrap();
    rider.step(&flat(), 0.0, &Input::default());
    let (position, axes) = rider.to_world(DVec3::new(0.0, 1.7, -1.0), Quat::IDENTITY);
    // A heading of pi/2 is -X.
    assert!((position - DVec3::new(9.0, 1.95, 20.0)).length() < 1e-12, "{position}");
    assert!(axes.z_axis.abs_diff_eq(Vec3::X, 1e-6) && axes.y_axis == Vec3::Y, "{axes:?}");
    assert_eq!(rider.play_space().position, DVec3::new(10.0, 0.25, 20.0));
}

#[test]
fn a_turn_keeps_the_head_where_it_is() {
    for given in [settings(), held(1.0), held(0.3)] {
        for at in [[5.0, -3.0], [1e6, -1e6]] {
            let (mut rider, maps, time) = tilted(&given, at);
            let before = rider.to_world(EYES, Quat::IDENTITY);
            let deck = rider.raft().pose();
            // No time passes between the two, so that the sea cannot have moved the head.
            rider.step(&maps, time, &input(EYES, 0.2, 1.0));
            let after = rider.to_world(EYES, Quat::IDENTITY);
            assert!((after.0 - before.0).length() < 1e-9, "{before:?} {after:?}");
            // 30 degrees to the right about the view's own up.
            let turned = before.1 * Mat3::from_rotation_y(-30f32.to_radians());
            assert!(after.1.abs_diff_eq(turned, 1e-5), "{before:?} {after:?}");
            // The raft turned along and swung around the head: 2 |(0.4, -0.3)| sin 15 degrees.
            let swung = rider.raft().pose();
            let way = (swung.position - deck.position).length();
            assert!(
                (way - 0.2588).abs() < if given.horizon == Horizon::Rides { 1e-4 } else { 0.05 },
                "{way}"
            );
            assert!((rider.raft().heading() - 0.3 + 30f64.to_radians()).abs() < 1e-12);
        }
    }
}

#[test]
fn a_turn_does_not_kick_the_raft() {
    let wave = Wave { length: 20.0, amplitude: 1.0, towards: 0.7 };
    let mut worst = [0.0_f64; 2];
    for side in 0..8 {
        let (sin, cos) = (f64::from(side) * FRAC_PI_4).sin_cos();
        let head = DVec3::new(0.5 * cos, 1.7, 0.5 * sin);
        let (mut turning, mut maps, time) = tilted(&settings(), [5.0, -3.0]);
        let mut still = turning;
        for frame in 1..40 {
            let now = time + f64::from(frame) / 72.0;
            wave.fill(&mut maps, now);
            turning.step(&maps, now, &input(head, 0.2, if frame == 1 { 1.0 } else { 0.0 }));
            still.step(&maps, now, &input(head, 0.2, 0.0));
            let [a, b] = [&turning, &still].map(|rider| rider.to_world(head, Quat::IDENTITY).0);
            worst[0] = worst[0].max((a - b).length());
            let [a, b] = [&turning, &still].map(|rider| rider.raft().heave().rate);
            worst[1] = worst[1].max((a - b).abs());
        }
    }
    // The deck comes to stand 0.26 m on, where the water rises at another speed, a k omega 0.26 = 0.14 m/s at the most, and
    // slopes by a k^2 0.26 = 0.026 more. A damper that felt that water jump would add 2 zeta omega 0.26 a k = 0.86 m/s.
    assert!(worst[0] < 0.06 && worst[1] < 0.2, "{worst:?}");
}

#[test]
fn a_still_horizon_is_level_exactly_and_heaves_as_told() {
    for share in [0.0, 0.5, 1.0] {
        let (rider, ..) = tilted(&held(share), [2.0, 2.0]);
        let (_, axes) = rider.to_world(EYES, Quat::IDENTITY);
        assert_eq!(axes.y_axis, Vec3::Y);
        assert_eq!((axes.x_axis.y, axes.z_axis.y), (0.0, 0.0));
        let floor = rider.play_space().position;
        let heave = rider.raft().heave().value;
        assert!(heave.abs() > 0.1 && (floor.y - 0.25 - share * heave).abs() < 1e-12, "{floor} {heave}");
        assert!(share < 1.0 || floor == rider.raft().position());
    }
}

#[test]
fn a_rider_tilts_with_the_deck_unless_the_horizon_is_held() {
    let (rider, ..) = tilted(&settings(), [2.0, 2.0]);
    let (deck, play) = (rider.raft().pose(), rider.play_space());
    assert_eq!(deck.position, play.position);
    assert!(play.axes.abs_diff_eq(deck.axes, 1e-6), "{play:?} {deck:?}");
    // The sea does not turn the deck: the smallest rotation to its normal has no part about +Y.
    assert!(rider.raft().tilt().y.abs() < 1e-15);
}

#[test]
fn gliding_moves_the_rider_by_the_way_and_no_more() {
    let maps = flat();
    let mut rider = Rider::new(&settings(), DVec2::ZERO, 0.5).unwrap();
    let start = rider.to_world(EYES, Quat::IDENTITY).0;
    for frame in 0..=144 {
        let given = Input { glide: Stick { x: 0.0, y: 1.0 }, ..input(EYES, 0.7, 0.0) };
        rider.step(&maps, f64::from(frame) / 72.0, &given);
    }
    // 2 s: 0.75 m to get going, then 1.5 s at 3 m/s, towards the head's yaw in the world, 1.2.
    let way = rider.to_world(EYES, Quat::IDENTITY).0 - start;
    let wanted = 5.25 * DVec3::new(-1.2f64.sin(), 0.0, -1.2f64.cos());
    assert!((way - wanted).length() < 1e-9, "{way} {wanted}");
    assert!((rider.velocity().length() - 3.0).abs() < 1e-12 && rider.vignette() == settings().vignette);
}

#[test]
fn waves_and_snaps_close_no_vignette_and_a_smooth_turn_does() {
    let (rider, ..) = tilted(&settings(), [0.0, 0.0]);
    assert_eq!(rider.vignette(), 0.0);
    for (smooth_turn, closed) in [(0.0, false), (2.0, true)] {
        let given = RaftSettings { smooth_turn, ..settings() };
        let (mut rider, maps, time) = tilted(&given, [0.0, 0.0]);
        rider.step(&maps, time + 0.014, &input(EYES, 0.2, 1.0));
        assert!((rider.to_world(EYES, Quat::IDENTITY).1.z_axis.x - 0.3f32.sin()).abs() > 0.01);
        assert_eq!(rider.vignette() > 0.0, closed, "{smooth_turn}");
    }
}

#[test]
fn after_a_pause_the_rider_stands_still() {
    let maps = flat();
    let mut rider = Rider::new(&settings(), DVec2::ZERO, 0.0).unwrap();
    let pushed = Input { glide: Stick { x: 0.0, y: 1.0 }, ..input(EYES, 0.0, 1.0) };
    rider.step(&maps, 0.0, &Input::default());
    rider.step(&maps, 0.5, &Input { turn: Stick::default(), ..pushed });
    assert!(rider.velocity().length() > 2.9);
    let before = rider.to_world(EYES, Quat::IDENTITY);
    rider.step(&maps, 60.0, &pushed);
    assert_eq!(rider.velocity(), DVec2::ZERO);
    assert_eq!(rider.to_world(EYES, Quat::IDENTITY), before);
    // The stick that turns was held all the while: that is no flick.
    rider.step(&maps, 60.1, &Input { glide: Stick::default(), ..pushed });
    assert_eq!(rider.to_world(EYES, Quat::IDENTITY), before);
}

#[test]
fn recentring_moves_the_raft_and_not_the_view() {
    for given in [settings(), held(0.5)] {
        let (mut rider, maps, time) = tilted(&given, [40.0, 7.0]);
        let before = rider.to_world(EYES, Quat::IDENTITY);
        rider.recentre();
        let after = rider.to_world(EYES, Quat::IDENTITY);
        assert!((after.0 - before.0).length() < 1e-12 && after.1 == before.1);
        // The deck lies under the head along its own up, and its front is where the head looks: 0.3 + 0.2.
        let (floor, _) = rider.to_world(EYES.with_y(0.0), Quat::IDENTITY);
        let deck = rider.raft().position();
        assert!((DVec2::new(floor.x, floor.z) - DVec2::new(deck.x, deck.z)).length() < 1e-12);
        assert!((rider.raft().heading() - 0.5).abs() < 1e-12);
        // Turns are still about the head, and the raft's front keeps its angle to play space.
        rider.step(&maps, time, &input(EYES + DVec3::X, 0.2, 0.0));
        let before = rider.to_world(EYES + DVec3::X, Quat::IDENTITY).0;
        rider.step(&maps, time, &input(EYES + DVec3::X, 0.2, -1.0));
        assert!((rider.to_world(EYES + DVec3::X, Quat::IDENTITY).0 - before).length() < 1e-9);
        assert!((rider.raft().heading() - 0.5 - 30f64.to_radians()).abs() < 1e-12);
    }
}

#[test]
fn the_same_ride_twice_is_the_same_to_the_last_bit() {
    let ride = || {
        let mut sea = breeze();
        let mut maps = sea.new_maps();
        let mut rider = Rider::new(&settings(), DVec2::new(1.0, 2.0), 0.1).unwrap();
        for frame in 0..120_u32 {
            let time = f64::from(frame) / 72.0;
            sea.step(time, &mut maps).unwrap();
            let turn = if frame % 30 == 15 { 1.0 } else { 0.0 };
            let glide = Stick { x: 0.3, y: 0.9 };
            rider.step(&maps, time, &Input { glide, ..input(EYES, 0.01 * f64::from(frame), turn) });
        }
        rider
    };
    assert_eq!(ride(), ride());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn to_the_world_and_back(
        position in [-3.0..3.0f64, 0.0..2.5, -3.0..3.0],
        turns in [-3.0..3.0f64, -1.5..1.5, -3.0..3.0],
        still in any::<bool>(),
    ) {
        let given = if still { held(1.0) } else { settings() };
        let (mut rider, maps, time) = tilted(&given, [1e6, -1e6]);
        rider.step(&maps, time, &input(DVec3::from(position), turns[0], 1.0));
        rider.recentre();
        let orientation = Quat::from_euler(glam::EulerRot::YXZ, turns[0] as f32, turns[1] as f32, turns[2] as f32);
        let (world, axes) = rider.to_world(DVec3::from(position), orientation);
        let (play, back) = rider.to_play(world, axes);
        prop_assert!((play - DVec3::from(position)).length() < 1e-6, "{play} {position:?}");
        prop_assert!(back.dot(orientation).abs() > 1.0 - 1e-6, "{back} {orientation}");
        prop_assert!((world - DVec3::new(1e6, 0.0, -1e6)).length() < 20.0);
    }

    #[test]
    fn no_input_makes_a_pose_that_is_none(
        steps in proptest::collection::vec(
            proptest::array::uniform9(prop_oneof![
                6 => -2.0..2.0f64,
                1 => Just(f64::NAN),
                1 => Just(f64::INFINITY),
                1 => Just(0.0),
            ]),
            1..20,
        ),
        smooth_turn in prop_oneof![Just(0.0), 0.0..6.0f64],
        still in any::<bool>(),
    ) {
        let base = if still { held(0.5) } else { settings() };
        let wave = Wave { length: 7.0, amplitude: 0.5, towards: 2.0 };
        let maps = wave.at(0.0);
        let mut rider = Rider::new(&RaftSettings { smooth_turn, ..base }, DVec2::ZERO, 0.0).unwrap();
        let mut time = 0.0;
        for [dt, gx, gy, tx, ty, hx, hz, yaw, forward] in steps {
            time = if dt.is_finite() { time + dt } else { dt };
            rider.step(&maps, time, &Input {
                glide: Stick { x: gx, y: gy },
                turn: Stick { x: tx, y: ty },
                forward,
                head: Head { position: DVec3::new(hx, 1.6, hz), yaw },
            });
            if gx > 1.0 {
                rider.recentre();
            }
            time = if time.is_finite() { time } else { 0.0 };
            let (position, axes) = rider.to_world(EYES, Quat::IDENTITY);
            prop_assert!(position.is_finite() && position.length() < 500.0, "{position}");
            prop_assert!((axes.determinant() - 1.0).abs() < 1e-5, "{axes:?}");
            let deck = rider.raft().pose();
            prop_assert!(deck.position.is_finite() && deck.axes.is_finite(), "{deck:?}");
            prop_assert!((0.0..=1.0).contains(&rider.vignette()));
        }
    }
}
