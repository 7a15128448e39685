//! A rest position that may be the one sought, and where else to look.
use super::{Query, sample::Sample};

/// The angle of a sunflower's seeds, which spreads any number of starting points evenly: pi (3 - sqrt 5).
pub const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// A rest position that may be the one sought.
#[derive(Clone, Copy, Debug)]
pub struct Guess {
    pub q: [f64; 2],
    pub sample: Sample,
    /// q + D(q) less the target.
    pub miss: [f64; 2],
}

impl Guess {
    pub fn at(query: &Query<'_>, q: [f64; 2], target: [f64; 2]) -> Self {
        let sample = Sample::at(query, q);
        Self { q, sample, miss: sample.miss(q, target) }
    }
}
