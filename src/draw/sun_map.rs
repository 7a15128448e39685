//! What the sun's map covers, and how positions come to lie on it: the arithmetic of docs/shadows.md.
//!
//! The map lies in the plane of the sea at rest. Positions go there along the sun's rays, so that a texel is as wide on the
//! sea under a low sun as under a high one; depth is height, so that what stands highest on a ray hides what is below.

use super::camera::{self, Eye};
use super::solids::Solid;
use super::uniforms::SunMap;
use crate::lod::Frustum;
use crate::scene::ShadowSettings;
use glam::{DVec2, DVec3, Mat4, Vec3, Vec4};

/// Sine of the lowest sun that shadows are cast by, 2 degrees; lower ones cast as this one does.
const LOWEST_SUN: f64 = 0.0349;
/// Share of the distance where shadows begin to fade.
const FADE: f64 = 0.8;
/// Metres of water that light comes through a crest: the green of clear water halves in about as much.
const THROUGH: f64 = 10.0;
/// Metres by which things near the viewer may stand above the sea and still lie on the map.
const RAISED: f64 = 1.5;
/// Sizes are rounded up to this share of the distance, so that the last bits of a turning head do not change them.
const STEP: f64 = 1.0 / 64.0;

/// The map for one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// Horizontal direction towards the sun (x, z), unit length: along u.
    towards: DVec2,
    /// Cotangent of the sun's height.
    lean: f64,
    /// Sine of it.
    sine: f64,
    /// Middle of the map along u and v, world metres.
    middle: DVec2,
    /// Half its sides, metres.
    half: DVec2,
    /// Heights of depth 0 and 1, metres.
    heights: [f64; 2],
    distance: f64,
    resolution: f64,
}

impl Fit {
    /// A map of what `eyes` may see, for the unit vector `sun` and waves within `max_height` of the sea at rest.
    ///
    /// Its size depends on the fields of view and not on where they look; its middle moves by whole texels.
    pub fn new(
        settings: &ShadowSettings,
        sun: Vec3,
        max_height: f64,
        eyes: &[Eye],
        solids: &[Solid],
    ) -> Self {
        let sun = sun.as_dvec3();
        let sine = sun.y.clamp(LOWEST_SUN, 1.0);
        let towards = DVec2::new(sun.x, sun.z).normalize_or(DVec2::X);
        let lean = (1.0 - sine * sine).sqrt() / sine;
        let ShadowSettings { distance, resolution, .. } = *settings;
        let (centre, radius) = surrounding(eyes, distance);
        // Waves' tops and feet lie farther on along the sun's rays.
        let margin = ((0.5 * max_height + RAISED) * lean).min(radius);
        let half = DVec2::new(radius + margin, radius).map(|side| round_up(side, STEP * distance));
        let resolution = f64::from(resolution);
        let texel = 2.0 * half / resolution;
        let place = DVec2::new(towards.dot(centre), towards.perp().dot(centre));
        let highest = solids.iter().map(Solid::top).fold(max_height, f64::max);
        Self {
            towards,
            lean,
            sine,
            middle: (place / texel).round() * texel,
            half,
            heights: [-max_height - 1.0, highest + 1.0],
            distance,
            resolution,
        }
    }

    /// Along u, along v and depth, each as the x, y, z and 1 of a position relative to `origin` (world metres); the map
    /// reaches from 0 to 1.
    fn rows(&self, origin: DVec3) -> [[f64; 4]; 3] {
        let level = DVec2::new(origin.x, origin.z);
        let (u, v) = (self.towards, self.towards.perp());
        let size = 2.0 * self.half;
        let [low, high] = self.heights;
        [
            [u.x, -self.lean, u.y, u.dot(level) - self.lean * origin.y - self.middle.x + self.half.x]
                .map(|factor| factor / size.x),
            [v.x, 0.0, v.y, v.dot(level) - self.middle.y + self.half.y].map(|factor| factor / size.y),
            [0.0, 1.0, 0.0, origin.y - low].map(|factor| factor / (high - low)),
        ]
    }

