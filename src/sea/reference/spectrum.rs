//! The initial amplitudes on the centred grid of eq (2).
use crate::sea::{CascadeSettings, dispersion, philox, spectrum};
use std::f64::consts::TAU;

/// A complex number (re, im).
pub type Complex = [f64; 2];

/// One wave vector of the centred grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// k, rad/m, along the cascade's axes, eq (2).
    pub k: [f64; 2],
    /// Omega', rad/s, eq (16).
    pub omega: f64,
    /// h0(k), metres, eq (13).
    pub along: Complex,
    /// conj(h0(-k)), metres.
    pub against: Complex,
}

/// All N x N waves, `[n N + m]` for k = 2 pi/L (m - N/2, n - N/2). The row and column at -N/2 are still.
pub fn spectrum(cascade: &CascadeSettings, gravity: f64, period: f64, index: u32) -> Vec<Wave> {
    let n = cascade.resolution as i32;
    let spacing = TAU / cascade.patch_size;
    let amplitude = |i: i32, j: i32| {
        let [re, im] = philox::gaussian(cascade.seed, i, j, index);
        let scale = spectrum::power(cascade, gravity, i, j).sqrt() / 2_f64.sqrt();
        [re * scale, im * scale]
    };
    let mut waves = Vec::new();
    for j in -n / 2..n / 2 {
        for i in -n / 2..n / 2 {
            let k = [spacing * f64::from(i), spacing * f64::from(j)];
            let length = k[0].hypot(k[1]);
            let still = length == 0.0 || i == -n / 2 || j == -n / 2;
            waves.push(if still {
                Wave { k, omega: 0.0, along: [0.0; 2], against: [0.0; 2] }
            } else {
                let omega = dispersion::frequency(cascade, gravity, length).omega;
                let omega_0 = TAU / period;
                let [re, im] = amplitude(-i, -j);
                Wave {
                    k,
                    omega: (omega / omega_0).floor() * omega_0,
                    along: amplitude(i, j),
                    against: [re, -im],
                }
            });
        }
    }
    waves
}
