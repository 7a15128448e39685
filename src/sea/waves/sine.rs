//! y = A sin f.

/// Height for an amplitude of 1 and its derivative by the phase, from sine and cosine of the phase.
pub fn profile(sin: f64, cos: f64) -> [f64; 2] {
    [sin, cos]
}
