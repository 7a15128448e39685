//! The point above a place where the sea has models: formulas, whose slope is known exactly, in place of a grid.
use super::{
    MAX_ITERATIONS, Query,
    guess::{GOLDEN_ANGLE, Guess},
    sample::norm,
};
use crate::sea::waves::Model;

/// Horizontal error, metres, at which a search is content: formulas let it be far less than maps do.
const TOLERANCE: f64 = 1e-9;
/// A step that leaves more than this share of the error is slow. At a cusp, where the field is a cubic, Newton's leave 0.3.
const SLOW: f64 = 0.5;
/// Slow steps in a row that end the search from one place.
const PATIENCE: u32 = 4;
/// Places to search from, after the first, that cover the disc in which the point must rest.
const STARTS: f64 = 10.0;
/// The best rest position found and the steps it took.
///
/// Newton's method; where a step does not help, damped as Levenberg and Marquardt do it until it does; where that is slow, at
/// a cusp or in a fold, again from other places around.
pub fn solve(query: &Query<'_>, target: [f64; 2]) -> ([f64; 2], u32) {
    let content = TOLERANCE.max(2.0 * f64::EPSILON * norm(target));
    let mut guess = Guess::at(query, target, target);
    let mut best = guess;
    let [dx, _, dz] = guess.sample.value.displacement;
    let (mut damping, mut slow, mut start) = (0.0, 0, 0_u32);
    for iteration in 1..MAX_ITERATIONS {
        if norm(best.miss) <= content {
            return (best.q, iteration);
        }
        let [x, z] = guess.sample.damped_newton(guess.miss, damping);
        let tried = Guess::at(query, [guess.q[0] - x, guess.q[1] - z], target);
        slow = if norm(tried.miss) < SLOW * norm(guess.miss) { 0 } else { slow + 1 };
        if norm(tried.miss) < norm(guess.miss) {
            guess = tried;
            damping = if damping < 1e-6 { 0.0 } else { 0.1 * damping };
        } else {
            damping = (10.0 * damping).max(1e-2);
        }
        if norm(guess.miss) < norm(best.miss) {
            best = guess;
        }
        if slow == PATIENCE {
            start += 1;
            (damping, slow) = (0.0, 0);
            // No point rests further from its place than it is displaced.
            let reach = query.models.iter().map(Model::reach).sum::<f64>() + norm([dx, dz]);
            let (sin, cos) = libm::sincos(GOLDEN_ANGLE * f64::from(start));
            let radius = reach * (f64::from(start) / STARTS).sqrt();
            guess = Guess::at(query, [target[0] + radius * cos, target[1] + radius * sin], target);
        }
    }
    (best.q, MAX_ITERATIONS)
}
