//! The laws every sea obeys, on the maps of each spectrum: they decide the signs that the paper prints both ways.
mod sea_common;
use sea_common::{SPECTRA, cascades, correlation, maps, planes, relative_error, rms, settings};
use std::f64::consts::{FRAC_PI_2, TAU};
use swell::sea::reference::{displacement::displacement, fft};
use swell::sea::{CascadeMaps, Sea, SeaSettings, expected_variance};

/// DFT of a real plane with e^{-i}: conjugate, transform with e^{+i}, conjugate.
fn forward(plane: &[f32], n: usize) -> Vec<[f64; 2]> {
    let grid: Vec<_> = plane.iter().map(|&v| [f64::from(v), 0.0]).collect();
    fft::separable(&grid, n, fft::radix2).into_iter().map(|[re, im]| [re, -im]).collect()
}

/// Signed wave indices of entry `at` of an n x n DFT.
fn wave(at: usize, n: usize) -> [f64; 2] {
    [at % n, at / n].map(|i| if i < n / 2 { i as f64 } else { i as f64 - n as f64 })
}

#[test]
fn law_1_heights_are_real() {
    for spectrum in SPECTRA {
        let sea = settings(spectrum);
        let (field, residue) = displacement(&sea.cascades[0], sea.gravity, sea.repeat_period, 0, 3.7);
        let power = field.iter().map(|d| d[1] * d[1]).sum::<f64>() / field.len() as f64;
        assert!(power.sqrt() > 0.01, "{spectrum:?} is flat");
        assert!(residue < 1e-5 * power.sqrt(), "{spectrum:?}: imaginary residue {residue}");
        // The engine keeps no imaginary part: it must agree with the real part of the full transform.
        let map = &maps(&sea, 3.7).cascades[0];
        let truth = |i: usize| field.iter().map(|d| d[i]).collect::<Vec<_>>();
        for (plane, i) in [(&planes(map).du, 0), (&planes(map).height, 1), (&planes(map).dv, 2)] {
            let error = relative_error(plane, &truth(i));
            assert!(error < 1e-6, "{spectrum:?}, component {i}: {error:e}");
        }
    }
}

/// Mean displacement per second, along world (x, z), of the pattern of `map` at a later time.
fn drift(before: &CascadeMaps, after: &CascadeMaps, seconds: f64) -> [f64; 2] {
    let n = before.resolution;
    let (a, b) = (forward(&planes(before).height, n), forward(&planes(after).height, n));
    // Every wave's phase advance is -k.c t; weighted by energy this gives the mean phase velocity along u and v.
    let (mut velocity, mut weight) = ([0.0; 2], 0.0);
    for at in 0..n * n {
        let k = wave(at, n).map(|i| TAU / before.patch_size * i);
        let k2 = k[0] * k[0] + k[1] * k[1];
        let cross = [a[at][0] * b[at][0] + a[at][1] * b[at][1], a[at][0] * b[at][1] - a[at][1] * b[at][0]];
        let energy = cross[0].hypot(cross[1]);
        if k2 > 0.0 {
            let advance = -cross[1].atan2(cross[0]) / seconds;
            velocity = [0, 1].map(|i| velocity[i] + energy * advance * k[i] / k2);
            weight += energy;
        }
    }
    let [u, v] = velocity.map(|sum| sum / weight);
    let (sin, cos) = before.rotation.sin_cos();
    [u * cos + v * sin, v * cos - u * sin]
}

#[test]
fn law_2_waves_run_with_the_wind() {
    for spectrum in SPECTRA {
        for (direction, rotation) in [(0.0, 0.0), (FRAC_PI_2, 0.0), (2.5, 0.0), (FRAC_PI_2, 0.7), (-1.0, 2.0)]
        {
            let mut sea = settings(spectrum);
            sea.cascades[0].wind_direction = direction;
            sea.cascades[0].rotation = rotation;
            let [x, z] = drift(&maps(&sea, 10.0).cascades[0], &maps(&sea, 10.05).cascades[0], 0.05);
            let wind = [direction.cos(), -direction.sin()];
            let along = x * wind[0] + z * wind[1];
            let across = (x * wind[1] - z * wind[0]).abs();
            assert!(
                along > 1.0,
                "{spectrum:?}, wind {direction}, axes {rotation}: {along} m/s along the wind"
            );
            assert!(across < 0.5 * along, "{spectrum:?}, wind {direction}, axes {rotation}: {across} across");
        }
    }
}

#[test]
fn law_3_points_bunch_at_crests() {
    for spectrum in SPECTRA {
        // A narrow band seen along one axis: nearly unidirectional.
        let mut sea = settings(spectrum);
        sea.cascades[0].band = [0.5, 0.9];
        let map = &maps(&sea, 4.0).cascades[0];
        let n = map.resolution;
        let slope = |at: usize| {
            let (row, c) = (at / n * n, at % n);
            f64::from(planes(map).du[row + (c + 1) % n]) - f64::from(planes(map).du[row + (c + n - 1) % n])
        };
        let slopes: Vec<_> = (0..n * n).map(slope).collect();
        let heights: Vec<_> = planes(map).height.iter().map(|&h| f64::from(h)).collect();
        let jacobian: Vec<_> = map.gradient[..n * n].iter().map(|texel| f64::from(texel[2])).collect();
        let found = correlation(&heights, &slopes);
        assert!(found < -0.7, "{spectrum:?}: height and dDx/dx correlate by {found}");
        let found = correlation(&heights, &jacobian);
        assert!(found < -0.7, "{spectrum:?}: height and J correlate by {found}");
    }
}

