//! Rings around a centre: a sine or peaked wave whose phase grows with the distance r to it.
//!
//! At the centre all directions meet, and a wave that went on to it would come to a point there. So the amplitude is
//! multiplied by b = s^2 (3 - 2 s), s = 2 r / wavelength up to 1: nothing at the centre, smooth, and all of it from half a
//! wavelength on, where the height is A sin f again to the last bit.
use std::f64::consts::PI;

/// Height and slope along the radius of a wave that has `[height, slope]` where its amplitude is whole, at `distance`
/// metres from the centre.
pub fn bounded([height, slope]: [f64; 2], k: f64, distance: f64) -> [f64; 2] {
    let s = (k / PI * distance).min(1.0);
    let bound = s * s * (3.0 - 2.0 * s);
    let growth = 6.0 * s * (1.0 - s) * (k / PI);
    [bound * height, bound * slope + growth * height]
}
