//! The sea's time in a window: even steps that follow the clock on the wall.
//!
//! A frame's sea is begun a frame ahead, when its time can only be guessed. The guess is what is drawn; how far it was off is
//! made good little by little. So no step is made twice, the sea never runs backwards, and one slow frame does not jerk it.

/// Share of the error that one frame makes good.
const FOLLOW: f64 = 0.1;
/// Share of a new frame's length in the length expected of the next.
const LEARN: f64 = 0.1;
/// A frame that is further off was a pause, seconds: the sea goes on from where it was.
const PAUSE: f64 = 0.5;

/// Times to draw, seconds.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    /// The latest time handed out.
    time: f64,
    /// The sea's time less the wall's.
    offset: f64,
    /// Length of a frame, as expected.
    frame: f64,
    /// From now until a frame drawn now is seen.
    delay: f64,
    /// When the frame before began.
    before: Option<f64>,
}

impl Clock {
    /// For a screen that shows a picture every `refresh` seconds. The first time is 0.
    pub const fn new(refresh: f64) -> Self {
        Self { time: 0.0, offset: 0.0, frame: refresh, delay: refresh, before: None }
    }

    /// The screen shows a picture every `refresh` seconds from now on.
    pub const fn set_refresh(&mut self, refresh: f64) {
        self.delay = refresh;
    }

    /// The time to show in the frame after this one, which begins when the wall's clock says `now`.
    pub fn following(&mut self, now: f64) -> f64 {
        let Some(before) = self.before.replace(now) else {
            // This frame shows the first time.
            self.offset = self.time - (now + self.delay);
            self.time += self.frame;
            return self.time;
        };
        let took = (now - before).max(0.0);
        if took > PAUSE {
            self.offset -= took - self.frame;
        } else {
            self.frame += LEARN * (took - self.frame);
        }
        let even = self.time + self.frame;
        let seen = now + self.frame + self.delay + self.offset;
        // Never back, and never more than twice as fast as the frames.
        self.time += (even - self.time + FOLLOW * (seen - even)).clamp(0.0, 2.0 * self.frame);
        self.time
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const REFRESH: f64 = 1.0 / 60.0;

    #[test]
    fn even_frames_make_even_steps() {
        let mut clock = Clock::new(REFRESH);
        for frame in 0..1000 {
            let time = clock.following(7.0 + f64::from(frame) * REFRESH);
            assert!((time - f64::from(frame + 1) * REFRESH).abs() < 1e-9, "{frame}: {time}");
        }
    }

    #[test]
    fn slow_frames_are_followed_to_their_own_time() {
        let mut clock = Clock::new(REFRESH);
        let (slow, mut now, mut time) = (0.11, 3.0, 0.0);
        for _ in 0..200 {
            let next = clock.following(now);
            assert!(next > time, "forwards");
            (time, now) = (next, now + slow);
        }
        // The latest time is that of the frame that begins at `now`.
        let wanted = now - 3.0;
        assert!((time - wanted).abs() < 0.01, "{time} for {wanted}");
    }

    #[test]
    fn one_late_frame_bends_the_time_and_does_not_break_it() {
        let mut clock = Clock::new(REFRESH);
        let mut times = vec![];
        let mut now = 0.0;
        for frame in 0..200 {
            now += if frame == 100 { 4.0 * REFRESH } else { REFRESH };
            times.push(clock.following(now));
        }
        let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(steps.iter().all(|step| (0.9 * REFRESH..=2.0 * REFRESH).contains(step)), "{steps:?}");
        // The three refreshes lost are made good in the end.
        assert!((times[199] - 203.0 * REFRESH).abs() < 0.1 * REFRESH, "{}", times[199]);
    }

    #[test]
    fn a_pause_is_left_out() {
        let mut clock = Clock::new(REFRESH);
        let before = (0..50).map(|frame| clock.following(f64::from(frame) * REFRESH)).next_back().unwrap();
        let after = clock.following(3600.0);
        assert!(after > before && after - before <= 2.0 * REFRESH, "{before} {after}");
        let next = clock.following(3600.0 + REFRESH);
        assert!((next - after - REFRESH).abs() < 0.1 * REFRESH);
    }
}
