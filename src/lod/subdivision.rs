//! Which nodes are divided: the quadtree itself, as one byte a node.
//!
//! The paper's map (62) holds a level for each finest cell and is rewritten whole. The same questions are answered by a
//! pyramid of "divided" flags, of which only those set last time need clearing: tens of writes in place of thousands.
use super::Node;

/// The divided nodes of a quadtree.
#[derive(Clone, Debug)]
pub struct SubdivisionMap {
    /// A flag for every node above the finest level; level l starts at (4^l - 1) / 3 and is row by row.
    flags: Vec<bool>,
    /// The nodes whose flag is set, in the order they were divided.
    divided: Vec<Node>,
    levels: u32,
}

impl SubdivisionMap {
    /// An undivided root; up to `levels` subdivisions and `capacity` divided nodes without allocation.
    pub(super) fn new(levels: u32, capacity: usize) -> Self {
        Self { flags: vec![false; level_offset(levels)], divided: Vec::with_capacity(capacity), levels }
    }

    /// Levels below the root, L_max.
    pub fn levels(&self) -> u32 {
        self.levels
    }

    /// True when `node` has children. Nodes of the finest level have none.
    pub fn is_divided(&self, node: Node) -> bool {
        u32::from(node.level) < self.levels && self.flags[index(node)]
    }

    /// Every divided node, in the order they were divided.
    pub fn divided(&self) -> &[Node] {
        &self.divided
    }

    /// Level of the leaf that holds cell (x, y) of the finest level: the paper's subdivision map (62).
    ///
    /// # Panics
    /// When the cell is outside the map, x or y >= 2^levels.
    pub fn level_at(&self, x: u16, y: u16) -> u8 {
        let width = 1_u32 << self.levels;
        assert!(u32::from(x) < width && u32::from(y) < width, "cell ({x}, {y}) is outside {width} x {width}");
        let mut node = Node::ROOT;
        while self.is_divided(node) {
            let level = node.level + 1;
            let shift = self.levels - u32::from(level);
            node = Node { level, x: x >> shift, y: y >> shift };
        }
        node.level
    }

    /// Makes the root a leaf again.
    pub(super) fn clear(&mut self) {
        for &node in &self.divided {
            self.flags[index(node)] = false;
        }
        self.divided.clear();
    }

    /// Divides `node`, once.
    pub(super) fn divide(&mut self, node: Node) {
        let flag = &mut self.flags[index(node)];
        if !*flag {
            *flag = true;
            self.divided.push(node);
        }
    }
}

/// Number of nodes above level `level`.
fn level_offset(level: u32) -> usize {
    ((1 << (2 * level)) - 1) / 3
}

fn index(node: Node) -> usize {
    level_offset(u32::from(node.level)) + (usize::from(node.y) << node.level) + usize::from(node.x)
}
