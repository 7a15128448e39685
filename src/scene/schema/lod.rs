//! Keys of `[lod]` and `[lod.signal]`.
use crate::lod::Quality;
use crate::scene::draft::{LodDraft, SignalDraft};
use crate::scene::key::{Absent, Key, Kind, number, optional, word};

/// Keys of `[lod]`.
pub(in crate::scene) static LOD: &[Key<LodDraft>] = &[
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

/// Keys of `[lod.signal]`: what chooses the density where `lod.tessellation` is "signal".
pub(in crate::scene) static LOD_SIGNAL: &[Key<SignalDraft>] = &[
    number(
        "threshold",
        "m",
        [0.0, 100.0],
        0.02,
        |s, v| s.threshold = v,
        "Amplitude, of a wave or of all waves of an octave, from which on they displace the surface.",
    ),
    number(
        "density",
        "",
        [0.01, 100.0],
        1.0,
        |s, v| s.density = v,
        "Factor on all densities: 1 is two vertices for the shortest wave that displaces.",
    ),
    Key {
        name: "fresnel",
        unit: "",
        kind: Kind::Pair {
            range: [0.0, 1.0],
            absent: Absent::Is([0.5, 1.0]),
            set: |s, v| s.settings.fresnel = v,
        },
        meaning: "Range that the factor (1 - cos)^5 of the angle between view and vertical is held to: fewer vertices seen from above.",
    },
    Key {
        name: "distance",
        unit: "m",
        kind: Kind::Pair {
            range: [0.0, 100_000.0],
            absent: Absent::Is([100.0, 4000.0]),
            set: |s, v| s.settings.distance = v,
        },
        meaning: "Distances between which density falls to one cell a patch.",
    },
];
