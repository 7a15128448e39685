//! y = A exp(sin f - 1): the peaked octave of [`super::fbm`], between A / e^2 and A.

/// Height for an amplitude of 1 and its derivative by the phase, from sine and cosine of the phase.
pub fn profile(sin: f64, cos: f64) -> [f64; 2] {
    let height = libm::exp(sin - 1.0);
    [height, height * cos]
}
