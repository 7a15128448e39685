//! The uniform block of waves that are formulas: the Rust twin of `Waves` in `shaders/models.wgsl`.
//!
//! Blinn-Phong's numbers are in it too, so that a sea without formulas that is shaded by light alone has nothing more to upload.
//!
//! What a wave is comes from [`ModelsUniform`]. Drawing wants to know besides what to put in the place of waves that are
//! finer than a mesh or a pixel can show: their mean height, and the variance of their slopes, which is roughness.

use super::shaders::WAVES_SIZE;
use super::uniforms::{FOAM_REPEAT, repeated_roughness};
use crate::scene::{Mirrored, Scene};
use crate::sea::SeaMaps;
use crate::sea::waves::{Kind, MAX_OCTAVES, MAX_WAVES, ModelsUniform, Wave, WaveUniform, exp_sine, peaked};
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3, Vec4};
use std::f32::consts::PI;
use std::f64::consts::TAU;

/// Fields as in the WGSL.
#[repr(C)]
#[derive(Clone, Copy, Default, Pod, Zeroable)]
struct Fineness {
    before: f32,
    mean: f32,
    variance: f32,
    per_turn: f32,
}

/// The block. Fields as in the WGSL.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub struct Waves {
    models: ModelsUniform,
    fineness: [Fineness; MAX_WAVES + MAX_OCTAVES],
    scale: Vec4,
    pattern: Vec4,
    look: Vec4,
    ambient: Vec4,
    own: Vec4,
}

const _: () = assert!(size_of::<Waves>() == WAVES_SIZE, "Waves and shaders/models.wgsl differ");

/// Points of a wavelength over which profiles are averaged: exact for sums of few harmonics.
const POINTS: u32 = 256;

impl Waves {
    /// All that stays as it is from frame to frame.
    #[expect(clippy::cast_possible_truncation, reason = "scene values, far inside f32")]
    pub fn new(scene: &Scene) -> Self {
        let sea = &scene.sea;
        let mut waves = Self::zeroed();
        let all = sea.models.iter().flat_map(|model| model.waves());
        for (slot, wave) in waves.fineness.iter_mut().zip(all) {
            *slot = Fineness::of(wave);
        }
        let own = sea.cascades.iter().map(|cascade| cascade.roughness.powi(2)).fold(0.0, f64::max);
        // Cascades have the water's own roughness in their maps.
        let alpha_squared = if sea.spectral { -repeated_roughness(sea) } else { own };
        let detail = scene.water.detail as f32;
        waves.scale = Vec4::new(0.0, detail, alpha_squared as f32, (1.0 / FOAM_REPEAT) as f32);
        let phong = &scene.water.phong;
        let look = [phong.shininess, phong.highlight, phong.sun_size, phong.sun_falloff];
        waves.look = Vec4::from(look.map(|number| number as f32));
        let cube = if phong.mirrored == Mirrored::Cubemap { 1.0 } else { 0.0 };
        waves.ambient = (Vec3::from(phong.ambient_color) / PI).extend(cube);
        waves.own.x = own as f32;
        waves
    }

    /// Turns the block to the sea of `maps`, and that at `before` (seconds), relative to `origin` (world metres). Vertices
    /// are `growth` metres apart for each metre from the head.
    #[expect(clippy::cast_possible_truncation, reason = "reduced in f64 first")]
    pub fn turn(&mut self, maps: &SeaMaps, before: Option<f64>, origin: DVec3, growth: f64) {
        let anchor = [origin.x, origin.z];
        self.models.describe(&maps.models, maps.time, anchor);
        let all = maps.models.iter().flat_map(|model| model.waves());
        for ((slot, now), wave) in self.fineness.iter_mut().zip(&self.models.waves).zip(all) {
            let then = before.map_or(*now, |time| WaveUniform::new(wave, time, anchor));
            slot.before = then.phase - now.phase;
        }
        self.scale.x = growth as f32;
        let [x, z] = anchor.map(|at| (at / FOAM_REPEAT).rem_euclid(1.0) as f32);
        self.pattern = Vec4::new(x, z, 0.0, 0.0);
    }
}

impl Fineness {
    #[expect(clippy::cast_possible_truncation, reason = "authored numbers, far inside f32")]
    fn of(wave: &Wave) -> Self {
        let [mean, variance] = match wave.kind {
            Kind::Sine => [0.0, 0.5],
            Kind::Gerstner => [0.0, gerstner_variance(wave.steepness())],
            Kind::Peaked => averages(|sin, cos| peaked::profile(sin, cos, wave.sharpness)),
            Kind::ExpSine => averages(exp_sine::profile),
        };
        // Near its top a peak of sharpness K is a Gaussian, sqrt(2 / K) radians wide.
        let fineness = (0.5 * wave.sharpness).sqrt().max(1.0);
        Self {
            before: 0.0,
            mean: (wave.amplitude * mean) as f32,
            variance: ((wave.k * wave.amplitude).powi(2) * variance) as f32,
            per_turn: (fineness / TAU) as f32,
        }
    }
}

/// Mean square, over the place where it is seen, of the slope cos f / (1 - q sin f) of a Gerstner wave that squeezes the
/// surface by `q`, and of amplitude 1 / k.
fn gerstner_variance(q: f64) -> f64 {
    let square = q.min(1.0).powi(2);
    // (1 - sqrt(1 - q^2)) / q^2, also for q = 0.
    1.0 / (1.0 + (1.0 - square).sqrt())
}

/// Mean of the height and of the squared slope by the phase, of a profile of amplitude 1.
fn averages(profile: impl Fn(f64, f64) -> [f64; 2]) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for point in 0..POINTS {
        let (sin, cos) = libm::sincos(TAU * f64::from(point) / f64::from(POINTS));
        let [height, slope] = profile(sin, cos);
        sums[0] += height / f64::from(POINTS);
        sums[1] += slope * slope / f64::from(POINTS);
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn averages_are_those_of_known_profiles() {
        // A lifted sine; and exp(sin f - 1), whose mean is I0(1) / e, and its square slope's (I0(2) - I2(2)) / (2 e^2).
        let [mean, variance] = averages(|sin, cos| peaked::profile(sin, cos, 1.0));
        assert!((mean - 1.0).abs() < 1e-12 && (variance - 0.5).abs() < 1e-12, "{mean} {variance}");
        let [mean, variance] = averages(exp_sine::profile);
        assert!((mean - 0.465_759_607_593_640_4).abs() < 1e-12, "{mean}");
        let wanted = 0.5 * (2.279_585_302_336_067 - 0.688_948_447_698_738_2) * (-2.0_f64).exp();
        assert!((variance - wanted).abs() < 1e-12, "{variance}, {wanted}");
    }

    #[test]
    fn gerstner_slopes_are_averaged_where_they_are_seen() {
        for q in [0.0, 0.3, 0.9] {
            let mean: f64 = (0..4096)
                .map(|point| {
                    let (sin, cos) = libm::sincos(TAU * f64::from(point) / 4096.0);
                    cos * cos / (1.0 - q * sin) / 4096.0
                })
                .sum();
            assert!((gerstner_variance(q) - mean).abs() < 1e-9, "{q}: {mean}");
        }
    }
}
