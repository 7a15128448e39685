//! Keys of `[sky]`.
use crate::scene::draft::{SkyDraft, SkyModel};
use crate::scene::key::{Key, Kind, angle, number, word};

/// Keys of `[sky]`.
pub(in crate::scene) static SKY: &[Key<SkyDraft>] = &[
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
