//! A person on the raft: from the headset's play space to the world and back.
use super::about_y;
use super::comfort::{Horizon, Vignette};
use super::error::RaftError;
use super::float::{Pose, Raft};
use super::settings::RaftSettings;
use super::steering::{Steering, Stick, yaw_of};
use crate::sea::SeaMaps;
use glam::{DQuat, DVec2, DVec3, Mat3, Quat, Vec3Swizzles};

/// A head in play space.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Head {
    /// Metres, the floor at y = 0.
    pub position: DVec3,
    /// Radians about +Y, see [`yaw_of`].
    pub yaw: f64,
}

/// What a rider does in one frame. Values that are no numbers count as nothing done.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Input {
    /// The stick that glides.
    pub glide: Stick,
    /// The stick that turns.
    pub turn: Stick,
    /// Play-space yaw in which the gliding stick's forward points: that of the head or of the hand, as the host likes.
    pub forward: f64,
    /// The head, as it will be when the frame is seen.
    pub head: Head,
}

/// Play space in the world.
struct Frame {
    /// The deck's centre; under a still horizon at the height the view follows.
    position: DVec3,
    rotation: DQuat,
}

/// A rider, their raft, and where the headset's play space lies in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rider {
    raft: Raft,
    steering: Steering,
    vignette: Vignette,
    /// Yaw of play space in the world.
    heading: f64,
    /// Point of play space's floor, (x, z), that stands on the deck's centre.
    centre: DVec2,
    head: Head,
}

impl Rider {
    /// A rider on a raft at world (x, z) `at`, metres: play space's origin stands on the deck's centre, and its -Z and the
    /// raft's front look along `heading`, radians about +Y.
    ///
    /// # Errors
    /// As [`Raft::new`].
    pub fn new(settings: &RaftSettings, at: DVec2, heading: f64) -> Result<Self, RaftError> {
        Ok(Self {
            raft: Raft::new(settings, at, heading)?,
            steering: Steering::default(),
            vignette: Vignette::default(),
            heading,
            centre: DVec2::ZERO,
            head: Head::default(),
        })
    }

    /// Goes on with other `settings`, in the same place and looking the same way.
    ///
    /// # Errors
    /// As [`Raft::new`].
    pub fn refit(&mut self, settings: &RaftSettings) -> Result<(), RaftError> {
        self.raft.refit(settings)
    }

    /// One frame: turns, glides, and rides the sea of `maps` to `time`, as [`Raft::step`] does. Where that puts the raft on
    /// the water anew, the rider stands still.
    pub fn step(&mut self, maps: &SeaMaps, time: f64, input: &Input) {
        let settings = *self.raft.settings();
        if input.head.position.is_finite() && input.head.yaw.is_finite() {
            self.head = input.head;
        }
        match self.raft.elapsed(time) {
            Some(seconds) => {
                let turn = self.steering.turn(&settings, input.turn, seconds);
                self.turn_about_head(turn);
                let forward = if input.forward.is_finite() { input.forward } else { self.head.yaw };
                let way = self.steering.glide(&settings, input.glide, self.heading + forward, seconds);
                self.raft.glide(way);
                let smooth = settings.smooth_turn > 0.0 && seconds > 0.0;
                let turn_rate = if smooth { turn / seconds } else { 0.0 };
                self.vignette.step(&settings, self.steering.velocity().length(), turn_rate, seconds);
            }
            None => {
                self.steering.stop();
                self.vignette = Vignette::default();
            }
        }
        self.raft.step(maps, time);
    }

    /// Turns play space, with the raft, by `angle` about the head, which stays where it is in the world.
    fn turn_about_head(&mut self, angle: f64) {
        if angle == 0.0 {
            return;
        }
        let from_centre = self.head.position.with_y(0.0) - self.centre3();
        let before = self.frame().rotation * from_centre;
        self.heading += angle;
        let after = self.frame().rotation * from_centre;
        self.raft.shift(before - after, angle);
    }

    /// Brings the deck's centre under the head and its front to where the head looks. The view stays where it is; the raft
    /// moves. Call it also after the runtime has moved play space, with a step between.
    pub fn recentre(&mut self) {
        let Frame { rotation, .. } = self.frame();
        let under_head = self.head.position.xz();
        let way = rotation * (self.head.position.with_y(0.0) - self.centre3());
        self.raft.shift(way, self.heading + self.head.yaw - self.raft.heading());
        self.centre = under_head;
    }

    fn centre3(&self) -> DVec3 {
        DVec3::new(self.centre.x, 0.0, self.centre.y)
    }

    fn frame(&self) -> Frame {
        let (position, heading) = (self.raft.position(), about_y(self.heading));
        let settings = self.raft.settings();
        match settings.horizon {
            Horizon::Rides => Frame { position, rotation: self.raft.tilt() * heading },
            Horizon::Still => {
                let height = settings.freeboard + settings.held_heave * self.raft.heave().value;
                Frame { position: position.with_y(height), rotation: heading }
            }
        }
    }

    /// From play space to the world: a position, metres, and the axes (columns right, up, back) of an `orientation`.
    pub fn to_world(&self, position: DVec3, orientation: Quat) -> (DVec3, Mat3) {
        let frame = self.frame();
        let axes = (frame.rotation * orientation.as_dquat()).as_quat().normalize();
        (frame.position + frame.rotation * (position - self.centre3()), Mat3::from_quat(axes))
    }

    /// From the world to play space: the inverse of [`Rider::to_world`].
    pub fn to_play(&self, position: DVec3, axes: Mat3) -> (DVec3, Quat) {
        let frame = self.frame();
        let back = frame.rotation.conjugate();
        let orientation = (back * Quat::from_mat3(&axes).as_dquat()).as_quat().normalize();
        (back * (position - frame.position) + self.centre3(), orientation)
    }

    /// Play space's origin and axes in the world.
    pub fn play_space(&self) -> Pose {
        let (position, axes) = self.to_world(DVec3::ZERO, Quat::IDENTITY);
        Pose { position, axes }
    }

    /// The raft, for drawing.
    pub fn raft(&self) -> &Raft {
        &self.raft
    }

    /// How far the edge of the view is to be darkened, 0..=1.
    pub fn vignette(&self) -> f64 {
        self.vignette.strength()
    }

    /// World (x, z) velocity of the glide, m/s.
    pub fn velocity(&self) -> DVec2 {
        self.steering.velocity()
    }
}

impl Head {
    /// From a pose as a headset gives it.
    pub fn new(position: DVec3, orientation: Quat) -> Self {
        Self { position, yaw: yaw_of(orientation) }
    }
}
