//! What is drawn for one viewer: patches sorted by stitch pattern, ready for instanced draws.
use super::{Edge, Frustum, Node, Pattern, Ranges, SubdivisionMap};
use bytemuck::{Pod, Zeroable};
use glam::{DVec2, DVec3, Vec3};
use std::ops::Range;

/// Most instances of one draw call (section 5.6).
pub const MAX_BATCH: u32 = 128;

/// One patch as the vertex shader reads it, 32 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Instance {
    /// Centre x, metres relative to [`Selection::origin`].
    pub centre_x: f32,
    /// Centre z, metres relative to [`Selection::origin`].
    pub centre_z: f32,
    /// Side, metres.
    pub size: f32,
    /// Weight of the slide of the vertices inside, 0 (own grid) ..= 1 (parent's grid).
    pub morph: f32,
    /// Weight on the edges E, N, W, S; on a stitched edge it is the coarser patch's.
    pub edge_morph: [f32; 4],
}

/// A leaf of the balanced quadtree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Leaf {
    /// Its place and level.
    pub node: Node,
    /// Edges where its neighbour is coarser.
    pub pattern: Pattern,
    /// Index of its instance; `None` when it was culled.
    pub instance: Option<u32>,
}

/// One instanced draw call.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Batch {
    /// Which of the 16 index patterns to draw.
    pub pattern: Pattern,
    /// Its instances, at most [`MAX_BATCH`].
    pub instances: Range<u32>,
}

/// The patches for one viewer.
#[derive(Clone, Debug)]
pub struct Selection {
    origin: DVec2,
    instances: Vec<Instance>,
    /// First instance of each pattern, and the number of instances.
    starts: [u32; Pattern::COUNT + 1],
    leaves: Vec<Leaf>,
    stack: Vec<Node>,
}

impl Selection {
    /// World (x, z) of the quadtree's snapped centre, metres; instances and skirt are relative to it.
    pub fn origin(&self) -> DVec2 {
        self.origin
    }

    /// The patches that may be seen, by ascending pattern.
    pub fn instances(&self) -> &[Instance] {
        &self.instances
    }

    /// Instances of one pattern.
    pub fn range(&self, pattern: Pattern) -> Range<u32> {
        self.starts[pattern.index()]..self.starts[pattern.index() + 1]
    }

    /// Draw calls for everything: ascending patterns, none empty.
    pub fn batches(&self) -> impl Iterator<Item = Batch> {
        Pattern::all().flat_map(|pattern| {
            let Range { start, end } = self.range(pattern);
            (start..end)
                .step_by(MAX_BATCH as usize)
                .map(move |first| Batch { pattern, instances: first..end.min(first + MAX_BATCH) })
        })
    }

    /// Every leaf, seen or not, by recursive quarters (SW, SE, NW, NE).
    pub fn leaves(&self) -> &[Leaf] {
        &self.leaves
    }

    /// Nothing selected; no allocation up to `leaves` leaves of `levels` levels.
    pub(super) fn with_capacity(leaves: usize, levels: u32) -> Self {
        Self {
            origin: DVec2::ZERO,
            instances: Vec::with_capacity(leaves),
            starts: [0; Pattern::COUNT + 1],
            leaves: Vec::with_capacity(leaves),
            stack: Vec::with_capacity(3 * levels as usize + 1),
        }
    }

    /// Collects the leaves of a balanced tree, culls them and sorts what is left by pattern.
    pub(super) fn fill(&mut self, map: &SubdivisionMap, view: &View<'_>) {
        self.origin = view.origin;
        self.collect_leaves(map, view);
        self.sort_by_pattern(view);
    }

    /// Finds the leaves with their patterns; `instance` is set where the leaf may be seen.
    fn collect_leaves(&mut self, map: &SubdivisionMap, view: &View<'_>) {
        self.leaves.clear();
        self.stack.clear();
        self.stack.push(Node::ROOT);
        while let Some(node) = self.stack.pop() {
            if map.is_divided(node) {
                self.stack.extend(node.children().into_iter().rev());
            } else {
                let pattern = Pattern::of_leaf(map, node);
                let instance = view.sees(node).then_some(0);
                self.leaves.push(Leaf { node, pattern, instance });
            }
        }
    }

    /// Counting sort: leaves keep their order within a pattern.
    fn sort_by_pattern(&mut self, view: &View<'_>) {
        let mut counts = [0_u32; Pattern::COUNT];
        for leaf in self.leaves.iter().filter(|leaf| leaf.instance.is_some()) {
            counts[leaf.pattern.index()] += 1;
        }
        let mut total = 0;
        for (start, count) in self.starts.iter_mut().zip(counts) {
            *start = total;
            total += count;
        }
        self.starts[Pattern::COUNT] = total;

        let mut next = self.starts;
        self.instances.clear();
        self.instances.resize(total as usize, Instance::default());
        for leaf in &mut self.leaves {
            if let Some(slot) = &mut leaf.instance {
                let place = &mut next[leaf.pattern.index()];
                *slot = *place;
                self.instances[*place as usize] = view.instance(leaf.node, leaf.pattern);
                *place += 1;
            }
        }
    }
}

/// One viewer: where the tree stands, what is in view, how far each node is.
pub(super) struct View<'a> {
    pub(super) origin: DVec2,
    /// The eye relative to the tree's centre at rest, metres.
    pub(super) eye: DVec3,
    pub(super) frusta: &'a [Frustum],
    pub(super) ranges: Ranges,
    pub(super) root_size: f64,
    pub(super) bounds: Bounds,
}

/// How far a patch's surface may leave its square.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    /// beta of eq (61).
    pub(super) cull_scale: f64,
    /// Largest height above and below rest, metres.
    pub(super) max_height: f64,
    /// Largest horizontal displacement, metres.
    pub(super) reach: f64,
}

impl View<'_> {
    /// True when any frustum keeps the node's box, eq (61).
    ///
    /// Its half extents are s beta / 2, but at least s / 2 + reach, and the whole of `max_height` up and down: half of
    /// it, as eq (61) has it, would lose waves of that height.
    fn sees(&self, node: Node) -> bool {
        let size = node.size(self.root_size);
        let across = (0.5 * size * self.bounds.cull_scale).max(0.5 * size + self.bounds.reach);
        let centre = node.centre(self.root_size);
        let centre = DVec3::new(centre.x, 0.0, centre.y) - self.eye;
        let half_extents = DVec3::new(across, self.bounds.max_height, across);
        let (centre, half_extents): (Vec3, Vec3) = (centre.as_vec3(), half_extents.as_vec3());
        self.frusta.iter().any(|frustum| frustum.keeps(centre, half_extents))
    }

    fn instance(&self, leaf: Node, pattern: Pattern) -> Instance {
        let centre = leaf.centre(self.root_size);
        let coarser = leaf.parent().unwrap_or(leaf);
        let morph = self.ranges.leaf_morph(leaf);
        let coarser_morph = if pattern == Pattern::FULL { morph } else { self.ranges.leaf_morph(coarser) };
        let edge_morph = Edge::ALL.map(|edge| {
            let (node, own) = if pattern.has(edge) { (coarser, coarser_morph) } else { (leaf, morph) };
            self.ranges.edge_morph_beside(node, edge, own)
        });
        Instance {
            centre_x: centre.x as f32,
            centre_z: centre.y as f32,
            size: leaf.size(self.root_size) as f32,
            morph,
            edge_morph,
        }
    }
}
