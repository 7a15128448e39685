//! Which frames are late.

/// A display's time between two frames that is no lateness but a pause, seconds.
const PAUSE: f64 = 1.0;

/// Tells late frames by the times at which they are seen.
#[derive(Clone, Copy, Debug)]
pub struct Punctuality {
    /// Refreshes for each frame.
    refreshes: f64,
    latest: Option<f64>,
}

impl Punctuality {
    /// Where each frame is drawn, or every other one and the runtime makes those between (`space_warp`).
    pub const fn new(space_warp: bool) -> Self {
        Self { refreshes: if space_warp { 2.0 } else { 1.0 }, latest: None }
    }

    /// Whether the frame seen at `seconds`, with `period` seconds between refreshes, is a refresh or more later than it could
    /// have been; nothing for a first one, and after a pause.
    pub fn frame(&mut self, seconds: f64, period: f64) -> Option<bool> {
        let since = seconds - self.latest.replace(seconds)?;
        (since < PAUSE.max(4.0 * period)).then_some(since > (self.refreshes + 0.5) * period)
    }

    /// Frames are interrupted: the next one is a first one.
    pub const fn interrupt(&mut self) {
        self.latest = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lateness_is_told_by_the_display() {
        let period = 1.0 / 72.0;
        let mut each = Punctuality::new(false);
        let mut told = |refresh: f64| each.frame(refresh * period, period);
        assert_eq!(
            [0.0, 1.0, 2.0, 4.0, 5.0].map(&mut told),
            [None, Some(false), Some(false), Some(true), Some(false)]
        );
        assert_eq!(told(100.0), None, "a pause");
        let mut other = Punctuality::new(true);
        let mut told = |refresh: f64| other.frame(refresh * period, period);
        assert_eq!([0.0, 2.0, 5.0].map(&mut told), [None, Some(false), Some(true)]);
        other.interrupt();
        assert_eq!(other.frame(6.0 * period, period), None);
        // A slow display, as tests have.
        let mut slow = Punctuality::new(false);
        assert_eq!([0.0, 0.2, 0.6].map(|at| slow.frame(at, 0.2)), [None, Some(false), Some(true)]);
    }
}
