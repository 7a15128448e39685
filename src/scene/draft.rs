//! Sections of a scene while they are being read: the settings they end as, and the few keys that need each other.
use super::{CameraSettings, Mirrored, PhongSettings, Shading, ShadowSettings, WaterSettings};
use crate::lod::{LodSettings, Quality, SignalSettings, Tessellation};
use crate::raft::{BuoySettings, Horizon, RaftSettings};
use crate::sea::waves::{FbmFoam, FbmSettings, Kernel, Lean};
use crate::sea::{CascadeSettings, FoamSettings, NormalKind, SeaSettings, Spectrum};

/// Which model was asked for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum SeaModel {
    Fft,
    Waves,
    Fbm,
}

/// What to do where waves would loop.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Loops {
    Allow,
    Limit,
    Refuse,
}

/// What `[sea]` says with every model.
pub(super) struct SeaDraft {
    pub model: SeaModel,
    pub gravity: f64,
    pub loops: Loops,
    pub loop_period: Option<f64>,
}

/// What `[sea]` says of water without a spectrum.
pub(super) struct StillWater {
    pub roughness: f64,
}

/// `[[layer]]`.
pub(super) struct LayerDraft {
    pub model: SeaModel,
}

/// Which kind of wave was asked for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    Sine,
    Peaked,
    Gerstner,
    Circular,
}

/// `[[sea.wave]]`.
#[derive(Clone, Copy)]
pub(super) struct WaveDraft {
    pub shape: Shape,
    pub wavelength: f64,
    pub amplitude: Option<f64>,
    /// Radians.
    pub direction: Option<f64>,
    pub speed: Option<f64>,
    pub phase: f64,
    pub sharpness: Option<f64>,
    pub steepness: Option<f64>,
    pub q: Option<f64>,
    pub centre: Option<[f64; 2]>,
}

/// A cascade, `[[sea.cascade]]`; also the keys of `[sea]` that every cascade starts from.
#[derive(Clone)]
pub(super) struct CascadeDraft {
    pub settings: CascadeSettings,
    pub band: Option<[f64; 2]>,
}

/// `[lod]`.
pub(super) struct LodDraft {
    pub settings: LodSettings,
    pub reach: Option<f64>,
    /// Density by the wave signal.
    pub by_signal: bool,
    pub signal: SignalDraft,
}

/// `[lod.signal]`; the sea says the frequency.
pub(super) struct SignalDraft {
    pub threshold: f64,
    pub density: f64,
    pub settings: SignalSettings,
}

/// Which kind of sky was asked for.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum SkyModel {
    Daylight,
    Cubemap,
}

/// `[sky]`.
pub(super) struct SkyDraft {
    pub model: SkyModel,
    pub turbidity: f64,
    pub clouds: f64,
    pub file: Option<String>,
    pub sun_azimuth: f64,
    pub sun_elevation: f64,
    pub sun_intensity: f64,
    pub exposure: f64,
    pub visibility: f64,
}

/// The value of a section before its keys' defaults are written into it. The schema has a default for each key that is
/// not optional, so nothing of this remains.
pub(super) trait Blank {
    const BLANK: Self;
}

impl Blank for CascadeDraft {
    const BLANK: Self = Self {
        settings: CascadeSettings {
            resolution: 0,
            patch_size: 0.0,
            rotation: 0.0,
            band: [0.0, f64::INFINITY],
            reference_resolution: 0,
            spectrum: Spectrum::Phillips,
            wind_speed: 0.0,
            wind_direction: 0.0,
            alignment: 0.0,
            choppiness: 0.0,
            small_wave_suppression: 0.0,
            roughness: 0.0,
            breaking: 0.0,
            amplitude: 0.0,
            fetch: 0.0,
            peak_enhancement: 0.0,
            depth: 0.0,
            seed: 0,
        },
        band: None,
    };
}

impl Blank for FoamSettings {
    const BLANK: Self = Self { threshold: 0.0, width: 0.0, fade_time: 0.0 };
}