    /// What casts shadows into the map, for boxes relative to `head`.
    pub fn frustum(&self, head: DVec3) -> Frustum {
        let row = |factors: [f64; 4]| Vec4::from_array(factors.map(|factor| factor as f32));
        let [u, v, depth] = self.rows(head).map(row);
        let clip = |row: Vec4| 2.0 * row - Vec4::W;
        Frustum::from_view_projection(Mat4::from_cols(clip(u), clip(v), depth, Vec4::W).transpose())
    }

    /// The same for shaders, for positions relative to `origin`.
    #[expect(clippy::cast_possible_truncation, reason = "subtracted in f64 first")]
    pub fn uniforms(&self, origin: DVec3) -> SunMap {
        let [u, v, depth] = self.rows(origin).map(|row| row.map(|factor| factor as f32));
        let fade = 1.0 / ((1.0 - FADE) * self.distance);
        let [low, high] = self.heights;
        SunMap {
            along: u,
            across: [v[0], depth[1], v[2], v[3]],
            reach: [
                depth[3],
                (self.distance * fade) as f32,
                fade as f32,
                (THROUGH * self.sine / (high - low)) as f32,
            ],
            texels: [0.5, 0.5, 1.5, 0.0].map(|count| (count / self.resolution) as f32),
        }
    }
}

/// World (x, z) of the middle, and radius of the smallest ball around what `eyes` see within `distance`.
fn surrounding(eyes: &[Eye], distance: f64) -> (DVec2, f64) {
    let head = camera::head(eyes);
    let forward = eyes.iter().map(|eye| -eye.axes.z_axis).sum::<Vec3>().normalize_or(Vec3::NEG_Z);
    let cosine = eyes.iter().flat_map(corners).map(|ray| ray.dot(forward)).fold(1.0, f32::min);
    let (cosine, forward) = (f64::from(cosine), forward.as_dvec3());
    // A cone with a round cap: up to 45 degrees from its axis the ball goes through tip and rim, then through the rim
    // alone, and beyond 90 it is all around the tip.
    let (ahead, radius) = if cosine * cosine > 0.5 {
        (0.5 / cosine, 0.5 / cosine)
    } else if cosine > 0.0 {
        (cosine, (1.0 - cosine * cosine).sqrt())
    } else {
        (0.0, 1.0)
    };
    let centre = head + forward * round_up(ahead, STEP) * distance;
    (DVec2::new(centre.x, centre.z), (radius + STEP) * distance)
}

/// Directions to the corners of what an eye sees.
fn corners(eye: &Eye) -> [Vec3; 4] {
    let fov = eye.fov;
    [(fov.left, fov.up), (fov.right, fov.up), (fov.left, fov.down), (fov.right, fov.down)]
        .map(|(x, y)| (eye.axes * Vec3::new(x, y, -1.0)).normalize())
}

