//! The sky as a cube of half floats with mips, from the daylight model or from a file.

use super::clouds::Clouds;
use super::daylight::Daylight;
use crate::scene::{SkySettings, SkySource};
use glam::Vec3;
use half::f16;
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Texels along a face's side: 0.35 degrees each at the middle, fine enough for clouds.
pub const FACE: usize = 256;
/// Mip levels of the cube.
pub const MIPS: usize = FACE.ilog2() as usize + 1;

/// Luminance of linear Rec. 709.
const LUMINANCE: Vec3 = Vec3::new(0.2126, 0.7152, 0.0722);

/// A sky file that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum SkyError {
    /// It cannot be read as an image.
    #[error("sky file {}: {source}", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// Why.
        source: image::ImageError,
    },
    /// Its shape is none of the known ones.
    #[error(
        "sky file {} is {width}x{height}: wanted a 6:1 strip (+X -X +Y -Y +Z -Z), a 3:4 vertical cross, or a 2:1 panorama",
        file.display()
    )]
    Shape {
        /// The file.
        file: PathBuf,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
}

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
            SkySource::Cubemap { file } => Picture::open(file)?.bake(),
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

/// How the faces lie in a picture.
enum Layout {
    Strip,
    Cross,
    Panorama,
}

struct Picture {
    image: image::Rgb32FImage,
    layout: Layout,
}

impl Picture {
    fn open(file: &Path) -> Result<Self, SkyError> {
        let read = |source| SkyError::Read { file: file.to_owned(), source };
        let reader = image::ImageReader::open(file).map_err(|e| read(e.into()))?;
        let reader = reader.with_guessed_format().map_err(|e| read(e.into()))?;
        let encoded = matches!(reader.format(), Some(image::ImageFormat::Png));
        let mut image = reader.decode().map_err(read)?.into_rgb32f();
        if encoded {
            // PNG holds sRGB; white is taken for a bright sky's 10 kcd/m^2.
            for value in image.as_flat_samples_mut().samples.iter_mut() {
                *value = 10.0 * linear(*value);
            }
        }
        let (width, height) = image.dimensions();
        let layout = match () {
            () if width == 6 * height => Layout::Strip,
            () if 4 * width == 3 * height => Layout::Cross,
            () if width == 2 * height => Layout::Panorama,
            () => return Err(SkyError::Shape { file: file.to_owned(), width, height }),
        };
        Ok(Self { image, layout })
    }

    fn bake(&self) -> Vec<Vec3> {
        match self.layout {
            Layout::Panorama => bake(|direction| self.panorama(direction)),
            Layout::Strip | Layout::Cross => (0..6 * FACE * FACE)
                .into_par_iter()
                .map(|i| self.face(i / (FACE * FACE), i % FACE, i / FACE % FACE))
                .collect(),
        }
    }

    /// The middle column looks along -Z, the top row is the zenith.
    fn panorama(&self, d: Vec3) -> Vec3 {
        let (width, height) = self.size();
        let u = 0.5 + d.x.atan2(-d.z) / std::f32::consts::TAU;
        let v = d.y.clamp(-1.0, 1.0).acos() / std::f32::consts::PI;
        self.sample(u * width - 0.5, v * height - 0.5)
    }

    /// Faces of a vertical cross: +Y on top; -X, +Z, +X beside each other; -Y; and -Z at the bottom, upside down.
    fn face(&self, face: usize, x: usize, y: usize) -> Vec3 {
        #[expect(clippy::cast_precision_loss, reason = "texel counts")]
        let [s, t] = [x, y].map(|i| (i as f32 + 0.5) / FACE as f32);
        let (width, height) = self.size();
        let (column, row, side, s, t) = match self.layout {
            #[expect(clippy::cast_precision_loss, reason = "0..6")]
            Layout::Strip => (face as f32, 0.0, height, s, t),
            _ => {
                let side = width / 3.0;
                match face {
                    0 => (2.0, 1.0, side, s, t),
                    1 => (0.0, 1.0, side, s, t),
                    2 => (1.0, 0.0, side, s, t),
                    3 => (1.0, 2.0, side, s, t),
                    4 => (1.0, 1.0, side, s, t),
                    _ => (1.0, 3.0, side, 1.0 - s, 1.0 - t),
                }
            }
        };
        // Kept half a pixel inside the face, so that neighbours in the picture do not bleed in.
        let inside = |unit: f32| (unit * side - 0.5).clamp(0.0, side - 1.0);
        self.sample(column * side + inside(s), row * side + inside(t))
    }

    #[expect(clippy::cast_precision_loss, reason = "picture sizes")]
    fn size(&self) -> (f32, f32) {
        (self.image.width() as f32, self.image.height() as f32)
    }

    /// Bilinear; wraps across, clamps down.
    fn sample(&self, x: f32, y: f32) -> Vec3 {
        let (width, height) = self.image.dimensions();
        let (fx, fy) = (x - x.floor(), y - y.floor());
        #[expect(clippy::cast_possible_truncation, reason = "a pixel's index")]
        let (x, y) = (x.floor() as i64, y.floor() as i64);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "wrapped and clamped")]
        let at = |dx: i64, dy: i64| {
            let column = (x + dx).rem_euclid(i64::from(width)) as u32;
            let row = (y + dy).clamp(0, i64::from(height) - 1) as u32;
            let texel = Vec3::from_array(self.image.get_pixel(column, row).0);
            if texel.is_finite() { texel.max(Vec3::ZERO) } else { Vec3::ZERO }
        };
        at(0, 0).lerp(at(1, 0), fx).lerp(at(0, 1).lerp(at(1, 1), fx), fy)
    }
}

/// The sRGB transfer function's inverse.
fn linear(encoded: f32) -> f32 {
    if encoded <= 0.040_45 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}
