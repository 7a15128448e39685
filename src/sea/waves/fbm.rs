//! Fractal sums: octaves whose amplitude, frequency and speed follow ramps, each in a random direction.
//!
//! Octave i has amplitude A a^i, wave number W w^i and angular speed P p^i for the ramps a, w and p.
use super::{Front, Kind, Wave, turns};
use crate::sea::philox;
use std::f64::consts::TAU;

/// What an octave is as a function of its phase.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kernel {
    /// sin f.
    Sine,
    /// exp(sin f - 1).
    ExpSine,
    /// sin f, and sideways `choppiness` times cos f along the direction.
    Gerstner,
}

/// Which normals the angle's share of the foam wants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lean {
    /// Upright ones, the tops of crests.
    Upright,
    /// Leaning ones, the flanks.
    Leaning,
}

/// How height and normal become foam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FbmFoam {
    /// Shares of the greatest height between which foam grows.
    pub range: [f64; 2],
    /// Share of that range, from its end, over which foam fades in, above 0.
    pub height_amount: f64,
    /// Exponent of the height's share.
    pub height_falloff: f64,
    /// How far below 1 the normal's upward part may be, above 0.
    pub angle_amount: f64,
    /// Exponent of the angle's share.
    pub angle_falloff: f64,
    /// Which normals.
    pub lean: Lean,
    /// Least and greatest share by which foam takes reflections away.
    pub reflection: [f64; 2],
}

/// What octaves are made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FbmSettings {
    /// A, metres.
    pub amplitude: f64,
    /// W, rad/m.
    pub frequency: f64,
    /// P, rad/s.
    pub speed: f64,
    /// a.
    pub amplitude_ramp: f64,
    /// w.
    pub frequency_ramp: f64,
    /// p.
    pub speed_ramp: f64,
    /// How many, 1..=64.
    pub octaves: usize,
    /// Their profile.
    pub kernel: Kernel,
    /// Horizontal over vertical amplitude of the Gerstner kernel.
    pub choppiness: f64,
    /// Seed of the directions.
    pub seed: u64,
    /// Foam.
    pub foam: FbmFoam,
}

/// A fractal sum, its octaves worked out.
#[derive(Clone, Debug, PartialEq)]
pub struct Fbm {
    /// From the first on.
    pub octaves: Vec<Wave>,
    /// Foam.
    pub foam: FbmFoam,
}

impl FbmSettings {
    /// Works out the octaves.
    pub fn build(&self) -> Fbm {
        let (mut amplitude, mut k, mut speed) = (self.amplitude, self.frequency, self.speed);
        let mut octaves = Vec::with_capacity(self.octaves);
        for index in 0..self.octaves as u32 {
            let kind = match self.kernel {
                Kernel::Sine => Kind::Sine,
                Kernel::ExpSine => Kind::ExpSine,
                Kernel::Gerstner => Kind::Gerstner,
            };
            let horizontal = if kind == Kind::Gerstner { self.choppiness * amplitude } else { 0.0 };
            octaves.push(Wave {
                kind,
                front: Front::Plane { direction: direction(self.seed, index) },
                k,
                frequency: speed / TAU,
                amplitude,
                horizontal,
                sharpness: 1.0,
                phase: 0.0,
            });
            amplitude *= self.amplitude_ramp;
            k *= self.frequency_ramp;
            speed *= self.speed_ramp;
        }
        Fbm { octaves, foam: self.foam }
    }
}

/// Unit direction (x, z) of octave `index`.
fn direction(seed: u64, index: u32) -> [f64; 2] {
    let (sin, cos) = libm::sincos(TAU * turns(1.0, philox::uniform(seed, index)));
    [cos, -sin]
}

impl Fbm {
    /// The height that no sum of the octaves passes, metres: the geometric sum of their amplitudes.
    pub fn max_height(&self) -> f64 {
        self.octaves.iter().map(|octave| octave.amplitude).sum()
    }
}

impl FbmFoam {
    /// Foam cover, 0..=1, of a `height` over the greatest there can be and the upward part of the unit normal.
    pub fn cover(&self, height: f64, up: f64) -> f64 {
        let unit = |value: f64| value.clamp(0.0, 1.0);
        let [low, high] = self.range;
        // A flat model has no height at all to compare with.
        let height = if height.is_finite() { unit(height) } else { 0.0 };
        let within = (height - low) / (high - low);
        let high =
            libm::pow(unit((within - 1.0 + self.height_amount) / self.height_amount), self.height_falloff);
        let upright = unit((unit(up) - 1.0 + self.angle_amount) / self.angle_amount);
        let angle = match self.lean {
            Lean::Upright => upright,
            Lean::Leaning => 1.0 - upright,
        };
        high + (libm::pow(angle, self.angle_falloff) - high) * high
    }
}
