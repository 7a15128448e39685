//! Handing things from one thread to another, in order, without a lock and without allocating.
//!
//! A thread in a headset's frame must not wait for one of lower priority that was interrupted while it held a lock. Here
//! things lie in a lock-free queue, and who finds nothing sleeps until it is woken (`thread::park`); nobody ever waits
//! for the other to get out of the way. [`std::sync::mpsc`] keeps its sleepers in a list behind a mutex, and allocates
//! for the first of them.
use atomic_waker::AtomicWaker;
use crossbeam_queue::ArrayQueue;
use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    task::{Wake, Waker},
    thread::{self, Thread, ThreadId},
};

/// Two ends of a way that has room for `room` things (1 or more).
///
/// # Panics
/// When `room` is 0.
pub fn handover<T>(room: usize) -> (Giver<T>, Taker<T>) {
    let way = Arc::new(Way {
        things: ArrayQueue::new(room),
        closed: AtomicBool::new(false),
        giver: AtomicWaker::new(),
        taker: AtomicWaker::new(),
    });
    (Giver { way: Arc::clone(&way), own: None }, Taker { way, own: None })
}

/// The end that gives. The other learns when it is dropped.
#[derive(Debug)]
pub struct Giver<T> {
    way: Arc<Way<T>>,
    own: Option<(ThreadId, Waker)>,
}

/// The end that takes. The other learns when it is dropped.
#[derive(Debug)]
pub struct Taker<T> {
    way: Arc<Way<T>>,
    own: Option<(ThreadId, Waker)>,
}

#[derive(Debug)]
struct Way<T> {
    things: ArrayQueue<T>,
    /// An end has gone.
    closed: AtomicBool,
    /// Who sleeps because there is no room.
    giver: AtomicWaker,
    /// Who sleeps because there is nothing.
    taker: AtomicWaker,
}

impl<T> Giver<T> {
    /// Gives `thing`, once there is room.
    ///
    /// # Errors
    /// The thing itself, when the taker has gone.
    pub fn give(&mut self, thing: T) -> Result<(), T> {
        let Self { way, own } = self;
        let mut refused = Some(thing);
        sleep_until(&way.giver, own, || {
            if way.closed.load(Ordering::Acquire) {
                return Some(());
            }
            refused = refused.take().and_then(|thing| way.things.push(thing).err());
            refused.is_none().then_some(())
        });
        way.taker.wake();
        refused.map_or(Ok(()), Err)
    }
}

impl<T> Taker<T> {
    /// Waits for a thing. `None` when the giver has gone and everything is taken.
    pub fn take(&mut self) -> Option<T> {
        let Self { way, own } = self;
        let taken = sleep_until(&way.taker, own, || {
            // What was given before the giver went is still there.
            let closed = way.closed.load(Ordering::Acquire);
            way.things.pop().map(Some).or(closed.then_some(None))
        });
        way.giver.wake();
        taken
    }
}

impl<T> Drop for Giver<T> {
    fn drop(&mut self) {
        self.way.closed.store(true, Ordering::Release);
        self.way.taker.wake();
    }
}

impl<T> Drop for Taker<T> {
    fn drop(&mut self) {
        self.way.closed.store(true, Ordering::Release);
        self.way.giver.wake();
    }
}

/// Sleeps until `ready` gives something; whoever changes what it looks at wakes `place` afterwards. `own` wakes this
/// thread: made at the first call and again on another thread, even where there is nothing to wait for, so that what a
/// later call allocates does not depend on who comes first.
fn sleep_until<R>(
    place: &AtomicWaker,
    own: &mut Option<(ThreadId, Waker)>,
    mut ready: impl FnMut() -> Option<R>,
) -> R {
    let here = thread::current();
    if own.as_ref().is_none_or(|(thread, _)| *thread != here.id()) {
        *own = None;
    }
    let (_, waker) =
        own.get_or_insert_with(|| (here.id(), Waker::from(Arc::new(Sleeper(thread::current())))));
    loop {
        if let Some(result) = ready() {
            return result;
        }
        // Registered first and then looked again: a change in between is seen by the one or wakes the other.
        place.register(waker);
        if let Some(result) = ready() {
            return result;
        }
        thread::park();
    }
}

/// A thread that sleeps.
struct Sleeper(Thread);

impl Wake for Sleeper {
    fn wake(self: Arc<Self>) {
        self.0.unpark();
    }

    fn wake_by_ref(self: &Arc<Self>) {
        self.0.unpark();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn things_come_in_order_whoever_is_slower() {
        for (room, slow_giver) in [(1, false), (1, true), (3, false), (3, true)] {
            let (mut giver, mut taker) = handover(room);
            let thread = thread::spawn(move || {
                for thing in 0..20_000 {
                    if slow_giver && thing % 1000 == 0 {
                        thread::sleep(std::time::Duration::from_millis(1));
                    }
                    giver.give(thing).unwrap();
                }
            });
            for thing in 0..20_000 {
                if !slow_giver && thing % 1000 == 0 {
                    thread::sleep(std::time::Duration::from_millis(1));
                }
                assert_eq!(taker.take(), Some(thing));
            }
            assert_eq!(taker.take(), None);
            thread.join().unwrap();
        }
    }

    #[test]
    fn who_waits_learns_that_the_other_has_gone() {
        let (giver, mut taker) = handover::<u8>(1);
        let thread = thread::spawn(move || taker.take());
        thread::sleep(std::time::Duration::from_millis(5));
        drop(giver);
        assert_eq!(thread.join().unwrap(), None);

        let (mut giver, taker) = handover(1);
        giver.give(1).unwrap();
        let thread = thread::spawn(move || giver.give(2));
        thread::sleep(std::time::Duration::from_millis(5));
        drop(taker);
        assert_eq!(thread.join().unwrap(), Err(2));
    }

    #[test]
    fn an_end_may_move_to_another_thread() {
        let (mut giver, mut taker) = handover(1);
        giver.give(1).unwrap();
        assert_eq!(taker.take(), Some(1));
        let thread = thread::spawn(move || (taker.take(), taker));
        giver.give(2).unwrap();
        let (taken, mut taker) = thread.join().unwrap();
        giver.give(3).unwrap();
        assert_eq!((taken, taker.take()), (Some(2), Some(3)));
    }
}
