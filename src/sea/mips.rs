//! Mip chains: their layout, eq (55), and their filter, eq (52).
use super::{
    gradient::{
        GradientParams, INVERSE_SQRTS, inverse_sqrts, jacobian_byte, roughness, smoothness, square, to_byte,
    },
    shade,
    simd::{Float, Kernel, MAX_LANES, Simd, Strided, StridedMut},
};
use half::f16;

/// Most levels of a chain: those of 512 x 512.
pub const MAX_LEVELS: usize = 10;

/// Numbers of a texel while it is filtered: the unit normal (u, y, v), [`Tangents::area`] for J, and (Du, h, Dv, compression).
///
/// [`Tangents::area`]: super::gradient::Tangents::area
pub const CHANNELS: usize = 8;

/// Levels of the chain of an `n` x `n` map, `n` a power of two: log2 n + 1.
pub const fn mip_levels(n: usize) -> usize {
    n.ilog2() as usize + 1
}

/// Texels of the longest row above level 0.
const LONGEST: usize = 256;

/// Numbers of working space for a row that is packed.
const EMITTED: usize = 4 * LONGEST;

/// Index of the first texel of `level` in the chain of an `n` x `n` map, eq (55). At `level == mip_levels(n)` it is the
/// chain's length.
pub const fn mip_offset(n: usize, level: usize) -> usize {
    let remaining = (1_usize << (2 * (mip_levels(n) - level))) - 1;
    (4 * n * n - 1) / 3 - remaining / 3
}

