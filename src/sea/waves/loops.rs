//! When an animation of waves closes.
use super::{Model, Wave};

/// Longest loop that is looked for, as a multiple of the longest period.
const MOST_LAPS: u32 = 100_000;
/// How far from a whole number of periods, in turns, a loop may end: a degree would be seen.
const TOLERANCE: f64 = 1e-6;

/// The wave with its frequency rounded to a whole number of periods in `loop_period`, seconds: at least one, unless it
/// stands still.
pub fn close(wave: Wave, loop_period: f64) -> Wave {
    if wave.frequency == 0.0 {
        return wave;
    }
    let laps = (wave.frequency.abs() * loop_period).round().max(1.0);
    Wave { frequency: (laps / loop_period).copysign(wave.frequency), ..wave }
}

/// Seconds after which all waves of `models` are where they were: the shortest such time, 0 where none moves, or nothing
/// where their periods have no common multiple within 100 000 of the longest.
pub fn length(models: &[Model]) -> Option<f64> {
    let frequencies = || {
        let all = models.iter().flat_map(Model::waves).map(|wave| wave.frequency.abs());
        all.filter(|&frequency| frequency > 0.0)
    };
    let slowest = frequencies().fold(f64::INFINITY, f64::min);
    if slowest.is_infinite() {
        return Some(0.0);
    }
    (1..=MOST_LAPS).map(|laps| f64::from(laps) / slowest).find(|&time| {
        frequencies().all(|frequency| {
            let laps = frequency * time;
            (laps - laps.round()).abs() <= TOLERANCE
        })
    })
}
