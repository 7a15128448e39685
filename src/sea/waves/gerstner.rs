//! Offset (d_x Q A cos f, A sin f, d_z Q A cos f): points go round in circles, or ellipses, and bunch at crests.
//!
//! Two ways to say how steep it is: `steepness` s, for which A = Q A = s / k; and GPU Gems' `amplitude` A with `q`, for which
//! Q = q / (k A n) for n such waves, so that q = 1 in all of them is as steep as their sum can be without loops.
use super::{Sample, Wave};

/// A and Q A, metres, of a wave number, rad/m, and a steepness.
pub fn of_steepness(k: f64, steepness: f64) -> [f64; 2] {
    [steepness / k; 2]
}

/// Q A, metres, of a wave number, rad/m, in the form of GPU Gems for `count` waves: A itself cancels out.
pub fn of_q(k: f64, q: f64, count: usize) -> f64 {
    q / (k * count.max(1) as f64)
}

/// Adds `wave`, which travels along `d`, from sine and cosine of its phase.
pub fn add(wave: &Wave, [x, z]: [f64; 2], [sin, cos]: [f64; 2], sum: &mut Sample) {
    let Wave { k, amplitude, horizontal, .. } = *wave;
    let along = horizontal * cos;
    // The derivative of the offset along d, times the parts of d.
    let squeeze = -k * horizontal * sin;
    let slope = k * amplitude * cos;
    for (sum, part) in sum.displacement.iter_mut().zip([x * along, amplitude * sin, z * along]) {
        *sum += part;
    }
    for (sum, part) in sum.along_x.iter_mut().zip([x * x * squeeze, x * slope, x * z * squeeze]) {
        *sum += part;
    }
    for (sum, part) in sum.along_z.iter_mut().zip([x * z * squeeze, z * slope, z * z * squeeze]) {
        *sum += part;
    }
}