/// A band of both maps: all rows of every level that come from some rows of level 0.
pub struct BandMaps<'a> {
    /// Displacement, level by level.
    pub displacement: [&'a mut [[f16; 4]]; MAX_LEVELS],
    /// Gradient, level by level.
    pub gradient: [&'a mut [[u8; 4]]; MAX_LEVELS],
}

/// The levels above 0 of a band, filtered as the rows below them become ready, so that no level is read from memory.
///
/// Of every level two rows are kept; when the second is there, they become one row of the next. Rows are numbered from the
/// band's first. Normals are averaged as they are, unnormalised: their length then tells how much they differ.
#[derive(Clone, Copy, Debug)]
pub struct Pyramid {
    /// N.
    pub n: usize,
    /// Length of a unit normal over this water, eq (49).
    pub normal_length: f32,
    /// Turns areas into 127.5 J.
    pub byte_scale: f32,
}

impl Pyramid {
    /// That of a grid of `n` x `n`.
    pub fn new(n: usize, gradient: &GradientParams) -> Self {
        let byte_scale = 127.5 * (gradient.per_difference * gradient.per_difference);
        Self { n, normal_length: gradient.normal_length, byte_scale }
    }

    /// Numbers of working space for a grid of `n` x `n`.
    pub const fn scratch_len(n: usize) -> usize {
        let pyramid = Self { n, normal_length: 1.0, byte_scale: 1.0 };
        pyramid.slots() + if shade::SCRATCH > EMITTED { shade::SCRATCH } else { EMITTED }
    }

    /// Numbers of all slots.
    const fn slots(&self) -> usize {
        self.slot(mip_levels(self.n), 0)
    }

    /// Numbers from a channel of a row to the next; rows shorter than two vectors end in what nobody looks at.
    const fn stride(&self, level: usize) -> usize {
        let side = self.n >> level;
        if side < 2 * MAX_LANES { 2 * MAX_LANES } else { side }
    }

    /// Where row 0 or 1 of `level`, 1 or more, is kept.
    #[inline(always)]
    pub const fn slot(&self, level: usize, row: usize) -> usize {
        let mut at = 0;
        let mut below = 1;
        while below < level {
            at += 2 * CHANNELS * self.stride(below);
            below += 1;
        }
        at + (row & 1) * CHANNELS * self.stride(level)
    }

    /// Working space for shading, and level 1's slot for row `row`.
    #[inline(always)]
    pub fn level_1<'k, S: Simd>(
        &self,
        simd: S,
        row: usize,
        kept: &'k mut [f32],
    ) -> (&'k mut [f32], Level1<'k, S>) {
        let (kept, scratch) = kept.split_at_mut(self.slots());
        let (first, stride) = (self.slot(1, row), self.stride(1));
        let vectors = (self.n / 2).div_ceil(S::LANES);
        let slot = StridedMut::reaching(simd, kept, first, S::LANES, vectors, (CHANNELS - 1) * stride);
        (scratch, Level1 { slot, stride })
    }

    /// The two rows of `level` become row `row` of the next.
    #[inline(always)]
    pub fn halve<S: Simd>(&self, simd: S, level: usize, row: usize, kept: &mut [f32]) {
        let (stride, next_stride) = (self.stride(level), self.stride(level + 1));
        let (from, to) = kept.split_at_mut(self.slot(level + 1, 0));
        let to = &mut to[(row & 1) * CHANNELS * next_stride..];
        let vectors = (self.n >> (level + 1)).div_ceil(S::LANES);
        let quarter = simd.splat(0.25);
        for channel in 0..CHANNELS {
            let upper = self.slot(level, 0) + channel * stride;
            let lower = self.slot(level, 1) + channel * stride;
            let upper = Strided::new(simd, from, upper, S::LANES, 2 * vectors);
            let lower = Strided::new(simd, from, lower, S::LANES, 2 * vectors);
            let mut to = StridedMut::new(simd, to, channel * next_stride, S::LANES, vectors);
            for vector in 0..vectors {
                let left = upper.load(2 * vector) + lower.load(2 * vector);
                let right = upper.load(2 * vector + 1) + lower.load(2 * vector + 1);
                to.store(vector, left.pair_sums(right, quarter));
            }
        }
    }

    /// Packs row `row` of `level` into the maps, in short passes as [`shade`] does.
    #[inline(always)]
    fn emit<S: Simd>(&self, simd: S, level: usize, row: usize, kept: &mut [f32], maps: &mut BandMaps<'_>) {
        let (side, stride) = (self.n >> level, self.stride(level));
        let displacement = &mut maps.displacement[level][row * side..][..side];
        let gradient = &mut maps.gradient[level][row * side..][..side];
        let (kept, scratch) = kept.split_at_mut(self.slots());
        let vectors = side.div_ceil(S::LANES);
        let reach = (CHANNELS - 1) * stride;
        let from = Strided::reaching(simd, kept, self.slot(level, row), S::LANES, vectors, reach);
        let (squares, scratch) = scratch.split_at_mut(LONGEST);
        let (inverse, scratch) = scratch.split_at_mut(LONGEST);
        let (rough, scratch) = scratch.split_at_mut(LONGEST);
        let inverse_root = &mut scratch[..LONGEST];
        // Rows are shorter than that: what is beyond them does no harm.
        let whole = (vectors * S::LANES).next_multiple_of(INVERSE_SQRTS);
        for vector in 0..vectors {
            let normal =
                [from.load(vector), from.load_after(vector, stride), from.load_after(vector, 2 * stride)];
            let square = square(normal);
            square.store(&mut squares[vector * S::LANES..]);
            square.store(&mut inverse[vector * S::LANES..]);
        }
        inverse_sqrts(simd, &mut inverse[..whole]);
        let length = simd.splat(self.normal_length);
        for at in (0..vectors * S::LANES).step_by(S::LANES) {
            let rough_here = roughness(simd, simd.load(&squares[at..]) * simd.load(&inverse[at..]) * length);
            rough_here.store(&mut rough[at..]);
            rough_here.store(&mut inverse_root[at..]);
        }
        inverse_sqrts(simd, &mut inverse_root[..whole]);
        let byte_scale = simd.splat(self.byte_scale);
        for vector in 0..vectors {
            let column = vector * S::LANES;
            let inverse = simd.load(&inverse[column..]);
            let bytes = [
                to_byte(simd, from.load(vector) * inverse),
                to_byte(simd, from.load_after(vector, 2 * stride) * inverse),
                jacobian_byte(simd, from.load_after(vector, 3 * stride), byte_scale),
                smoothness(simd, simd.load(&rough[column..]), simd.load(&inverse_root[column..])),
            ];
            let mut halves = [simd.splat(0.0); 4];
            for (channel, half) in halves.iter_mut().enumerate() {
                *half = from.load_after(vector, (4 + channel) * stride);
            }
            if column + S::LANES <= side {
                S::F32::store_bytes(bytes, &mut gradient[column..]);
                S::F32::store_halves(halves, &mut displacement[column..]);
            } else {
                let (mut wide_halves, mut wide_bytes) = ([[f16::ZERO; 4]; MAX_LANES], [[0; 4]; MAX_LANES]);
                S::F32::store_bytes(bytes, &mut wide_bytes);
                S::F32::store_halves(halves, &mut wide_halves);
                gradient.copy_from_slice(&wide_bytes[..side]);
                displacement.copy_from_slice(&wide_halves[..side]);
            }
        }
    }
}

