//! When an animation of waves closes.
use super::{Model, Wave};

/// The most laps of the slowest wave in a loop that is looked for.
const MOST_LAPS: u64 = 1_000_000;
/// The greatest denominator of a ratio of frequencies.
const MOST_DENOMINATOR: f64 = 1e5;
/// Relative error that a ratio may have. Rounding leaves a thousandth of it, and of ratios that are no fractions one in a
/// thousand comes as close to one.
const TOLERANCE: f64 = 1e-13;

/// The wave with its frequency rounded to a whole number of periods in `loop_period`, seconds: at least one, unless it
/// stands still.
pub fn close(wave: Wave, loop_period: f64) -> Wave {
    if wave.frequency == 0.0 {
        return wave;
    }
    let laps = (wave.frequency.abs() * loop_period).round().max(1.0);
    Wave { frequency: (laps / loop_period).copysign(wave.frequency), ..wave }
}

/// Seconds after which all waves of `models` are where they were: 0 where none moves, nothing where the ratios of their
/// frequencies are no fractions.
pub fn length(models: &[Model]) -> Option<f64> {
    let frequencies = || {
        let all = models.iter().flat_map(Model::waves).map(|wave| wave.frequency.abs());
        all.filter(|&frequency| frequency > 0.0)
    };
    let slowest = frequencies().fold(f64::INFINITY, f64::min);
    if slowest.is_infinite() {
        return Some(0.0);
    }
    // A wave that makes p laps in q of the slowest is back after any multiple of q of them.
    let mut laps = 1_u64;
    for frequency in frequencies() {
        let own = denominator(frequency / slowest)?;
        laps = laps / common_divisor(laps, own) * own;
        if laps > MOST_LAPS {
            return None;
        }
    }
    Some(laps as f64 / slowest)
}

/// The denominator of the fraction that `ratio`, 1 or more, is; by its continued fraction.
fn denominator(ratio: f64) -> Option<u64> {
    let (mut p, mut q) = ([1.0, ratio.floor()], [0.0, 1.0]);
    let mut rest = ratio - ratio.floor();
    while (p[1] / q[1] - ratio).abs() > TOLERANCE * ratio {
        let whole = (1.0 / rest).floor();
        rest = 1.0 / rest - whole;
        p = [p[1], whole * p[1] + p[0]];
        q = [q[1], whole * q[1] + q[0]];
        if q[1].is_nan() || q[1] > MOST_DENOMINATOR {
            return None;
        }
    }
    Some(q[1] as u64)
}

fn common_divisor(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { common_divisor(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_are_found_and_roots_are_none() {
        for (ratio, own) in [(1.0, 1), (1.5, 2), (7.0 / 5.0, 5), (1234.0 / 997.0, 997), (3.0, 1)] {
            assert_eq!(denominator(ratio), Some(own), "{ratio}");
        }
        for root in [2.0_f64, 3.0, 5.0, 1.3, 2.7] {
            assert_eq!(denominator(root.sqrt()), None, "{root}");
        }
    }
}
