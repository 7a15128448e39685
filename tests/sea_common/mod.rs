//! Seas for the tests of the sea.
#![allow(dead_code, clippy::expect_used, reason = "every test file uses some of these; a test may panic")]
use swell::sea::{CascadeMaps, CascadeSettings, FoamSettings, Planes, Sea, SeaMaps, SeaSettings, Spectrum};

pub const SPECTRA: [Spectrum; 3] = [Spectrum::Phillips, Spectrum::Jonswap, Spectrum::Tma];

/// One cascade of 64 x 64 over 80 m with waves well inside its grid, no foam memory.
pub fn settings(spectrum: Spectrum) -> SeaSettings {
    let cascade = CascadeSettings {
        resolution: 64,
        reference_resolution: 64,
        patch_size: 80.0,
        spectrum,
        wind_speed: 7.0,
        alignment: 1.0,
        choppiness: 0.8,
        small_wave_suppression: 0.6,
        fetch: 20_000.0,
        seed: 5,
        // As printed, Phillips' waves would be metres high here, and fold over.
        amplitude: if spectrum == Spectrum::Phillips { 0.3 } else { 1.0 },
        ..CascadeSettings::default()
    };
    let foam = FoamSettings { fade_time: 0.0, ..FoamSettings::default() };
    SeaSettings { cascades: vec![cascade], foam, ..SeaSettings::default() }
}

/// Three cascades of different patch sizes, one rotated, with foam that lasts a second.
pub fn cascades() -> SeaSettings {
    let patches = [(160.0, 64), (37.0, 32), (9.0, 32)];
    let mut sea = settings(Spectrum::Jonswap);
    sea.foam.fade_time = 1.0;
    let bands = swell::sea::split_bands(&patches);
    let first = sea.cascades[0].clone();
    sea.cascades = patches
        .iter()
        .zip(bands)
        .enumerate()
        .map(|(index, (&(patch_size, resolution), band))| CascadeSettings {
            resolution,
            patch_size,
            band,
            rotation: if index == 1 { 0.6 } else { 0.0 },
            small_wave_suppression: 0.2,
            ..first.clone()
        })
        .collect();
    sea
}

pub fn maps(settings: &SeaSettings, time: f64) -> SeaMaps {
    let mut sea = Sea::new(settings).expect("valid settings");
    let mut maps = sea.new_maps_with_planes();
    sea.step(time, &mut maps).expect("a step");
    maps
}

/// The planes of full precision.
pub fn planes(maps: &CascadeMaps) -> &Planes {
    maps.planes.as_ref().expect("maps with planes")
}

pub fn rms(values: &[f32]) -> f64 {
    (values.iter().map(|&v| f64::from(v) * f64::from(v)).sum::<f64>() / values.len() as f64).sqrt()
}

/// Root mean square of the difference over that of `truth`.
pub fn relative_error(values: &[f32], truth: &[f64]) -> f64 {
    let error: f64 = values.iter().zip(truth).map(|(&v, t)| (f64::from(v) - t).powi(2)).sum();
    let scale: f64 = truth.iter().map(|t| t * t).sum();
    (error / scale).sqrt()
}

pub fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let (ma, mb) = (mean(a), mean(b));
    let cov: f64 = a.iter().zip(b).map(|(x, y)| (x - ma) * (y - mb)).sum();
    let var = |v: &[f64], m: f64| v.iter().map(|x| (x - m).powi(2)).sum::<f64>();
    cov / (var(a, ma) * var(b, mb)).sqrt()
}
