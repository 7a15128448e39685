//! Everything a raft and its rider can be told.
use super::comfort::Horizon;
use super::error::{RaftError, check_range};

/// A raft and its rider, in SI units and radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RaftSettings {
    /// Side of the deck from front to back, metres, 0.5..=20.
    pub length: f64,
    /// Side of the deck from left to right, metres, 0.5..=20.
    pub width: f64,
    /// Height of the deck above the water, metres, 0..=5.
    pub freeboard: f64,
    /// Natural frequency of heave, Hz, 0.1..=10: the lighter the raft, the higher.
    pub heave_frequency: f64,
    /// Damping of heave as a share of the critical, 0.05..=1.
    pub heave_damping: f64,
    /// Natural frequency of pitch and roll, Hz, 0.1..=10.
    pub tilt_frequency: f64,
    /// Damping of pitch and roll as a share of the critical, 0.05..=1.
    pub tilt_damping: f64,
    /// Whether the rider's view pitches and rolls with the deck.
    pub horizon: Horizon,
    /// Share of the heave that the view follows when the horizon is [`Horizon::Still`], 0..=1.
    pub held_heave: f64,
    /// Speed at a thumbstick's full deflection, m/s, 0..=20.
    pub glide_speed: f64,
    /// Most by which the velocity changes, m/s^2, 0.1..=100.
    pub glide_acceleration: f64,
    /// Deflection of a thumbstick that counts as none, 0..=0.9.
    pub dead_zone: f64,
    /// Angle of one snap turn, radians, 1 to 90 degrees.
    pub snap_turn: f64,
    /// Rate of a smooth turn at full deflection, rad/s, 0 to 360 degrees a second; 0 turns by snaps.
    pub smooth_turn: f64,
    /// Strength of the vignette at full speed, 0..=1.
    pub vignette: f64,
}

impl Default for RaftSettings {
    /// Of wood, for two, for a rider who is new to it.
    fn default() -> Self {
        Self {
            length: 2.4,
            width: 2.4,
            freeboard: 0.25,
            heave_frequency: 1.2,
            heave_damping: 0.7,
            tilt_frequency: 1.0,
            tilt_damping: 0.7,
            horizon: Horizon::Rides,
            held_heave: 1.0,
            glide_speed: 3.0,
            glide_acceleration: 6.0,
            dead_zone: 0.15,
            snap_turn: 30f64.to_radians(),
            smooth_turn: 0.0,
            vignette: 0.7,
        }
    }
}

impl RaftSettings {
    /// Every value in its range.
    ///
    /// # Errors
    /// [`RaftError::OutOfRange`] for the first one that is not.
    pub fn check(&self) -> Result<(), RaftError> {
        let degrees = |low: f64, high: f64| [low.to_radians(), high.to_radians()];
        for (key, value, range) in [
            ("length", self.length, [0.5, 20.0]),
            ("width", self.width, [0.5, 20.0]),
            ("freeboard", self.freeboard, [0.0, 5.0]),
            ("heave_frequency", self.heave_frequency, [0.1, 10.0]),
            ("heave_damping", self.heave_damping, [0.05, 1.0]),
            ("tilt_frequency", self.tilt_frequency, [0.1, 10.0]),
            ("tilt_damping", self.tilt_damping, [0.05, 1.0]),
            ("held_heave", self.held_heave, [0.0, 1.0]),
            ("glide_speed", self.glide_speed, [0.0, 20.0]),
            ("glide_acceleration", self.glide_acceleration, [0.1, 100.0]),
            ("dead_zone", self.dead_zone, [0.0, 0.9]),
            ("snap_turn", self.snap_turn, degrees(1.0, 90.0)),
            ("smooth_turn", self.smooth_turn, degrees(0.0, 360.0)),
            ("vignette", self.vignette, [0.0, 1.0]),
        ] {
            check_range(key, value, range)?;
        }
        Ok(())
    }
}