impl Blank for SeaSettings {
    const BLANK: Self = Self {
        cascades: Vec::new(),
        spectral: true,
        models: Vec::new(),
        gravity: 0.0,
        repeat_period: 0.0,
        foam: FoamSettings::BLANK,
        normals: NormalKind::Exact,
    };
}

impl Blank for SeaDraft {
    const BLANK: Self = Self { model: SeaModel::Fft, gravity: 0.0, loops: Loops::Allow, loop_period: None };
}

impl Blank for StillWater {
    const BLANK: Self = Self { roughness: 0.0 };
}

impl Blank for LayerDraft {
    const BLANK: Self = Self { model: SeaModel::Waves };
}

impl Blank for WaveDraft {
    const BLANK: Self = Self {
        shape: Shape::Sine,
        wavelength: 0.0,
        amplitude: None,
        direction: None,
        speed: None,
        phase: 0.0,
        sharpness: None,
        steepness: None,
        q: None,
        centre: None,
    };
}

impl Blank for FbmSettings {
    const BLANK: Self = Self {
        amplitude: 0.0,
        frequency: 0.0,
        speed: 0.0,
        amplitude_ramp: 0.0,
        frequency_ramp: 0.0,
        speed_ramp: 0.0,
        octaves: 0,
        kernel: Kernel::Sine,
        choppiness: 0.0,
        seed: 0,
        foam: FbmFoam::BLANK,
    };
}

impl Blank for FbmFoam {
    const BLANK: Self = Self {
        range: [0.0; 2],
        height_amount: 0.0,
        height_falloff: 0.0,
        angle_amount: 0.0,
        angle_falloff: 0.0,
        lean: Lean::Upright,
        reflection: [0.0; 2],
    };
}

impl Blank for LodDraft {
    const BLANK: Self = Self {
        settings: LodSettings {
            size: 0.0,
            quality: Quality::Medium,
            levels: None,
            max_height: None,
            reach: 0.0,
            skirt_extent: 0.0,
            tessellation: Tessellation::Grid,
        },
        reach: None,
        by_signal: false,
        signal: SignalDraft::BLANK,
    };
}

impl Blank for SignalDraft {
    const BLANK: Self = Self {
        threshold: 0.0,
        density: 0.0,
        settings: SignalSettings { frequency: 0.0, density: 0.0, fresnel: [0.0; 2], distance: [0.0; 2] },
    };
}

impl Blank for SkyDraft {
    const BLANK: Self = Self {
        model: SkyModel::Daylight,
        turbidity: 0.0,
        clouds: 0.0,
        file: None,
        sun_azimuth: 0.0,
        sun_elevation: 0.0,
        sun_intensity: 0.0,
        exposure: 0.0,
        visibility: 0.0,
    };
}

impl Blank for WaterSettings {
    const BLANK: Self = Self {
        deep_color: [0.0; 3],
        scatter_color: [0.0; 3],
        scatter: 0.0,
        foam_color: [0.0; 3],
        detail: 0.0,
        shadows: ShadowSettings::BLANK,
        shading: Shading::Physical,
        phong: PhongSettings {
            shininess: 0.0,
            highlight: 0.0,
            mirrored: Mirrored::Cubemap,
            ambient_color: [0.0; 3],
            sun_size: 0.0,
            sun_falloff: 0.0,
        },
    };
}

impl Blank for CameraSettings {
    const BLANK: Self = Self { eye: [0.0; 3], look: [0.0; 3], fov_y: 0.0, eye_separation: 0.0 };
}

impl Blank for RaftSettings {
    const BLANK: Self = Self {
        length: 0.0,
        width: 0.0,
        freeboard: 0.0,
        heave_frequency: 0.0,
        heave_damping: 0.0,
        tilt_frequency: 0.0,
        tilt_damping: 0.0,
        horizon: Horizon::Rides,
        held_heave: 0.0,
        glide_speed: 0.0,
        glide_acceleration: 0.0,
        dead_zone: 0.0,
        snap_turn: 0.0,
        smooth_turn: 0.0,
        vignette: 0.0,
    };
}

impl Blank for BuoySettings {
    const BLANK: Self = Self { at: [0.0; 2], radius: 0.0, color: [0.0; 3], height: 0.0 };
}
