//! `cores`: what as many threads as a case has are worth on this machine, at this moment.
//!
//! Every thread does the same arithmetic, on registers alone. Where each has a core of its own, the row of several threads
//! takes as long as that of one; virtual cores that turn out to be two threads of one core, or that somebody else uses, show
//! here before they are taken for a fault of the sea's jobs.
use super::harness::{Body, Case, Label, Work};
use super::{BenchError, peak, selection::Selection};

/// Runs of [`peak::chains`] in a call: some 200 microseconds.
const RUNS: usize = 32;

struct Cores;

impl Body for Cores {
    fn run(&mut self) -> Result<(), BenchError> {
        rayon::broadcast(|_| (0..RUNS).for_each(|_| peak::chains()));
        Ok(())
    }
}

/// One case for each number of threads, in the group of size `n`, if they are wanted.
pub fn cases(selection: &Selection, n: usize) -> Vec<Case> {
    let threads = selection.threads.iter().filter(|_| selection.wants("cores"));
    let case = |&threads| {
        let label = Label { name: "cores".to_owned(), n, cascades: 0, threads, isa: "" };
        Case::new(label, Work::default(), Cores)
    };
    threads.map(case).collect()
}
