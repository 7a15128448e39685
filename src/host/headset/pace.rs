//! When a frame is: the sea is stepped ahead for the time at which the next frame is expected to be seen, and anew where
//! the runtime then says another time.

use crate::sea::{SeaAhead, SeaError, SeaMaps};
use crate::xr::FrameTime;

/// A guess that is off by less than this is as good: waves of the steepest seas move a millimetre meanwhile.
const TOLERANCE: f64 = 250e-6;

/// Frames further apart than this, seconds, are no rhythm.
const LONGEST: f64 = 0.25;

/// The sea's clock.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pace {
    /// The runtime's time at which the sea's is 0; nothing before a session's first frame.
    origin: Option<f64>,
    /// Time of the latest frame, and the period after it.
    latest: Option<(f64, f64)>,
    /// Time of the step that is on its way.
    ahead: Option<f64>,
    /// Steps that were for nothing.
    missed: u64,
}

impl Pace {
    /// Another session, whose runtime may have another clock: the sea goes on where it was.
    pub const fn forget_clock(&mut self) {
        self.origin = None;
    }

    /// The sea's time of a frame, seconds.
    pub fn time_of(&mut self, time: FrameTime) -> f64 {
        let next = self.latest.map_or(0.0, |(latest, period)| latest + period);
        time.seconds - *self.origin.get_or_insert(time.seconds - next)
    }

    /// The sea at `time`, and the time in seconds it is stepped for, which is within a quarter of a millisecond. Begins the
    /// step to the frame after it.
    ///
    /// # Errors
    /// A worker failed.
    pub fn maps<'a>(
        &mut self,
        sea: &'a mut SeaAhead,
        time: FrameTime,
    ) -> Result<(f64, &'a SeaMaps), SeaError> {
        let seconds = self.time_of(time);
        let seconds = match self.ahead {
            Some(guess) if (guess - seconds).abs() <= TOLERANCE => guess,
            guess => {
                self.missed += u64::from(guess.is_some());
                seconds
            }
        };
        let following = seconds + self.step(seconds, time.period);
        self.latest = Some((seconds, time.period));
        sea.begin(seconds)?;
        self.ahead = None;
        let maps = sea.next(Some(following))?;
        self.ahead = Some(following);
        Ok((seconds, maps))
    }

    /// From a frame to the next: as from the one before, so that who misses every other refresh guesses right too.
    fn step(&self, seconds: f64, period: f64) -> f64 {
        let before = self.latest.map_or(period, |(latest, _)| seconds - latest);
        if (period..=LONGEST).contains(&before) { before } else { period }
    }

    /// Steps that were thrown away because a frame was seen at another time than expected.
    pub const fn missed(&self) -> u64 {
        self.missed
    }
}
