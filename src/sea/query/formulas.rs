//! The point above a place where the sea has models: formulas, whose slope is known exactly, in place of a grid.
use super::{
    MAX_ITERATIONS, Query,
    sample::{Sample, norm},
};

/// Horizontal error, metres, at which a search is content: formulas let it be far less than maps do.
const TOLERANCE: f64 = 1e-9;
/// Damping at which a step helps nobody any more.
const STUCK: f64 = 1e3;
/// The angle of a sunflower's seeds, which spreads any number of starting points evenly: pi (3 - sqrt 5).
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// The best rest position found and the steps it took.
///
/// Newton's method; where a step does not help, damped as Levenberg and Marquardt do it until it does; where that ends in
/// a fold, again from points around.
pub fn solve(query: &Query<'_>, target: [f64; 2]) -> ([f64; 2], u32) {
    let content = TOLERANCE.max(2.0 * f64::EPSILON * norm(target));
    let mut guess = Guess::at(query, target, target);
    let mut best = guess;
    let [dx, _, dz] = guess.sample.value.displacement;
    let mut damping = 0.0;
    let mut start = 0_u32;
    for iteration in 1..MAX_ITERATIONS {
        if norm(best.miss) <= content {
            return (best.q, iteration);
        }
        let [x, z] = guess.sample.damped_newton(guess.miss, damping);
        let tried = Guess::at(query, [guess.q[0] - x, guess.q[1] - z], target);
        if norm(tried.miss) < norm(guess.miss) {
            guess = tried;
            damping = if damping < 1e-6 { 0.0 } else { 0.1 * damping };
        } else {
            damping = (10.0 * damping).max(1e-3);
        }
        if norm(guess.miss) < norm(best.miss) {
            best = guess;
        }
        if damping > STUCK {
            start += 1;
            damping = 0.0;
            let (sin, cos) = libm::sincos(GOLDEN_ANGLE * f64::from(start));
            // The nearest crest or trough is about a displacement away.
            let radius = norm([dx, dz]) * f64::from(start).sqrt();
            let q = [target[0] - dx + radius * cos, target[1] - dz + radius * sin];
            guess = Guess::at(query, q, target);
        }
    }
    (best.q, MAX_ITERATIONS)
}

/// A rest position that may be the one sought.
#[derive(Clone, Copy, Debug)]
struct Guess {
    q: [f64; 2],
    sample: Sample,
    /// q + D(q) less the target.
    miss: [f64; 2],
}

impl Guess {
    fn at(query: &Query<'_>, q: [f64; 2], target: [f64; 2]) -> Self {
        let sample = Sample::at(query, q);
        Self { q, sample, miss: sample.miss(q, target) }
    }
}
