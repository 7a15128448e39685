//! The person: what their hands and head do, and where that puts them.

use super::eyes;
use super::leap::Leap;
use crate::draw::{Eye, Moment, Solid};
use crate::host::HostError;
use crate::host::afloat::Afloat;
use crate::raft::{Input, Rider, Stick, yaw_of};
use crate::scene::Scene;
use crate::sea::SeaMaps;
use crate::xr::vendor::Joints;
use crate::xr::{HANDS, Hand, SpaceStep, VIEWS, View};
use glam::{DVec2, Vec2, Vec3Swizzles};

/// A rider and what floats around them.
pub struct Ride {
    rider: Rider,
    afloat: Afloat,
    leap: Leap,
}

/// What a headset knows of its wearer at a frame's time.
#[derive(Clone, Copy)]
pub struct Person<'a> {
    /// Left, right.
    pub views: &'a [View; VIEWS],
    /// Controllers, as far as they are the raft's business.
    pub hands: &'a [Hand; HANDS],
    /// Lengths of rays from where they point, metres.
    pub rays: &'a [Option<f32>; HANDS],
    /// Bare hands.
    pub joints: &'a [Option<Joints>; HANDS],
    /// Whether play space's origin has moved since the frame before.
    pub moved: bool,
}

/// Where a frame is seen from, and what is afloat in it.
pub struct Ridden<'a> {
    /// Left, right.
    pub eyes: [Eye; VIEWS],
    /// Hands that feel something.
    pub buzz: [bool; HANDS],
    /// What floats.
    pub solids: &'a [Solid],
    /// How far the vignette is closed.
    pub vignette: f32,
    /// How play space has moved in the world since the frame before.
    pub step: SpaceStep,
}

impl Ridden<'_> {
    /// The frame, with the sea of `maps`.
    pub fn moment<'a>(&'a self, maps: &'a SeaMaps) -> Moment<'a> {
        Moment { eyes: &self.eyes, maps, solids: self.solids, vignette: self.vignette }
    }
}

impl Ride {
    /// A rider under the scene's camera, looking where it looks.
    ///
    /// # Errors
    /// Settings of the raft that are out of range.
    pub fn new(scene: &Scene) -> Result<Self, HostError> {
        let (at, heading) = (scene.camera.ground(), scene.camera.heading());
        let rider = Rider::new(&scene.raft, at, heading)?;
        Ok(Self { rider, afloat: Afloat::default(), leap: Leap::default() })
    }

    /// Under the camera of `scene`, as at the start.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn begin(&mut self, scene: &Scene) -> Result<(), HostError> {
        *self = Self::new(scene)?;
        Ok(())
    }

    /// Goes on where it is, on the raft of `scene`.
    ///
    /// # Errors
    /// Settings of the raft that are out of range.
    pub fn refit(&mut self, scene: &Scene) -> Result<(), HostError> {
        Ok(self.rider.refit(&scene.raft)?)
    }

    /// Moves on to `time`, seconds, over the sea of `maps`.
    pub fn step(&mut self, scene: &Scene, maps: &SeaMaps, time: f64, person: &Person<'_>) -> Ridden<'_> {
        let Person { views, hands, rays, joints, moved } = *person;
        let head = eyes::head(views);
        let before = self.rider.play_space().axes.z_axis;
        let (glide, turn) = (self.glide(head.yaw, hands), hands[1].stick);
        let input = Input {
            glide,
            turn: Stick { x: f64::from(turn[0]), y: f64::from(turn[1]) },
            forward: head.yaw,
            head,
        };
        self.rider.step(maps, time, &input);
        // Wherever the runtime has put the person, it is the middle of the raft again.
        if moved {
            self.rider.recentre();
        }
        let mut buzz = [false; HANDS];
        for (hand, buzz) in hands.iter().zip(&mut buzz) {
            if hand.recentre {
                self.rider.recentre();
                *buzz = true;
            }
        }
        // A snap turn is felt in the hand that made it.
        // Seen from above, so that a deck that tilts far between two frames is no turn.
        let turned = Vec2::angle_to(before.xz(), self.rider.play_space().axes.z_axis.xz());
        let snapped = scene.raft.smooth_turn == 0.0 && f64::from(turned.abs()) > 0.5 * scene.raft.snap_turn;
        buzz[1] |= snapped;
        let step = self.leap.step(self.rider.play_space(), views, snapped || moved);
        let eyes = eyes::eyes(&self.rider, views);
        self.afloat.begin(&scene.buoys, maps);
        let between = (eyes[0].position + eyes[1].position) * 0.5;
        self.afloat.raft(&scene.raft, self.rider.raft().pose(), between);
        let rider = &self.rider;
        self.afloat.hands(hands, joints, |pose| eyes::placed(rider, pose));
        self.afloat.rays(hands, rays, |pose| eyes::placed(rider, pose));
        #[expect(clippy::cast_possible_truncation, reason = "0 to 1")]
        let vignette = self.rider.vignette() as f32;
        Ridden { eyes, buzz, solids: self.afloat.solids(), vignette, step }
    }

    /// The left stick, and whatever trigger or pinch pulls towards where its hand points, relative to the head.
    fn glide(&self, head: f64, hands: &[Hand; HANDS]) -> Stick {
        let [x, y] = hands[0].stick.map(f64::from);
        let mut way = DVec2::new(x, y);
        for hand in hands {
            if let Some(aim) = hand.aim {
                let (sin, cos) = (yaw_of(eyes::parts(aim).1) - head).sin_cos();
                way += DVec2::new(-sin, cos) * f64::from(hand.go);
            }
        }
        let way = way.clamp_length_max(1.0);
        Stick { x: way.x, y: way.y }
    }
}
