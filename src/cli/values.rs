//! Values of options, checked: the error says what is wanted.
use std::time::Duration;
use swell::lod::Quality;

/// Far enough for any voyage, and f64 still resolves micrometres there.
const FARTHEST: f64 = 1e9;

/// Three coordinates.
pub fn point(text: &str) -> Result<[f64; 3], String> {
    let number = |text: &str| text.trim().parse().ok().filter(|value: &f64| value.abs() <= FARTHEST);
    let numbers: Option<Vec<f64>> = text.split(',').map(number).collect();
    numbers
        .and_then(|numbers| numbers.try_into().ok())
        .ok_or_else(|| "wanted X,Y,Z: three numbers of metres, -1e9 to 1e9".to_owned())
}

/// Factor on a headset's size.
pub fn xr_scale(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|scale| (0.1..=4.0).contains(scale));
    number.ok_or_else(|| "wanted a factor, 0.1 to 4".to_owned())
}

/// A refresh rate.
pub fn hertz(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|rate| (1.0..=1000.0).contains(rate));
    number.ok_or_else(|| "wanted a refresh rate, 1 to 1000 hertz".to_owned())
}

/// Starting threads beyond all sense takes a system's memory before it is refused.
const MOST_THREADS: usize = 1024;

/// A number of threads.
pub fn threads(text: &str) -> Result<usize, String> {
    let number = text.parse().ok().filter(|&number| number <= MOST_THREADS);
    number.ok_or_else(|| format!("wanted a number of threads, 1 to {MOST_THREADS}, or 0 for one a core"))
}

/// N.
pub fn grid_size(text: &str) -> Result<usize, String> {
    let number = text.trim().parse().ok().filter(|n: &usize| n.is_power_of_two() && (16..=512).contains(n));
    number.ok_or_else(|| "wanted points along a side, a power of two, 16 to 512".to_owned())
}

/// How long a case is measured.
pub fn measuring_time(text: &str) -> Result<Duration, String> {
    let number = text.parse().ok().filter(|seconds| (0.001..=60.0).contains(seconds));
    number.map(Duration::from_secs_f64).ok_or_else(|| "wanted seconds, 0.001 to 60".to_owned())
}

/// A quality level's name.
pub fn quality(text: &str) -> Result<Quality, String> {
    Ok(match text {
        "low" => Quality::Low,
        "medium" => Quality::Medium,
        "high" => Quality::High,
        "ultra" => Quality::Ultra,
        _ => return Err("one of low, medium, high, ultra".to_owned()),
    })
}

/// A day's worth at 10 000 a second: no clip of this many is wanted, and numbers of files stay what they are.
const MOST_FRAMES: u64 = 864_000_000;

/// A number of frames.
pub fn frame_count(text: &str) -> Result<u64, String> {
    let number = text.parse().ok().filter(|number| (1..=MOST_FRAMES).contains(number));
    number.ok_or_else(|| format!("wanted a number of frames, 1 to {MOST_FRAMES}"))
}

/// Pixels of a picture.
pub fn picture_size(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| text.parse().ok().filter(|side| (1..=16384).contains(side));
    let sides = text.split_once('x').and_then(|(width, height)| Some([side(width)?, side(height)?]));
    sides.ok_or_else(|| "wanted WIDTHxHEIGHT, each 1 to 16384".to_owned())
}
