//! The sky as a cube of half floats with mips, from the daylight model or from a file.

use super::clouds::Clouds;
use super::daylight::Daylight;
use super::sky_picture::{Picture, SkyError};
use crate::scene::{SkySettings, SkySource};
use glam::Vec3;
use half::f16;
use rayon::prelude::*;

/// Texels along a face's side: 0.35 degrees each at the middle, fine enough for clouds.
pub const FACE: usize = 256;
/// Mip levels of the cube.
pub const MIPS: usize = FACE.ilog2() as usize + 1;

/// Luminance of linear Rec. 709.
const LUMINANCE: Vec3 = Vec3::new(0.2126, 0.7152, 0.0722);

/// Texels and the light they shed.
pub struct SkyMap {
    /// RGBA halves: mip after mip, within a mip face after face (+X -X +Y -Y +Z -Z), rows from the top.
    pub texels: Vec<[f16; 4]>,
    /// Illuminance of a level plane by the sky alone.
    pub sky_light: Vec3,
    /// Illuminance by the sun on a plane facing it.
    pub sun_light: Vec3,
    /// Unit vector towards the sun.
    pub sun: Vec3,
}

impl SkyMap {
    /// Bakes or loads the sky of a scene.
    ///
    /// # Errors
    /// The file of a [`SkySource::Cubemap`] is missing, unreadable, or of an unknown shape.
    pub fn new(settings: &SkySettings) -> Result<Self, SkyError> {
        let (azimuth, elevation) = (settings.sun_azimuth, settings.sun_elevation);
        let level = elevation.cos();
        let sun = glam::DVec3::new(azimuth.cos() * level, elevation.sin(), -azimuth.sin() * level).as_vec3();
        // The sun shines through the same air whether or not the sky behind it comes from a file.
        let turbidity = match settings.source {
            SkySource::Daylight { turbidity, .. } => turbidity,
            SkySource::Cubemap { .. } => 3.0,
        };
        #[expect(clippy::cast_possible_truncation, reason = "factors of a scene file")]
        let (turbidity, strength) = (turbidity as f32, settings.sun_intensity as f32);
        let daylight = Daylight::new(sun, turbidity);
        let top: Vec<Vec3> = match &settings.source {
            SkySource::Daylight { clouds, .. } => {
                let sun_light = daylight.sun_light() * strength;
                // Droplets scatter all colours alike: clouds are as bright as the sky around them, and grey.
                let around = daylight.radiance(Vec3::new(-sun.x, 0.5, -sun.z).normalize());
                let ambient = 1.3 * around.lerp(Vec3::splat(around.dot(LUMINANCE)), 0.85);
                let clouds = Clouds::new(*clouds as f32, sun, sun_light, ambient);
                bake(|direction| {
                    // What a mirror facing down would see is sea: the horizon's light, getting darker downwards.
                    let sea = 1.0 - 0.8 * (-4.0 * direction.y).clamp(0.0, 1.0);
                    clouds.over(direction, daylight.radiance(direction) * sea)
                })
            }
            SkySource::Cubemap { file } => {
                let picture = Picture::open(file)?;
                bake(|direction| picture.radiance(direction))
            }
        };
        let sky_light = illuminance(&top);
        Ok(Self { texels: chain(top), sky_light, sun_light: daylight.sun_light() * strength, sun })
    }
}

/// Direction through texel (x, y) of a face, as Vulkan orders and turns the faces of a cube.
pub fn direction(face: usize, x: usize, y: usize, size: usize) -> Vec3 {
    #[expect(clippy::cast_precision_loss, reason = "texel counts")]
    let [s, t] = [x, y].map(|i| (2 * i + 1) as f32 / size as f32 - 1.0);
    match face {
        0 => Vec3::new(1.0, -t, -s),
        1 => Vec3::new(-1.0, -t, s),
        2 => Vec3::new(s, 1.0, t),
        3 => Vec3::new(s, -1.0, -t),
        4 => Vec3::new(s, -t, 1.0),
        _ => Vec3::new(-s, -t, -1.0),
    }
    .normalize()
}

fn bake(radiance: impl Fn(Vec3) -> Vec3 + Sync) -> Vec<Vec3> {
    (0..6 * FACE * FACE)
        .into_par_iter()
        .map(|i| radiance(direction(i / (FACE * FACE), i % FACE, i / FACE % FACE, FACE)))
        .collect()
}

/// Integral of radiance times the cosine from the zenith over the upper half.
fn illuminance(top: &[Vec3]) -> Vec3 {
    let (mut sum, mut weight) = (Vec3::ZERO, 0.0);
    for (i, radiance) in top.iter().enumerate() {
        let (face, x, y) = (i / (FACE * FACE), i % FACE, i / FACE % FACE);
        let d = direction(face, x, y, FACE);
        // A texel's solid angle falls with the cube of the cosine at the face's middle.
        let solid = d.abs().max_element().powi(3);
        weight += solid;
        sum += *radiance * d.y.max(0.0) * solid;
    }
    sum * (4.0 * std::f32::consts::PI / weight)
}

/// The whole mip chain in halves, each level the 2x2 mean of the one above, face by face.
fn chain(top: Vec<Vec3>) -> Vec<[f16; 4]> {
    let mut texels = Vec::new();
    let (mut level, mut size) = (top, FACE);
    loop {
        // Halves end at 65504; a file's sun may be beyond.
        texels.extend(level.iter().map(|c| {
            let c = c.min(Vec3::splat(60_000.0));
            [c.x, c.y, c.z, 1.0].map(f16::from_f32)
        }));
        if size == 1 {
            return texels;
        }
        let half = size / 2;
        level = (0..6 * half * half)
            .map(|i| {
                let (face, x, y) = (i / (half * half), i % half * 2, i / half % half * 2);
                let at = |dx, dy| level[(face * size + y + dy) * size + x + dx];
                (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) * 0.25
            })
            .collect();
        size = half;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_white_sky_lights_the_sea_with_pi() {
        let white = vec![Vec3::ONE; 6 * FACE * FACE];
        assert!((illuminance(&white).x - std::f32::consts::PI).abs() < 0.01);
        let texels = chain(white);
        assert_eq!(texels.len(), (0..MIPS).map(|m| 6 * (FACE >> m).pow(2)).sum::<usize>());
        assert!(texels.iter().all(|t| t[0].to_f32() == 1.0));
    }
}
