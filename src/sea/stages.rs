//! The job graph of one cascade. Cascades share no buffer, so their graphs run side by side.
use crate::jobs::{Stage, StageTimes};

/// Stage numbers, indices into [`STAGES`].
pub mod stage {
    /// (cos, sin) of every harmonic.
    pub const ROTATIONS: usize = 0;
    /// Evolution and the pass along columns.
    pub const COLUMNS: usize = 1;
    /// The pass along rows, gradients, and all mips that a band can make by itself.
    pub const BANDS: usize = 2;
    /// The mips above.
    pub const TOP: usize = 3;
    /// Foam's memory, at its own ticks only: the pass along rows and J.
    pub const FOAM: usize = 4;
}

/// Every stage of a step.
pub const STAGES: [Stage; 5] = [
    Stage { name: "rotations", reads: &["harmonics"], writes: &["rotations"], batch: "a cascade" },
    Stage {
        name: "columns",
        reads: &["amplitudes", "rotations"],
        writes: &["half spectra"],
        batch: "a tile of ku",
    },
    Stage {
        name: "bands",
        reads: &["half spectra", "memory"],
        writes: &["displacement", "gradient", "memory", "tops"],
        batch: "a band of rows",
    },
    Stage { name: "top", reads: &["tops"], writes: &["displacement", "gradient"], batch: "a cascade" },
    Stage { name: "foam", reads: &["half spectra", "memory"], writes: &["memory"], batch: "a band of rows" },
];

/// Time spent in each of [`STAGES`].
pub type Times = StageTimes<{ STAGES.len() }>;
