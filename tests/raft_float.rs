//! The raft on seas whose every height is known.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod raft_common;
use glam::{DVec2, DVec3, Mat3, Vec3};
use proptest::prelude::*;
use raft_common::{Complex, Wave, breeze, flat, settings, transfer};
use std::f64::consts::PI;
use swell::raft::{BuoySettings, Plane, Raft, RaftSettings};
use swell::sea::Surface;

const RATE: f64 = 72.0;

fn raft(at: [f64; 2], heading: f64) -> Raft {
    Raft::new(&settings(), DVec2::from(at), heading).unwrap()
}

/// Mean of e^(i k s) over the probes of a deck's side along which the wave number is `k`, and what is left of the slope.
fn averages(k: f64, side: f64) -> [f64; 2] {
    let probes = [-0.375, -0.125, 0.125, 0.375].map(|share| share * side);
    let mean = probes.iter().map(|s| (k * s).cos()).sum::<f64>() / 4.0;
    let square: f64 = probes.iter().map(|s| s * s).sum();
    let slope =
        if k == 0.0 { 1.0 } else { probes.iter().map(|s| s * (k * s).sin()).sum::<f64>() / (k * square) };
    [mean, slope]
}

#[test]
fn on_a_flat_sea_the_deck_is_level_at_its_freeboard_exactly() {
    let maps = flat();
    for heading in [0.0, 1.3] {
        let mut raft = raft([3.0, -4.0], heading);
        let before = raft.pose();
        for time in [0.0, 0.01, 0.01, 1.5, 0.2, 100.0, f64::NAN, 7.0, 7.5] {
            raft.step(&maps, time);
            assert_eq!(raft.pose(), before);
        }
        assert_eq!(before.position, DVec3::new(3.0, 0.25, -4.0));
        let (sin, cos) = (heading.sin() as f32, heading.cos() as f32);
        let axes = Mat3::from_cols(Vec3::new(cos, 0.0, -sin), Vec3::Y, Vec3::new(sin, 0.0, cos));
        assert_eq!(before.axes.y_axis, Vec3::Y);
        assert!(before.axes.abs_diff_eq(axes, 1e-6), "{:?}", before.axes);
    }
}

#[test]
fn the_plane_is_the_waves_mean_over_the_deck() {
    for (length, towards, heading) in
        [(60.0, 0.0, 0.0), (9.0, 0.7, 0.0), (5.0, 2.5, -0.9), (2.4, 0.3, 0.3), (1.7, -1.1, 4.0)]
    {
        let wave = Wave { length, amplitude: 0.02 * length, towards };
        let maps = wave.at(0.37);
        let sides = [3.0, 1.6];
        for at in [[0.0, 0.0], [12.3, -7.7], [-0.61 * length, 0.2 * length]] {
            let plane = Plane::under(&maps, DVec2::from(at), heading, sides);
            // Wave numbers along the deck's right and back.
            let [right, back] =
                [0.0, -PI / 2.0].map(|turn| wave.wave_number() * (heading + turn - towards).cos());
            let [[mean_right, slope_right], [mean_back, slope_back]] =
                [averages(right, sides[1]), averages(back, sides[0])];
            let phase = wave.along(at[0], at[1]) - wave.omega() * 0.37;
            let height = wave.amplitude * phase.cos() * mean_right * mean_back;
            let steepness = -wave.amplitude * phase.sin();
            let local =
                [steepness * right * slope_right * mean_back, steepness * back * slope_back * mean_right];
            let (sin, cos) = heading.sin_cos();
            let slope = DVec2::new(local[0] * cos + local[1] * sin, local[1] * cos - local[0] * sin);
            let error = 5e-4 * wave.amplitude;
            assert!((plane.height - height).abs() < error, "{wave:?} {at:?}: {plane:?} {height}");
            assert!((plane.slope - slope).length() < 3.0 * error, "{wave:?} {at:?}: {plane:?} {slope}");
        }
    }
}

#[test]
fn the_probes_mean_is_nearly_the_whole_decks() {
    for ratio in [0.02, 0.1, 0.3, 0.5, 0.7, 1.0] {
        // Deck length over wavelength; sinc is the mean over the deck.
        let half = PI * ratio;
        let [mean, _] = averages(2.0 * half, 1.0);
        assert!((mean - half.sin() / half).abs() < 0.03, "{ratio}: {mean}");
    }
}

/// Rides `wave` from 0 for `seconds`; calls `see` with the raft and the time after each step.
fn ride(wave: &Wave, raft: &mut Raft, seconds: f64, mut see: impl FnMut(&Raft, f64)) {
    let mut maps = wave.maps();
    for frame in 0..(seconds * RATE) as u32 {
        let time = f64::from(frame) / RATE;
        wave.fill(&mut maps, time);
        raft.step(&maps, time);
        see(raft, time);
    }
}

