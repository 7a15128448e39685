//! The printed formulas, written down as they are printed and in no other way: sums over waves of offset and tangents.
#![allow(dead_code, reason = "each test uses a part")]
use std::f64::consts::TAU;

/// A rest point's offset and the derivatives of it along x and z.
#[derive(Clone, Copy, Debug, Default)]
pub struct Parts {
    pub offset: [f64; 3],
    pub along_x: [f64; 3],
    pub along_z: [f64; 3],
}

impl Parts {
    pub fn add(&mut self, other: Self) {
        for i in 0..3 {
            self.offset[i] += other.offset[i];
            self.along_x[i] += other.along_x[i];
            self.along_z[i] += other.along_z[i];
        }
    }

    /// Of a surface that moves up and down alone: (-dh/dx, 1, -dh/dz), else binormal x tangent.
    pub fn normal(&self) -> [f64; 3] {
        let t = [1.0 + self.along_x[0], self.along_x[1], self.along_x[2]];
        let b = [self.along_z[0], self.along_z[1], 1.0 + self.along_z[2]];
        let n = [b[1] * t[2] - b[2] * t[1], b[2] * t[0] - b[0] * t[2], b[0] * t[1] - b[1] * t[0]];
        let length = n.iter().map(|part| part * part).sum::<f64>().sqrt();
        n.map(|part| part / length)
    }
}

/// Unit vector of an angle from +X, counter-clockwise seen from above.
pub fn towards(degrees: f64) -> [f64; 2] {
    [degrees.to_radians().cos(), -degrees.to_radians().sin()]
}

/// What all plane waves are written with.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    pub wavelength: f64,
    pub degrees: f64,
    pub speed: Option<f64>,
    pub phase: f64,
}

impl Plane {
    pub fn k(&self) -> f64 {
        TAU / self.wavelength
    }

    pub fn speed(&self) -> f64 {
        self.speed.unwrap_or_else(|| (9.81 / self.k()).sqrt())
    }

    /// f = k (d . (x, z) - c t) + phase.
    pub fn f(&self, [x, z]: [f64; 2], t: f64) -> f64 {
        let d = towards(self.degrees);
        self.k() * (d[0] * x + d[1] * z - self.speed() * t) + self.phase
    }

    fn upright(&self, height: f64, slope: f64) -> Parts {
        let d = towards(self.degrees);
        Parts {
            offset: [0.0, height, 0.0],
            along_x: [0.0, d[0] * slope, 0.0],
            along_z: [0.0, d[1] * slope, 0.0],
        }
    }

    /// y = A sin f.
    pub fn sine(&self, amplitude: f64, rest: [f64; 2], t: f64) -> Parts {
        let f = self.f(rest, t);
        self.upright(amplitude * f.sin(), amplitude * self.k() * f.cos())
    }

    /// y = 2 A ((sin f + 1) / 2)^K.
    pub fn peaked(&self, amplitude: f64, sharpness: f64, rest: [f64; 2], t: f64) -> Parts {
        let f = self.f(rest, t);
        let base = (f.sin() + 1.0) / 2.0;
        let slope = amplitude * sharpness * base.powf(sharpness - 1.0) * self.k() * f.cos();
        self.upright(2.0 * amplitude * base.powf(sharpness), slope)
    }

    /// Offset (d_x a cos f, a sin f, d_z a cos f) with a = steepness / k, and the tangents printed with it.
    pub fn gerstner(&self, steepness: f64, rest: [f64; 2], t: f64) -> Parts {
        let (f, s, [dx, dz]) = (self.f(rest, t), steepness, towards(self.degrees));
        let a = s / self.k();
        Parts {
            offset: [dx * a * f.cos(), a * f.sin(), dz * a * f.cos()],
            along_x: [-dx * dx * s * f.sin(), dx * s * f.cos(), -dx * dz * s * f.sin()],
            along_z: [-dx * dz * s * f.sin(), dz * s * f.cos(), -dz * dz * s * f.sin()],
        }
    }

