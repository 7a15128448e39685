//! Simulating the next frame while this one is drawn: two buffers and a driver that never leaves the pool.
use super::{Sea, SeaError, SeaMaps};
use crate::jobs::{Giver, Taker, Workers, handover};
use std::{
    any::Any,
    panic::{AssertUnwindSafe, catch_unwind},
    time::{Duration, Instant},
};

/// A sea stepped one frame ahead of whoever draws it.
///
/// One worker of the pool drives the steps and takes part in them; it sleeps in between. Buffers change hands by move,
/// so that a frame allocates nothing, and without a lock. The pool is given away for that reason: other work would wait
/// for ever on a pool of one thread.
///
/// Where [cascades take turns](Self::take_turns), those beyond the first are stepped in every second frame only, and what a
/// frame does not step it takes over from the one before: maps change places, nothing is copied.
#[derive(Debug)]
pub struct SeaAhead {
    asked: Giver<Asked>,
    finished: Taker<Finished>,
    /// The maps handed out last, free again at the next call.
    front: Option<SeaMaps>,
    /// Maps that no step uses: the second buffer, until the first step begins.
    spare: Option<SeaMaps>,
    /// The step that is on its way: its time and its cascades.
    pending: Option<(f64, Cascades)>,
    /// Whether cascades take turns.
    in_turns: bool,
    /// Cascades can be taken over from the front maps: they are those of a frame.
    whole: bool,
    /// Counts steps, for turns.
    steps: u32,
    /// How long the step took whose maps were handed out last.
    took: Duration,
    workers: Workers,
}

/// Cascades of a step, a bit for each.
type Cascades = u32;
/// All of them.
const ALL: Cascades = Cascades::MAX;
/// A step to make: its time, its cascades and what it fills.
type Asked = (f64, Cascades, SeaMaps);
/// What became of it: how long it took, and what it was to fill.
type Finished = (Result<Duration, SeaError>, SeaMaps);

impl SeaAhead {
    /// Puts `sea` to work on `workers`.
    pub fn new(sea: Sea, workers: Workers) -> Self {
        let (asked, to_make) = handover(1);
        let (made, finished) = handover(1);
        let (front, spare) = (Some(sea.new_maps()), Some(sea.new_maps()));
        workers.spawn(move || drive(sea, to_make, made));
        let (pending, in_turns, whole, steps) = (None, false, false, 0);
        Self { asked, finished, front, spare, pending, in_turns, whole, steps, took: Duration::ZERO, workers }
    }

    /// From the next step that begins: whether cascades beyond the first are stepped in turns, each in every second frame.
    pub const fn take_turns(&mut self, in_turns: bool) {
        self.in_turns = in_turns;
    }

    /// Begins the step to `time`, unless it is already on its way. One to another time, which somebody began and then
    /// gave up, is waited for and dropped.
    ///
    /// # Errors
    /// [`SeaError::Gone`] when the driver has ended.
    pub fn begin(&mut self, time: f64) -> Result<(), SeaError> {
        if let Some((begun, _)) = self.pending {
            if begun == time {
                return Ok(());
            }
            // What became of it is nobody's business any more.
            let _dropped = self.next(None);
            // It was for another time: nothing is to be taken over from it.
            self.whole = false;
        }
        let maps = self.spare.take().or_else(|| self.front.take()).ok_or(SeaError::Gone)?;
        self.steps = self.steps.wrapping_add(1);
        let cascades = if self.in_turns && self.whole { turn(self.steps) } else { ALL };
        self.asked.give((time, cascades, maps)).map_err(|(_, _, maps)| {
            self.spare = Some(maps);
            SeaError::Gone
        })?;
        self.pending = Some((time, cascades));
        Ok(())
    }

    /// Waits for the step that is on its way, begins the one to `following`, and returns the finished maps, which stay
    /// valid until the next call.
    ///
    /// # Errors
    /// [`SeaError::NotBegun`] when no step is on its way; those of [`Sea::step`]; [`SeaError::Panicked`] when a job
    /// panicked. After an error the next `begin` starts afresh.
    pub fn next(&mut self, following: Option<f64>) -> Result<&SeaMaps, SeaError> {
        let Some((_, cascades)) = self.pending else { return Err(SeaError::NotBegun) };
        let finished = self.finished.take();
        self.pending = None;
        let (result, mut maps) = finished.ok_or(SeaError::Gone)?;
        match result {
            Ok(took) => self.took = took,
            Err(error) => {
                // What it has left half written is filled anew, all of it.
                (self.spare, self.whole) = (Some(maps), false);
                return Err(error);
            }
        }
        if let Some(front) = &mut self.front {
            for (index, (new, old)) in maps.cascades.iter_mut().zip(&mut front.cascades).enumerate() {
                if cascades & (1 << index) == 0 {
                    std::mem::swap(new, old);
                }
            }
        }
        self.whole = true;
        self.spare = self.front.replace(maps);
        if let Some(time) = following {
            self.begin(time)?;
        }
        self.front.as_ref().ok_or(SeaError::Gone)
    }

