//! What a person in a headset stands on, and how they move: a small raft that rides the sea by the height query, glides by
//! thumbstick, and carries the headset's play space. No Vulkan, no headset: poses in, poses out. See `docs/raft.md`.
//!
//! # From the sea to an eye
//! ```text
//! SeaMaps -> deck: plane under the deck -> response: heave and tilt follow it -> float: Raft's pose
//! sticks  -> steering: glide and turns  ------------------------------------------^      |
//!            comfort: vignette, horizon -> rider: play space -> world  <-----------------+
//! ```
//!
//! # Conventions
//! Those of the world: right-handed, Y up, -Z forward. A heading or yaw is an angle about +Y in radians, counter-clockwise
//! seen from above; at 0 one looks along -Z, at pi/2 along -X. Play space is OpenXR's: metres, the floor at y = 0.
//! Positions are `f64`: nothing is lost a thousand kilometres out.
//!
//! # Guarantees
//! Everything is a pure function of the settings and of what was stepped: the same poses on every run. No time step, stick or
//! pose makes a pose that is not finite. Stepping does not allocate.
pub mod buoy;
pub mod comfort;
pub mod deck;
pub mod error;
pub mod float;
pub mod response;
pub mod rider;
pub mod settings;
pub mod steering;

pub use buoy::{BuoySettings, MAX_BUOYS};
pub use comfort::{Horizon, Vignette};
pub use deck::Plane;
pub use error::RaftError;
pub use float::{Pose, Raft};
pub use response::{Motion, Response};
pub use rider::{Head, Input, Rider};
pub use settings::RaftSettings;
pub use steering::{Steering, Stick, yaw_of};

use glam::{DQuat, DVec3};

/// A turn by `yaw` about +Y. Not glam's own: libm's sine is the same on every machine.
fn about_y(yaw: f64) -> DQuat {
    let (sin, cos) = libm::sincos(0.5 * yaw);
    DQuat::from_xyzw(0.0, sin, 0.0, cos)
}

/// The smallest rotation that takes +Y to the unit vector `normal`: it turns nothing about +Y itself.
fn tilt_to(normal: DVec3) -> DQuat {
    DQuat::from_rotation_arc(DVec3::Y, normal)
}
