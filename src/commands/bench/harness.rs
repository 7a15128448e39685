//! The order of measurement: cases take turns in short bursts, so that all of them meet the same machine.
//!
//! A machine flips between quiet and busy within seconds, by a factor that exceeds what is to be measured. Cases that
//! are run one after the other meet different machines, and their ratio says little. Here a group's cases go round: a
//! burst of some milliseconds each, begun with a call that is not counted (it brings code and data back into the
//! caches; several threads need more of them), then calls that are timed one by one.
use super::{BenchError, samples::Samples};
use crate::jobs::Workers;
use std::time::{Duration, Instant};

/// Turns that a case gets.
pub const ROUNDS: u32 = 40;
/// Calls that a turn has room for where one is spent on the caches.
const CALLS: u32 = 3;
/// What a turn of several threads spends on calls that are not counted: threads that slept wake up on one core, and the
/// system takes milliseconds to give each its own.
const SETTLING: Duration = Duration::from_millis(20);

/// What is timed.
pub trait Body: Send {
    /// Makes ready for one call of [`Self::run`], outside its time.
    fn prepare(&mut self) {}

    /// One call.
    ///
    /// # Errors
    /// What the measured code gives.
    fn run(&mut self) -> Result<(), BenchError>;

    /// Hands times of its parts within the latest call to `take`, by number.
    fn parts(&mut self, take: &mut dyn FnMut(usize, Duration)) {
        let _ = take;
    }
}

/// What a row of the report is about.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// Name in the report.
    pub name: String,
    /// Points along a side of the grid; 0 where there is none.
    pub n: usize,
    /// Cascades of the sea; 0 where there is none.
    pub cascades: usize,
    /// Worker threads.
    pub threads: usize,
    /// Instruction set, empty where it does not apply.
    pub isa: &'static str,
}

/// How much one call does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Work {
    /// Grid points, patches or questions.
    pub points: f64,
    /// Bytes that it has to read and write at least, each once; 0 where that says nothing.
    pub bytes: f64,
    /// Floating-point operations by the usual count; 0 where there is none.
    pub flops: f64,
}

/// One thing to measure, and what was measured of it.
pub struct Case {
    /// What it is.
    pub label: Label,
    /// How much it does.
    pub work: Work,
    /// Names of the parts that [`Body::parts`] numbers.
    pub parts: Vec<String>,
    /// The whole, then the parts.
    pub samples: Vec<Samples>,
    body: Box<dyn Body>,
    spent: Duration,
    latest: Duration,
}

impl Case {
    /// Not yet measured, without parts.
    pub fn new(label: Label, work: Work, body: impl Body + 'static) -> Self {
        let samples = vec![Samples::default()];
        let (spent, latest) = Default::default();
        Self { label, work, parts: Vec::new(), samples, body: Box::new(body), spent, latest }
    }

    /// The same with parts of these names.
    pub fn with_parts(mut self, parts: Vec<String>) -> Self {
        self.samples.resize(parts.len() + 1, Samples::default());
        self.parts = parts;
        self
    }

    /// One call; its time and its parts' are kept if `kept`.
    fn call(&mut self, kept: bool) -> Result<(), BenchError> {
        self.body.prepare();
        let start = Instant::now();
        let done = self.body.run();
        self.latest = start.elapsed();
        done?;
        if kept {
            self.spent += self.latest;
            self.samples[0].push(self.latest);
        }
        let samples = &mut self.samples;
        self.body.parts(&mut |part, time| {
            if let Some(samples) = samples.get_mut(part + 1).filter(|_| kept) {
                samples.push(time);
            }
        });
        Ok(())
    }

    /// One turn of `turn` at most, where `allowed` may be spent in all by its end: a case too long for a turn lets
    /// several pass.
    fn turn(&mut self, turn: Duration, allowed: Duration) -> Result<(), BenchError> {
        if self.spent >= allowed {
            return Ok(());
        }
        if self.latest * CALLS < turn {
            self.call(false)?;
        }
        let start = Instant::now();
        while self.label.threads > 1 && start.elapsed() < SETTLING {
            self.call(false)?;
        }
        self.call(true)?;
        while self.spent + self.latest / 2 < allowed {
            self.call(true)?;
        }
        Ok(())
    }
}

/// Pools of every number of threads that a case wants.
#[derive(Default)]
pub struct Pools(Vec<Workers>);

impl Pools {
    /// The pool of `threads` threads, started when first asked for.
    ///
    /// # Errors
    /// The system gives no more threads.
    pub fn of(&mut self, threads: usize) -> Result<&Workers, BenchError> {
        let place = match self.0.iter().position(|workers| workers.threads() == threads) {
            Some(place) => place,
            None => {
                self.0.push(Workers::new(threads)?);
                self.0.len() - 1
            }
        };
        Ok(&self.0[place])
    }
}

/// Measures `cases` in turns, each for about `time`, on a pool of its own number of threads. `round` is called as often as
/// [`ROUNDS`] says.
///
/// # Errors
/// The first that a case has.
pub fn measure(
    cases: &mut [Case],
    pools: &mut Pools,
    time: Duration,
    mut round: impl FnMut(),
) -> Result<(), BenchError> {
    for case in &mut *cases {
        pools.of(case.label.threads)?.run(|| case.call(false))?;
    }
    for done in 1..=ROUNDS {
        for case in &mut *cases {
            pools.of(case.label.threads)?.run(|| case.turn(time / ROUNDS, time * done / ROUNDS))?;
        }
        round();
    }
    Ok(())
}
