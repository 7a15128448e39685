//! How far a job is: a bar on a terminal, a plain line now and then elsewhere.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::{IsTerminal, stderr};

/// Progress of a job of known length, on standard error.
pub struct Progress {
    name: &'static str,
    total: u64,
    done: u64,
    bar: Option<ProgressBar>,
}

impl Progress {
    /// Begins a job of `total` steps.
    pub fn new(name: &'static str, total: u64) -> Self {
        let bar = (stderr().is_terminal() && total > 1).then(|| {
            let style = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len} {eta}");
            let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
            ProgressBar::new(total).with_style(style).with_message(name)
        });
        Self { name, total, done: 0, bar }
    }

    /// One step more is done.
    pub fn step(&mut self) {
        self.done += 1;
        match &self.bar {
            Some(bar) => bar.inc(1),
            // Ten lines for a job, however long.
            None if self.total > 1 && self.done * 10 / self.total != (self.done - 1) * 10 / self.total => {
                eprintln!("{} {}/{}", self.name, self.done, self.total);
            }
            None => {}
        }
    }

    /// The job is over.
    pub fn finish(self) {
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
    }
}
