//! The oscillator against what is known of it in closed form.
mod raft_common;
use proptest::prelude::*;
use raft_common::{Complex, transfer};
use std::f64::consts::{SQRT_2, TAU};
use swell::raft::{Motion, Response};

const REST: Motion = Motion { value: 0.0, rate: 0.0 };

#[test]
fn a_step_of_the_water_is_answered_as_textbooks_say() {
    for (frequency, damping) in [(1.2, 0.7), (0.3, 0.05), (5.0, 0.999_999_9), (1.0, 1.0)] {
        let response = Response::new(frequency, damping);
        let omega: f64 = TAU * frequency;
        for step in 1..200 {
            let time = f64::from(step) * 0.02;
            let (value, rate) = if damping < 1.0 {
                let root = (1.0 - damping * damping).sqrt();
                let (sin, cos) = (omega * root * time).sin_cos();
                let left = (-damping * omega * time).exp();
                (1.0 - left * (cos + damping / root * sin), left * omega / root * sin)
            } else {
                let left = (-omega * time).exp();
                (1.0 - left * (1.0 + omega * time), left * omega * omega * time)
            };
            let motion = response.advance(REST, [1.0, 1.0], time);
            assert!(
                (motion.value - value).abs() < 1e-9,
                "{frequency} Hz, {damping}, {time} s: {motion:?} {value}"
            );
            assert!(
                (motion.rate - rate).abs() < 1e-8 * omega,
                "{frequency} Hz, {damping}, {time} s: {motion:?} {rate}"
            );
        }
    }
}

#[test]
fn waves_are_passed_on_by_the_transfer_function() {
    let (frequency, damping) = (1.2, 0.4);
    let response = Response::new(frequency, damping);
    for ratio in [0.1, 0.5, 1.0, SQRT_2, 3.0] {
        let omega = ratio * TAU * frequency;
        let h = transfer(omega, frequency, damping);
        if ratio == SQRT_2 {
            assert!((h.0.hypot(h.1) - 1.0).abs() < 1e-12);
        }
        let dt = 0.002 / omega;
        let mut motion = REST;
        for step in 0..80_000 {
            let [from, to] = [step, step + 1].map(|s| (omega * dt * f64::from(s)).cos());
            motion = response.advance(motion, [from, to], dt);
            let truth = h.times(Complex::turn(omega * dt * f64::from(step + 1)));
            // What the start left behind has died away by then.
            assert!(step < 70_000 || (motion.value - truth.0).abs() < 1e-5, "{ratio}: {motion:?} {truth:?}");
        }
    }
}

#[test]
fn water_that_rises_evenly_is_followed_without_lag() {
    let response = Response::new(0.7, 0.3);
    let mut motion = Motion { value: 5.0, rate: 2.0 };
    for step in 0..100 {
        let from = 5.0 + 2.0 * 0.1 * f64::from(step);
        motion = response.advance(motion, [from, from + 0.2], 0.1);
        assert!((motion.value - from - 0.2).abs() < 1e-12 && (motion.rate - 2.0).abs() < 1e-12);
    }
}

#[test]
fn no_time_moves_nothing() {
    let motion = Motion { value: 1.0, rate: -2.0 };
    for seconds in [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(Response::new(1.0, 0.5).advance(motion, [0.0, 3.0], seconds), motion);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn one_step_is_as_good_as_many(
        frequency in 0.1..10.0f64,
        damping in 0.05..=1.0f64,
        value in -5.0..5.0f64,
        rate in -20.0..20.0f64,
        targets in [-5.0..5.0f64, -5.0..5.0],
        seconds in 1e-4..2.0f64,
        parts in 2..40u32,
    ) {
        let response = Response::new(frequency, damping);
        let motion = Motion { value, rate };
        let once = response.advance(motion, targets, seconds);
        let target = |part| targets[0] + (targets[1] - targets[0]) * f64::from(part) / f64::from(parts);
        let many = (0..parts).fold(motion, |motion, part| {
            response.advance(motion, [target(part), target(part + 1)], seconds / f64::from(parts))
        });
        // The largest rate there can be: all of it moving, and the spring's pull over a period.
        let scale = 1.0 + rate.abs() + (targets[1] - targets[0]).abs() / seconds + 10.0 * TAU * frequency;
        prop_assert!((once.value - many.value).abs() < 1e-11 * scale, "{once:?} {many:?}");
        prop_assert!((once.rate - many.rate).abs() < 1e-11 * scale * TAU * frequency.max(1.0), "{once:?} {many:?}");
    }

    #[test]
    fn energy_only_dwindles(
        frequency in 0.1..10.0f64,
        damping in 0.0..=1.0f64,
        value in -5.0..5.0f64,
        rate in -20.0..20.0f64,
        exponent in -9.0..9.0f64,
    ) {
        let response = Response::new(frequency, damping);
        let energy = |motion: Motion| (motion.value * TAU * frequency).powi(2) + motion.rate.powi(2);
        let motion = Motion { value, rate };
        let later = response.advance(motion, [0.0, 0.0], 10f64.powf(exponent));
        prop_assert!(energy(later) <= energy(motion) * (1.0 + 1e-9), "{motion:?} {later:?}");
    }
}
