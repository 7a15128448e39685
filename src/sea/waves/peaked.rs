//! y = 2 A ((sin f + 1) / 2)^K: sharp crests on wide troughs, all above the sea at rest. Finch, "Effective Water Simulation
//! from Physical Models", GPU Gems, chapter 1.

/// Height for an amplitude of 1 and its derivative by the phase, from sine and cosine of the phase; `sharpness` is K, 1
/// or more, and 1 is a sine lifted by its amplitude.
pub fn profile(sin: f64, cos: f64, sharpness: f64) -> [f64; 2] {
    let base = (0.5 * (sin + 1.0)).max(0.0);
    let power = libm::pow(base, sharpness - 1.0);
    [2.0 * base * power, sharpness * power * cos]
}
