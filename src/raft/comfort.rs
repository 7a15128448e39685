//! What keeps a rider well: a vignette while the stick moves them, and a horizon that may stay level.
use super::settings::RaftSettings;
use std::f64::consts::FRAC_PI_2;

/// Seconds in which the vignette closes from nothing to all.
pub const ATTACK: f64 = 0.15;
/// Seconds in which it opens again.
pub const RELEASE: f64 = 0.6;
/// Rate of a smooth turn at which the vignette is as strong as at full speed, rad/s.
const FULL_TURN: f64 = FRAC_PI_2;

/// Whether a rider's view tilts with the deck.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Horizon {
    /// The view heaves, pitches and rolls with the deck: the deck looks still, the horizon sways.
    #[default]
    Rides,
    /// The view never pitches or rolls: the horizon looks level, the deck sways. It heaves as far as
    /// [`RaftSettings::held_heave`] says.
    Still,
}

/// How far the edge of the view is darkened.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vignette {
    strength: f64,
}

impl Vignette {
    /// Follows a glide of `speed` (m/s) and a smooth turn of `turn_rate` (rad/s) for `seconds` (0 or more).
    ///
    /// Strength grows in proportion to the faster of the two, changes at a limited rate, and is exactly 0 again after
    /// standing still for [`RELEASE`]. Waves and snap turns count for nothing: the first are not the stick's, and between
    /// the two pictures of a snap nothing flows.
    pub fn step(&mut self, settings: &RaftSettings, speed: f64, turn_rate: f64, seconds: f64) {
        let share = |rate: f64, full: f64| if full > 0.0 { (rate.abs() / full).min(1.0) } else { 0.0 };
        let flow = share(speed, settings.glide_speed).max(share(turn_rate, FULL_TURN));
        let target = settings.vignette * flow;
        let (down, up) = (self.strength - seconds / RELEASE, self.strength + seconds / ATTACK);
        if down <= up {
            self.strength = target.clamp(down, up).clamp(0.0, 1.0);
        }
    }

    /// 0 (none) ..= 1 (as far as the drawing of it goes).
    pub fn strength(&self) -> f64 {
        self.strength
    }
}
