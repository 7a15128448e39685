//! Which cases, of which sizes, on which instruction sets.
use super::BenchOptions;
use crate::commands::CommandError;
use crate::sea::simd::{Isa, NoSuchIsa};
use std::str::FromStr;

/// Every case, as `--only` names it. Some give several rows: see `docs/performance.md`.
pub const CASES: [&str; 14] = [
    "fft3",
    "step",
    "stages",
    "step_2c",
    "step_3c",
    "step_4c",
    "step_foam_tick",
    "quadtree",
    "query",
    "upload",
    "fftw3",
    "rustfft2",
    "paper_step",
    "cores",
];

/// Those that need the feature `rivals`.
const RIVALS: [&str; 2] = ["fftw3", "rustfft2"];

/// One of [`CASES`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CaseName(&'static str);

impl FromStr for CaseName {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let known = CASES.into_iter().find(|&name| name == text);
        known.map(Self).ok_or_else(|| format!("one of {}", CASES.join(", ")))
    }
}

/// Which instruction sets the sea is measured on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IsaChoice {
    /// The best this machine has.
    Best,
    /// Each that it has.
    All,
    /// This one.
    One(Isa),
}

impl FromStr for IsaChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "all" {
            return Ok(Self::All);
        }
        text.parse().map(Self::One).map_err(|error: NoSuchIsa| format!("{error}, or all"))
    }
}

/// [`BenchOptions`], checked against this machine.
pub struct Selection {
    only: Vec<CaseName>,
    /// Points along a side, ascending.
    pub sizes: Vec<usize>,
    /// The size at which parts, more cascades and what is not a grid are measured.
    pub detail: usize,
    /// Instruction sets, the best first.
    pub isas: Vec<Isa>,
    /// Numbers of threads: one, and the other that was asked for.
    pub threads: Vec<usize>,
    /// Part of the name of a Vulkan device.
    pub device: Option<String>,
}

/// The size of the flagship's cascades and of most of the promises.
const DETAIL: usize = 256;

impl Selection {
    /// Checks what was asked for.
    ///
    /// # Errors
    /// [`CommandError::Usage`] for a rival that is not there.
    pub fn new(options: &BenchOptions) -> Result<Self, CommandError> {
        let isas: Vec<Isa> = match options.isa {
            IsaChoice::Best => vec![Isa::best()],
            IsaChoice::All => Isa::available().collect(),
            IsaChoice::One(isa) => vec![isa],
        };
        let rival = |name: &&CaseName| RIVALS.contains(&name.0);
        if let Some(CaseName(name)) = options.only.iter().find(rival).filter(|_| !cfg!(feature = "rivals")) {
            return Err(CommandError::Usage(format!(
                "--only {name}: this build has no rivals; ./x bench makes one that has"
            )));
        }
        let mut sizes = options.sizes.clone();
        sizes.sort_unstable();
        sizes.dedup();
        let largest = sizes.last().copied().unwrap_or(DETAIL);
        let all = match options.threads {
            0 => std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
            threads => threads,
        };
        let mut threads = vec![1, all];
        threads.dedup();
        Ok(Self {
            only: options.only.clone(),
            detail: if sizes.contains(&DETAIL) { DETAIL } else { largest },
            sizes,
            isas,
            threads,
            device: options.device.clone(),
        })
    }

    /// Whether the case of this name is to be measured.
    pub fn wants(&self, name: &str) -> bool {
        self.only.is_empty() || self.only.iter().any(|only| only.0 == name)
    }
}
