//! Keys of `[lod.signal]`.
use super::super::draft::SignalDraft;
use super::super::key::{Absent, Key, Kind, number};

/// What chooses the density where `lod.tessellation` is "signal".
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
