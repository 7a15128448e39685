//! Keys of the sea's models: which one, waves one by one, fractal sums, and layers.
use crate::scene::draft::{LayerDraft, Loops, SeaDraft, SeaModel, Shape, StillWater, WaveDraft};
use crate::scene::key::{Absent, Key, Kind, number, optional, word};
use crate::sea::waves::{FbmFoam, FbmSettings, Kernel, Lean};

/// Keys of `[sea]` with every model.
pub(in crate::scene) static ANY_SEA: &[Key<SeaDraft>] = &[
    word(
        "model",
        "fft",
        &[
            ("fft", |s| s.model = SeaModel::Fft),
            ("waves", |s| s.model = SeaModel::Waves),
            ("fbm", |s| s.model = SeaModel::Fbm),
        ],
        "How the sea moves: a spectrum by inverse Fourier transform, waves one by one, or a fractal sum of octaves.",
    ),
    number("gravity", "m/s^2", [0.1, 100.0], 9.81, |s, v| s.gravity = v, "Acceleration of gravity."),
    word(
        "loops",
        "allow",
        &[
            ("allow", |s| s.loops = Loops::Allow),
            ("limit", |s| s.loops = Loops::Limit),
            ("refuse", |s| s.loops = Loops::Refuse),
        ],
        "Where the steepness of Gerstner waves, layers and all, sums to more than 1: warn, scale it to 1, or refuse the scene.",
    ),
    optional(
        "loop_period",
        "s",
        [0.1, 3600.0],
        "every wave keeps its speed",
        |s, v| s.loop_period = Some(v),
        "Waves and octaves, not the spectrum's, repeat after this time: the frequency of each is rounded to a whole number of periods in it.",
    ),
];

/// Keys of `[sea]` with models "waves" and "fbm", which have no spectrum.
pub(in crate::scene) static STILL_WATER: &[Key<StillWater>] = &[number(
    "roughness",
    "",
    [0.0, 1.0],
    0.1,
    |s, v| s.roughness = v,
    "Roughness of the water at scales below the waves.",
)];

/// Keys of `[[sea.wave]]` and `[[layer.wave]]`.
pub(in crate::scene) static WAVE: &[Key<WaveDraft>] = &[
    word(
        "kind",
        "sine",
        &[
            ("sine", |w| w.shape = Shape::Sine),
            ("peaked", |w| w.shape = Shape::Peaked),
            ("gerstner", |w| w.shape = Shape::Gerstner),
            ("circular", |w| w.shape = Shape::Circular),
        ],
        "Up and down; the same with sharp crests; round in circles; or rings, which are sines, or peaked where `sharpness` is given.",
    ),
    number("wavelength", "m", [0.05, 10_000.0], 10.0, |w, v| w.wavelength = v, "Distance between crests."),
    optional(
        "amplitude",
        "m",
        [0.0, 100.0],
        "0.1, and steepness / k for gerstner",
        |w, v| w.amplitude = Some(v),
        "A: half the height from trough to crest.",
    ),
    optional(
        "direction_deg",
        "degrees",
        [-360.0, 360.0],
        "along +X",
        |w, v| w.direction = Some(v.to_radians()),
        "Direction in which crests travel, from +X counter-clockwise seen from above: 90 is -Z. Rings have none.",
    ),
    optional(
        "speed",
        "m/s",
        [-100.0, 100.0],
        "sqrt(gravity / k), deep water's",
        |w, v| w.speed = Some(v),
        "Speed of crests; below 0 against the direction, and for rings inwards.",
    ),
    number("phase", "rad", [-10.0, 10.0], 0.0, |w, v| w.phase = v, "Added to the phase."),
    optional(
        "sharpness",
        "",
        [1.0, 32.0],
        "2 for peaked, none for circular",
        |w, v| w.sharpness = Some(v),
        "K, the exponent that makes crests sharp and troughs wide (peaked, circular).",
    ),
    optional(
        "steepness",
        "",
        [0.0, 2.0],
        "0.5, unless q is given",
        |w, v| w.steepness = Some(v),
        "Amplitude as a share of 1 / k, at which crests are cusps; above 1 they loop (gerstner).",
    ),
    optional(
        "q",
        "",
        [0.0, 2.0],
        "as steepness says",
        |w, v| w.q = Some(v),
        "With `amplitude`, in place of steepness: share of the steepness at which the sum of the model's gerstner waves loops (gerstner).",
    ),
    Key {
        name: "centre",
        unit: "m",
        kind: Kind::Pair {
            range: [-1e9, 1e9],
            absent: Absent::Means("the origin"),
            set: |w, v| w.centre = Some(v),
        },
        meaning: "Where rings come from, (x, z) (circular).",
    },
];

