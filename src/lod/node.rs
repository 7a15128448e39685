//! A square of the quadtree and where it stands.
use glam::DVec2;

/// One square of the quadtree: level 0 is the root, and a level has `2^level` x `2^level` squares.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Node {
    /// Subdivisions below the root.
    pub level: u8,
    /// Column, 0 at the west, growing with world x.
    pub x: u16,
    /// Row, 0 at the paper's south, growing with world z.
    pub y: u16,
}

impl Node {
    /// The square that covers the whole quadtree.
    pub const ROOT: Self = Self { level: 0, x: 0, y: 0 };

    /// The four quarters: south-west, south-east, north-west, north-east.
    pub fn children(self) -> [Self; 4] {
        let (level, x, y) = (self.level + 1, 2 * self.x, 2 * self.y);
        [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| Self { level, x: x + dx, y: y + dy })
    }

    /// The square this one is a quarter of; `None` for the root.
    pub fn parent(self) -> Option<Self> {
        let level = self.level.checked_sub(1)?;
        Some(Self { level, x: self.x / 2, y: self.y / 2 })
    }

    /// The square of the same size across an edge; `None` outside the root.
    pub fn neighbour(self, edge: super::Edge) -> Option<Self> {
        let (dx, dy) = edge.step();
        let x = self.x.checked_add_signed(dx)?;
        let y = self.y.checked_add_signed(dy)?;
        let width = 1_u32 << self.level;
        (u32::from(x) < width && u32::from(y) < width).then_some(Self { level: self.level, x, y })
    }

    /// Side in metres, `S / 2^level`, of a node in a root of side `root_size`.
    pub fn size(self, root_size: f64) -> f64 {
        // A power of two: the product is the quotient, exactly.
        root_size * f64::from_bits((1023 - u64::from(self.level)) << 52)
    }

    /// Centre (x, z) in metres relative to the root's centre, eq (58).
    pub fn centre(self, root_size: f64) -> DVec2 {
        let size = self.size(root_size);
        DVec2::new(f64::from(self.x) + 0.5, f64::from(self.y) + 0.5) * size - 0.5 * root_size
    }
}
