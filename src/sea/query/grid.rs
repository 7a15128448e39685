//! A cascade's displacement map, with all that a look at it needs worked out once.
use crate::sea::{
    maps::CascadeMaps,
    simd::{MAX_LANES, MOVED_HALF, REBIAS, Simd, Texels},
};
use half::f16;

/// 1.5 * 2^52: adding it to a number below 2^51 rounds that to an integer and leaves the integer, modulo any power of
/// two, in the lowest bits of the sum. Vector instruction sets of all ages can do that, and not all of them can floor.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// Level 0 of one cascade.
#[derive(Clone, Copy, Debug)]
pub struct Grid<'a> {
    /// (Du, h, Dv, compression), N x N, N a power of two.
    pub texels: Texels<'a>,
    /// N - 1.
    pub mask: u64,
    /// log2 N.
    pub shift: u32,
    /// N / L.
    pub per_metre: f64,
    /// Cosine and sine of the cascade's rotation.
    pub turn: [f64; 2],
    /// Both times `per_metre`.
    scaled: [f64; 2],
}

impl<'a> Grid<'a> {
    /// A sea at rest, of one texel.
    pub const FLAT: Grid<'static> = Grid {
        texels: Texels::new(&[[f16::ZERO; 4]; 2]),
        mask: 0,
        shift: 0,
        per_metre: 1.0,
        turn: [1.0, 0.0],
        scaled: [1.0, 0.0],
    };

    /// The map of a cascade.
    pub fn new(maps: &'a CascadeMaps) -> Self {
        let n = maps.resolution;
        debug_assert!(n.is_power_of_two(), "a cascade has 2^m x 2^m points");
        let (sin, cos) = libm::sincos(maps.rotation);
        let per_metre = n as f64 / maps.patch_size;
        Self {
            // Level 1 follows.
            texels: Texels::new(&maps.displacement[..=n * n]),
            mask: n as u64 - 1,
            shift: n.trailing_zeros(),
            per_metre,
            turn: [cos, sin],
            scaled: [cos * per_metre, sin * per_metre],
        }
    }

    /// World (x, z) along the cascade's axes u and v, in texels.
    #[inline(always)]
    pub fn along(&self, [x, z]: [f64; 2]) -> [f64; 2] {
        let [cos, sin] = self.scaled;
        [x * cos - z * sin, x * sin + z * cos]
    }

    /// The column or row in which a coordinate in texels lies, and where in it, 0..=1.
    #[inline(always)]
    pub fn cell(&self, along: f64) -> (u64, f64) {
        let nearest = (along - 0.5) + ROUND;
        (nearest.to_bits() & self.mask, along - (nearest - ROUND))
    }

    /// (Du, h, Dv) at the corners of cells whose columns and rows may be any, on the torus: themselves, the next along u,
    /// along v, along both.
    #[inline(always)]
    pub fn corners<S: Simd>(&self, simd: S, columns: &[u32], rows: &[u32]) -> [[S::F32; 3]; 4] {
        let (columns, rows, mask) = (&columns[..S::LANES], &rows[..S::LANES], self.mask as u32);
        let (mut upper, mut lower, mut last) = ([0; MAX_LANES], [0; MAX_LANES], 0);
        for l in 0..S::LANES {
            let (column, row) = (columns[l] & mask, rows[l] & mask);
            upper[l] = row << self.shift | column;
            lower[l] = ((row + 1) & mask) << self.shift | column;
            last |= u32::from(column == mask);
        }
        let ([a, mut b], [c, mut d]) =
            (simd.texel_pairs(self.texels, &upper), simd.texel_pairs(self.texels, &lower));
        // What is next to a row's last texel is its first, and not the one that follows in memory.
        if last != 0 {
            for l in 0..S::LANES {
                let right = columns[l].wrapping_add(1) & mask;
                upper[l] = upper[l] & !mask | right;
                lower[l] = lower[l] & !mask | right;
            }
            [b, _] = simd.texel_pairs(self.texels, &upper);
            [d, _] = simd.texel_pairs(self.texels, &lower);
        }
        [a, b, c, d]
    }

    /// The 16-bit floats of a texel, Du in the lowest bits.
    #[inline(always)]
    pub fn bits(&self, index: u64) -> u64 {
        bytemuck::cast(self.texels.get(index as u32))
    }

    /// A texel's values. Column and row may be any, on the torus.
    #[inline(always)]
    pub fn texel(&self, column: u64, row: u64) -> [f32; 4] {
        let bits = self.bits((row & self.mask) << self.shift | column & self.mask);
        [0, 16, 32, 48].map(|at| single((bits >> at) as u32))
    }
}

