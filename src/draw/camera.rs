//! Eyes: where a view is seen from and what its pixels cover.

use crate::lod::Frustum;
use crate::scene::CameraSettings;
use glam::{DVec3, Mat3, Mat4, Vec3, Vec4};

/// Nothing nearer than this is drawn, metres.
pub const NEAR: f32 = 0.1;

/// Tangents of the angles from the axis to the four sides of a view; left and down are negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fov {
    /// To the left.
    pub left: f32,
    /// To the right.
    pub right: f32,
    /// Upwards.
    pub up: f32,
    /// Downwards.
    pub down: f32,
}

impl Fov {
    /// The same to both sides: `fov_y` radians from bottom to top, `aspect` times that (in tangents) across.
    pub fn symmetric(fov_y: f32, aspect: f32) -> Self {
        let up = (0.5 * fov_y).tan();
        Self { left: -up * aspect, right: up * aspect, up, down: -up }
    }

    /// Reverse-Z projection with an infinite far plane into Vulkan's clip space (y down, depth 1 at [`NEAR`], 0 at infinity).
    pub fn projection(self) -> Mat4 {
        let (width, height) = (self.right - self.left, self.up - self.down);
        Mat4::from_cols(
            Vec4::new(2.0 / width, 0.0, 0.0, 0.0),
            Vec4::new(0.0, -2.0 / height, 0.0, 0.0),
            Vec4::new((self.right + self.left) / width, -(self.up + self.down) / height, 0.0, -1.0),
            Vec4::new(0.0, 0.0, NEAR, 0.0),
        )
    }

    /// From tangents of angles to the right and up to clip space at any distance: factors in xy, summands in zw.
    pub fn scale(self) -> Vec4 {
        let (width, height) = (self.right - self.left, self.up - self.down);
        let middle = [-(self.right + self.left) / width, (self.up + self.down) / height];
        Vec4::new(2.0 / width, -2.0 / height, middle[0], middle[1])
    }
}

/// One view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    /// World metres.
    pub position: DVec3,
    /// Columns: the eye's right, up and backwards in the world.
    pub axes: Mat3,
    /// What it covers.
    pub fov: Fov,
}

impl Eye {
    /// From positions relative to `origin` to clip space.
    pub fn view_projection(&self, origin: DVec3) -> Mat4 {
        let offset = (origin - self.position).as_vec3();
        self.fov.projection() * Mat4::from_mat3(self.axes.transpose()) * Mat4::from_translation(offset)
    }

    /// From clip space (x, y, 0, 1) to directions in the world.
    pub fn clip_to_ray(&self) -> Mat4 {
        (self.fov.projection() * Mat4::from_mat3(self.axes.transpose())).inverse()
    }

    /// What the eye sees, relative to `head`.
    pub fn frustum(&self, head: DVec3) -> Frustum {
        Frustum::from_view_projection(self.view_projection(head))
    }
}

/// A scene's camera as one eye, or as a left and a right one.
pub fn eyes(camera: &CameraSettings, aspect: f32, stereo: bool) -> Vec<Eye> {
    let (position, look) = (DVec3::from(camera.eye), DVec3::from(camera.look));
    let back = (position - look).normalize_or(DVec3::Z).as_vec3();
    // Looking straight up or down leaves "right" open: it is then +X.
    let right = Vec3::Y.cross(back).try_normalize().unwrap_or(Vec3::X);
    let axes = Mat3::from_cols(right, back.cross(right), back);
    #[expect(clippy::cast_possible_truncation, reason = "an angle")]
    let fov = Fov::symmetric(camera.fov_y as f32, aspect);
    let eye = |shift: f64| Eye { position: position + right.as_dvec3() * shift, axes, fov };
    let half = 0.5 * camera.eye_separation;
    if stereo { vec![eye(-half), eye(half)] } else { vec![eye(0.0)] }
}

/// The point between the eyes.
pub fn head(eyes: &[Eye]) -> DVec3 {
    let sum: DVec3 = eyes.iter().map(|eye| eye.position).sum();
    #[expect(clippy::cast_precision_loss, reason = "one or two eyes")]
    let count = eyes.len().max(1) as f64;
    sum / count
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec2, Vec4Swizzles};

    fn camera() -> CameraSettings {
        CameraSettings { eye: [3.0, 2.0, 5.0], look: [3.0, 2.0, -10.0], fov_y: 1.0, eye_separation: 0.064 }
    }

    #[test]
    fn depth_is_one_at_the_near_plane_and_falls_to_zero() {
        let eye = eyes(&camera(), 1.5, false)[0];
        let clip = |z: f32| eye.view_projection(eye.position) * Vec4::new(0.0, 0.0, z, 1.0);
        let depth = |z: f32| clip(z).z / clip(z).w;
        assert!((depth(-NEAR) - 1.0).abs() < 1e-6);
        assert!(depth(-100.0) > depth(-1000.0) && depth(-1000.0) > 0.0);
        assert_eq!(clip(-1.0).w, 1.0);
    }

    #[test]
    fn up_is_up_in_vulkan() {
        let eye = eyes(&camera(), 1.5, false)[0];
        let clip = eye.view_projection(eye.position) * Vec4::new(1.0, 1.0, -10.0, 1.0);
        assert!(clip.x > 0.0 && clip.y < 0.0, "{clip}");
    }

    #[test]
    fn rays_lead_back_to_clip_space_for_skewed_views() {
        let fov = Fov { left: -1.2, right: 0.8, up: 0.7, down: -1.1 };
        let eye = Eye { fov, ..eyes(&camera(), 1.5, false)[0] };
        for (x, y) in [(-1.0, -1.0), (0.3, -0.6), (1.0, 0.9)] {
            let ray = eye.clip_to_ray() * Vec4::new(x, y, 0.0, 1.0);
            let clip = eye.view_projection(eye.position) * ray.truncate().extend(0.0);
            assert!((clip.x / clip.w - x).abs() < 1e-5 && (clip.y / clip.w - y).abs() < 1e-5);
            assert!(clip.w > 0.0);
        }
    }

    #[test]
    fn tangents_land_where_points_do() {
        let fov = Fov { left: -1.2, right: 0.8, up: 0.7, down: -1.1 };
        let eye = Eye { axes: Mat3::IDENTITY, fov, ..eyes(&camera(), 1.5, false)[0] };
        let scale = fov.scale();
        for (x, y) in [(-1.2, 0.7), (0.8, -1.1), (0.1, 0.2)] {
            let clip = eye.view_projection(eye.position) * Vec4::new(3.0 * x, 3.0 * y, -3.0, 1.0);
            let place = Vec2::new(x, y) * scale.xy() + scale.zw();
            assert!((clip.xy() / clip.w - place).length() < 1e-6, "{clip} {place}");
        }
    }

    #[test]
    fn two_eyes_stand_beside_the_head() {
        let both = eyes(&camera(), 1.5, true);
        assert!((both[1].position - both[0].position - DVec3::X * 0.064).length() < 1e-12);
        assert_eq!(head(&both), DVec3::new(3.0, 2.0, 5.0));
    }
}
