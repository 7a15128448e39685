//! When a frame is, and the sea at that time.
//!
//! While one frame is drawn the sea is stepped for the time at which the next is expected to be seen. The runtime has the
//! last word: where it says another time, the step is made anew. Who misses refreshes irregularly would so step twice a
//! frame; so nothing is stepped ahead until frames have come as expected again.

use crate::sea::{SeaAhead, SeaError, SeaMaps};
use crate::xr::FrameTime;

/// A guess that is off by less than this, seconds, is as good: waves of the steepest seas move a millimetre meanwhile.
const TOLERANCE: f64 = 250e-6;
/// Frames further apart than this, seconds, are no rhythm.
const LONGEST: f64 = 0.25;
/// Frames that have to come as expected before a step is made ahead again.
const TRUSTED: u32 = 2;

/// The sea's clock.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    /// The runtime's time at which the sea's is 0; nothing before a session's first frame.
    origin: Option<f64>,
    guess: Guess,
    /// Time of the step that is on its way.
    ahead: Option<f64>,
    /// Steps that were for nothing.
    missed: u64,
}

impl Default for Pace {
    fn default() -> Self {
        Self { origin: None, guess: Guess { latest: None, trust: TRUSTED }, ahead: None, missed: 0 }
    }
}

impl Pace {
    /// Another session, whose runtime may have another clock: the sea goes on where it was.
    pub const fn forget_clock(&mut self) {
        self.origin = None;
    }

    /// The sea's time of a frame, seconds.
    pub fn time_of(&mut self, time: FrameTime) -> f64 {
        let next = self.guess.latest.map_or(0.0, |latest| latest.next);
        time.seconds - *self.origin.get_or_insert(time.seconds - next)
    }

    /// Sees to it that the step to the frame of `time` is on its way, and returns the time in seconds it is made for, which
    /// is the frame's own within a quarter of a millisecond.
    ///
    /// # Errors
    /// A worker failed.
    pub fn begin(&mut self, sea: &mut SeaAhead, time: FrameTime) -> Result<f64, SeaError> {
        let seconds = self.time_of(time);
        self.guess.learn(seconds, time.period);
        let seconds = match self.ahead.take() {
            Some(ahead) if (ahead - seconds).abs() <= TOLERANCE => ahead,
            ahead => {
                self.missed += u64::from(ahead.is_some());
                seconds
            }
        };
        sea.begin(seconds)?;
        Ok(seconds)
    }

    /// The sea of the step that [`Self::begin`] saw to; begins the one to the frame after it, where that can be told.
    ///
    /// # Errors
    /// A worker failed.
    pub fn maps<'a>(&mut self, sea: &'a mut SeaAhead) -> Result<&'a SeaMaps, SeaError> {
        let following = self.guess.next();
        let maps = sea.next(following)?;
        self.ahead = following;
        Ok(maps)
    }

    /// Steps that were thrown away because a frame was seen at another time than expected.
    pub const fn missed(&self) -> u64 {
        self.missed
    }
}

/// When the next frame will be.
#[derive(Clone, Copy, Debug)]
struct Guess {
    latest: Option<Latest>,
    /// Frames that came as expected, up to [`TRUSTED`].
    trust: u32,
}

#[derive(Clone, Copy, Debug)]
struct Latest {
    seconds: f64,
    /// When the frame after it was expected.
    next: f64,
}

impl Guess {
    /// A frame is at `seconds`, with `period` seconds to the next refresh. The next one is as far away as this one was from
    /// the one before, so that who misses every other refresh is understood too.
    fn learn(&mut self, seconds: f64, period: f64) {
        let since = match self.latest {
            Some(latest) => {
                let expected = (latest.next - seconds).abs() <= TOLERANCE;
                self.trust = if expected { (self.trust + 1).min(TRUSTED) } else { 0 };
                seconds - latest.seconds
            }
            None => period,
        };
        // A refresh rate that rises ends a rhythm as much as one that falls.
        let rhythm = (period - TOLERANCE..=LONGEST).contains(&since);
        self.latest = Some(Latest { seconds, next: seconds + if rhythm { since } else { period } });
    }

    fn next(&self) -> Option<f64> {
        self.latest.filter(|_| self.trust >= TRUSTED).map(|latest| latest.next)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD: f64 = 1.0 / 72.0;

    /// Guesses made after each of these frames, counted in periods, and whether they came true.
    fn hits(frames: &[u32]) -> Vec<Option<bool>> {
        let mut guess = Pace::default().guess;
        let times: Vec<f64> = frames.iter().map(|&frame| f64::from(frame) * PERIOD).collect();
        let after = times.iter().skip(1);
        times
            .iter()
            .zip(after)
            .map(|(&time, next)| {
                guess.learn(time, PERIOD);
                guess.next().map(|guess| (guess - next).abs() <= TOLERANCE)
            })
            .collect()
    }

    #[test]
    fn regular_frames_are_all_expected() {
        assert_eq!(hits(&[0, 1, 2, 3, 4, 5]), [Some(true); 5]);
    }

    #[test]
    fn half_the_rate_is_a_rhythm_too() {
        let (hit, miss) = (Some(true), Some(false));
        assert_eq!(hits(&[0, 1, 2, 4, 6, 8, 10, 12]), [hit, hit, miss, None, None, hit, hit][..7]);
    }

    #[test]
    fn irregular_frames_cost_one_wrong_step_and_not_one_each() {
        let hits = hits(&[0, 1, 3, 4, 9, 11, 12, 17, 18, 20, 25]);
        assert_eq!(hits.iter().filter(|hit| **hit == Some(false)).count(), 1, "{hits:?}");
    }

    #[test]
    fn a_pause_is_no_rhythm() {
        let hits = hits(&[0, 1, 2, 200, 201, 202, 203, 204]);
        assert_eq!(hits[2], Some(false));
        assert_eq!(hits.last(), Some(&Some(true)));
    }
}
