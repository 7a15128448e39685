//! How far the sea may move from rest, for scenes that do not say so.

/// Largest height as a share of the side of the quadtree's square ("VR Ocean" section 5.2.2).
const HEIGHT_SHARE: f64 = 0.03;

/// Horizontal displacement in metres that a wind sea of 24 m/s does not exceed: five standard deviations of 1.6 m.
const REACH: f64 = 8.0;

/// Largest displacements that culling allows for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extent {
    /// Metres above or below the sea at rest.
    pub height: f64,
    /// Metres to the side.
    pub reach: f64,
}

/// Bounds for a square of sea of side `size` metres.
pub(super) fn estimate(size: f64) -> Extent {
    Extent { height: HEIGHT_SHARE * size, reach: REACH }
}
