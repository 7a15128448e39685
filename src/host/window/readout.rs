//! What frames cost, in the window's title: it is seen without a panel over the picture.

use crate::host::FrameRecord;
use std::time::{Duration, Instant};

/// Numbers that change more often cannot be read.
const EVERY: Duration = Duration::from_millis(500);

/// Means over half a second.
#[derive(Debug)]
pub struct Readout {
    shown: bool,
    since: Instant,
    frames: u32,
    sea: f64,
}

/// The title without numbers.
pub const TITLE: &str = "Swell";

impl Readout {
    /// Not shown at first.
    pub fn new() -> Self {
        Self { shown: false, since: Instant::now(), frames: 0, sea: 0.0 }
    }

    /// Shows the numbers, or hides them: then the plain title is returned.
    pub fn toggle(&mut self) -> Option<&'static str> {
        *self = Self { shown: !self.shown, ..Self::new() };
        (!self.shown).then_some(TITLE)
    }

    /// Counts a frame; returns a title when it is time for one.
    pub fn frame(&mut self, record: &FrameRecord) -> Option<String> {
        if !self.shown {
            return None;
        }
        self.frames += 1;
        self.sea += record.sea_milliseconds;
        let (passed, frames) = (self.since.elapsed(), f64::from(self.frames));
        if passed < EVERY {
            return None;
        }
        let seconds = passed.as_secs_f64();
        let title = format!(
            "{TITLE}: {:.1} ms, {:.0} frames/s, sea {:.1} ms, {} draws, {} triangles",
            1e3 * seconds / frames,
            frames / seconds,
            self.sea / frames,
            record.draws,
            record.triangles
        );
        *self = Self { shown: true, ..Self::new() };
        Some(title)
    }
}
