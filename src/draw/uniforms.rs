//! The uniform block: the Rust twin of `shaders/frame.wgsl`.

use super::camera::{self, Eye};
use super::moment::Moment;
use super::shaders::FRAME_SIZE;
use super::sky_map::{self, SkyMap};
use super::vignette;
use crate::scene::Scene;
use crate::sea::{SeaSettings, settings::MAX_CASCADES};
use bytemuck::{Pod, Zeroable};
use glam::{DVec2, DVec3, Mat4, Vec3, Vec4};
use std::f32::consts::PI;

/// How one cascade's maps are addressed.
#[repr(C)]
#[derive(Clone, Copy, Default, Pod, Zeroable)]
pub struct Cascade {
    offset: [f32; 2],
    axes: [f32; 2],
    axes_per_length: [f32; 2],
    log_reach: f32,
    unused: f32,
    twice_axes: [f32; 2],
    middle: [f32; 2],
}

/// What one view sees.
#[repr(C)]
#[derive(Clone, Copy, Default, Pod, Zeroable)]
pub struct View {
    projection: Mat4,
    eye: Vec4,
    scale: Vec4,
    unused: [Vec4; 2],
}

/// Where positions lie on the sun's map, and how far shadows reach.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct SunMap {
    pub along: [f32; 4],
    pub across: [f32; 4],
    pub reach: [f32; 4],
    pub texels: [f32; 4],
}

/// Everything shaders see but textures. Fields as in the WGSL, where each is explained.
#[repr(C)]
#[derive(Clone, Copy, Default, Pod, Zeroable)]
pub struct Frame {
    views: [View; 2],
    previous_view_projection: [Mat4; 2],
    clip_to_ray: [Mat4; 2],
    head: Vec4,
    cascades: [Cascade; MAX_CASCADES],
    sun: Vec4,
    sun_light: Vec4,
    sky_light: Vec4,
    deep: Vec4,
    scatter: Vec4,
    foam: Vec4,
    foam_range: Vec4,
    lod: Vec4,
    air: Vec4,
    tone: Vec4,
    vignette: Vec4,
    sun_map: SunMap,
}

const _: () = assert!(size_of::<Frame>() == FRAME_SIZE, "Frame and shaders/frame.wgsl differ");

/// Radius of the sun's disc, radians.
const SUN_RADIUS: f32 = 0.004_65;
/// With 0 stops of exposure a white wall in full sun (about 35 kcd/m^2) is a bright white, and a clear sky keeps its blue.
const EXPOSURE: f64 = 0.03;
/// Metres, at most, across which the foam's pattern repeats.
pub(super) const FOAM_REPEAT: f64 = 11.0;
/// Narkowicz's constants, divided out: the linear term above the line, then the square's and the linear one's below.
const TONE: Vec4 = Vec4::new(0.03 - 2.51 * 0.59 / 2.43, 2.43, 0.59, 0.0);
/// Share of the quadtree's half side, from 0.7 to 0.98 of it, over which waves fade: see `lod::border_fade`.
const BORDER: f64 = 0.28;
/// Koschmieder's 2 % of contrast: -ln 0.02.
const VISIBILITY: f64 = 3.912;

/// What the vertex spacing needs: bounds in metres and the growth with distance.
#[derive(Clone, Copy, Debug)]
pub struct Spacing {
    /// Metres of spacing for each metre of distance.
    pub per_metre: f64,
    /// Of the finest patches.
    pub finest: f64,
    /// Of the coarsest.
    pub coarsest: f64,
}

/// What turning a frame needs of the scene.
#[derive(Clone, Copy, Debug)]
pub struct Constant {
    /// The vertex spacing's growth with distance, [`Spacing::per_metre`].
    pub growth: f64,
    /// Factor on the level part of normals.
    pub detail: f64,
}

/// By how much the squared roughness summed over cascades is more than the water's own: every cascade's map holds it, and the
/// surface has it once.
pub(super) fn repeated_roughness(sea: &SeaSettings) -> f64 {
    let own = sea.cascades.iter().map(|cascade| cascade.roughness.powi(2));
    own.clone().sum::<f64>() - own.fold(0.0, f64::max)
}

