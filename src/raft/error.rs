//! What can be wrong with a raft's settings.

/// A value that no raft or buoy can be made from.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum RaftError {
    /// A number outside its range, or not a number.
    #[error("building the raft: `{key}` is {value}; give a value in {low}..={high}")]
    OutOfRange {
        /// Field of [`super::RaftSettings`], or `x`, `z`, `heading` of where it begins.
        key: &'static str,
        /// What it held.
        value: f64,
        /// Smallest value accepted.
        low: f64,
        /// Largest value accepted.
        high: f64,
    },
}

/// `Ok` when `value` is in `low..=high`; NaN is in no range.
pub(super) fn check_range(key: &'static str, value: f64, [low, high]: [f64; 2]) -> Result<(), RaftError> {
    if (low..=high).contains(&value) { Ok(()) } else { Err(RaftError::OutOfRange { key, value, low, high }) }
}
