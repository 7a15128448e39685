//! Scene files: TOML in, a checked [`Scene`] out.
use crate::{lod::LodSettings, sea::SeaSettings};
use std::path::PathBuf;

/// A whole scene, every value checked, in SI units and radians.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The sea's own physics.
    pub sea: SeaSettings,
    /// How finely it is drawn.
    pub lod: LodSettings,
    /// What it reflects.
    pub sky: SkySettings,
    /// How it looks.
    pub water: WaterSettings,
    /// From where it is seen.
    pub camera: CameraSettings,
}

/// Where the light of the sky comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum SkySource {
    /// Preetham, Shirley and Smits 1999, with this turbidity (1.7 very clear ..= 10 hazy).
    Daylight {
        /// Ratio of the optical thickness of haze and air to that of air alone.
        turbidity: f64,
    },
    /// Six square faces in one image file: a vertical cross, a 6x1 strip (+X -X +Y -Y +Z -Z), or an equirectangular panorama.
    Cubemap {
        /// PNG, HDR or EXR; relative paths are relative to the scene file.
        file: PathBuf,
    },
}

/// Sky, sun and air.
#[derive(Clone, Debug, PartialEq)]
pub struct SkySettings {
    /// Daylight or a file.
    pub source: SkySource,
    /// Direction to the sun, radians from +X counter-clockwise seen from above.
    pub sun_azimuth: f64,
    /// Height of the sun above the horizon, radians.
    pub sun_elevation: f64,
    /// Factor on the sun's light.
    pub sun_intensity: f64,
    /// Factor on all light before the tone map, in stops (powers of two).
    pub exposure: f64,
    /// Distance at which haze leaves 2 % of the contrast (Koschmieder's visibility), metres.
    pub visibility: f64,
}

/// Colours and strengths of the water. Colours are linear Rec. 709.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaterSettings {
    /// Diffuse reflectance of deep water seen from straight above.
    pub deep_color: [f32; 3],
    /// Colour of light that came through a crest.
    pub scatter_color: [f32; 3],
    /// Strength of that light.
    pub scatter: f64,
    /// Albedo of foam.
    pub foam_color: [f32; 3],
    /// Factor on the slopes used for shading, 1 is physical.
    pub detail: f64,
}

/// A pinhole camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraSettings {
    /// Position, world metres.
    pub eye: [f64; 3],
    /// Point looked at, world metres.
    pub look: [f64; 3],
    /// Vertical field of view, radians.
    pub fov_y: f64,
    /// Distance between the eyes, metres (`--stereo`).
    pub eye_separation: f64,
}
