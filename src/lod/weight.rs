//! When a node is divided, eq (57), and how far its vertices have slid towards the coarser grid before it is joined.
//!
//! Let q(P) = |centre of P - viewer| / (s tau) for a node P of side s: P is divided while q < 1 (57). Its children are
//! drawn with their odd vertices slid onto P's own grid by m(P) = smoothstep(start, 1, q), so at q = 1, where they are
//! replaced by P, they already lie where P's vertices lie (continuous level of detail, after Strugar 2010).
//!
//! `start` is such that this never meets the next change. A child C of P has its centre s sqrt(2)/4 from P's. If C is
//! divided, |centre of C - viewer| < s tau / 2, hence |centre of P - viewer| < s tau / 2 + s sqrt(2)/4, that is
//! q(P) < 1/2 + sqrt(2)/(4 tau). With that as `start`, m(P) = 0 whenever one of its children is divided: C's vertices
//! do not slide towards P while C's children slide towards C.
use super::{Edge, Node};
use glam::DVec3;
use std::f64::consts::SQRT_2;

/// Weights are whole multiples of 1 / this: sums with vertex numbers are then exact in `f32`, see `docs/lod.md`.
pub const WEIGHT_STEPS: f64 = 256.0;

/// Where the slide begins at the latest: a range must be left for it when tau is small.
const LATEST_START: f64 = 0.95;

/// q at which a node's children begin to slide, 0.5..=0.95, for this tau.
pub fn morph_start(lod_scale: f64) -> f64 {
    (0.5 + SQRT_2 / (4.0 * lod_scale)).min(LATEST_START)
}

/// Distances of nodes from one viewer, in units of the distance at which each is divided.
#[derive(Clone, Copy, Debug)]
pub struct Ranges {
    /// The viewer relative to the root's centre, metres.
    viewer: DVec3,
    root_size: f64,
    lod_scale: f64,
    start: f64,
}

impl Ranges {
    /// For a viewer at `viewer` metres from the centre of a root of side `root_size`, with this tau.
    pub fn new(viewer: DVec3, root_size: f64, lod_scale: f64) -> Self {
        Self { viewer, root_size, lod_scale, start: morph_start(lod_scale) }
    }

    /// q(node)^2: squared distance from the node's centre at rest over (s tau)^2.
    pub fn ratio_squared(&self, node: Node) -> f64 {
        let [distance, range] = self.squares(node);
        distance / range
    }

    /// Squares of the node's distance and of s tau.
    fn squares(&self, node: Node) -> [f64; 2] {
        let centre = node.centre(self.root_size);
        let away = DVec3::new(centre.x - self.viewer.x, self.viewer.y, centre.y - self.viewer.z);
        let range = node.size(self.root_size) * self.lod_scale;
        [away.length_squared(), range * range]
    }

    /// Eq (57): the node is too near to be drawn whole.
    pub fn divides(&self, node: Node) -> bool {
        // The same as q^2 < 1, rounding included, without the division.
        let [distance, range] = self.squares(node);
        distance < range
    }

    /// m(node), 0..=1: how far the node's children have slid onto its grid.
    pub fn morph(&self, node: Node) -> f32 {
        let ratio_squared = self.ratio_squared(node);
        if ratio_squared <= self.start * self.start {
            return 0.0;
        }
        if ratio_squared >= 1.0 {
            return 1.0;
        }
        let t = (ratio_squared.sqrt() - self.start) / (1.0 - self.start);
        let weight = t * t * (3.0 - 2.0 * t);
        ((weight * WEIGHT_STEPS).round() / WEIGHT_STEPS) as f32
    }

    /// Weight of the vertices inside leaf `leaf`: m of its parent, and 0 for the root.
    pub fn leaf_morph(&self, leaf: Node) -> f32 {
        leaf.parent().map_or(0.0, |parent| self.morph(parent))
    }

    /// Weight of the vertices on an edge of a leaf of this place and size.
    ///
    /// The larger of m(P) and m(P') where P' is across the edge from the leaf's parent P, m(P) where the edge is inside
    /// P or nothing is across. Both sides of an edge compute the same number from the same nodes.
    pub fn edge_morph(&self, leaf: Node, edge: Edge) -> f32 {
        self.edge_morph_beside(leaf, edge, self.leaf_morph(leaf))
    }

    /// [`Self::edge_morph`], given the leaf's own weight, [`Self::leaf_morph`].
    pub(super) fn edge_morph_beside(&self, leaf: Node, edge: Edge, own: f32) -> f32 {
        match leaf.neighbour(edge).and_then(Node::parent) {
            // m is at most 1.
            Some(across) if own < 1.0 && Some(across) != leaf.parent() => own.max(self.morph(across)),
            _ => own,
        }
    }
}
