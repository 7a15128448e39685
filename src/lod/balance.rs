//! Two neighbouring leaves may differ by one level at most, or the stitch patterns cannot close the seam.
//!
//! The presets of table 2 do not see to it: with tau = 1.5 every fourth view, with tau = 1 nearly every view has
//! neighbours two levels apart. So leaves are divided until none is left: a forced split.
use super::{Edge, Node, SubdivisionMap};

/// Divides the fewest nodes that make the tree balanced across edges.
///
/// A divided node puts leaves one level finer, or more, along its edges, so the square of its own size across each
/// edge must exist: that square's parent must be divided. `divided()` grows while it is walked, so forced splits are
/// themselves balanced. The smallest such tree is unique: the order of the walk does not matter.
pub(super) fn balance(map: &mut SubdivisionMap) {
    let mut next = 0;
    while let Some(&node) = map.divided().get(next) {
        next += 1;
        for edge in Edge::ALL {
            if let Some(parent) = node.neighbour(edge).and_then(Node::parent) {
                map.divide(parent);
            }
        }
    }
}

/// Most nodes that can be divided at one level of a balanced tree, for this tau.
///
/// A node divided by eq (57) has its centre within D = tau of its own sides of the viewer, along each axis. A forced
/// one, twice as large, holds a square beside such a node: (D + 1 + 1/2) / 2 of its own sides at most. D = max(tau,
/// 1.5) satisfies both, and a square of side 2 D holds at most (floor(2 D) + 1)^2 centres.
pub(super) fn divided_per_level(lod_scale: f64) -> usize {
    let across = (2.0 * lod_scale.max(1.5)).floor() as usize + 1;
    across * across
}