/// Keys of `[sea]` and of `[[layer]]` with model "fbm".
pub(in crate::scene) static FBM: &[Key<FbmSettings>] = &[
    number("amplitude", "m", [0.0, 100.0], 0.3, |f, v| f.amplitude = v, "Of the first octave."),
    number(
        "frequency",
        "rad/m",
        [1e-4, 100.0],
        0.3,
        |f, v| f.frequency = v,
        "Wave number of the first octave.",
    ),
    number(
        "speed",
        "rad/s",
        [-100.0, 100.0],
        1.0,
        |f, v| f.speed = v,
        "How fast the first octave's phase turns.",
    ),
    number(
        "amplitude_ramp",
        "",
        [0.0, 1.0],
        0.82,
        |f, v| f.amplitude_ramp = v,
        "Amplitude of an octave over that of the one before.",
    ),
    number(
        "frequency_ramp",
        "",
        [1.0, 4.0],
        1.18,
        |f, v| f.frequency_ramp = v,
        "Wave number of an octave over that of the one before.",
    ),
    number(
        "speed_ramp",
        "",
        [0.0, 4.0],
        1.07,
        |f, v| f.speed_ramp = v,
        "Speed of an octave over that of the one before.",
    ),
    Key {
        name: "octaves",
        unit: "",
        kind: Kind::Integer { range: [1, 64], absent: Absent::Is(32), set: |f, v| f.octaves = v as usize },
        meaning: "How many; all layers together have at most 64.",
    },
    word(
        "kernel",
        "exp-sine",
        &[
            ("sine", |f| f.kernel = Kernel::Sine),
            ("exp-sine", |f| f.kernel = Kernel::ExpSine),
            ("gerstner", |f| f.kernel = Kernel::Gerstner),
        ],
        "Profile of an octave: sin f, exp(sin f - 1), or sin f that is displaced sideways too.",
    ),
    number(
        "choppiness",
        "",
        [0.0, 3.0],
        1.0,
        |f, v| f.choppiness = v,
        "Horizontal over vertical amplitude of an octave (kernel gerstner).",
    ),
    Key {
        name: "seed",
        unit: "",
        kind: Kind::Integer { range: [0, i64::MAX as u64], absent: Absent::Is(0), set: |f, v| f.seed = v },
        meaning: "Seed of the octaves' directions.",
    },
];

/// Keys of `[sea.foam]` and `[layer.foam]` with model "fbm".
pub(in crate::scene) static FBM_FOAM: &[Key<FbmFoam>] = &[
    Key {
        name: "range",
        unit: "",
        kind: Kind::Pair { range: [0.0, 1.0], absent: Absent::Is([0.5, 0.85]), set: |f, v| f.range = v },
        meaning: "Heights between which foam grows, as shares of the most that the octaves can sum to; the second exceeds the first.",
    },
    number(
        "height_amount",
        "",
        [0.001, 1.0],
        1.0,
        |f, v| f.height_amount = v,
        "Share of that range, from its end, over which foam appears.",
    ),
    number(
        "height_falloff",
        "",
        [0.1, 16.0],
        1.5,
        |f, v| f.height_falloff = v,
        "Exponent of the height's share.",
    ),
    number(
        "angle_amount",
        "",
        [0.001, 1.0],
        0.3,
        |f, v| f.angle_amount = v,
        "How far the upward part of the normal may fall below 1 before the angle's share is at its other end.",
    ),
    number(
        "angle_falloff",
        "",
        [0.1, 16.0],
        1.0,
        |f, v| f.angle_falloff = v,
        "Exponent of the angle's share.",
    ),
    word(
        "angle",
        "upright",
        &[("upright", |f| f.lean = Lean::Upright), ("leaning", |f| f.lean = Lean::Leaning)],
        "Which normals make foam: upright ones, crest tops; or its complement, leaning ones, flanks.",
    ),
    Key {
        name: "reflection",
        unit: "",
        kind: Kind::Pair { range: [0.0, 1.0], absent: Absent::Is([0.0, 1.0]), set: |f, v| f.reflection = v },
        meaning: "Least and greatest share of reflections that foam takes away, [least, greatest].",
    },
];

/// Keys of `[[layer]]` with every model.
pub(in crate::scene) static LAYER: &[Key<LayerDraft>] = &[word(
    "model",
    "waves",
    &[("waves", |l| l.model = SeaModel::Waves), ("fbm", |l| l.model = SeaModel::Fbm)],
    "What is added to the sea.",
)];
