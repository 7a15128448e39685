//! Hands as a mouse: one of them points, its trigger clicks, its stick scrolls.

use super::board::{Board, Hit};
use crate::xr::{HANDS, Hand};
use egui::{Event, Modifiers, MouseWheelUnit, PointerButton, Pos2, TouchPhase, vec2};
use glam::Vec2;

/// How far a trigger is pulled where it clicks, and where it lets go: apart, so that a finger at rest does not chatter.
const PULLED: f32 = 0.6;
const LET_GO: f32 = 0.4;
/// Points a second that a stick scrolls when it is all the way out.
const SCROLLED: f32 = 900.0;

/// Which hand points, and what it holds.
#[derive(Clone, Debug)]
pub struct Pointer {
    /// Side of the hand that points.
    side: usize,
    /// Where on the panel, points.
    at: Option<Pos2>,
    /// Whether its trigger is pulled on the panel.
    pressed: bool,
    /// Triggers pulled on nothing: they glide, wherever they point until they are let go.
    gliding: [bool; HANDS],
}

impl Default for Pointer {
    /// The right hand's.
    fn default() -> Self {
        Self { side: 1, at: None, pressed: false, gliding: [false; HANDS] }
    }
}

/// What a frame's hands come to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pointed {
    /// Hands as the raft sees them: what goes to the panel is gone.
    pub hands: [Hand; HANDS],
    /// How long each one's ray is, metres, where it has one.
    pub rays: [Option<f32>; HANDS],
}

/// Length of a ray that meets nothing, metres.
const IDLE: f32 = 0.4;

impl Pointer {
    /// Whether some hand points at the panel, or drags.
    pub const fn is_busy(&self) -> bool {
        self.at.is_some()
    }

    /// Where it points, points, and whether it presses.
    pub fn shown(&self) -> Option<(Pos2, bool)> {
        Some((self.at?, self.pressed))
    }

    /// Follows `hands` for `seconds` on `board`, which is `size` points large; what egui should know of goes to `events`.
    pub fn step(
        &mut self,
        hands: &[Hand; HANDS],
        board: &Board,
        size: [f32; 2],
        seconds: f32,
        events: &mut Vec<Event>,
    ) -> Pointed {
        let hits = hands.map(|hand| board.hit(hand.aim?));
        let on = |side: usize| hits[side].is_some_and(|hit| hit.is_on());
        for (side, hand) in hands.iter().enumerate() {
            let own = self.pressed && self.side == side;
            self.gliding[side] = hand.go > LET_GO && !own && (self.gliding[side] || !on(side));
        }
        // While something is dragged the hand stays; otherwise whichever pulls its trigger on the panel points, or alone is on it.
        if !self.pressed {
            let wants = |side: usize| on(side) && !self.gliding[side];
            let pulls = |side: usize| wants(side) && hands[side].go > PULLED;
            let other = 1 - self.side;
            if wants(other) && (!wants(self.side) || (pulls(other) && !pulls(self.side))) {
                self.side = other;
            }
        }
        let hand = hands[self.side];
        let points = |hit: Hit| {
            let at = hit.at.clamp(Vec2::splat(-1.0), Vec2::splat(2.0));
            Pos2::new(at.x * size[0], at.y * size[1])
        };
        let seen = hits[self.side].filter(|hit| self.pressed || (hit.is_on() && !self.gliding[self.side]));
        match seen.map(points) {
            Some(at) => {
                if self.at != Some(at) {
                    events.push(Event::PointerMoved(at));
                }
                self.at = Some(at);
                if !self.pressed && hand.go > PULLED {
                    self.button(at, true, events);
                } else if self.pressed && hand.go < LET_GO {
                    self.button(at, false, events);
                }
                if hand.stick[1] != 0.0 && on(self.side) {
                    let delta = vec2(0.0, hand.stick[1] * SCROLLED * seconds);
                    let (unit, phase, modifiers) = (MouseWheelUnit::Point, TouchPhase::Move, Modifiers::NONE);
                    events.push(Event::MouseWheel { unit, delta, phase, modifiers });
                }
            }
            None => self.leave(events),
        }
        let mut pointed = Pointed { hands: *hands, rays: [None; HANDS] };
        for side in 0..HANDS {
            let own = on(side) && !self.gliding[side] || self.pressed && self.side == side;
            if own {
                (pointed.hands[side].go, pointed.hands[side].stick) = (0.0, [0.0; 2]);
            }
            if hands[side].aim.is_some() && !self.gliding[side] {
                pointed.rays[side] = Some(hits[side].filter(Hit::is_on).map_or(IDLE, |hit| hit.distance));
            }
        }
        pointed
    }

    /// Lets go of everything.
    pub fn leave(&mut self, events: &mut Vec<Event>) {
        if let Some(at) = self.at.take() {
            if self.pressed {
                self.button(at, false, events);
            }
            events.push(Event::PointerGone);
        }
    }

    fn button(&mut self, pos: Pos2, pressed: bool, events: &mut Vec<Event>) {
        self.pressed = pressed;
        let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
        events.push(Event::PointerButton { pos, button, pressed, modifiers });
    }
}

#[cfg(test)]
mod tests {
    use super::super::board;
    use super::*;
    use crate::host::headset::eyes;
    use crate::raft::Head;
    use crate::xr;
    use glam::{DVec3, Quat, Vec3};

    const POINTS: [f32; 2] = [420.0, 560.0];

    fn board() -> Board {
        Board::before(Head::new(DVec3::new(0.0, 1.6, 0.0), Quat::IDENTITY))
    }

