//! Every key of a scene file. Reading, checking, defaults and `docs/scene.md` all come from these tables.
use super::CameraSettings;
use super::draft::{CascadeDraft, LodDraft, SkyDraft, SkyModel};
use super::key::{Absent, Key, Kind, angle, number, optional, position, power_of_two, word};
use crate::lod::Quality;
use crate::sea::{FoamSettings, NormalKind, SeaSettings, Spectrum};

mod lod_signal;
mod raft;
mod water;
mod wave_kinds;
mod waves;

pub(super) use lod_signal::LOD_SIGNAL;
pub(super) use raft::{BUOY, RAFT};
pub(super) use water::WATER;
pub(super) use wave_kinds::{GERSTNER_FORMS, KEYS_OF_KINDS, kinds_with};
pub(super) use waves::{ANY_SEA, FBM, FBM_FOAM, LAYER, STILL_WATER, WAVE};

/// Keys of `[sea]` with model "fft" that hold for the sea as a whole.
pub(super) static SEA: &[Key<SeaSettings>] = &[
    number(
        "repeat_period",
        "s",
        [10.0, 3600.0],
        200.0,
        |s, v| s.repeat_period = v,
        "The animation closes after this time.",
    ),
    word(
        "normals",
        "exact",
        &[("exact", |s| s.normals = NormalKind::Exact), ("sheet", |s| s.normals = NormalKind::Sheet)],
        "Normals of the displaced surface, or of the height sheet before it is displaced sideways.",
    ),
];

/// Keys of `[sea]` with model "fft" that `[[sea.cascade]]` may override.
pub(super) static SEA_AND_CASCADE: &[Key<CascadeDraft>] = &[
    power_of_two(
        "resolution",
        [16, 512],
        256,
        |c, v| c.settings.resolution = v as usize,
        "Grid points along each side of the patch.",
    ),
    number(
        "patch_size",
        "m",
        [1.0, 10_000.0],
        200.0,
        |c, v| c.settings.patch_size = v,
        "Side of the periodic patch.",
    ),
    word(
        "spectrum",
        "jonswap",
        &[
            ("phillips", |c| c.settings.spectrum = Spectrum::Phillips),
            ("jonswap", |c| c.settings.spectrum = Spectrum::Jonswap),
            ("tma", |c| c.settings.spectrum = Spectrum::Tma),
        ],
        "Shape of the spectrum: Phillips (uncalibrated, scaled by `amplitude`), a sea still growing, or one over a shallow bed.",
    ),
    number(
        "wind_speed",
        "m/s",
        [0.0, 60.0],
        10.0,
        |c, v| c.settings.wind_speed = v,
        "Wind 10 m above the sea; 0 is a flat sea.",
    ),
    angle(
        "wind_direction_deg",
        [-360.0, 360.0],
        0.0,
        |c, v| c.settings.wind_direction = v,
        "Direction the wind blows towards, from +X counter-clockwise seen from above: 90 is -Z.",
    ),
    number(
        "alignment",
        "",
        [0.0, 1.0],
        0.6,
        |c, v| c.settings.alignment = v,
        "How closely waves follow the wind: 0 all directions, 1 with the wind.",
    ),
    number(
        "choppiness",
        "",
        [0.0, 3.0],
        1.0,
        |c, v| c.settings.choppiness = v,
        "Factor on the horizontal displacement that sharpens crests; above about 1.2 crests fold over.",
    ),
    number(
        "small_wave_suppression",
        "",
        [0.0, 1.0],
        0.0,
        |c, v| c.settings.small_wave_suppression = v,
        "Damps short waves: 0 none, 1 all below a quarter of the patch.",
    ),
    number(
        "roughness",
        "",
        [0.0, 1.0],
        0.1,
        |c, v| c.settings.roughness = v,
        "Roughness of the water at scales below the map.",
    ),
    number(
        "breaking",
        "",
        [0.0, 1.0],
        1.0,
        |c, v| c.settings.breaking = v,
        "Share of the compression that counts for foam: below 1 for ripples, which are steep and do not break.",
    ),
    number(
        "amplitude",
        "",
        [0.0, 1000.0],
        1.0,
        |c, v| c.settings.amplitude = v,
        "Factor on every displacement.",
    ),
    number(
        "fetch",
        "m",
        [100.0, 5e6],
        1e5,
        |c, v| c.settings.fetch = v,
        "Distance over which the wind has blown (jonswap, tma).",
    ),
    number(
        "peak_enhancement",
        "",
        [1.0, 7.0],
        3.3,
        |c, v| c.settings.peak_enhancement = v,
        "Gamma of the JONSWAP peak: 1 is a fully grown sea (jonswap, tma).",
    ),
    number("depth", "m", [0.5, 12_000.0], 30.0, |c, v| c.settings.depth = v, "Depth of the water (tma)."),
    Key {
        name: "seed",
        unit: "",
        kind: Kind::Integer {
            range: [0, i64::MAX as u64],
            absent: Absent::Is(0),
            set: |c, v| c.settings.seed = v,
        },
        meaning: "Seed of the random numbers. A cascade without one takes the sea's plus its place in the file, from 0.",
    },
];

/// Keys only `[[sea.cascade]]` has.
pub(super) static CASCADE_ONLY: &[Key<CascadeDraft>] = &[
    angle(
        "rotation_deg",
        [-360.0, 360.0],
        0.0,
        |c, v| c.settings.rotation = v,
        "Angle of the cascade's axes, counter-clockwise seen from above; its waves still follow the wind.",
    ),
    Key {
        name: "band",
        unit: "rad/m",
        kind: Kind::Band {
            absent: "bands that meet at 6 waves of the next smaller patch, or at half the Nyquist wave number if that is less",
            set: |c, v| c.band = Some(v),
        },
        meaning: "Wave numbers carried, [low, high), high excluded. All cascades give one or none does; they must not overlap.",
    },
];

