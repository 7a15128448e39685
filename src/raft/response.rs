//! How one degree of freedom of a floating body follows the water: an oscillator, integrated exactly.
use std::f64::consts::TAU;

/// Below this angle sin(x) / x is 1 - x^2 / 6 to the last digit.
const SMALL: f64 = 1e-4;

/// A damped oscillator whose spring and damper both hang on the water u, not on the world:
///
/// y'' + 2 zeta omega (y' - u') + omega^2 (y - u) = 0
///
/// It is "base excitation" of vibration theory, and what the relative-motion hypothesis of ship motions leaves of heave when
/// the water's acceleration is left out. At Omega = r omega its transfer is
/// (1 + 2 i zeta r) / (1 - r^2 + 2 i zeta r): 1 for long waves, off by r^2 and in phase to r^3. See `docs/raft.md`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response {
    /// Natural angular frequency, rad/s.
    omega: f64,
    /// zeta omega, 1/s.
    decay: f64,
    /// omega sqrt(1 - zeta^2), rad/s.
    damped: f64,
}

/// A value and its rate of change.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Value.
    pub value: f64,
    /// Change of the value in a second.
    pub rate: f64,
}

impl Response {
    /// Natural `frequency` in Hz, above 0; `damping` as a share of the critical, 0..=1.
    pub fn new(frequency: f64, damping: f64) -> Self {
        let omega = TAU * frequency;
        Self { omega, decay: damping * omega, damped: omega * (1.0 - damping * damping).max(0.0).sqrt() }
    }

    /// `motion` after `seconds` in which the water goes from `target[0]` to `target[1]` at a constant rate.
    ///
    /// Exact, not a quadrature: y - u obeys the free oscillator, whose solution is known. So any step is stable, and one
    /// step is as good as ten as long as the water's rate is constant. Nothing happens unless `seconds` is above 0.
    #[must_use]
    pub fn advance(&self, motion: Motion, target: [f64; 2], seconds: f64) -> Motion {
        if !(seconds > 0.0 && seconds.is_finite()) {
            return motion;
        }
        let flow = (target[1] - target[0]) / seconds;
        let (miss, rate) = (motion.value - target[0], motion.rate - flow);
        let angle = self.damped * seconds;
        let (sin, cos) = libm::sincos(angle);
        // sin(damped t) / damped, which is t where the damping is critical.
        let sin = seconds * if angle < SMALL { 1.0 - angle * angle / 6.0 } else { sin / angle };
        let left = libm::exp(-self.decay * seconds);
        Motion {
            value: target[1] + left * (miss * cos + (rate + self.decay * miss) * sin),
            rate: flow + left * (rate * cos - (self.decay * rate + self.omega * self.omega * miss) * sin),
        }
    }
}
