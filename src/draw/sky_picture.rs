//! A sky from a file: six faces of a cube, or a panorama.

use glam::Vec3;
use std::path::{Path, PathBuf};

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

/// How the faces lie in a picture.
enum Layout {
    Strip,
    Cross,
    Panorama,
}

/// A picture of the whole sky.
pub(super) struct Picture {
    image: image::Rgb32FImage,
    layout: Layout,
}

impl Picture {
    /// Reads a PNG, HDR or EXR file of a known shape.
    ///
    /// # Errors
    /// The file cannot be read, or has another shape.
    pub fn open(file: &Path) -> Result<Self, SkyError> {
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

    /// Light from the unit vector `direction`.
    pub fn radiance(&self, direction: Vec3) -> Vec3 {
        match self.layout {
            Layout::Panorama => self.panorama(direction),
            Layout::Strip | Layout::Cross => self.faces(direction),
        }
    }

    /// The middle column looks along -Z, the top row is the zenith.
    fn panorama(&self, d: Vec3) -> Vec3 {
        let (width, height) = self.size();
        let u = 0.5 + d.x.atan2(-d.z) / std::f32::consts::TAU;
        let v = d.y.clamp(-1.0, 1.0).acos() / std::f32::consts::PI;
        self.sample(u * width - 0.5, v * height - 0.5)
    }

    /// Each face is what a viewer at the middle sees, upright; up and down are seen by tilting the head from -Z. So a
    /// vertical cross has -X, -Z and +X beside each other, +Y above, -Y below, and +Z upside down under that.
    fn faces(&self, d: Vec3) -> Vec3 {
        let size = d.abs();
        let (face, right, up): (u8, Vec3, Vec3) = if size.x >= size.y && size.x >= size.z {
            (if d.x > 0.0 { 0 } else { 1 }, Vec3::Z * d.x.signum(), Vec3::Y)
        } else if size.y >= size.z {
            (if d.y > 0.0 { 2 } else { 3 }, Vec3::X, Vec3::Z * d.y.signum())
        } else {
            (if d.z > 0.0 { 4 } else { 5 }, Vec3::NEG_X * d.z.signum(), Vec3::Y)
        };
        let scale = 0.5 / size.max_element();
        let (s, t) = (0.5 + scale * d.dot(right), 0.5 - scale * d.dot(up));
        let (width, height) = self.size();
        let (column, row, side, s, t) = match (&self.layout, face) {
            (Layout::Strip, _) => (f32::from(face), 0.0, height, s, t),
            (_, 0) => (2.0, 1.0, width / 3.0, s, t),
            (_, 1) => (0.0, 1.0, width / 3.0, s, t),
            (_, 2) => (1.0, 0.0, width / 3.0, s, t),
            (_, 3) => (1.0, 2.0, width / 3.0, s, t),
            (_, 4) => (1.0, 3.0, width / 3.0, 1.0 - s, 1.0 - t),
            _ => (1.0, 1.0, width / 3.0, s, t),
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

#[cfg(test)]
mod tests {
    use super::*;
    use image::{Rgb, Rgb32FImage};

    /// A strip whose faces are `face + 1` in red and get brighter to the right in green and upwards in blue.
    fn strip() -> Picture {
        let image = Rgb32FImage::from_fn(6 * 64, 64, |x, y| {
            Rgb([(x / 64 + 1) as f32, (x % 64) as f32 / 64.0, 1.0 - y as f32 / 64.0])
        });
        Picture { image, layout: Layout::Strip }
    }

    #[test]
    fn faces_are_seen_as_they_are_painted() {
        let picture = strip();
        let axes = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
        for (face, ahead) in (1..).zip(axes) {
            // Whoever looks up or down tilted the head from -Z.
            let up = if ahead.y == 0.0 { Vec3::Y } else { Vec3::Z * ahead.y };
            let right = ahead.cross(up);
            let middle = picture.faces(ahead);
            assert_eq!(middle.x, face as f32);
            assert!(picture.faces((ahead + 0.5 * right).normalize()).y > middle.y + 0.2, "face {face}");
            assert!(picture.faces((ahead + 0.5 * up).normalize()).z > middle.z + 0.2, "face {face}");
        }
    }

    #[test]
    fn a_panorama_looks_along_minus_z_in_its_middle() {
        let image = Rgb32FImage::from_fn(256, 128, |x, y| Rgb([x as f32, y as f32, 0.0]));
        let picture = Picture { image, layout: Layout::Panorama };
        let ahead = picture.panorama(Vec3::NEG_Z);
        assert!((ahead.x - 127.5).abs() < 1.0 && (ahead.y - 63.5).abs() < 1.0, "{ahead}");
        assert!(picture.panorama(Vec3::X).x > ahead.x + 60.0, "+X is to the right of -Z");
    }
}
