//! What is given up when frames run late, and taken back when they no longer do.
//!
//! A ladder of levels, the best first: views get smaller, then the quadtree's preset coarser, then the sea's smaller waves are
//! stepped every second frame. Down quickly, since a person in a headset feels each late frame; up slowly, and the more slowly
//! the more often that was too early: a headset that can hold one level and not the one above would else swing between them.

mod ladder;
mod punctuality;

pub use ladder::{Ladder, Level};
pub use punctuality::Punctuality;

/// Frames over which late ones are counted: about a second.
const WINDOW: u32 = 90;
/// Late frames among them that are too many.
const TOO_MANY: u32 = 9;
/// Late frames among them that do not disturb: a system has other things to do now and then.
const PARDONED: u32 = 1;
/// Frames after a change that say nothing: things are made anew meanwhile.
const SETTLE: u32 = 45;
/// Undisturbed frames before a level is taken back: 20 to 25 seconds.
const CALM: u32 = 20 * WINDOW;
/// The same, at most: about five minutes.
const MOST_CALM: u32 = 16 * CALM;

/// A change of level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Change {
    /// Number of the level before.
    pub from: usize,
    /// Number of the level now.
    pub to: usize,
    /// Late frames that were counted where it went down.
    pub late: u32,
    /// Among so many.
    pub frames: u32,
}

/// Decides the level, frame by frame.
#[derive(Clone, Debug)]
pub struct Fallback {
    ladder: Ladder,
    level: usize,
    /// Frames to come that say nothing.
    settling: u32,
    frames: u32,
    late: u32,
    /// Frames without too many late ones since the latest change or disturbance.
    calm: u32,
    /// Calm frames that are wanted before a level is taken back.
    patience: u32,
    /// Frames since a level was taken back.
    since_up: Option<u32>,
}

impl Fallback {
    /// Begins on level `level` of `ladder`, where an earlier run ended.
    pub fn new(ladder: Ladder, level: usize) -> Self {
        let level = level.min(ladder.last());
        let (settling, patience) = (SETTLE, CALM);
        Self { ladder, level, settling, frames: 0, late: 0, calm: 0, patience, since_up: None }
    }

    /// The level that frames are made on.
    pub fn level(&self) -> Level {
        self.ladder.level(self.level)
    }

    /// Its number, 0 for the best.
    pub const fn number(&self) -> usize {
        self.level
    }

    /// Learns that a frame was shown, `late` or in time, and says whether the level changes after it.
    pub fn frame(&mut self, late: bool) -> Option<Change> {
        if let Some(since) = &mut self.since_up {
            *since = since.saturating_add(1);
        }
        if self.settling > 0 {
            self.settling -= 1;
            return None;
        }
        self.frames += 1;
        self.late += u32::from(late);
        if self.late >= TOO_MANY && self.level < self.ladder.last() {
            // Back soon after it was left: this level is what can be held, and the next try is to come later.
            self.patience = match self.since_up.take() {
                Some(since) if since <= self.patience => (2 * self.patience).min(MOST_CALM),
                _ => CALM,
            };
            return Some(self.go(self.level + 1));
        }
        if self.frames < WINDOW {
            return None;
        }
        self.calm = if self.late <= PARDONED { self.calm + self.frames } else { 0 };
        (self.frames, self.late) = (0, 0);
        if self.calm >= self.patience && self.level > 0 {
            self.since_up = Some(0);
            return Some(self.go(self.level - 1));
        }
        None
    }