/// The 16-bit float in the lower half of `bits`, which must be finite: its sign and its exponent go where a single has
/// them. Plain arithmetic, so that the compiler can do several at once.
#[inline(always)]
pub fn single(bits: u32) -> f32 {
    let moved = ((bits << 16).cast_signed() >> 3).cast_unsigned() & MOVED_HALF;
    f32::from_bits(moved) * REBIAS
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sea::simd::{Float, Isa, Kernel};

    #[test]
    fn every_finite_half_is_read() {
        assert_eq!(REBIAS, 112_f32.exp2());
        for bits in 0..=u16::MAX {
            let truth = f16::from_bits(bits);
            if truth.is_finite() {
                let got = single(0xabcd_0000 | u32::from(bits));
                assert_eq!(got.to_bits(), truth.to_f32().to_bits(), "{bits:#x}");
            }
        }
    }

    /// Corners of cells anywhere: within rows, at their ends, below the last one.
    struct Corners<'a>(&'a Grid<'a>);

    impl Kernel for Corners<'_> {
        type Output = ();
        #[inline(always)]
        fn run<S: Simd>(self, simd: S) {
            for at in [[0, 0], [2, 3], [3, 1], [7, 10], [u32::MAX, u32::MAX], [u32::MAX - 9, 5]] {
                // A single vector has cells at the end of a row or none.
                for spread in [0, 1] {
                    let cells = at.map(|at| {
                        std::array::from_fn::<_, MAX_LANES, _>(|l| at.wrapping_add(spread * l as u32))
                    });
                    let corners = self.0.corners(simd, &cells[0], &cells[1]);
                    for (corner, numbers) in corners.into_iter().enumerate() {
                        for (place, numbers) in numbers.into_iter().enumerate() {
                            let mut lanes = [0.0; MAX_LANES];
                            numbers.store(&mut lanes);
                            for l in 0..S::LANES {
                                let [column, row] = [cells[0][l], cells[1][l]].map(u64::from);
                                let (right, below) = (corner as u64 & 1, corner as u64 >> 1);
                                let truth = self.0.texel(column + right, row + below)[place];
                                assert_eq!(lanes[l], truth, "{column} {row}, corner {corner}, {place}");
                            }
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn corners_are_those_of_the_torus() {
        let texels: Vec<[f16; 4]> = (0..17)
            .map(|i| [0.0, 100.0, 200.0, 300.0].map(|first| f16::from_f32(first + i as f32)))
            .collect();
        let grid = Grid { texels: Texels::new(&texels), mask: 3, shift: 2, ..Grid::FLAT };
        for isa in Isa::available() {
            isa.run(Corners(&grid));
        }
    }

    #[test]
    fn a_coordinate_is_its_cell_and_its_fraction() {
        let grid = Grid { mask: 15, ..Grid::FLAT };
        for (along, cell, fraction) in
            [(0.25, 0, 0.25), (15.5, 15, 0.5), (16.75, 0, 0.75), (-0.25, 15, 0.75), (-1e9 + 0.5, 0, 0.5)]
        {
            assert_eq!(grid.cell(along), (cell, fraction), "{along}");
        }
        // A whole number is at the end of one cell or at the beginning of the next.
        let (cell, fraction) = grid.cell(3.0);
        assert_eq!(cell as f64 + fraction, 3.0);
    }
}
