//! Keys of `[water]`.
use crate::scene::key::{Key, color, number, power_of_two, word};
use crate::scene::{Mirrored, Shading, Shadows, WaterSettings};

/// Keys of `[water]`.
pub(in crate::scene) static WATER: &[Key<WaterSettings>] = &[
    color(
        "deep_color",
        [0.002, 0.014, 0.026],
        |w, v| w.deep_color = v.map(|c| c as f32),
        "Diffuse reflectance of deep water seen from straight above, linear Rec. 709.",
    ),
    color(
        "scatter_color",
        [0.01, 0.11, 0.1],
        |w, v| w.scatter_color = v.map(|c| c as f32),
        "Colour of light that came through a crest, linear Rec. 709.",
    ),
    number("scatter", "", [0.0, 10.0], 1.0, |w, v| w.scatter = v, "Strength of that light."),
    color(
        "foam_color",
        [0.8, 0.83, 0.85],
        |w, v| w.foam_color = v.map(|c| c as f32),
        "Albedo of foam, linear Rec. 709.",
    ),
    number(
        "detail",
        "",
        [0.0, 4.0],
        1.0,
        |w, v| w.detail = v,
        "Factor on the slopes used for shading; 1 is physical.",
    ),
    word(
        "shadows",
        "off",
        &[
            ("off", |w| w.shadows.shadows = Shadows::Off),
            ("screen", |w| w.shadows.shadows = Shadows::Screen),
            ("on", |w| w.shadows.shadows = Shadows::On),
        ],
        "Shadows that the waves and what floats on them cast on each other; `screen` is everywhere but in headsets.",
    ),
    Key {
        unit: "texels",
        ..power_of_two(
            "shadow_resolution",
            [256, 4096],
            2048,
            |w, v| w.shadows.resolution = v as u32,
            "Side of the map the sun's shadows are looked up in.",
        )
    },
    number(
        "shadow_distance",
        "m",
        [10.0, 2000.0],
        200.0,
        |w, v| w.shadows.distance = v,
        "Distance from the viewer at which shadows have faded; nearer ones are the sharper the less it is.",
    ),
    word(
        "shading",
        "physical",
        &[
            ("physical", |w| w.shading = Shading::Physical),
            ("blinn-phong", |w| w.shading = Shading::BlinnPhong),
        ],
        "How light becomes a colour: by the optics of rough water, or by a deep colour, a mirror and a highlight. The keys below are for the latter.",
    ),
    number(
        "shininess",
        "",
        [1.0, 10_000.0],
        400.0,
        |w, v| w.phong.shininess = v,
        "Exponent of the highlight: the larger, the smaller.",
    ),
    number(
        "highlight",
        "",
        [0.0, 100.0],
        1.0,
        |w, v| w.phong.highlight = v,
        "Strength of the highlight; 1 is as bright as a white wall in the sun.",
    ),
    word(
        "mirrored",
        "cubemap",
        &[
            ("cubemap", |w| w.phong.mirrored = Mirrored::Cubemap),
            ("ambient", |w| w.phong.mirrored = Mirrored::Ambient),
        ],
        "What is mirrored where the sun is not: the sky, or `ambient_color`.",
    ),
    color(
        "ambient_color",
        [1.0, 1.0, 1.0],
        |w, v| w.phong.ambient_color = v.map(|c| c as f32),
        "Colour that is mirrored, over that of a white wall under the sky, linear Rec. 709.",
    ),
    number(
        "sun_size",
        "",
        [1e-5, 1.0],
        0.02,
        |w, v| w.phong.sun_size = v,
        "Size of the mirrored sun with its halo: 1 less the cosine of its radius; 1 reaches from the sun to all that is at right angles to it.",
    ),
    number(
        "sun_falloff",
        "",
        [0.1, 1000.0],
        4.0,
        |w, v| w.phong.sun_falloff = v,
        "Exponent by which the mirrored sun falls off towards its rim: the larger, the less halo.",
    ),
];
