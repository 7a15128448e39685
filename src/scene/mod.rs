//! Scene files: TOML in, a checked [`Scene`] out.
//!
//! `schema` holds every key with its unit, range and default; `reader` checks a file against it and finds the place of
//! whatever is wrong; `assemble` checks what keys say together. `docs/scene.md` is [`reference`]'s text. `document` is a file being
//! changed by a panel, which is made from [`parts`], and `history` what it was before.
use crate::{
    lod::LodSettings,
    raft::{BuoySettings, RaftSettings},
    sea::SeaSettings,
};
use glam::DVec2;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

mod address;
mod assemble;
mod document;
mod draft;
mod error;
mod field;
mod headset;
mod history;
mod key;
mod models;
mod reader;
mod reference;
mod schema;
mod section;
mod shadows;
mod tessellation;

pub use address::Address;
pub use document::Document;
pub use error::{Place, SceneError};
pub use field::{Alternative, Field, FieldKind, Part, Value, parts};
pub use headset::{WAVE_LIMITS, WaveLimit};
pub use history::History;
pub use reference::reference;
pub use shadows::{ShadowSettings, Shadows};

/// Most bytes of a scene file.
pub const MAX_BYTES: u64 = 1 << 20;

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
    /// What a rider in a headset stands on, and how they move.
    pub raft: RaftSettings,
    /// Floating markers, at most [`crate::raft::MAX_BUOYS`].
    pub buoys: Vec<BuoySettings>,
    /// What is allowed and hardly meant, a line each with file, line and column.
    pub warnings: Vec<String>,
}

impl Scene {
    /// The text of the scene that is drawn when none is named: `scenes/open_ocean.toml`, built in.
    pub const FLAGSHIP: &str = include_str!("../../scenes/open_ocean.toml");

    /// Reads and checks the scene file at `path`.
    ///
    /// # Errors
    /// A file that cannot be read, is larger than [`MAX_BYTES`], is not UTF-8 or not TOML, or says something that is not
    /// allowed. The error names the file and, where there is one, line, column, key, value and range.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, SceneError> {
        let path = path.as_ref();
        let failed = |source| SceneError::Read { path: path.to_owned(), source };
        let file = File::open(path).map_err(failed)?;
        let mut bytes = Vec::new();
        file.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(failed)?;
        if bytes.len() as u64 > MAX_BYTES {
            return Err(SceneError::TooLarge { path: path.to_owned(), limit: MAX_BYTES });
        }
        Self::parse_bytes(&bytes, &path.to_string_lossy())
    }

    /// Checks a scene given as bytes; see [`Scene::parse`].
    ///
    /// # Errors
    /// As [`Scene::load`], except those of reading.
    pub fn parse_bytes(bytes: &[u8], origin: &str) -> Result<Self, SceneError> {
        let text = str::from_utf8(bytes).map_err(|error| {
            let (valid, rest) = bytes.split_at(error.valid_up_to());
            let place = Place::of(origin, &String::from_utf8_lossy(valid), valid.len());
            SceneError::NotText { place, byte: rest.first().copied().unwrap_or_default() }
        })?;
        Self::parse(text, origin)
    }

    /// Checks a scene given as text. `origin` names it in errors; relative paths in it start from `origin`'s folder.
    ///
    /// # Errors
    /// As [`Scene::load`], except those of reading.
    pub fn parse(text: &str, origin: &str) -> Result<Self, SceneError> {
        assemble::assemble(text, origin)
    }

    /// [`Scene::FLAGSHIP`], read.
    ///
    /// # Errors
    /// None as shipped; a test reads it.
    pub fn flagship() -> Result<Self, SceneError> {
        Self::parse(Self::FLAGSHIP, "scenes/open_ocean.toml")
    }
}

/// Where the light of the sky comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum SkySource {
    /// Preetham, Shirley and Smits 1999, with this turbidity (1.7 very clear ..= 10 hazy).
    Daylight {
        /// Ratio of the optical thickness of haze and air to that of air alone.
        turbidity: f64,
        /// Share of the sky that clouds cover, 0..=1.
        clouds: f64,
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
    /// Shadows that the sun casts.
    pub shadows: ShadowSettings,
    /// How light becomes a colour.
    pub shading: Shading,
    /// With [`Shading::BlinnPhong`].
    pub phong: PhongSettings,
}

/// How light becomes a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shading {
    /// Facets of a rough surface mirror sky and sun, and let light out from below.
    Physical,
    /// A deep colour, a mirror after Schlick, and a highlight after Blinn and Phong.
    BlinnPhong,
}

/// What is mirrored where the sun is not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mirrored {
    /// The sky, in every direction its own light.
    Cubemap,
    /// One colour.
    Ambient,
}

/// Numbers of [`Shading::BlinnPhong`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhongSettings {
    /// Exponent of the highlight.
    pub shininess: f64,
    /// Its strength: 1 is as bright as a white wall in the sun.
    pub highlight: f64,
    /// What is mirrored.
    pub mirrored: Mirrored,
    /// Colour that is mirrored, linear Rec. 709, over that of a white wall under the sky.
    pub ambient_color: [f32; 3],
    /// Size of the mirrored sun with its halo: 1 less the cosine of its radius.
    pub sun_size: f64,
    /// Exponent by which it falls off towards its rim.
    pub sun_falloff: f64,
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

impl CameraSettings {
    /// World (x, z) under the camera, metres: where a rider's raft begins.
    pub fn ground(&self) -> DVec2 {
        DVec2::new(self.eye[0], self.eye[2])
    }

    /// Direction looked in as seen from above, radians about +Y: 0 along -Z, pi/2 along -X. Straight up or down it is 0, as
    /// the camera's right is +X then.
    pub fn heading(&self) -> f64 {
        let [x, z] = [self.look[0] - self.eye[0], self.look[2] - self.eye[2]];
        if x == 0.0 && z == 0.0 { 0.0 } else { libm::atan2(-x, -z) }
    }
}
