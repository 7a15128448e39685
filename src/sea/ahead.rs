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
#[derive(Debug)]
pub struct SeaAhead {
    asked: Giver<Asked>,
    finished: Taker<Finished>,
    /// The maps handed out last, free again at the next call.
    front: Option<SeaMaps>,
    /// Maps that no step uses: the second buffer, until the first step begins.
    spare: Option<SeaMaps>,
    /// Time of the step that is on its way.
    pending: Option<f64>,
    /// How long the step took whose maps were handed out last.
    took: Duration,
    workers: Workers,
}

/// A step to make: its time and what it fills.
type Asked = (f64, SeaMaps);
/// What became of it: how long it took, and what it was to fill.
type Finished = (Result<Duration, SeaError>, SeaMaps);

impl SeaAhead {
    /// Puts `sea` to work on `workers`.
    pub fn new(sea: Sea, workers: Workers) -> Self {
        let (asked, to_make) = handover(1);
        let (made, finished) = handover(1);
        let (front, spare) = (Some(sea.new_maps()), Some(sea.new_maps()));
        workers.spawn(move || drive(sea, to_make, made));
        Self { asked, finished, front, spare, pending: None, took: Duration::ZERO, workers }
    }

    /// Begins the step to `time`, unless it is already on its way. One to another time, which somebody began and then
    /// gave up, is waited for and dropped.
    ///
    /// # Errors
    /// [`SeaError::Gone`] when the driver has ended.
    pub fn begin(&mut self, time: f64) -> Result<(), SeaError> {
        if let Some(begun) = self.pending {
            if begun == time {
                return Ok(());
            }
            // What became of it is nobody's business any more.
            let _dropped = self.next(None);
        }
        let maps = self.spare.take().or_else(|| self.front.take()).ok_or(SeaError::Gone)?;
        self.asked.give((time, maps)).map_err(|(_, maps)| {
            self.spare = Some(maps);
            SeaError::Gone
        })?;
        self.pending = Some(time);
        Ok(())
    }

    /// Waits for the step that is on its way, begins the one to `following`, and returns the finished maps, which stay
    /// valid until the next call.
    ///
    /// # Errors
    /// [`SeaError::NotBegun`] when no step is on its way; those of [`Sea::step`]; [`SeaError::Panicked`] when a job
    /// panicked. After an error the next `begin` starts afresh.
    pub fn next(&mut self, following: Option<f64>) -> Result<&SeaMaps, SeaError> {
        if self.pending.is_none() {
            return Err(SeaError::NotBegun);
        }
        let finished = self.finished.take();
        self.pending = None;
        let (result, maps) = finished.ok_or(SeaError::Gone)?;
        match result {
            Ok(took) => self.took = took,
            Err(error) => {
                self.spare = Some(maps);
                return Err(error);
            }
        }
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
    while let Some((time, mut maps)) = asked.take() {
        let began = Instant::now();
        let result = catch_unwind(AssertUnwindSafe(|| sea.step(time, &mut maps))).unwrap_or_else(|panic| {
            sea.forget();
            Err(SeaError::Panicked { time, message: words(&*panic) })
        });
        if finished.give((result.map(|()| began.elapsed()), maps)).is_err() {
            return;
        }
    }
}

/// What a panic said.
fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no message".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sea::{SeaSettings, foam::Fading};

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
