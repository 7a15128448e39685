//! Simulating the next frame while this one is drawn: two buffers and a driver that never leaves the pool.
use super::{Sea, SeaError, SeaMaps};
use crate::jobs::Workers;
use std::{
    any::Any,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError},
    time::{Duration, Instant},
};

/// A sea stepped one frame ahead of whoever draws it.
///
/// One worker of the pool drives the steps and takes part in them; it sleeps in between. Buffers change hands by move,
/// so that a frame allocates nothing. The pool is given away for that reason: other work would wait for ever on a pool
/// of one thread.
#[derive(Debug)]
pub struct SeaAhead {
    shared: Arc<Shared>,
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

#[derive(Debug)]
struct Shared {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Debug)]
enum State {
    /// Nothing to do.
    Idle,
    /// A step to make.
    Asked(f64, SeaMaps),
    /// The driver is at it.
    Busy,
    /// Done.
    Finished(Result<Duration, SeaError>, SeaMaps),
    /// The owner or the driver has gone.
    Closed,
}

impl Shared {
    /// A panic while the lock was held leaves a state that is whole: every change is one assignment.
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn set(&self, state: State) {
        *self.lock() = state;
        self.changed.notify_all();
    }

    /// Waits until `pick` takes something out of the state.
    fn wait<R>(&self, pick: impl Fn(&mut State) -> Option<R>) -> R {
        let mut state = self.lock();
        loop {
            if let Some(picked) = pick(&mut state) {
                return picked;
            }
            state = self.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

impl SeaAhead {
    /// Puts `sea` to work on `workers`.
    pub fn new(sea: Sea, workers: Workers) -> Self {
        let shared = Arc::new(Shared { state: Mutex::new(State::Idle), changed: Condvar::new() });
        let (front, spare) = (Some(sea.new_maps()), Some(sea.new_maps()));
        let driver = Arc::clone(&shared);
        workers.spawn(move || drive(sea, &driver));
        Self { shared, front, spare, pending: None, took: Duration::ZERO, workers }
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
        let mut state = self.shared.lock();
        if matches!(*state, State::Closed) {
            self.spare = Some(maps);
            return Err(SeaError::Gone);
        }
        *state = State::Asked(time, maps);
        drop(state);
        self.shared.changed.notify_all();
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
        let finished = self.shared.wait(|state| match std::mem::replace(state, State::Idle) {
            State::Finished(result, maps) => Some(Ok((result, maps))),
            State::Closed => {
                *state = State::Closed;
                Some(Err(SeaError::Gone))
            }
            other => {
                *state = other;
                None
            }
        });
        self.pending = None;
        let (result, maps) = finished?;
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

impl Drop for SeaAhead {
    fn drop(&mut self) {
        self.shared.set(State::Closed);
    }
}

/// Makes the steps asked for, until the owner has gone.
fn drive(mut sea: Sea, shared: &Shared) {
    loop {
        let asked = shared.wait(|state| match std::mem::replace(state, State::Busy) {
            State::Asked(time, maps) => Some(Some((time, maps))),
            State::Closed => {
                *state = State::Closed;
                Some(None)
            }
            other => {
                *state = other;
                None
            }
        });
        let Some((time, mut maps)) = asked else { return };
        let began = Instant::now();
        let result = catch_unwind(AssertUnwindSafe(|| sea.step(time, &mut maps))).unwrap_or_else(|panic| {
            sea.forget();
            Err(SeaError::Panicked { time, message: words(&*panic) })
        });
        let result = result.map(|()| began.elapsed());
        let mut state = shared.lock();
        if matches!(*state, State::Closed) {
            return;
        }
        *state = State::Finished(result, maps);
        drop(state);
        shared.changed.notify_all();
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