/// Keys of `[sea.foam]`.
pub(super) static FOAM: &[Key<FoamSettings>] = &[
    number(
        "threshold",
        "",
        [0.0, 4.0],
        0.27,
        |f, v| f.threshold = v,
        "Compression 1 - J, summed over cascades, at which foam begins.",
    ),
    number("width", "", [0.001, 4.0], 0.3, |f, v| f.width = v, "Further compression at which foam is whole."),
    number(
        "fade_time",
        "s",
        [0.0, 600.0],
        4.0,
        |f, v| f.fade_time = v,
        "Time in which a compression of 1 fades to nothing; 0 keeps no memory.",
    ),
];

/// Keys of `[lod]`.
pub(super) static LOD: &[Key<LodDraft>] = &[
    number(
        "size",
        "m",
        [256.0, 8192.0],
        4096.0,
        |l, v| l.settings.size = v,
        "Side of the square of sea that is drawn with waves around the viewer.",
    ),
    word(
        "quality",
        "medium",
        &[
            ("low", |l| l.settings.quality = Quality::Low),
            ("medium", |l| l.settings.quality = Quality::Medium),
            ("high", |l| l.settings.quality = Quality::High),
            ("ultra", |l| l.settings.quality = Quality::Ultra),
        ],
        "Density of the mesh and how far each level reaches.",
    ),
    Key {
        name: "levels",
        unit: "",
        kind: Kind::Integer {
            range: [0, 10],
            absent: Absent::Means("floor(log2(size / 64) + 0.5), 2 to 8"),
            set: |l, v| l.settings.levels = Some(v as u32),
        },
        meaning: "Levels below the root: the finest patch has the side size / 2^levels. Fewer than 2 need `tessellation = \"signal\"`.",
    },
    optional(
        "max_height",
        "m",
        [0.0, 500.0],
        "five standard deviations",
        |l, v| l.settings.max_height = Some(v),
        "Largest height above or below the sea at rest that culling allows for.",
    ),
    optional(
        "reach",
        "m",
        [0.0, 500.0],
        "five standard deviations",
        |l, v| l.reach = Some(v),
        "Largest horizontal displacement that culling allows for.",
    ),
    number(
        "skirt_extent",
        "",
        [1.0, 100.0],
        10.0,
        |l, v| l.settings.skirt_extent = v,
        "Distance to which the sea continues to the horizon, as a multiple of `size`.",
    ),
    word(
        "tessellation",
        "grid",
        &[("grid", |l| l.by_signal = false), ("signal", |l| l.by_signal = true)],
        "Cells of a patch: the quality's own number, or by `[lod.signal]` as many as the waves there need, up to that number.",
    ),
];

/// Keys of `[sky]`.
pub(super) static SKY: &[Key<SkyDraft>] = &[
    word(
        "model",
        "daylight",
        &[("daylight", |s| s.model = SkyModel::Daylight), ("cubemap", |s| s.model = SkyModel::Cubemap)],
        "Analytic daylight (Preetham, Shirley and Smits 1999), or an image.",
    ),
    number(
        "turbidity",
        "",
        [1.7, 10.0],
        3.0,
        |s, v| s.turbidity = v,
        "Haze of the daylight: 1.7 very clear, 10 hazy.",
    ),
    number(
        "clouds",
        "",
        [0.0, 1.0],
        0.0,
        |s, v| s.clouds = v,
        "Share of the daylight's sky that clouds cover.",
    ),
    Key {
        name: "file",
        unit: "",
        kind: Kind::Path { absent: "none", set: |s, v| s.file = Some(v.to_owned()) },
        meaning: "Image of the cubemap: PNG, HDR or EXR; a vertical cross, a strip of six faces or an equirectangular panorama. Relative to the scene file.",
    },
    angle(
        "sun_azimuth_deg",
        [-360.0, 360.0],
        90.0,
        |s, v| s.sun_azimuth = v,
        "Direction to the sun, from +X counter-clockwise seen from above.",
    ),
    angle(
        "sun_elevation_deg",
        [-5.0, 90.0],
        30.0,
        |s, v| s.sun_elevation = v,
        "Height of the sun above the horizon.",
    ),
    number("sun_intensity", "", [0.0, 100.0], 1.0, |s, v| s.sun_intensity = v, "Factor on the sun's light."),
    number(
        "exposure",
        "stops",
        [-20.0, 20.0],
        0.0,
        |s, v| s.exposure = v,
        "Brightness of the picture in powers of two.",
    ),
    number(
        "visibility",
        "m",
        [100.0, 1e6],
        30_000.0,
        |s, v| s.visibility = v,
        "Distance at which haze leaves 2 % of the contrast.",
    ),
];

/// Keys of `[camera]`.
pub(super) static CAMERA: &[Key<CameraSettings>] = &[
    position("eye", [0.0, 4.0, 0.0], |c, v| c.eye = v, "Position of the camera."),
    position("look", [0.0, 0.0, -60.0], |c, v| c.look = v, "Point looked at; must differ from `eye`."),
    angle("fov_deg", [10.0, 120.0], 50.0, |c, v| c.fov_y = v, "Vertical field of view."),
    number(
        "eye_separation",
        "m",
        [0.0, 1.0],
        0.063,
        |c, v| c.eye_separation = v,
        "Distance between the eyes of stereo pictures.",
    ),
];
