//! Seas whose every height is known, for the tests of the raft.
#![allow(dead_code, clippy::expect_used, reason = "every test file uses some of these; a test may panic")]
use half::f16;
use std::f64::consts::TAU;
use swell::raft::RaftSettings;
use swell::sea::{CascadeMaps, CascadeSettings, FoamSettings, Sea, SeaMaps, SeaSettings};

/// One long-crested wave that does not displace sideways: h = a cos(k u - omega t), u along world (cos r, -sin r).
#[derive(Clone, Copy, Debug)]
pub struct Wave {
    /// Metres.
    pub length: f64,
    /// Metres.
    pub amplitude: f64,
    /// Radians counter-clockwise seen from above, from +X.
    pub towards: f64,
}

/// Grid points along a wave. Between two of them a facet is off by (2 pi / N)^2 / 8 of the amplitude, 2e-5; halves add
/// 2.5e-4.
const POINTS: usize = 512;

impl Wave {
    pub fn wave_number(&self) -> f64 {
        TAU / self.length
    }

    /// Deep water: omega^2 = g k, rad/s.
    pub fn omega(&self) -> f64 {
        (9.81 * self.wave_number()).sqrt()
    }

    /// k u, the phase's part in space.
    pub fn along(&self, x: f64, z: f64) -> f64 {
        let (sin, cos) = self.towards.sin_cos();
        self.wave_number() * (x * cos - z * sin)
    }

    pub fn height(&self, x: f64, z: f64, time: f64) -> f64 {
        self.amplitude * (self.along(x, z) - self.omega() * time).cos()
    }

    /// Maps that are flat yet, one wave to the patch.
    pub fn maps(&self) -> SeaMaps {
        let cascade = CascadeSettings {
            resolution: POINTS,
            patch_size: self.length,
            rotation: self.towards,
            ..CascadeSettings::default()
        };
        SeaMaps {
            time: 0.0,
            foam: FoamSettings::default(),
            cascades: vec![CascadeMaps::new(&cascade, false)],
            models: Default::default(),
        }
    }

    pub fn fill(&self, maps: &mut SeaMaps, time: f64) {
        maps.time = time;
        let mut row = [[f16::ZERO; 4]; POINTS];
        for (i, texel) in row.iter_mut().enumerate() {
            let phase = TAU * i as f64 / POINTS as f64 - self.omega() * time;
            texel[1] = f16::from_f64(self.amplitude * phase.cos());
        }
        maps.cascades[0].displacement[..POINTS * POINTS]
            .chunks_exact_mut(POINTS)
            .for_each(|to| to.copy_from_slice(&row));
    }

    pub fn at(&self, time: f64) -> SeaMaps {
        let mut maps = self.maps();
        self.fill(&mut maps, time);
        maps
    }
}

/// A flat sea.
pub fn flat() -> SeaMaps {
    Wave { length: 10.0, amplitude: 0.0, towards: 0.0 }.maps()
}

/// A fresh breeze over 80 m, choppy: crests a metre high, all directions.
pub fn breeze() -> Sea {
    let cascade = CascadeSettings {
        resolution: 64,
        reference_resolution: 64,
        patch_size: 80.0,
        wind_speed: 9.0,
        alignment: 0.3,
        seed: 5,
        ..CascadeSettings::default()
    };
    let foam = FoamSettings { fade_time: 0.0, ..FoamSettings::default() };
    Sea::new(&SeaSettings { cascades: vec![cascade], foam, ..SeaSettings::default() })
        .expect("valid settings")
}

/// The default raft; written out where a test's numbers depend on it.
pub fn settings() -> RaftSettings {
    RaftSettings {
        length: 2.4,
        width: 2.4,
        freeboard: 0.25,
        heave_frequency: 1.2,
        heave_damping: 0.7,
        tilt_frequency: 1.0,
        tilt_damping: 0.7,
        glide_speed: 3.0,
        glide_acceleration: 6.0,
        dead_zone: 0.2,
        ..RaftSettings::default()
    }
}

/// A complex number, for transfer functions.
#[derive(Clone, Copy, Debug)]
pub struct Complex(pub f64, pub f64);

impl Complex {
    /// e^(i angle).
    pub fn turn(angle: f64) -> Self {
        Self(angle.cos(), angle.sin())
    }

    pub fn times(self, other: Self) -> Self {
        Self(self.0 * other.0 - self.1 * other.1, self.0 * other.1 + self.1 * other.0)
    }

    pub fn over(self, other: Self) -> Self {
        let square = other.0 * other.0 + other.1 * other.1;
        let product = self.times(Self(other.0, -other.1));
        Self(product.0 / square, product.1 / square)
    }
}

/// (1 + 2 i zeta r) / (1 - r^2 + 2 i zeta r) for r = omega / (2 pi frequency).
pub fn transfer(omega: f64, frequency: f64, damping: f64) -> Complex {
    let r = omega / (TAU * frequency);
    Complex(1.0, 2.0 * damping * r).over(Complex(1.0 - r * r, 2.0 * damping * r))
}