#[test]
fn law_4_displacement_is_the_riesz_transform_of_height() {
    for spectrum in SPECTRA {
        let sea = settings(spectrum);
        let choppiness = sea.cascades[0].choppiness;
        let map = &maps(&sea, 11.3).cascades[0];
        let n = map.resolution;
        let height = forward(&planes(map).height, n);
        for (axis, plane) in [&planes(map).du, &planes(map).dv].into_iter().enumerate() {
            let spectrum: Vec<_> = height
                .iter()
                .enumerate()
                .map(|(at, [re, im])| {
                    let k = wave(at, n);
                    let unit = choppiness * k[axis] / k[0].hypot(k[1]).max(1.0) / (n * n) as f64;
                    [-im * unit, re * unit]
                })
                .collect();
            let rebuilt: Vec<_> = fft::separable(&spectrum, n, fft::radix2).iter().map(|v| v[0]).collect();
            let error = relative_error(plane, &rebuilt);
            assert!(error < 1e-3, "axis {axis}: {error:e}");
        }
    }
}

#[test]
fn law_5_the_loop_closes_and_runs_repeat() {
    let mut seas: Vec<SeaSettings> = SPECTRA.map(settings).to_vec();
    seas.push(cascades());
    for sea in &seas {
        for time in [0.0, 0.3, 12.5, 199.9] {
            let first = maps(sea, time);
            assert_eq!(first, maps(sea, time), "a second run at {time} s");
            let mut later = maps(sea, time + sea.repeat_period);
            later.time = time;
            assert!(first == later, "one period after {time} s");
        }
    }
}

#[test]
fn law_6_the_variance_is_the_spectrums_sum() {
    const SEEDS: u64 = 256;
    for spectrum in SPECTRA {
        let mut sea = settings(spectrum);
        sea.cascades[0].resolution = 32;
        let expected = expected_variance(&sea.cascades[0], sea.gravity);
        let variances: Vec<f64> = (0..SEEDS)
            .map(|seed| {
                sea.cascades[0].seed = seed;
                rms(&planes(&maps(&sea, 1.0).cascades[0]).height).powi(2)
            })
            .collect();
        let mean = variances.iter().sum::<f64>() / SEEDS as f64;
        let spread = variances.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (SEEDS - 1) as f64;
        let error = (spread / SEEDS as f64).sqrt();
        assert!(
            (mean - expected).abs() < 3.0 * error,
            "{spectrum:?}: {mean} m^2 over seeds, {expected} m^2 expected, standard error {error}"
        );
    }
}

#[test]
fn law_7_doubling_the_amplitude_doubles_and_no_wind_is_flat() {
    for spectrum in SPECTRA {
        let mut sea = settings(spectrum);
        let single = maps(&sea, 6.0);
        sea.cascades[0].amplitude *= 2.0;
        let double = maps(&sea, 6.0);
        let (single, double) = (&single.cascades[0], &double.cascades[0]);
        for (a, b) in [
            (&planes(single).du, &planes(double).du),
            (&planes(single).height, &planes(double).height),
            (&planes(single).dv, &planes(double).dv),
        ] {
            assert!(rms(a) > 0.005);
            assert!(a.iter().zip(b).all(|(a, b)| (2.0 * a - b).abs() <= 1e-6 * b.abs().max(0.01)));
        }
        sea.cascades[0].wind_speed = 0.0;
        let flat = maps(&sea, 6.0);
        let flat = &flat.cascades[0];
        assert!(
            planes(flat).height.iter().chain(&planes(flat).du).chain(&planes(flat).dv).all(|&v| v == 0.0)
        );
        assert!(flat.gradient.iter().all(|texel| texel[..3] == [128, 128, 255]));
        assert!(flat.displacement.iter().flatten().all(|v| v.to_f32() == 0.0));
    }
}

#[test]
fn a_sea_of_metres_is_as_high_as_the_books_say() {
    // JONSWAP at 10 m/s over 100 km: significant height 4 sigma near 1.7 m (Hasselmann's sigma^2 = 1.6e-7 U^2 F / g).
    let sea = SeaSettings {
        cascades: vec![swell::sea::CascadeSettings {
            patch_size: 1000.0,
            resolution: 512,
            small_wave_suppression: 0.0,
            ..Default::default()
        }],
        ..Default::default()
    };
    let empirical = (1.6e-7 * 100.0 * 1e5 / sea.gravity).sqrt();
    let ratio = sea.expected_rms_height() / empirical;
    assert!((0.85..1.4).contains(&ratio), "{} m, {empirical} m", sea.expected_rms_height());
    assert!(Sea::new(&sea).is_ok());
}
