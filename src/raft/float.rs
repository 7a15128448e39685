//! The raft: where it is, how it heaves, pitches and rolls.
use super::deck::Plane;
use super::error::{RaftError, check_range};
use super::response::{Motion, Response};
use super::settings::RaftSettings;
use super::{about_y, tilt_to};
use crate::sea::SeaMaps;
use glam::{DQuat, DVec2, DVec3, Mat3, Vec3Swizzles};

/// A longer pause than this, seconds, or a step back in time, and the raft is put on the water anew.
pub const LONGEST_STEP: f64 = 2.0;
/// The raft begins within this of the world's origin, metres, as the camera does.
const WORLD: f64 = 1e9;

/// A place in the world and the directions of its axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// World metres.
    pub position: DVec3,
    /// Columns: right, up and back in the world, unit length.
    pub axes: Mat3,
}

/// What was seen at the step before.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Seen {
    time: f64,
    plane: Plane,
    /// Whether the rates are known: the first look at the water tells no speed.
    moving: bool,
}

/// A small raft that rides the sea.
///
/// Its (x, z) and heading are the rider's: waves neither push nor turn it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Raft {
    settings: RaftSettings,
    heave_response: Response,
    tilt_response: Response,
    at: DVec2,
    heading: f64,
    /// Height of the water the raft floats on, metres.
    heave: Motion,
    /// Slope of the deck along world x and z, metres a metre.
    tilt: [Motion; 2],
    seen: Option<Seen>,
}

impl Raft {
    /// A raft at world (x, z) `at`, metres, whose front looks along `heading`, radians about +Y. It lies level on the sea at
    /// rest until its first step.
    ///
    /// # Errors
    /// [`RaftError::OutOfRange`] for settings that [`RaftSettings::check`] refuses, or a place beyond 1e9 m.
    pub fn new(settings: &RaftSettings, at: DVec2, heading: f64) -> Result<Self, RaftError> {
        settings.check()?;
        check_range("x", at.x, [-WORLD, WORLD])?;
        check_range("z", at.y, [-WORLD, WORLD])?;
        check_range("heading", heading, [-WORLD, WORLD])?;
        Ok(Self {
            settings: *settings,
            heave_response: Response::new(settings.heave_frequency, settings.heave_damping),
            tilt_response: Response::new(settings.tilt_frequency, settings.tilt_damping),
            at,
            heading,
            heave: Motion::default(),
            tilt: [Motion::default(); 2],
            seen: None,
        })
    }

    /// Follows the sea of `maps` to `time`, seconds: the time they are for, not reduced to the sea's period.
    ///
    /// At the first step, after a pause of more than [`LONGEST_STEP`], and when time goes backwards or is no number, the raft
    /// is put on the water anew, moving as the water does. When no time has passed, nothing moves.
    pub fn step(&mut self, maps: &SeaMaps, time: f64) {
        let plane = Plane::under(maps, self.at, self.heading, [self.settings.length, self.settings.width]);
        if !plane.is_finite() {
            return;
        }
        let moving = match (self.seen, self.elapsed(time)) {
            (_, Some(0.0)) => return,
            (Some(seen), Some(seconds)) => {
                self.follow(&seen, &plane, seconds);
                true
            }
            _ => {
                self.heave = Motion { value: plane.height, rate: 0.0 };
                self.tilt = plane.slope.to_array().map(|value| Motion { value, rate: 0.0 });
                false
            }
        };
        self.seen = Some(Seen { time, plane, moving });
    }

    fn follow(&mut self, seen: &Seen, plane: &Plane, seconds: f64) {
        let [tilt_x, tilt_z] = &mut self.tilt;
        for (motion, response, from, to) in [
            (&mut self.heave, &self.heave_response, seen.plane.height, plane.height),
            (tilt_x, &self.tilt_response, seen.plane.slope.x, plane.slope.x),
            (tilt_z, &self.tilt_response, seen.plane.slope.y, plane.slope.y),
        ] {
            if !seen.moving {
                motion.rate = (to - from) / seconds;
            }
            *motion = response.advance(*motion, [from, to], seconds);
        }
    }

    /// Seconds from the last step to `time`; `None` where a step to `time` would put the raft on the water anew.
    pub fn elapsed(&self, time: f64) -> Option<f64> {
        let seconds = time - self.seen?.time;
        (0.0..=LONGEST_STEP).contains(&seconds).then_some(seconds)
    }

    /// The deck's centre and its axes: right, up, back.
    pub fn pose(&self) -> Pose {
        Pose {
            position: self.position(),
            axes: Mat3::from_quat((self.tilt() * about_y(self.heading)).as_quat()),
        }
    }

    /// The deck's centre, world metres.
    pub fn position(&self) -> DVec3 {
        DVec3::new(self.at.x, self.settings.freeboard + self.heave.value, self.at.y)
    }

    /// Pitch and roll: the smallest rotation that takes +Y to the deck's normal.
    pub fn tilt(&self) -> DQuat {
        let slope = DVec2::new(self.tilt[0].value, self.tilt[1].value);
        tilt_to(Plane { height: self.heave.value, slope }.normal())
    }

    /// Height of the water the raft floats on, and its rate: metres, m/s.
    pub fn heave(&self) -> Motion {
        self.heave
    }

    /// Direction of the deck's front, radians about +Y.
    pub fn heading(&self) -> f64 {
        self.heading
    }

    /// What it was made from.
    pub fn settings(&self) -> &RaftSettings {
        &self.settings
    }

    /// Goes on with other `settings`, where it is; the next step puts it on the water anew.
    ///
    /// # Errors
    /// As [`Raft::new`].
    pub fn refit(&mut self, settings: &RaftSettings) -> Result<(), RaftError> {
        *self = Self::new(settings, self.at, self.heading)?;
        Ok(())
    }

    /// Moves the raft over the water by world (x, z) `by`, metres; the next step feels the water it comes to.
    pub fn glide(&mut self, by: DVec2) {
        if by.is_finite() {
            self.at += by;
        }
    }

    /// Moves the deck at once by `by`, metres, and turns it by `turn`, radians about +Y, and takes the plane of water
    /// under it along: a person who turns on the spot does not kick the raft.
    pub fn shift(&mut self, by: DVec3, turn: f64) {
        if !by.is_finite() || !turn.is_finite() {
            return;
        }
        self.at += by.xz();
        self.heave.value += by.y;
        self.heading += turn;
        if let Some(seen) = &mut self.seen {
            seen.plane.height += seen.plane.slope.dot(by.xz());
        }
    }
}