#[test]
fn a_long_wave_is_followed_in_height_and_slope() {
    let wave = Wave { length: 100.0, amplitude: 1.0, towards: 0.4 };
    let mut raft = raft([7.0, -3.0], 1.1);
    let [mut high, mut steep] = [0.0_f64; 2];
    ride(&wave, &mut raft, 10.0, |raft, time| {
        let pose = raft.pose();
        // |1 - H| is about r^2 = (0.125 / 1.2)^2 = 0.0108 for heave and 0.0156 for tilt; the deck's mean takes 0.001.
        let water = wave.height(7.0, -3.0, time);
        high = high.max((pose.position.y - 0.25 - water).abs());
        let rise = -wave.amplitude * wave.wave_number() * (wave.along(7.0, -3.0) - wave.omega() * time).sin();
        let (sin, cos) = wave.towards.sin_cos();
        let normal = DVec3::new(-rise * cos, 1.0, rise * sin).normalize();
        steep = steep.max(pose.axes.y_axis.as_dvec3().angle_between(normal));
    });
    assert!(high < 0.0125 && high > 0.005, "{high} m");
    assert!(steep < 0.0628 * 0.017 + 5e-4, "{steep} rad");
}

#[test]
fn heave_is_the_transfer_function_of_deck_and_oscillator() {
    let given = settings();
    for length in [25.0, 6.0, 3.5] {
        let wave = Wave { length, amplitude: 0.01 * length, towards: 0.0 };
        let mut raft = raft([0.0, 0.0], 0.0);
        let [mean, slope] = averages(wave.wave_number(), given.width);
        let heave = transfer(wave.omega(), given.heave_frequency, given.heave_damping);
        let tilt = transfer(wave.omega(), given.tilt_frequency, given.tilt_damping);
        let mut errors = [0.0_f64; 2];
        ride(&wave, &mut raft, 8.0, |raft, time| {
            if time < 3.0 {
                return;
            }
            let at = Complex::turn(wave.omega() * time);
            let height = wave.amplitude * mean * heave.times(at).0;
            // h = a cos(k x - omega t) slopes by a k sin(omega t) at x = 0.
            let rise = wave.amplitude * wave.wave_number() * slope * tilt.times(at).1;
            let up = raft.pose().axes.y_axis;
            errors[0] = errors[0].max((raft.heave().value - height).abs());
            errors[1] = errors[1].max((-f64::from(up.x / up.y) - rise).abs());
            assert!(up.z.abs() < 1e-4 && raft.heading() == 0.0);
        });
        assert!(
            errors[0] < 2e-3 * wave.amplitude && errors[1] < 2e-3 * wave.amplitude,
            "{length}: {errors:?}"
        );
    }
}

#[test]
fn a_wave_as_long_as_the_deck_is_not_felt_in_heave() {
    let most = |length| {
        let mut most = 0.0_f64;
        let wave = Wave { length, amplitude: 0.05, towards: 0.0 };
        ride(&wave, &mut raft([0.3, 0.0], 0.0), 4.0, |raft, _| most = most.max(raft.heave().value.abs()));
        most / 0.05
    };
    let [whole, third, longer] = [2.4, 1.2, 24.0].map(most);
    assert!(whole < 0.01 && third < 0.01, "{whole} {third}");
    assert!(longer > 0.95, "{longer}");
}

#[test]
fn frame_rates_do_not_matter() {
    let mut sea = breeze();
    let mut maps = sea.new_maps();
    let mut run = |rate: u32| {
        let mut raft = raft([4.0, 9.0], 0.2);
        for frame in 0..=2 * rate {
            let time = f64::from(frame) / f64::from(rate);
            sea.step(time, &mut maps).unwrap();
            raft.step(&maps, time);
        }
        raft.pose()
    };
    let [slow, fast] = [45, 180].map(&mut run);
    assert!((slow.position - fast.position).length() < 0.003, "{slow:?} {fast:?}");
    assert!(slow.axes.abs_diff_eq(fast.axes, 0.005), "{slow:?} {fast:?}");
    // Bit for bit the same again.
    assert_eq!(run(45), slow);
}

#[test]
fn a_jump_in_time_puts_it_on_the_water_anew() {
    let wave = Wave { length: 30.0, amplitude: 1.0, towards: 0.0 };
    let given = settings();
    let mut raft = raft([2.0, 0.0], 0.0);
    for (time, anew) in [
        (0.0, true),
        (0.02, false),
        (10.02, true),
        (10.04, false),
        (-5.0, true),
        (f64::NAN, true),
        (200.0, true),
        (201.5, false),
        (0.0, true),
        (f64::INFINITY, true),
        (1.0, true),
    ] {
        let maps = wave.at(if time.is_finite() { time } else { 0.5 });
        assert_eq!(raft.elapsed(time).is_none(), anew, "{time}");
        raft.step(&maps, time);
        let plane = Plane::under(&maps, DVec2::new(2.0, 0.0), 0.0, [given.length, given.width]);
        assert!(!anew || (raft.heave().value == plane.height && raft.heave().rate == 0.0), "{time}");
        assert!((raft.heave().value - plane.height).abs() < 0.5, "{time}");
    }
}