    /// Points at a share of the panel, from one side of the body.
    fn at(side: usize, x: f32, y: f32) -> Hand {
        let (middle, turn) = eyes::parts(board().pose());
        let place =
            middle.as_vec3() + turn * Vec3::new((x - 0.5) * board::SIZE[0], (0.5 - y) * board::SIZE[1], 0.0);
        let from = Vec3::new(if side == 0 { -0.2 } else { 0.2 }, 1.2, -0.3);
        let turn = Quat::from_rotation_arc(Vec3::NEG_Z, (place - from).normalize());
        Hand { aim: Some(xr::Pose { position: from.into(), orientation: turn.into() }), ..Hand::default() }
    }

    fn step(pointer: &mut Pointer, hands: [Hand; HANDS]) -> (Pointed, Vec<Event>) {
        let mut events = Vec::new();
        let pointed = pointer.step(&hands, &board(), POINTS, 0.01, &mut events);
        (pointed, events)
    }

    fn pressed(events: &[Event]) -> Vec<bool> {
        let one = |event: &Event| match event {
            Event::PointerButton { pressed, .. } => Some(*pressed),
            _ => None,
        };
        events.iter().filter_map(one).collect()
    }

    #[test]
    fn a_trigger_clicks_once_and_does_not_glide() {
        let mut pointer = Pointer::default();
        let (_, events) = step(&mut pointer, [Hand::default(), at(1, 0.5, 0.25)]);
        let [Event::PointerMoved(place)] = events[..] else { panic!("{events:?}") };
        assert!((place - Pos2::new(210.0, 140.0)).length() < 0.1, "{place}");
        for (go, clicks) in [(0.5, vec![]), (0.7, vec![true]), (0.5, vec![]), (0.3, vec![false])] {
            let (pointed, events) = step(&mut pointer, [Hand::default(), Hand { go, ..at(1, 0.5, 0.25) }]);
            assert_eq!(pressed(&events), clicks, "at {go}");
            assert_eq!(pointed.hands[1].go, 0.0);
        }
    }

    #[test]
    fn a_drag_goes_on_beside_the_panel() {
        let mut pointer = Pointer::default();
        let pull = |x| Hand { go: 1.0, ..at(1, x, 0.5) };
        let still = |x| [Hand::default(), at(1, x, 0.5)];
        step(&mut pointer, still(0.9));
        step(&mut pointer, [Hand::default(), pull(0.9)]);
        let (pointed, events) = step(&mut pointer, [Hand::default(), pull(1.3)]);
        assert!(matches!(events[..], [Event::PointerMoved(place)] if place.x > POINTS[0]), "{events:?}");
        assert_eq!(pointed.hands[1].go, 0.0, "it drags, and does not glide");
        let (_, events) = step(&mut pointer, still(1.3));
        assert_eq!(pressed(&events), [false]);
        let (_, events) = step(&mut pointer, still(1.3));
        assert_eq!(events, [Event::PointerGone]);
    }

    #[test]
    fn who_glides_onto_the_panel_goes_on_gliding() {
        let mut pointer = Pointer::default();
        let pull = |x| [Hand::default(), Hand { go: 1.0, ..at(1, x, 0.5) }];
        step(&mut pointer, pull(1.5));
        let (pointed, events) = step(&mut pointer, pull(0.5));
        assert_eq!((pointed.hands[1].go, events), (1.0, vec![]));
        step(&mut pointer, [Hand::default(), at(1, 0.5, 0.5)]);
        let (pointed, events) = step(&mut pointer, pull(0.5));
        assert_eq!((pointed.hands[1].go, pressed(&events)), (0.0, vec![true]));
    }

    #[test]
    fn the_other_hand_takes_over_by_its_trigger() {
        let mut pointer = Pointer::default();
        let both = |go| [Hand { go, ..at(0, 0.1, 0.1) }, at(1, 0.9, 0.9)];
        step(&mut pointer, both(0.0));
        assert!(pointer.shown().unwrap().0.x > 300.0, "the right hand points");
        let (_, events) = step(&mut pointer, both(1.0));
        assert!(pointer.shown().unwrap().0.x < 100.0 && pressed(&events) == [true], "{events:?}");
    }

    #[test]
    fn a_stick_scrolls_where_its_hand_points_and_steers_elsewhere() {
        let mut pointer = Pointer::default();
        let stick = |x| [Hand::default(), Hand { stick: [0.2, -1.0], ..at(1, x, 0.5) }];
        let (pointed, events) = step(&mut pointer, stick(0.5));
        let scrolled = |event: &Event| matches!(event, Event::MouseWheel { delta, .. } if delta.y < 0.0);
        assert!(events.iter().any(scrolled), "{events:?}");
        assert_eq!(pointed.hands[1].stick, [0.0; 2]);
        let (pointed, events) = step(&mut pointer, stick(1.5));
        assert!(!events.iter().any(scrolled));
        assert_eq!(pointed.hands[1].stick, [0.2, -1.0]);
    }

    #[test]
    fn a_hand_that_is_lost_lets_go() {
        let mut pointer = Pointer::default();
        step(&mut pointer, [Hand::default(), at(1, 0.5, 0.5)]);
        step(&mut pointer, [Hand::default(), Hand { go: 1.0, ..at(1, 0.5, 0.5) }]);
        let (_, events) = step(&mut pointer, [Hand::default(); 2]);
        assert_eq!(pressed(&events), [false]);
        assert_eq!(events.last(), Some(&Event::PointerGone));
        assert!(!pointer.is_busy());
    }
}