/// The next multiple of `step`, or this one as far as rounding tells.
fn round_up(value: f64, step: f64) -> f64 {
    (value / step - 1e-4).ceil() * step
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::camera::Fov;
    use crate::scene::Shadows;
    use glam::Mat3;

    const SETTINGS: ShadowSettings =
        ShadowSettings { shadows: Shadows::On, resolution: 1024, distance: 150.0 };
    const HEIGHT: f64 = 2.0;

    fn pair(position: DVec3, yaw: f32, pitch: f32) -> [Eye; 2] {
        let axes = Mat3::from_rotation_y(yaw) * Mat3::from_rotation_x(pitch);
        let fov = |left, right| Fov { left, right, up: 0.9, down: -1.1 };
        let side = axes.x_axis.as_dvec3() * 0.0315;
        [
            Eye { position: position - side, axes, fov: fov(-1.3, 0.8) },
            Eye { position: position + side, axes, fov: fov(-0.8, 1.3) },
        ]
    }

    fn sun(elevation: f32) -> Vec3 {
        let e = elevation.to_radians();
        Vec3::new(0.6 * e.cos(), e.sin(), -0.8 * e.cos())
    }

    fn fit(eyes: &[Eye], elevation: f32) -> Fit {
        Fit::new(&SETTINGS, sun(elevation), HEIGHT, eyes, &[])
    }

    /// Texture coordinates and depth of a world position, in `f64`.
    fn place(fit: &Fit, position: DVec3) -> DVec3 {
        let [u, v, depth] =
            fit.rows(DVec3::ZERO).map(|row| DVec3::new(row[0], row[1], row[2]).dot(position) + row[3]);
        DVec3::new(u, v, depth)
    }

    #[test]
    fn what_is_seen_within_the_distance_lies_on_the_map() {
        for elevation in [0.0, 2.0, 8.0, 30.0, 60.0, 90.0] {
            for yaw in [0.0, 0.7, 2.0, 3.1, 4.6] {
                for pitch in [-1.5, -0.5, 0.0, 0.3] {
                    let eyes = pair(DVec3::new(1.0e5, 1.8, -2.0e5), yaw, pitch);
                    let fit = fit(&eyes, elevation);
                    for eye in &eyes {
                        for (x, y) in [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0), (0.5, 0.2)] {
                            let fov = eye.fov;
                            let across = Vec3::new(
                                fov.left + (fov.right - fov.left) * x,
                                fov.down + (fov.up - fov.down) * y,
                                -1.0,
                            );
                            let ray = (eye.axes * across).normalize().as_dvec3();
                            for distance in [1.0, 20.0, 100.0, 149.0] {
                                let point = eye.position + ray * distance;
                                // Waves as high as that, and what stands on a raft.
                                if point.y.abs() > 0.5 * HEIGHT {
                                    continue;
                                }
                                let place = place(&fit, point);
                                assert!(
                                    place.min_element() > 0.0 && place.max_element() < 1.0,
                                    "{place} {point} at {elevation} {yaw} {pitch}"
                                );
                            }
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn a_ray_of_the_sun_is_one_place_and_the_higher_end_the_nearer() {
        let fit = fit(&pair(DVec3::Y, 0.3, -0.2), 12.0);
        let (low, up) = (DVec3::new(3.0, -1.0, -20.0), sun(12.0).as_dvec3() * 7.0);
        let [low, high] = [low, low + up].map(|point| place(&fit, point));
        assert!((low - high).truncate().length() < 1e-6, "{low} {high}");
        assert!(high.z > low.z);
    }

    /// Texels lie still in the world, or shadows' edges would crawl when a head moves.
    #[test]
    fn texels_stay_where_they_are_when_the_head_moves() {
        let texels = |eyes: &[Eye]| place(&fit(eyes, 15.0), DVec3::new(2.0, 0.3, -9.0)).truncate() * 1024.0;
        let first = texels(&pair(DVec3::new(0.0, 1.7, 0.0), 0.0, 0.0));
        for step in 1..200 {
            let t = f64::from(step);
            let position = DVec3::new(0.37 * t, 1.7 + (0.3 * t).sin(), -0.11 * t);
            let moved = texels(&pair(position, 0.021 * step as f32, (0.05 * step as f32).sin())) - first;
            assert!((moved - moved.round()).abs().max_element() < 1e-5, "{moved} after {step}");
        }
    }

    #[test]
    fn shaders_get_the_same_numbers() {
        let origin = DVec3::new(4.0e5, 0.0, -3.0e5);
        let fit = fit(&pair(origin + DVec3::Y, 1.0, -0.2), 6.0);
        let point = DVec3::new(12.5, 0.75, -30.25);
        let SunMap { along, across, reach, .. } = fit.uniforms(origin);
        let p = point.as_vec3();
        let seen = DVec3::new(
            f64::from(along[0] * p.x + along[1] * p.y + along[2] * p.z + along[3]),
            f64::from(across[0] * p.x + across[2] * p.z + across[3]),
            f64::from(across[1] * p.y + reach[0]),
        );
        assert!((seen - place(&fit, origin + point)).abs().max_element() < 1e-5);
        // Boxes that touch the map are kept, others are not.
        let frustum = fit.frustum(origin);
        assert!(frustum.keeps(p, Vec3::ONE) && !frustum.keeps(Vec3::new(900.0, 0.0, 900.0), Vec3::ONE));
    }
}