#[test]
fn it_starts_with_the_waters_own_speed() {
    // Half way up a front that rises by 0.9 m/s; started at rest the raft would fall 4 cm behind.
    let wave = Wave { length: 50.0, amplitude: 0.8, towards: 0.0 };
    let mut worst = 0.0_f64;
    ride(&wave, &mut raft([12.5, 0.0], 0.0), 3.0, |raft, time| {
        worst = worst.max((raft.heave().value - wave.height(12.5, 0.0, time)).abs());
    });
    assert!(worst < 0.02, "{worst} m");
}

#[test]
fn no_time_moves_nothing() {
    let wave = Wave { length: 30.0, amplitude: 1.0, towards: 0.0 };
    let mut raft = raft([2.0, 0.0], 0.0);
    raft.step(&wave.at(1.0), 1.0);
    let before = raft;
    raft.step(&wave.at(2.0), 1.0);
    assert_eq!(raft, before);
}

#[test]
fn a_thousand_kilometres_out_it_rides_as_at_home() {
    // 80 m divide 1 000 000 m.
    let mut sea = breeze();
    let mut maps = sea.new_maps();
    let mut rafts = [raft([3.0, 4.0], 0.5), raft([1_000_003.0, -999_996.0], 0.5)];
    for frame in 0..100 {
        let time = f64::from(frame) / RATE;
        sea.step(time, &mut maps).unwrap();
        rafts.iter_mut().for_each(|raft| raft.step(&maps, time));
        let [near, far] = rafts.map(|raft| raft.pose());
        let moved = far.position - near.position - DVec3::new(1e6, 0.0, -1e6);
        assert!(moved.length() < 1e-6 && near.axes.abs_diff_eq(far.axes, 1e-6), "{near:?} {far:?}");
    }
}

#[test]
fn buoys_are_where_the_surface_is() {
    let mut sea = breeze();
    let mut maps = sea.new_maps();
    sea.step(6.5, &mut maps).unwrap();
    for at in [[0.0, 0.0], [17.0, -3.5], [1e6, 40.0]] {
        let buoy = BuoySettings { at, radius: 0.5, color: [1.0, 0.0, 0.0], height: 2.0 };
        let (position, axes) = buoy.float(&maps);
        let surface = Surface::above(&maps, at[0], at[1]);
        assert_eq!(position, DVec3::new(at[0], surface.height(), at[1]));
        let normal = DVec3::from(surface.normal).as_vec3();
        assert!(axes.y_axis.abs_diff_eq(normal, 1e-6) && normal.y < 1.0, "{axes:?} {normal}");
        assert!((axes.transpose() * axes).abs_diff_eq(Mat3::IDENTITY, 1e-6) && axes.determinant() > 0.0);
    }
    let flat = BuoySettings { at: [1.0, 2.0], radius: 0.5, color: [1.0; 3], height: 0.0 }.float(&flat());
    assert_eq!(flat, (DVec3::new(1.0, 0.0, 2.0), Mat3::IDENTITY));
}

#[test]
fn settings_out_of_range_are_refused_by_name() {
    let refused = |change: fn(&mut RaftSettings)| {
        let mut given = settings();
        change(&mut given);
        Raft::new(&given, DVec2::ZERO, 0.0).unwrap_err().to_string()
    };
    assert_eq!(refused(|s| s.length = 0.0), "building the raft: `length` is 0; give a value in 0.5..=20");
    assert!(refused(|s| s.heave_damping = f64::NAN).contains("`heave_damping` is NaN"));
    assert!(refused(|s| s.snap_turn = 2.0).contains("`snap_turn` is 2"));
    assert!(Raft::new(&settings(), DVec2::new(0.0, f64::INFINITY), 0.0).is_err());
    assert!(Raft::new(&settings(), DVec2::ZERO, f64::NAN).is_err());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn whatever_the_clock_says_it_stays_by_the_water(
        times in proptest::collection::vec(
            prop_oneof![
                4 => -3.0..3.0f64,
                1 => Just(f64::NAN),
                1 => Just(f64::NEG_INFINITY),
                1 => -1e12..1e12f64,
                1 => Just(0.0),
            ],
            1..12,
        ),
        heave_frequency in 0.1..10.0f64,
        damping in 0.05..=1.0f64,
    ) {
        let given = RaftSettings {
            heave_frequency,
            heave_damping: damping,
            tilt_frequency: heave_frequency,
            tilt_damping: damping,
            ..settings()
        };
        let wave = Wave { length: 20.0, amplitude: 1.0, towards: 0.3 };
        let mut maps = wave.maps();
        let mut raft = Raft::new(&given, DVec2::ZERO, 0.0).unwrap();
        let mut time = 0.0_f64;
        for step in times {
            time = if step.is_finite() && time.is_finite() { time + step } else { step };
            wave.fill(&mut maps, if time.is_finite() { time } else { 0.0 });
            raft.step(&maps, time);
            let pose = raft.pose();
            // At resonance with the least damping |H| is sqrt(1 + 1 / (2 zeta)^2), about 10; the start adds its own.
            prop_assert!(pose.position.is_finite() && pose.position.y.abs() < 25.0, "{pose:?}");
            prop_assert!((pose.axes.determinant() - 1.0).abs() < 1e-5, "{pose:?}");
            prop_assert!(pose.axes.y_axis.y > 0.0, "{pose:?}");
        }
    }
}
