//! Worker threads, and what a graph of jobs is made of.
//!
//! A stage is a parallel-for over disjoint pieces of its output, so its result cannot depend on the number of threads
//! or on their order. Stages of one chain follow each other; chains that share nothing (the cascades of a sea) run
//! side by side, and a worker that waits for one helps with another: nobody blocks.
mod handover;

pub use handover::{Giver, Taker, handover};

use std::{
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
    thread,
    time::{Duration, Instant},
};

/// Errors of starting threads.
#[derive(Debug, thiserror::Error)]
pub enum JobsError {
    /// The operating system refused.
    #[error("starting {threads} worker threads: {source}; ask for fewer")]
    Start {
        /// How many were wanted.
        threads: usize,
        /// Why not.
        source: rayon::ThreadPoolBuildError,
    },
}

/// A pool of threads named `swell-worker-0`, `swell-worker-1`, ...
#[derive(Debug)]
pub struct Workers {
    pool: rayon::ThreadPool,
    kernel_ids: Arc<Mutex<Vec<u32>>>,
}

impl Workers {
    /// Starts `threads` threads; 0 starts one per processor that the calling thread may use: those of its affinity mask,
    /// or fewer where the process's share of time (a cgroup's quota) is worth fewer. Threads inherit the mask.
    ///
    /// # Errors
    /// [`JobsError::Start`] when the operating system gives no more threads.
    pub fn new(threads: usize) -> Result<Self, JobsError> {
        let threads = if threads == 0 {
            thread::available_parallelism().map_or(1, std::num::NonZero::get)
        } else {
            threads
        };
        let kernel_ids = Arc::<Mutex<Vec<u32>>>::default();
        let started = Arc::clone(&kernel_ids);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|index| format!("swell-worker-{index}"))
            .start_handler(move |_| {
                started.lock().unwrap_or_else(PoisonError::into_inner).extend(kernel_id())
            })
            .build()
            .map_err(|source| JobsError::Start { threads, source })?;
        // Each answers, so each has started and said its number.
        pool.broadcast(|_| ());
        Ok(Self { pool, kernel_ids })
    }

    /// Number of threads.
    pub fn threads(&self) -> usize {
        self.pool.current_num_threads()
    }

    /// The kernel's numbers of the threads, for whoever tells a scheduler about them; none where threads have no such
    /// number. Why not a function that each thread calls as it starts: `docs/jobs.md`.
    pub fn kernel_ids(&self) -> Vec<u32> {
        self.kernel_ids.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Runs `work` on a worker, with the whole pool for its parallel-fors, and waits for it.
    pub fn run<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        self.pool.install(work)
    }

    /// Hands `work` to a worker and returns at once. Work that never ends keeps that worker.
    pub fn spawn(&self, work: impl FnOnce() + Send + 'static) {
        self.pool.spawn(work);
    }
}

/// The kernel's number of the calling thread.
#[cfg(any(target_os = "linux", target_os = "android"))]
pub fn kernel_id() -> Option<u32> {
    u32::try_from(nix::unistd::gettid().as_raw()).ok()
}

/// The kernel's number of the calling thread, where it has one.
#[cfg(not(any(target_os = "linux", target_os = "android")))]
pub fn kernel_id() -> Option<u32> {
    None
}

/// One node of a job graph: a parallel-for over `batch`, after every earlier stage that writes what it reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stage {
    /// Name in benches and traces.
    pub name: &'static str,
    /// Buffers read.
    pub reads: &'static [&'static str],
    /// Buffers written.
    pub writes: &'static [&'static str],
    /// What one job of it covers.
    pub batch: &'static str,
}

/// Time spent in each of `N` stages since the last [`StageTimes::take`].
#[derive(Debug)]
pub struct StageTimes<const N: usize> {
    nanoseconds: [AtomicU64; N],
}

impl<const N: usize> Default for StageTimes<N> {
    fn default() -> Self {
        Self { nanoseconds: [const { AtomicU64::new(0) }; N] }
    }
}

impl<const N: usize> StageTimes<N> {
    /// Runs `work` and adds its wall-clock time to stage `index`. Stages of chains that run side by side overlap.
    pub fn measure<R>(&self, index: usize, work: impl FnOnce() -> R) -> R {
        let start = Instant::now();
        let result = work();
        let spent = u64::try_from(start.elapsed().as_nanos()).unwrap_or(u64::MAX);
        self.nanoseconds[index].fetch_add(spent, Ordering::Relaxed);
        result
    }

    /// The times so far; counting starts again at 0.
    pub fn take(&self) -> [Duration; N] {
        self.nanoseconds.each_ref().map(|stage| Duration::from_nanos(stage.swap(0, Ordering::Relaxed)))
    }
}