impl Frame {
    /// All that stays as it is from frame to frame.
    #[expect(clippy::cast_possible_truncation, reason = "scene values, far inside f32")]
    pub fn still(scene: &Scene, sky: &SkyMap, rms_height: f64, spacing: Spacing) -> Self {
        let (water, foam) = (&scene.water, &scene.sea.foam);
        let (height, width) = (rms_height.max(0.01), foam.width.max(1e-3));
        let exposure = (EXPOSURE * scene.sky.exposure.exp2()) as f32;
        let repeated = repeated_roughness(&scene.sea);
        // The disc's radiance is far beyond white: limited, so that resolving samples leaves its edge round.
        let disc = (1.0 / (PI * SUN_RADIUS * SUN_RADIUS)).min(60.0);
        let texels_per_radian = sky_map::FACE as f32 / std::f32::consts::FRAC_PI_2;
        let mut still = Self {
            sun: sky.sun.extend(SUN_RADIUS.cos()),
            sun_light: sky.sun_light.extend(disc),
            sky_light: sky.sky_light.extend(repeated as f32),
            deep: (Vec3::from(water.deep_color) / PI).extend(0.0),
            scatter: (Vec3::from(water.scatter_color) * (water.scatter / height) as f32).extend(0.0),
            foam: (Vec3::from(water.foam_color) / PI).extend(0.0),
            foam_range: Vec4::new(
                (foam.threshold / width) as f32,
                (1.0 / width) as f32,
                (scene.sea.cascades.first().map_or(1.0, |cascade| cascade.patch_size) / FOAM_REPEAT).ceil()
                    as f32,
                (0.25 / height) as f32,
            ),
            air: Vec4::new(
                (VISIBILITY * std::f64::consts::LOG2_E / scene.sky.visibility) as f32,
                0.0,
                // A lobe of roughness alpha spreads over sqrt(2) alpha radians: the mip whose texels are that wide.
                (std::f32::consts::SQRT_2 * texels_per_radian).log2(),
                0.0,
            ),
            tone: TONE * Vec4::new(exposure, exposure * exposure, exposure, 0.0),
            ..Self::default()
        };
        still.set_lod(scene, spacing);
        still
    }

    /// Tells of vertices that are so far apart.
    #[expect(clippy::cast_possible_truncation, reason = "scene values, far inside f32")]
    pub fn set_lod(&mut self, scene: &Scene, spacing: Spacing) {
        self.lod = Vec4::new(
            (1.0 / (BORDER * 0.5 * scene.lod.size)) as f32,
            scene.lod.size as f32,
            (spacing.finest / spacing.per_metre).powi(2) as f32,
            (spacing.coarsest / spacing.per_metre).powi(2) as f32,
        );
    }

    /// Tells of the sun's map.
    pub const fn cast(&mut self, map: SunMap) {
        self.sun_map = map;
    }

    /// Tells where `eyes` were in the frame before.
    pub fn look_back(&mut self, eyes: &[Eye], origin: DVec3) {
        for (matrix, eye) in self.previous_view_projection.iter_mut().zip(eyes) {
            *matrix = eye.view_projection(origin);
        }
    }

    /// Turns the frame to `moment`: the eyes, and the maps' place relative to `origin` (world metres).
    #[expect(clippy::cast_possible_truncation, reason = "reduced in f64 first")]
    pub fn turn(&mut self, moment: Moment<'_>, origin: DVec3, constant: Constant) {
        let Moment { eyes, maps, vignette, .. } = moment;
        for (i, eye) in eyes.iter().take(2).enumerate() {
            self.views[i] = View {
                projection: eye.view_projection(origin),
                eye: (eye.position - origin).as_vec3().extend(1.0),
                scale: eye.fov.scale(),
                ..View::default()
            };
            self.clip_to_ray[i] = eye.clip_to_ray();
        }
        self.head = (camera::head(eyes) - origin).as_vec3().extend(1.0);
        self.vignette = vignette::angles(eyes, vignette);
        for (slot, maps) in self.cascades.iter_mut().zip(&maps.cascades) {
            let (sin, cos) = maps.rotation.sin_cos();
            let detail = constant.detail;
            let along = DVec2::new(origin.x * cos - origin.z * sin, origin.x * sin + origin.z * cos);
            let unit = along / maps.patch_size;
            let offset = unit - unit.floor() + 0.5 / maps.resolution as f64;
            *slot = Cascade {
                offset: offset.as_vec2().into(),
                axes: [cos as f32, sin as f32],
                axes_per_length: [(cos / maps.patch_size) as f32, (sin / maps.patch_size) as f32],
                log_reach: (maps.patch_size / maps.resolution as f64 / constant.growth).log2() as f32,
                unused: 0.0,
                twice_axes: [(2.0 * detail * cos) as f32, (2.0 * detail * sin) as f32],
                middle: [(-detail * (cos + sin)) as f32, (detail * (sin - cos)) as f32],
            };
        }
    }
}
