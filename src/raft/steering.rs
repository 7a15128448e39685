//! From thumbsticks to a glide over the water and to turns.
use super::about_y;
use super::settings::RaftSettings;
use glam::{DQuat, DVec2, DVec3, Quat, Vec3Swizzles};

/// Deflection to the side at which a flick turns.
pub const FLICK: f64 = 0.7;
/// Deflection to the side below which the next flick counts.
pub const REARM: f64 = 0.4;

/// A thumbstick as OpenXR gives it: -1..=1 each, right and forward positive.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stick {
    /// To the right.
    pub x: f64,
    /// Forward.
    pub y: f64,
}

impl Stick {
    /// (right, forward), of length 0 within `dead_zone` (0..1) and growing evenly from there to 1 at full deflection.
    ///
    /// The dead zone is round, so that no direction sticks to an axis. What is no number is no deflection.
    pub fn deflection(self, dead_zone: f64) -> DVec2 {
        let stick = DVec2::new(self.x, self.y);
        let length = stick.length();
        if !length.is_finite() || length <= dead_zone {
            return DVec2::ZERO;
        }
        stick / length * ((length.min(1.0) - dead_zone) / (1.0 - dead_zone))
    }
}

/// Yaw of a head or hand: the direction its -Z points in seen from above, radians about +Y.
///
/// Straight up or down -Z points nowhere; the direction blends to that of the top of the head, which then lies along it.
/// 0 where there is none.
pub fn yaw_of(orientation: Quat) -> f64 {
    let orientation = orientation.as_dquat();
    let (forward, up) = (orientation * DVec3::NEG_Z, orientation * DVec3::Y);
    let along = forward - up * forward.y;
    let yaw = libm::atan2(-along.x, -along.z);
    if yaw.is_finite() { yaw } else { 0.0 }
}

/// The velocity of a glide and the state of the turning stick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Steering {
    velocity: DVec2,
    /// Whether the next flick turns. Not from the start: a stick held while the program begins is no flick.
    armed: bool,
}

impl Steering {
    /// Glides for `seconds` (0 or more): world (x, z) by which to move, metres. `forward` is the world yaw in which the
    /// stick's forward points.
    ///
    /// The velocity goes straight to the one asked for, by at most the acceleration allowed; the way is its exact integral.
    pub fn glide(&mut self, settings: &RaftSettings, stick: Stick, forward: f64, seconds: f64) -> DVec2 {
        let stick = stick.deflection(settings.dead_zone);
        let local = DVec3::new(stick.x, 0.0, -stick.y) * settings.glide_speed;
        let wanted = (about_y(forward) * local).xz();
        let before = self.velocity;
        let change = (wanted - before).length();
        let needed = change / settings.glide_acceleration;
        if needed <= seconds {
            self.velocity = wanted;
            return 0.5 * (before + wanted) * needed + wanted * (seconds - needed);
        }
        self.velocity = before + (wanted - before) * (seconds / needed);
        0.5 * (before + self.velocity) * seconds
    }

    /// Turns for `seconds` (0 or more): radians about +Y, negative to the right. The velocity turns along, so that the view
    /// ahead goes on as before.
    pub fn turn(&mut self, settings: &RaftSettings, stick: Stick, seconds: f64) -> f64 {
        let angle = if settings.smooth_turn > 0.0 {
            -stick.deflection(settings.dead_zone).x * settings.smooth_turn * seconds
        } else {
            self.snap(settings.snap_turn, stick)
        };
        if angle != 0.0 {
            let turn: DQuat = about_y(angle);
            self.velocity = (turn * DVec3::new(self.velocity.x, 0.0, self.velocity.y)).xz();
        }
        angle
    }

    fn snap(&mut self, angle: f64, stick: Stick) -> f64 {
        let side = stick.x.abs();
        if self.armed && side >= FLICK {
            self.armed = false;
            return -angle * stick.x.signum();
        }
        self.armed |= side <= REARM;
        0.0
    }

    /// World (x, z) velocity, m/s.
    pub fn velocity(&self) -> DVec2 {
        self.velocity
    }

    /// Stands still; a stick that is held now turns only after it was let go.
    pub fn stop(&mut self) {
        *self = Self::default();
    }
}