    fn go(&mut self, to: usize) -> Change {
        let change = Change { from: self.level, to, late: self.late, frames: self.frames };
        (self.level, self.settling) = (to, SETTLE);
        (self.frames, self.late, self.calm) = (0, 0, 0);
        change
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lod::Quality;
    use proptest::prelude::*;

    fn fallback(level: usize) -> Fallback {
        Fallback::new(Ladder::new(Quality::High), level)
    }

    /// Changes over `frames` frames, with the frame each came after; `late` knows the level.
    fn run(
        fallback: &mut Fallback,
        frames: u32,
        mut late: impl FnMut(u32, usize) -> bool,
    ) -> Vec<(u32, Change)> {
        let step = |frame| Some((frame, fallback.frame(late(frame, fallback.number()))?));
        (0..frames).filter_map(step).collect()
    }

    #[test]
    fn frames_in_time_change_nothing() {
        assert_eq!(run(&mut fallback(0), 100_000, |_, _| false), []);
    }

    #[test]
    fn late_frames_reach_the_end_of_the_ladder_within_seconds_and_stay_there() {
        let mut late = fallback(0);
        let changes = run(&mut late, 1000, |_, _| true);
        assert_eq!(changes.len(), 6);
        assert!(changes.last().unwrap().0 < 6 * (SETTLE + TOO_MANY) + SETTLE);
        assert_eq!(late.number(), 6);
        assert_eq!(run(&mut late, 10_000, |_, _| true), []);
    }

    #[test]
    fn what_was_given_up_comes_back_when_the_trouble_has_passed() {
        let mut late = fallback(6);
        let changes = run(&mut late, 7 * (CALM + WINDOW), |_, _| false);
        assert_eq!(late.number(), 0);
        assert!(changes.iter().all(|(_, change)| change.to + 1 == change.from));
    }

    #[test]
    fn a_level_that_cannot_be_held_is_tried_less_and_less_often() {
        // Levels below the third are too much, for an hour at 90 Hz.
        let changes = run(&mut fallback(3), 324_000, |_, level| level < 3);
        let tries: Vec<_> = changes.iter().filter(|(_, change)| change.to < change.from).collect();
        assert!(tries.len() <= 4 + 324_000 / MOST_CALM as usize, "{} tries", tries.len());
        let waits: Vec<_> = tries.windows(2).map(|pair| pair[1].0 - pair[0].0).collect();
        assert!(waits.windows(2).all(|pair| pair[1] + WINDOW >= pair[0]), "{waits:?}");
    }

    #[test]
    fn a_late_frame_now_and_then_is_pardoned() {
        let mut late = fallback(1);
        assert_eq!(run(&mut late, 3 * CALM, |frame, _| frame % 200 == 0).len(), 1);
        assert_eq!(late.number(), 0);
        // Between calm and trouble nothing moves.
        assert_eq!(run(&mut fallback(1), 100_000, |frame, _| frame % 20 == 0), []);
    }

    proptest! {
        #[test]
        fn whatever_happens_it_moves_one_level_at_a_time_and_not_at_once(
            lates in prop::collection::vec(any::<bool>(), 0..4000),
            level in 0_usize..9,
        ) {
            let mut fallback = fallback(level);
            let (mut at, mut since) = (fallback.number(), u32::MAX);
            for late in lates {
                since = since.saturating_add(1);
                if let Some(change) = fallback.frame(late) {
                    prop_assert_eq!(change.from, at);
                    prop_assert_eq!(change.from.abs_diff(change.to), 1);
                    prop_assert!(change.to <= fallback.ladder.last());
                    prop_assert!(since > SETTLE, "changed again after {} frames", since);
                    (at, since) = (change.to, 0);
                }
                prop_assert_eq!(fallback.number(), at);
            }
        }

        #[test]
        fn it_goes_down_only_for_late_frames_and_up_only_without(
            share in 0_u32..=100,
            level in 1_usize..6,
        ) {
            // `share` of a hundred frames late, spread evenly.
            let late = |frame: u32, _| (frame + 1) * share / 100 > frame * share / 100;
            let changes = run(&mut fallback(level), 3000, late);
            let (down, up): (Vec<_>, Vec<_>) = changes.into_iter().partition(|(_, change)| change.to > change.from);
            prop_assert!(down.is_empty() || share >= 9, "{share} of 100 are few: {down:?}");
            prop_assert!(up.is_empty() || share <= 2, "{share} of 100 are many: {up:?}");
            prop_assert!(share < 13 || !down.is_empty());
        }

        #[test]
        fn a_headset_that_can_hold_a_level_ends_on_it_or_beside_it(holds in 0_usize..=6, from in 0_usize..=6) {
            let mut fallback = fallback(from);
            run(&mut fallback, 40 * CALM, |_, level| level < holds);
            prop_assert!(fallback.number() == holds || fallback.number() + 1 == holds);
        }
    }
}
