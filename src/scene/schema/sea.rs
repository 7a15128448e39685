//! Keys of the spectral sea: what holds for all of it, its cascades, its foam.
use crate::scene::draft::CascadeDraft;
use crate::scene::key::{Absent, Key, Kind, angle, number, power_of_two, word};
use crate::sea::{FoamSettings, NormalKind, SeaSettings, Spectrum};

/// Keys of `[sea]` with model "fft" that hold for the sea as a whole.
pub(in crate::scene) static SEA: &[Key<SeaSettings>] = &[
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
pub(in crate::scene) static SEA_AND_CASCADE: &[Key<CascadeDraft>] = &[
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
pub(in crate::scene) static CASCADE_ONLY: &[Key<CascadeDraft>] = &[
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
pub(in crate::scene) static FOAM: &[Key<FoamSettings>] = &[
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
