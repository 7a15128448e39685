//! The job graph of one cascade. Cascades share no buffer, so their graphs run side by side.
use crate::jobs::{Stage, StageTimes};

/// Stage numbers, indices into [`STAGES`].
pub mod stage {
    /// (cos, sin) of every harmonic.
    pub const ROTATIONS: usize = 0;
    /// Evolution and the first pass of the transform.
    pub const ALONG_U: usize = 1;
    /// Second pass.
    pub const ALONG_V: usize = 2;
    /// Displacement planes.
    pub const DISPLACEMENT: usize = 3;
    /// Foam's memory, at its own ticks only.
    pub const FOAM: usize = 4;
    /// Gradients, packing, level 0 of both maps.
    pub const GRADIENT: usize = 5;
    /// The levels above.
    pub const MIPS: usize = 6;
}

/// Every stage of a step, in an order that respects the graph. The spectrum is made once, before the first step.
pub const STAGES: [Stage; 7] = [
    Stage {
        name: "rotations",
        reads: &["spectrum"],
        writes: &["rotations"],
        batch: "the table of one cascade",
    },
    Stage {
        name: "evolve, transform along u",
        reads: &["spectrum", "rotations"],
        writes: &["half spectra"],
        batch: "8 rows kv",
    },
    Stage {
        name: "transform along v",
        reads: &["half spectra"],
        writes: &["column tiles"],
        batch: "16 columns u",
    },
    Stage {
        name: "displacement",
        reads: &["column tiles"],
        writes: &["displacement planes"],
        batch: "8 rows v",
    },
    Stage {
        name: "foam memory",
        reads: &["displacement planes"],
        writes: &["foam memory"],
        batch: "8 rows v",
    },
    Stage {
        name: "gradient",
        reads: &["displacement planes", "foam memory"],
        writes: &["normals", "texels", "gradient map", "displacement map"],
        batch: "8 rows v",
    },
    Stage {
        name: "mips",
        reads: &["normals", "texels"],
        writes: &["gradient map", "displacement map"],
        batch: "rows of one level holding at least 1024 texels",
    },
];

/// Times of the stages, summed over the cascades.
pub type Times = StageTimes<{ STAGES.len() }>;
