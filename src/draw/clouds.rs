//! A thin layer of fair-weather cloud, painted into the sky when it is baked: it costs a frame nothing.
//!
//! Density is fractal value noise (five octaves, warped by itself) on a plane overhead. Light passes by Beer's law;
//! what the sun adds is scattered forwards (Henyey and Greenstein 1941), so thin edges near the sun are the brightest.

use glam::{Vec2, Vec3};

/// How many times the noise repeats itself at half the size.
const OCTAVES: u32 = 5;
/// Angle above the horizon (its sine) below which clouds dissolve in the haze.
const FADE: f32 = 0.16;
/// Asymmetry of scattering by droplets.
const FORWARDS: f32 = 0.6;
/// Optical depth of the thickest cloud.
const DEPTH: f32 = 2.6;

/// Clouds of one sky.
pub struct Clouds {
    cover: f32,
    sun: Vec3,
    sun_light: Vec3,
    /// What a white wall would send in the light of the sky around them.
    ambient: Vec3,
}

impl Clouds {
    /// Clouds over the share `cover` (0..=1) of the sky, lit by the sun and by a sky that a white wall would send on as `ambient`.
    pub const fn new(cover: f32, sun: Vec3, sun_light: Vec3, ambient: Vec3) -> Self {
        Self { cover, sun, sun_light, ambient }
    }

    /// Light from the unit vector `direction`, when `behind` is what a clear sky would send.
    pub fn over(&self, direction: Vec3, behind: Vec3) -> Vec3 {
        if self.cover <= 0.0 || direction.y <= 0.0 {
            return behind;
        }
        let place = Vec2::new(direction.x, direction.z) / (direction.y + 0.08);
        let warp = Vec2::new(fractal(place * 0.7 + 11.0), fractal(place * 0.7 + 37.0));
        let noise = fractal(place * 1.3 + 1.6 * warp);
        // Value noise is nearly normal about 0.5: this threshold leaves about `cover` of it.
        let threshold = 0.5 + 0.22 * (1.0 - 2.0 * self.cover);
        let density = smoothstep(threshold, threshold + 0.22, noise) * smoothstep(0.0, FADE, direction.y);
        let depth = DEPTH * density;
        let kept = (-depth).exp();
        let cosine = direction.dot(self.sun);
        let g2 = FORWARDS * FORWARDS;
        let phase =
            (1.0 - g2) / (4.0 * std::f32::consts::PI * (1.0 + g2 - 2.0 * FORWARDS * cosine).powf(1.5));
        // Light is scattered on its way through, and shadowed by the cloud it has crossed.
        let scattered = self.sun_light * (phase + 0.06) * (1.0 - kept) * (-0.5 * depth).exp();
        // The thicker it is, the darker its underside.
        behind * kept + scattered + self.ambient * ((1.0 - kept) * (0.45 + 0.55 * kept))
    }
}

fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Sum of octaves, in 0..1.
fn fractal(mut place: Vec2) -> f32 {
    let (mut sum, mut weight) = (0.0, 0.5);
    for _ in 0..OCTAVES {
        sum += weight * noise(place);
        // Turned a little each time, so that the grids do not show.
        place = Vec2::new(1.6 * place.x - 1.2 * place.y, 1.2 * place.x + 1.6 * place.y) + 7.3;
        weight *= 0.5;
    }
    sum
}

/// Smoothly interpolated random values on the integers, in 0..1.
fn noise(place: Vec2) -> f32 {
    let cell = place.floor();
    let t = place - cell;
    let t = t * t * (Vec2::splat(3.0) - 2.0 * t);
    #[expect(clippy::cast_possible_truncation, reason = "cells near the zenith")]
    let at = |dx: i32, dy: i32| hash(cell.x as i32 + dx, cell.y as i32 + dy);
    let low = at(0, 0) + (at(1, 0) - at(0, 0)) * t.x;
    let high = at(0, 1) + (at(1, 1) - at(0, 1)) * t.x;
    low + (high - low) * t.y
}

/// A random value of a cell, in 0..1: Wellons' lowbias32 over both coordinates.
#[expect(clippy::cast_precision_loss, clippy::cast_sign_loss, reason = "bits")]
fn hash(x: i32, y: i32) -> f32 {
    let mut h = (x as u32).wrapping_mul(0x9e37_79b9) ^ (y as u32).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 16)).wrapping_mul(0x7feb_352d);
    h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    ((h ^ (h >> 16)) >> 8) as f32 / 16_777_216.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clouds(cover: f32) -> Clouds {
        Clouds::new(cover, Vec3::new(0.0, 0.6, -0.8), Vec3::splat(80.0), Vec3::splat(3.0))
    }

    /// Directions spread over the sky above the haze.
    fn sky() -> impl Iterator<Item = Vec3> {
        (0..4000).map(|i| {
            let (turn, y) = (i as f32 * 2.399_963, 0.2 + 0.8 * (i as f32 + 0.5) / 4000.0);
            let level = (1.0 - y * y).sqrt();
            Vec3::new(turn.cos() * level, y, turn.sin() * level)
        })
    }

    #[test]
    fn without_cover_and_below_the_horizon_the_sky_is_as_it_was() {
        assert_eq!(clouds(0.0).over(Vec3::Y, Vec3::ONE), Vec3::ONE);
        assert_eq!(clouds(1.0).over(-Vec3::Y, Vec3::ONE), Vec3::ONE);
    }

    #[test]
    fn more_cover_hides_more_sky() {
        let hidden = |cover: f32| {
            let clouds = clouds(cover);
            // Behind a sky without light of its own, whatever shines is cloud.
            sky().filter(|&d| clouds.over(d, Vec3::ZERO).x > 1.0).count()
        };
        let counts = [0.1, 0.3, 0.6, 0.9].map(hidden);
        assert!(counts.is_sorted() && counts[0] > 0 && counts[3] > 3000, "{counts:?}");
        assert!((800..2400).contains(&counts[1]), "{counts:?}");
    }
}
