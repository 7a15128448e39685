//! How fast waves of a length run, eqs (15)(16).
use super::settings::{CascadeSettings, Spectrum};

/// Angular frequency and group velocity of a wave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frequency {
    /// omega, rad/s.
    pub omega: f64,
    /// d omega / d k, m/s.
    pub group_velocity: f64,
}

/// The dispersion relation of a cascade's water at wave number `k` (rad/m, above 0).
///
/// Deep water, eq (15): omega = sqrt(g k). A TMA sea has a depth d: omega = sqrt(g k tanh(k d)), the linear theory's
/// full form (Airy), of which eq (15) is the limit.
pub fn frequency(cascade: &CascadeSettings, gravity: f64, k: f64) -> Frequency {
    let deep = (gravity * k).sqrt();
    match cascade.spectrum {
        Spectrum::Phillips | Spectrum::Jonswap => Frequency { omega: deep, group_velocity: 0.5 * deep / k },
        Spectrum::Tma => {
            let kd = k * cascade.depth;
            let omega = deep * libm::tanh(kd).sqrt();
            Frequency { omega, group_velocity: 0.5 * omega / k * (1.0 + shoaling(kd)) }
        }
    }
}

/// 2 kd / sinh(2 kd): 1 in the shallows, 0 in deep water.
pub(super) fn shoaling(kd: f64) -> f64 {
    // The series keeps 0/0 away; beyond, sinh overflows to infinity and the quotient is the right 0.
    if kd < 1e-4 { 1.0 - 2.0 / 3.0 * kd * kd } else { 2.0 * kd / libm::sinh(2.0 * kd) }
}

/// Number of the harmonic of 2 pi / `period` at or below `omega`, eq (16).
pub fn harmonic(omega: f64, period: f64) -> u32 {
    (omega * period / std::f64::consts::TAU).floor() as u32
}
