//! The search for points that plain steps do not find: the sea is steep there, or folded.
use super::{
    MAX_ITERATIONS, Query, TOLERANCE,
    guess::{GOLDEN_ANGLE, Guess},
    sample::norm,
};

/// Steps from one starting point; twice as many from the first.
const STEPS: u32 = 8;
/// Lengths tried in one step: whole, half, ... one eighth.
const HALVINGS: u32 = 4;
impl Guess {
    /// One step, halved until it helps.
    fn improved(&self, query: &Query<'_>, target: [f64; 2]) -> Option<Self> {
        let step = self.sample.newton(self.miss);
        let mut share = 1.0;
        for _ in 0..HALVINGS {
            let tried = Self::at(query, [self.q[0] - share * step[0], self.q[1] - share * step[1]], target);
            if norm(tried.miss) < norm(self.miss) {
                return Some(tried);
            }
            share *= 0.5;
        }
        None
    }
}

/// The best rest position found, and the steps it took, `taken` included.
///
/// Newton's method with damped steps; where it stalls, it starts again from points around.
#[cold]
pub fn search(query: &Query<'_>, target: [f64; 2], taken: u32) -> ([f64; 2], u32) {
    let [x, z] = target;
    let mut best = Guess::at(query, target, target);
    let mut iterations = taken + 1;
    let [dx, _, dz] = best.sample.value.displacement;
    // The nearest crest or trough is about a displacement away; the spiral goes twice as far.
    let reach = 2.0 * norm([dx, dz]);
    let mut guess = Guess::at(query, [x - dx, z - dz], target);
    for start in 1_u32.. {
        if iterations >= MAX_ITERATIONS {
            return (best.q, iterations);
        }
        iterations += 1;
        let steps = if start == 1 { 2 * STEPS } else { STEPS };
        for _ in 0..steps {
            if norm(guess.miss) < norm(best.miss) {
                best = guess;
            }
            if norm(best.miss) <= TOLERANCE || iterations >= MAX_ITERATIONS {
                return (best.q, iterations);
            }
            iterations += 1;
            match guess.improved(query, target) {
                Some(improved) => guess = improved,
                None => break,
            }
        }
        let (sin, cos) = libm::sincos(GOLDEN_ANGLE * f64::from(start));
        let radius = reach * (f64::from(start) * f64::from(STEPS) / f64::from(MAX_ITERATIONS)).sqrt();
        guess = Guess::at(query, [x - dx + radius * cos, z - dz + radius * sin], target);
    }
    (best.q, iterations)
}