    /// The kernel's numbers of the threads that step, see [`Workers::kernel_ids`].
    pub fn kernel_ids(&self) -> Vec<u32> {
        self.workers.kernel_ids()
    }

    /// How long the step took whose maps were handed out last.
    pub const fn last_step(&self) -> Duration {
        self.took
    }
}

/// Makes the steps asked for, until the owner has gone.
fn drive(mut sea: Sea, mut asked: Taker<Asked>, mut finished: Giver<Finished>) {
    while let Some((time, cascades, mut maps)) = asked.take() {
        let began = Instant::now();
        let step = AssertUnwindSafe(|| sea.step_some(time, cascades, &mut maps));
        let result = catch_unwind(step).unwrap_or_else(|panic| {
            sea.forget();
            Err(SeaError::Panicked { time, message: words(&*panic) })
        });
        if finished.give((result.map(|()| began.elapsed()), maps)).is_err() {
            return;
        }
    }
}

/// Cascades of the step of this number: the first, and every other one of the others. None waits twice in a row.
const fn turn(step: u32) -> Cascades {
    1 | if step.is_multiple_of(2) { 0x5555_5555 } else { 0xaaaa_aaaa }
}

/// What a panic said.
fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no message".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sea::{CascadeSettings, SeaSettings, foam::Fading};

    #[test]
    fn in_turns_each_cascade_is_at_most_a_frame_old_and_the_first_is_never() {
        let cascade = |patch_size, band| CascadeSettings {
            resolution: 16,
            patch_size,
            band,
            ..CascadeSettings::default()
        };
        let cascades =
            vec![cascade(200.0, [0.0, 0.1]), cascade(60.0, [0.1, 0.5]), cascade(10.0, [0.5, f64::INFINITY])];
        let settings = SeaSettings { cascades, ..SeaSettings::default() };
        let mut plain = Sea::new(&settings).unwrap();
        let mut maps_at = |time| {
            let mut maps = plain.new_maps();
            plain.step(time, &mut maps).unwrap();
            maps
        };
        let mut ahead = SeaAhead::new(Sea::new(&settings).unwrap(), Workers::new(1).unwrap());
        ahead.take_turns(true);
        let mut waited = 2;
        let times: Vec<f64> = (0..8).map(|frame| f64::from(frame) * 0.1).collect();
        ahead.begin(times[0]).unwrap();
        for (frame, &time) in times.iter().enumerate() {
            // In the fourth frame the next one is expected at another time than it comes.
            let next = times.get(frame + 1).map(|next| if frame == 4 { 17.0 } else { *next });
            ahead.begin(time).unwrap();
            let maps = ahead.next(next).unwrap();
            let now = maps_at(time);
            let old: Vec<_> = (0..3).filter(|&i| maps.cascades[i] != now.cascades[i]).collect();
            match frame {
                0 | 5 => assert_eq!(old, [0_usize; 0], "frame {frame}: there is nothing to take over"),
                _ => {
                    let [waits] = old[..] else { panic!("frame {frame}: {old:?} are old") };
                    assert_eq!(waits, if waited == 1 { 2 } else { 1 }, "frame {frame}: in turns");
                    let before = maps_at(times[frame - 1]);
                    assert!(maps.cascades[waits] == before.cascades[waits], "frame {frame}: one frame old");
                    waited = waits;
                }
            }
        }
        ahead.take_turns(false);
        ahead.begin(2.0).unwrap();
        assert!(*ahead.next(None).unwrap() == maps_at(2.0));
    }

    #[test]
    fn a_panic_is_an_error_and_not_a_hang() {
        let mut settings = SeaSettings::default();
        settings.cascades[0].resolution = 16;
        let mut sea = Sea::new(&settings).unwrap();
        // No clock has zero ticks: the step divides by them.
        sea.fading = Some(Fading { ticks: 0, decay: 0.1, decay_per_period: 1.0, window: 3 });
        let mut ahead = SeaAhead::new(sea, Workers::new(1).unwrap());
        for _ in 0..2 {
            ahead.begin(1.0).unwrap();
            assert!(matches!(ahead.next(Some(2.0)), Err(SeaError::Panicked { time: 1.0, .. })));
        }
    }
}
