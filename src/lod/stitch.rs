//! The four edges of a patch, and the 16 ways they can meet coarser neighbours, eqs (63)(64).
//!
//! The paper's grid (x, y) lies on world (x, z): East is +x and North is +y of the grid, which is +z of the world.
//! Seen from above with +x to the right, +z points down: the paper's North is the south of a map drawn with -z up.
use super::{Node, SubdivisionMap};

/// An edge of a patch; the discriminant is f(d) of eq (64) and the index into [`super::Instance::edge_morph`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Edge {
    /// Towards +x.
    East = 0,
    /// Towards +z.
    North = 1,
    /// Towards -x.
    West = 2,
    /// Towards -z.
    South = 3,
}

impl Edge {
    /// All four, in the order of eq (64).
    pub const ALL: [Self; 4] = [Self::East, Self::North, Self::West, Self::South];

    /// Step (column, row) to the square across this edge.
    pub const fn step(self) -> (i16, i16) {
        match self {
            Self::East => (1, 0),
            Self::North => (0, 1),
            Self::West => (-1, 0),
            Self::South => (0, -1),
        }
    }

    /// The edge that faces this one across it.
    pub const fn opposite(self) -> Self {
        match self {
            Self::East => Self::West,
            Self::North => Self::South,
            Self::West => Self::East,
            Self::South => Self::North,
        }
    }
}

/// Which edges of a patch meet a coarser one: the 4-bit flags of eq (64), 0..=15.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Pattern(u8);

impl Pattern {
    /// How many there are.
    pub const COUNT: usize = 16;

    /// No edge stitched.
    pub const FULL: Self = Self(0);

    /// All of them, by ascending bits.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..16).map(Self)
    }

    /// The pattern of these flags (E 1, N 2, W 4, S 8); bits above the fourth are ignored.
    pub const fn from_bits(bits: u8) -> Self {
        Self(bits & 15)
    }

    /// The flags, 0..=15.
    pub const fn bits(self) -> u8 {
        self.0
    }

    /// Position among the 16 patterns.
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    /// True when `edge` meets a coarser patch.
    pub const fn has(self, edge: Edge) -> bool {
        self.0 & (1 << edge as u8) != 0
    }

    /// This pattern with `edge` stitched too.
    pub const fn with(self, edge: Edge) -> Self {
        Self(self.0 | 1 << edge as u8)
    }

    /// The flags of leaf `leaf` in a balanced tree, eq (64).
    ///
    /// In place of the map of eq (63) it asks whether the square of the same size across the edge exists, that is,
    /// whether its parent is divided. Squares outside the root count as being of the same level.
    pub(super) fn of_leaf(map: &SubdivisionMap, leaf: Node) -> Self {
        Edge::ALL.into_iter().fold(Self::FULL, |pattern, edge| {
            let coarser =
                leaf.neighbour(edge).and_then(Node::parent).is_some_and(|across| !map.is_divided(across));
            if coarser { pattern.with(edge) } else { pattern }
        })
    }
}