    /// Offset (Q A d_x cos f, A sin f, Q A d_z cos f) with Q = q / (k A n).
    pub fn gems(&self, amplitude: f64, q: f64, n: f64, rest: [f64; 2], t: f64) -> Parts {
        let (f, k, [dx, dz]) = (self.f(rest, t), self.k(), towards(self.degrees));
        let big_q = q / (k * amplitude * n);
        let (wa, a) = (k * amplitude, amplitude);
        Parts {
            offset: [big_q * a * dx * f.cos(), a * f.sin(), big_q * a * dz * f.cos()],
            along_x: [-big_q * dx * dx * wa * f.sin(), dx * wa * f.cos(), -big_q * dx * dz * wa * f.sin()],
            along_z: [-big_q * dx * dz * wa * f.sin(), dz * wa * f.cos(), -big_q * dz * dz * wa * f.sin()],
        }
    }
}

/// Rings: f = k (r - c t) + phase; `height` and `slope` by f are those of the plane wave, bounded within half a wavelength.
pub fn circular(
    wave: &Plane,
    centre: [f64; 2],
    profile: impl Fn(f64) -> [f64; 2],
    rest: [f64; 2],
    t: f64,
) -> Parts {
    let [x, z] = [rest[0] - centre[0], rest[1] - centre[1]];
    let r = (x * x + z * z).sqrt();
    let [height, by_f] = profile(wave.k() * (r - wave.speed() * t) + wave.phase);
    let half = wave.wavelength / 2.0;
    let (bound, growth) = if r >= half {
        (1.0, 0.0)
    } else {
        let s = r / half;
        (3.0 * s.powi(2) - 2.0 * s.powi(3), (6.0 * s - 6.0 * s.powi(2)) / half)
    };
    let slope = bound * by_f * wave.k() + growth * height;
    Parts {
        offset: [0.0, bound * height, 0.0],
        along_x: [0.0, slope * x / r, 0.0],
        along_z: [0.0, slope * z / r, 0.0],
    }
}

/// One octave of a fractal sum along `d`: its offset and tangents.
pub fn octave(kernel: &str, choppiness: f64, a: f64, k: f64, d: [f64; 2], f: f64) -> Parts {
    let [dx, dz] = d;
    let (height, by_f) = match kernel {
        "exp-sine" => ((f.sin() - 1.0).exp(), (f.sin() - 1.0).exp() * f.cos()),
        _ => (f.sin(), f.cos()),
    };
    let slope = a * k * by_f;
    let (aside, squeeze) = match kernel {
        "gerstner" => (choppiness * a * f.cos(), -choppiness * a * k * f.sin()),
        _ => (0.0, 0.0),
    };
    Parts {
        offset: [dx * aside, a * height, dz * aside],
        along_x: [dx * dx * squeeze, dx * slope, dx * dz * squeeze],
        along_z: [dx * dz * squeeze, dz * slope, dz * dz * squeeze],
    }
}

/// Foam of height over its maximum and of the unit normal's y, as printed; the complement where `leaning`.
pub fn foam(h: f64, max: f64, n_y: f64, leaning: bool) -> f64 {
    let saturate = |value: f64| value.clamp(0.0, 1.0);
    let (range, height_amount, height_falloff) = ([0.1, 0.7], 0.8, 1.5);
    let (angle_amount, angle_falloff) = (0.2, 2.0);
    let mut ratio = saturate(h / max);
    ratio = (ratio - range[0]) / (range[1] - range[0]);
    ratio = saturate((ratio - 1.0 + height_amount) / height_amount);
    ratio = ratio.powf(height_falloff);
    let mut angle = saturate((saturate(n_y) - 1.0 + angle_amount) / angle_amount);
    if leaning {
        angle = 1.0 - angle;
    }
    // lerp(ratio, angle ^ falloff, ratio)
    ratio + (angle.powf(angle_falloff) - ratio) * ratio
}

/// The same numbers as keys.
pub const FOAM: &str =
    "range = [0.1, 0.7]\nheight_amount = 0.8\nheight_falloff = 1.5\nangle_amount = 0.2\nangle_falloff = 2\n";
