//! Which frames of an animation, and when each of them is.
use std::{num::NonZeroU64, ops::Range, str::FromStr};

/// Most frames of one animation: more than a year at 240 frames a second.
const MAX_FRAMES: u64 = 10_000_000_000;

/// A half-open range of frame indices, as `--frames N` or `--frames A..B`; never empty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frames {
    first: u64,
    count: NonZeroU64,
}

/// Errors of frame ranges and their times.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FramesError {
    /// Neither a number nor a range.
    #[error("frames {given:?} is neither a number of frames, such as 60, nor a range, such as 60..120")]
    Form {
        /// What was given.
        given: String,
    },
    /// A range without frames.
    #[error("frames {given:?} holds no frame: the end of A..B is excluded, so B must exceed A")]
    Empty {
        /// What was given.
        given: String,
    },
    /// Too large a number.
    #[error("frames {given:?} is out of range: at most {MAX_FRAMES}")]
    TooMany {
        /// What was given.
        given: String,
    },
    /// Frames a second that make no time.
    #[error("{fps} frames a second is out of range: 0.001 to 10000")]
    Rate {
        /// What was given.
        fps: f64,
    },
    /// A start that is no time.
    #[error("start time {start} s is out of range: -1e9 to 1e9")]
    Start {
        /// What was given.
        start: f64,
    },
}

impl Frames {
    /// The frames `range`.
    ///
    /// # Errors
    /// [`FramesError::Empty`] and [`FramesError::TooMany`].
    pub fn new(range: Range<u64>) -> Result<Self, FramesError> {
        let given = || format!("{}..{}", range.start, range.end);
        if range.end > MAX_FRAMES {
            return Err(FramesError::TooMany { given: given() });
        }
        match NonZeroU64::new(range.end.saturating_sub(range.start)) {
            Some(count) => Ok(Self { first: range.start, count }),
            None => Err(FramesError::Empty { given: given() }),
        }
    }

    /// How many.
    pub fn count(self) -> u64 {
        self.count.get()
    }

    /// Their indices.
    pub fn indices(self) -> Range<u64> {
        self.first..self.first + self.count.get()
    }
}

impl FromStr for Frames {
    type Err = FramesError;

    fn from_str(given: &str) -> Result<Self, FramesError> {
        let number = |text: &str| {
            if text.is_empty() || !text.bytes().all(|byte| byte.is_ascii_digit()) {
                return Err(FramesError::Form { given: given.to_owned() });
            }
            text.parse().map_err(|_| FramesError::TooMany { given: given.to_owned() })
        };
        let range = match given.split_once("..") {
            Some((first, end)) => number(first)?..number(end)?,
            None => 0..number(given)?,
        };
        Self::new(range)
    }
}

/// When frames are: frame i at `start + i / fps`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    start: f64,
    fps: f64,
}

impl Clock {
    /// A clock from its start, seconds, and rate, frames a second.
    ///
    /// # Errors
    /// [`FramesError::Start`] and [`FramesError::Rate`] for what is not finite or out of range.
    pub fn new(start: f64, fps: f64) -> Result<Self, FramesError> {
        if !(0.001..=10_000.0).contains(&fps) {
            return Err(FramesError::Rate { fps });
        }
        if !(-1e9..=1e9).contains(&start) {
            return Err(FramesError::Start { start });
        }
        Ok(Self { start, fps })
    }

    /// Seconds; the same for a frame whatever range it is part of.
    pub fn time(self, frame: u64) -> f64 {
        self.start + frame as f64 / self.fps
    }

    /// Time of frame 0, seconds.
    pub fn start(self) -> f64 {
        self.start
    }

    /// Frames a second.
    pub fn fps(self) -> f64 {
        self.fps
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_and_a_range() {
        assert_eq!("8".parse::<Frames>().unwrap().indices(), 0..8);
        assert_eq!("3..5".parse::<Frames>().unwrap().indices(), 3..5);
        assert_eq!("3..5".parse::<Frames>().unwrap().count(), 2);
    }

    #[test]
    fn what_is_no_range_is_named() {
        for form in ["", "x", "1..", "..2", "-1", "1...3", "1..2..3", "+1", "1.5", " 1"] {
            assert_eq!(form.parse::<Frames>(), Err(FramesError::Form { given: form.to_owned() }));
        }
        for empty in ["0", "5..5", "6..5"] {
            assert!(matches!(empty.parse::<Frames>(), Err(FramesError::Empty { .. })), "{empty}");
        }
        for large in ["99999999999", "1..99999999999999999999999"] {
            assert!(matches!(large.parse::<Frames>(), Err(FramesError::TooMany { .. })), "{large}");
        }
    }

    #[test]
    fn clocks() {
        assert_eq!(Clock::new(2.0, 30.0).unwrap().time(15), 2.5);
        for fps in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(Clock::new(0.0, fps), Err(FramesError::Rate { .. })));
        }
        assert!(matches!(Clock::new(f64::NAN, 1.0), Err(FramesError::Start { .. })));
    }
}
