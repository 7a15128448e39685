//! Keys of what floats: the raft and its rider, and buoys.
use crate::raft::{BuoySettings, Horizon, RaftSettings};
use crate::scene::key::{Absent, Key, Kind, angle, color, number, word};

/// Keys of `[raft]`.
pub(in crate::scene) static RAFT: &[Key<RaftSettings>] = &[
    number("length", "m", [0.5, 20.0], 2.4, |r, v| r.length = v, "Side of the deck from front to back."),
    number("width", "m", [0.5, 20.0], 2.4, |r, v| r.width = v, "Side of the deck from left to right."),
    number("freeboard", "m", [0.0, 5.0], 0.25, |r, v| r.freeboard = v, "Height of the deck above the water."),
    number(
        "heave_frequency",
        "Hz",
        [0.1, 10.0],
        1.2,
        |r, v| r.heave_frequency = v,
        "Natural frequency of heave: the lighter the raft, the higher, and the closer it follows the water.",
    ),
    number(
        "heave_damping",
        "",
        [0.05, 1.0],
        0.7,
        |r, v| r.heave_damping = v,
        "Damping of heave as a share of the critical.",
    ),
    number(
        "tilt_frequency",
        "Hz",
        [0.1, 10.0],
        1.0,
        |r, v| r.tilt_frequency = v,
        "Natural frequency of pitch and roll.",
    ),
    number(
        "tilt_damping",
        "",
        [0.05, 1.0],
        0.7,
        |r, v| r.tilt_damping = v,
        "Damping of pitch and roll as a share of the critical.",
    ),
    word(
        "horizon",
        "rides",
        &[("rides", |r| r.horizon = Horizon::Rides), ("still", |r| r.horizon = Horizon::Still)],
        "Whether a rider's view pitches and rolls with the deck, or stays level.",
    ),
    number(
        "held_heave",
        "",
        [0.0, 1.0],
        1.0,
        |r, v| r.held_heave = v,
        "Share of the heave that the view follows while the horizon is \"still\".",
    ),
    number(
        "glide_speed",
        "m/s",
        [0.0, 20.0],
        3.0,
        |r, v| r.glide_speed = v,
        "Speed at a thumbstick's full deflection; 0 stays where it is.",
    ),
    number(
        "glide_acceleration",
        "m/s^2",
        [0.1, 100.0],
        6.0,
        |r, v| r.glide_acceleration = v,
        "Most by which the velocity changes.",
    ),
    number(
        "dead_zone",
        "",
        [0.0, 0.9],
        0.15,
        |r, v| r.dead_zone = v,
        "Deflection of a thumbstick that counts as none.",
    ),
    angle("snap_turn_deg", [1.0, 90.0], 30.0, |r, v| r.snap_turn = v, "Angle of one snap turn."),
    Key {
        name: "smooth_turn_deg",
        unit: "degrees/s",
        kind: Kind::Angle { range: [0.0, 360.0], absent: Absent::Is(0.0), set: |r, v| r.smooth_turn = v },
        meaning: "Rate of a smooth turn at full deflection; 0 turns by snaps.",
    },
    number(
        "vignette",
        "",
        [0.0, 1.0],
        0.7,
        |r, v| r.vignette = v,
        "How far the edge of the view darkens at full speed; 0 never.",
    ),
];

/// Keys of `[[buoy]]`.
pub(in crate::scene) static BUOY: &[Key<BuoySettings>] = &[
    Key {
        name: "at",
        unit: "m",
        kind: Kind::Pair { range: [-1e9, 1e9], absent: Absent::Is([0.0, -20.0]), set: |b, v| b.at = v },
        meaning: "Where it is moored, (x, z).",
    },
    number("radius", "m", [0.05, 5.0], 0.5, |b, v| b.radius = v, "Radius of the ball."),
    color(
        "color",
        [0.8, 0.12, 0.02],
        |b, v| b.color = v.map(|c| c as f32),
        "Diffuse reflectance, linear Rec. 709.",
    ),
    number(
        "height",
        "m",
        [0.0, 10.0],
        2.0,
        |b, v| b.height = v,
        "Height of the mast above the water; 0 has none.",
    ),
];
