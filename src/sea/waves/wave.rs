//! One wave, in the few numbers that all kinds share.
use super::{Sample, circular, exp_sine, gerstner, peaked, sine, turns};
use crate::sea::error::SeaError;
use std::f64::consts::TAU;

/// What a wave is as a function of its phase.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// [`sine`].
    Sine,
    /// [`peaked`].
    Peaked,
    /// [`exp_sine`].
    ExpSine,
    /// [`gerstner`].
    Gerstner,
}

/// Where its crests go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Front {
    /// Straight crests that travel along this unit direction (x, z).
    Plane {
        /// Unit length.
        direction: [f64; 2],
    },
    /// Rings around this world (x, z), metres: see [`circular`].
    Ring {
        /// Their middle.
        centre: [f64; 2],
    },
}

/// A wave, all its numbers worked out. Its phase at a rest point q is
/// `f = k (d . q) - 2 pi frequency time + phase`, with the distance to the centre in place of `d . q` for rings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// What it is as a function of the phase.
    pub kind: Kind,
    /// Where it goes.
    pub front: Front,
    /// Wave number, rad/m, above 0.
    pub k: f64,
    /// Crests that pass a place in a second; below 0 they run the other way.
    pub frequency: f64,
    /// A, metres.
    pub amplitude: f64,
    /// Q A of a Gerstner wave, metres: how far points move to and fro. 0 for other kinds.
    pub horizontal: f64,
    /// K of a peaked wave; 1 for other kinds.
    pub sharpness: f64,
    /// Phase at the origin, or the centre, at time 0; radians.
    pub phase: f64,
}

/// Points of one wavelength at which a profile's variance is summed: enough for sharpness 32.
const PROFILE: u32 = 256;

impl Wave {
    /// Speed of its crests along its direction, m/s.
    pub fn speed(&self) -> f64 {
        TAU * self.frequency / self.k
    }

    /// Distance between crests, metres.
    pub fn wavelength(&self) -> f64 {
        TAU / self.k
    }

    /// Seconds between crests; infinite where it stands still.
    pub fn period(&self) -> f64 {
        1.0 / self.frequency.abs()
    }

    /// k Q A: the most by which it squeezes the surface. A sum above 1 may loop.
    pub fn steepness(&self) -> f64 {
        self.k * self.horizontal.abs()
    }

    /// Phase in turns at a place where `k (d . q)`, or k times the distance to the centre, is 0; within half a turn.
    pub(super) fn turned(&self, time: f64) -> f64 {
        self.phase / TAU - turns(self.frequency, time)
    }

    /// Adds the wave at `rest` (x, z), metres, and `time`, seconds, to `sum`.
    pub fn add(&self, rest: [f64; 2], time: f64, sum: &mut Sample) {
        let rate = self.k / TAU;
        match self.front {
            Front::Plane { direction: [x, z] } => {
                let along = turns(rate * x, rest[0]) + turns(rate * z, rest[1]);
                let (sin, cos) = libm::sincos(TAU * (along + self.turned(time)));
                match self.kind {
                    Kind::Gerstner => gerstner::add(self, [x, z], [sin, cos], sum),
                    _ => self.add_height(self.profile(sin, cos), [x, z], sum),
                }
            }
            Front::Ring { centre } => {
                let from = [rest[0] - centre[0], rest[1] - centre[1]];
                let distance = libm::hypot(from[0], from[1]);
                let (sin, cos) = libm::sincos(TAU * (turns(rate, distance) + self.turned(time)));
                let ring = circular::bounded(self.profile(sin, cos), self.k, distance);
                let out = if distance > 0.0 { from.map(|part| part / distance) } else { [0.0; 2] };
                self.add_height(ring, out, sum);
            }
        }
    }

    fn add_height(&self, [height, slope]: [f64; 2], [x, z]: [f64; 2], sum: &mut Sample) {
        sum.displacement[1] += height;
        sum.along_x[1] += slope * x;
        sum.along_z[1] += slope * z;
    }

    /// Height, metres, and slope along the direction, from sine and cosine of the phase.
    fn profile(&self, sin: f64, cos: f64) -> [f64; 2] {
        let [height, by_phase] = match self.kind {
            Kind::Sine | Kind::Gerstner => sine::profile(sin, cos),
            Kind::Peaked => peaked::profile(sin, cos, self.sharpness),
            Kind::ExpSine => exp_sine::profile(sin, cos),
        };
        [self.amplitude * height, self.amplitude * self.k * by_phase]
    }

    /// Heights, metres, that it stays between.
    pub fn height_range(&self) -> [f64; 2] {
        match self.kind {
            Kind::Sine | Kind::Gerstner => [-self.amplitude, self.amplitude],
            Kind::Peaked => [0.0, 2.0 * self.amplitude],
            Kind::ExpSine => [0.0, self.amplitude],
        }
    }

    /// Variance of the height over a wavelength, square metres. For sums of few harmonics equally spaced points are exact.
    pub fn variance(&self) -> f64 {
        let [mut mean, mut square] = [0.0; 2];
        for point in 0..PROFILE {
            let (sin, cos) = libm::sincos(TAU * f64::from(point) / f64::from(PROFILE));
            let [height, _] = self.profile(sin, cos);
            mean += height / f64::from(PROFILE);
            square += height * height / f64::from(PROFILE);
        }
        square - mean * mean
    }

    pub(super) fn validate(&self) -> Result<(), SeaError> {
        let [x, z] = match self.front {
            Front::Plane { direction } => direction,
            Front::Ring { centre } => {
                let inside = centre.iter().all(|part| part.abs() <= 1e9);
                // A direction that is in order, or none.
                if inside { [1.0, 0.0] } else { [f64::NAN; 2] }
            }
        };
        let rows = [
            (
                "length of a wave's direction",
                libm::hypot(x, z),
                1.0 - 1e-9,
                1.0 + 1e-9,
                "1, and a centre within 1e9 m",
            ),
            ("wave number", self.k, 1e-6, 1e4, "1e-6..=1e4 rad/m"),
            ("frequency of a wave", self.frequency, -1e4, 1e4, "-1e4..=1e4 Hz"),
            ("amplitude of a wave", self.amplitude, 0.0, 1e4, "0..=1e4 m"),
            ("horizontal amplitude of a wave", self.horizontal, 0.0, 1e4, "0..=1e4 m"),
            ("sharpness of a wave", self.sharpness, 1.0, 32.0, "1..=32"),
            ("phase of a wave", self.phase, -1e3, 1e3, "-1000..=1000 rad"),
        ];
        for (key, value, low, high, allowed) in rows {
            if !(low..=high).contains(&value) {
                return Err(SeaError::Sea { key, value: value.to_string(), allowed });
            }
        }
        Ok(())
    }
}
