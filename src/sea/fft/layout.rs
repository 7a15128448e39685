//! Where the numbers of a transform lie.
//!
//! # Tiles
//! The spectra of three real fields are kept for ku = 0..N/2 alone (the other half is their conjugate mirror), in tiles of
//! neighbouring ku. A tile holds N rows kv; a row is the real parts of its
//! ku, then the imaginary parts. After every `R2` rows one is left out, since N = R1 x R2: transforms along a column walk in
//! steps of `R2` rows, and steps of a power of two would fall on the same few sets of the cache. So is one after each tile: the
//! pass along rows walks from tile to tile.
//!
//! # Order
//! Columns are transformed in place: what comes out of row `R2 p + q` of the tile is row `p + R1 q` of the field. Nobody sorts
//! it; the pass along rows fetches each row from where it is.

/// Values of ku in a tile: a multiple of the lanes of the vectors that columns are transformed on. A longer vector, see
/// [`crate::sea::simd::Simd::wide`], spans tiles.
pub const TILE: usize = 8;

/// Numbers in a row of a tile.
pub const ROW: usize = 2 * TILE;

/// The shape of a transform of N x N.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// N.
    pub n: usize,
    /// First radix along columns.
    pub r1: usize,
    /// Second radix along columns.
    pub r2: usize,
}

/// Fields transformed together: h, Du, Dv.
pub const FIELDS: usize = 3;

/// Points of the second of the two transforms that one along a row consists of; the first has N / 16.
pub const ROW_RADIX: usize = 16;

impl Layout {
    /// `None` unless `n` is 16, 32, 64, 128, 256 or 512.
    pub const fn new(n: usize) -> Option<Self> {
        let (r1, r2) = match n {
            16 => (4, 4),
            32 => (4, 8),
            64 => (8, 8),
            128 => (8, 16),
            256 => (16, 16),
            512 => (16, 32),
            _ => return None,
        };
        Some(Self::of(r1, r2))
    }

    /// The shape of a transform of `r1` x `r2` points.
    #[inline(always)]
    pub const fn of(r1: usize, r2: usize) -> Self {
        Self { n: r1 * r2, r1, r2 }
    }

    /// Numbers from a row of a tile to the one that is `R2` rows further.
    #[inline(always)]
    pub const fn group_len(&self) -> usize {
        (self.r2 + 1) * ROW
    }

    /// Numbers in a tile.
    #[inline(always)]
    pub const fn tile_len(&self) -> usize {
        (self.n + self.r1 + 1) * ROW
    }

    /// Tiles of a field.
    #[inline(always)]
    pub const fn tiles(&self) -> usize {
        self.n / 2 / TILE
    }

    /// First number of row `row` of a tile.
    #[inline(always)]
    pub const fn row(&self, row: usize) -> usize {
        row / self.r2 * self.group_len() + row % self.r2 * ROW
    }

    /// First number of row v of the field in a tile whose columns have been transformed.
    #[inline(always)]
    pub const fn transformed_row(&self, v: usize) -> usize {
        self.row(v % self.r1 * self.r2 + v / self.r1)
    }
}
