//! What is drawn for one viewer: patches sorted by mesh, ready for instanced draws.
use super::tessellation::{Density, MOST_PIECES, Pieces, Plan};
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
    /// Index of its instance, the first where it is drawn in pieces; `None` when it was culled.
    pub instance: Option<u32>,
}

/// One instanced draw call.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Batch {
    /// What to draw: [`Pattern::index`], or a number of [`Pieces`] where density is chosen by the wave signal.
    pub mesh: usize,
    /// Its instances, at most [`MAX_BATCH`].
    pub instances: Range<u32>,
}

/// The patches for one viewer.
#[derive(Clone, Debug)]
pub struct Selection {
    origin: DVec2,
    instances: Vec<Instance>,
    /// First instance of each mesh, and the number of instances.
    starts: Vec<u32>,
    /// Where the next instance of each mesh goes.
    next: Vec<u32>,
    leaves: Vec<Leaf>,
    /// One for each leaf that may be seen, in their order.
    plans: Vec<Plan>,
    stack: Vec<Node>,
}

impl Selection {
    /// World (x, z) of the quadtree's snapped centre, metres; instances and skirt are relative to it.
    pub fn origin(&self) -> DVec2 {
        self.origin
    }

    /// The patches that may be seen, by ascending mesh; one that is drawn in pieces is there for each of them.
    pub fn instances(&self) -> &[Instance] {
        &self.instances
    }

    /// How many patches may be seen.
    pub fn patches(&self) -> usize {
        self.plans.len()
    }

    /// Instances of one mesh.
    pub fn range(&self, mesh: usize) -> Range<u32> {
        self.starts[mesh]..self.starts[mesh + 1]
    }

    /// Draw calls for everything: ascending meshes, none empty.
    pub fn batches(&self) -> impl Iterator<Item = Batch> {
        (0..self.next.len()).flat_map(|mesh| {
            let Range { start, end } = self.range(mesh);
            (start..end)
                .step_by(MAX_BATCH as usize)
                .map(move |first| Batch { mesh, instances: first..end.min(first + MAX_BATCH) })
        })
    }

    /// Every leaf, seen or not, by recursive quarters (SW, SE, NW, NE).
    pub fn leaves(&self) -> &[Leaf] {
        &self.leaves
    }

    /// Nothing selected; no allocation up to `leaves` leaves of `levels` levels, drawn with the patterns or with `pieces`.
    pub(super) fn with_capacity(leaves: usize, levels: u32, pieces: Option<Pieces>) -> Self {
        let (meshes, most) = pieces.map_or((Pattern::COUNT, 1), |pieces| (pieces.count(), MOST_PIECES));
        Self {
            origin: DVec2::ZERO,
            instances: Vec::with_capacity(most * leaves),
            starts: vec![0; meshes + 1],
            next: vec![0; meshes],
            leaves: Vec::with_capacity(leaves),
            plans: Vec::with_capacity(leaves),
            stack: Vec::with_capacity(3 * levels as usize + 1),
        }
    }

    /// Collects the leaves of a balanced tree, culls them and sorts what is left by mesh.
    pub(super) fn fill(&mut self, map: &SubdivisionMap, view: &View<'_>) {
        self.origin = view.origin;
        self.collect_leaves(map, view);
        self.sort_by_mesh();
    }

    /// Finds the leaves with their patterns; `instance` is set where the leaf may be seen, and there it has a plan.
    fn collect_leaves(&mut self, map: &SubdivisionMap, view: &View<'_>) {
        self.leaves.clear();
        self.plans.clear();
        self.stack.clear();
        self.stack.push(Node::ROOT);
        while let Some(node) = self.stack.pop() {
            if map.is_divided(node) {
                self.stack.extend(node.children().into_iter().rev());
            } else {
                let pattern = Pattern::of_leaf(map, node);
                let instance = view.sees(node).then_some(0);
                if instance.is_some() {
                    self.plans.push(view.plan(map, node, pattern));
                }
                self.leaves.push(Leaf { node, pattern, instance });
            }
        }
    }

    /// Counting sort: leaves keep their order within a mesh.
    fn sort_by_mesh(&mut self) {
        self.next.fill(0);
        for mesh in self.plans.iter().flat_map(Plan::meshes) {
            self.next[usize::from(*mesh)] += 1;
        }
        let mut total = 0;
        for (start, next) in self.starts.iter_mut().zip(&mut self.next) {
            *start = total;
            total += std::mem::replace(next, total);
        }
        if let Some(end) = self.starts.last_mut() {
            *end = total;
        }
        self.instances.clear();
        self.instances.resize(total as usize, Instance::default());
        let seen = self.leaves.iter_mut().filter_map(|leaf| leaf.instance.as_mut());
        for (slot, plan) in seen.zip(&self.plans) {
            for (place, mesh) in plan.meshes().iter().enumerate() {
                let next = &mut self.next[usize::from(*mesh)];
                self.instances[*next as usize] = plan.instance;
                if place == 0 {
                    *slot = *next;
                }
                *next += 1;
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
    /// Where the wave signal chooses the density.
    pub(super) density: Option<(Pieces, Density)>,
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

    /// What a leaf is drawn with.
    fn plan(&self, map: &SubdivisionMap, leaf: Node, pattern: Pattern) -> Plan {
        let instance = self.instance(leaf, pattern);
        match &self.density {
            None => Plan::grid(instance, pattern),
            Some((pieces, density)) => Plan::signal(*pieces, density, map, (leaf, pattern), instance),
        }
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
