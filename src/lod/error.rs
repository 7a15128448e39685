//! What can be wrong with the quadtree's settings.

/// A value of [`super::LodSettings`] that no quadtree can be built from.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum LodError {
    /// A number outside the range the quadtree supports, or not a number.
    #[error("building the quadtree: `{key}` is {value}; give a value in {low}..={high}")]
    OutOfRange {
        /// Field of [`super::LodSettings`].
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
pub(super) fn check_range(key: &'static str, value: f64, low: f64, high: f64) -> Result<(), LodError> {
    if (low..=high).contains(&value) { Ok(()) } else { Err(LodError::OutOfRange { key, value, low, high }) }
}