/// Writes a row that is in its slot to the maps, and every row above that it completes.
pub struct Absorb<'a, 'm> {
    /// Whose slots.
    pub pyramid: Pyramid,
    /// The row's level, 1 or more.
    pub level: usize,
    /// The row.
    pub row: usize,
    /// The last level to be written.
    pub top: usize,
    /// The slots, [`Pyramid::scratch_len`].
    pub kept: &'a mut [f32],
    /// The maps of the band that rows are counted from.
    pub maps: &'a mut BandMaps<'m>,
}

impl Kernel for Absorb<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Self { pyramid, mut level, mut row, top, kept, maps } = self;
        while level <= top {
            pyramid.emit(simd, level, row, kept, maps);
            if row & 1 == 0 || level == top {
                return;
            }
            pyramid.halve(simd, level, row / 2, kept);
            level += 1;
            row /= 2;
        }
    }
}

/// A row of level 1 that is being made.
#[derive(Debug)]
pub struct Level1<'k, S> {
    slot: StridedMut<'k, S>,
    stride: usize,
}

impl<S: Simd> Level1<'_, S> {
    /// Vector `vector` of `channel`.
    #[inline(always)]
    pub fn store(&mut self, vector: usize, channel: usize, value: S::F32) {
        self.slot.store_after(vector, channel * self.stride, value);
    }
}

/// The levels above those that bands make by themselves.
pub struct Top<'a, 'm> {
    /// The grid's.
    pub pyramid: Pyramid,
    /// Rows in a band.
    pub band: usize,
    /// The bands' top rows, [`Top::len`] numbers each, from [`Pyramid::top`].
    pub tops: &'a [f32],
    /// Working space, [`Pyramid::scratch_len`].
    pub kept: &'a mut [f32],
    /// The whole maps.
    pub maps: &'a mut BandMaps<'m>,
}

impl Top<'_, '_> {
    /// Numbers that a band of a grid of `n` x `n` keeps: at most the row of level 1 of a band of two rows.
    pub const fn len(n: usize) -> usize {
        let pyramid = Pyramid { n, normal_length: 1.0, byte_scale: 1.0 };
        CHANNELS * pyramid.stride(1)
    }
}

impl Pyramid {
    /// The one row of `level`, a band's top, in its slot.
    pub fn top<'k>(&self, level: usize, kept: &'k [f32]) -> &'k [f32] {
        &kept[self.slot(level, 0)..][..CHANNELS * self.stride(level)]
    }
}

impl Kernel for Top<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let pyramid = self.pyramid;
        let n = pyramid.n;
        let (level, last) = (self.band.ilog2() as usize, mip_levels(n) - 1);
        let row = CHANNELS * pyramid.stride(level);
        for (index, top) in self.tops.chunks_exact(Self::len(n)).take(n / self.band).enumerate() {
            self.kept[pyramid.slot(level, index)..][..row].copy_from_slice(&top[..row]);
            if index & 1 == 1 {
                pyramid.halve(simd, level, index / 2, self.kept);
                let (kept, maps) = (&mut *self.kept, &mut *self.maps);
                simd.run(Absorb { pyramid, level: level + 1, row: index / 2, top: last, kept, maps });
            }
        }
    }
}
