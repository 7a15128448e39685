//! Mip chains: their layout, eq (55), and their filter, eq (52).
use super::{
    gradient::GradientParams,
    pack::{self, pack},
    shade,
    simd::{Channels, ChannelsMut, Float, Kernel, MAX_LANES, Simd},
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

/// Index of the first texel of `level` in the chain of an `n` x `n` map, eq (55). At `level == mip_levels(n)` it is the
/// chain's length.
pub const fn mip_offset(n: usize, level: usize) -> usize {
    let remaining = (1_usize << (2 * (mip_levels(n) - level))) - 1;
    (4 * n * n - 1) / 3 - remaining / 3
}

/// A row of level 1 that is being made.
pub type Level1<'k, S> = ChannelsMut<'k, S, CHANNELS>;

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
    /// Where row 0 of each level is kept, and where the last one ends.
    slots: [usize; MAX_LEVELS + 1],
}

impl Pyramid {
    /// That of a grid of `n` x `n` whose unit normals are `normal_length` long and whose areas times `byte_scale` are 127.5 J.
    pub const fn new(n: usize, normal_length: f32, byte_scale: f32) -> Self {
        let mut pyramid = Self { n, normal_length, byte_scale, slots: [0; MAX_LEVELS + 1] };
        let (mut level, mut at) = (1, 0);
        while level < mip_levels(n) {
            pyramid.slots[level] = at;
            // Two vectors are read of rows that are shorter than two.
            at += CHANNELS * pyramid.stride(level) + 2 * MAX_LANES;
            level += 1;
        }
        pyramid.slots[level] = at;
        pyramid
    }

    /// That of a cascade.
    pub fn of(n: usize, gradient: &GradientParams) -> Self {
        let scale = gradient.per_difference * gradient.per_difference;
        Self::new(n, gradient.normal_length, 127.5 * scale)
    }

    /// Numbers of working space for a grid of `n` x `n`.
    pub const fn scratch_len(n: usize) -> usize {
        let slots = Self::new(n, 1.0, 1.0).slots();
        slots + if shade::SCRATCH > pack::SCRATCH { shade::SCRATCH } else { pack::SCRATCH }
    }

    /// Numbers of all slots.
    #[inline(always)]
    pub(super) const fn slots(&self) -> usize {
        self.slots[mip_levels(self.n)]
    }

    /// Numbers from a channel to the next: two rows, and as much as a vector that begins in the second may reach beyond it.
    pub(super) const fn stride(&self, level: usize) -> usize {
        let side = self.n >> level;
        if side < MAX_LANES { 2 * MAX_LANES } else { 2 * side }
    }

    /// Where channel 0 of row 0 or 1 of `level`, 1 or more, is kept. Row 1 of a channel follows its row 0: to whoever packs
    /// them they are one.
    #[inline(always)]
    pub(super) const fn slot(&self, level: usize, row: usize) -> usize {
        self.slots[level] + (row & 1) * (self.n >> level)
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
        (scratch, ChannelsMut::new(simd, kept, first, stride, vectors))
    }

    /// The two rows of `level` become row `row` of the next.
    #[inline(always)]
    fn halve<S: Simd>(&self, simd: S, level: usize, row: usize, kept: &mut [f32]) {
        let (side, stride, next_stride) = (self.n >> level, self.stride(level), self.stride(level + 1));
        let vectors = (side / 2).div_ceil(S::LANES);
        let (from, to) = kept.split_at_mut(self.slot(level + 1, 0));
        let upper = Channels::<S, CHANNELS>::new(simd, from, self.slot(level, 0), stride, 2 * vectors);
        let lower = Channels::<S, CHANNELS>::new(simd, from, self.slot(level, 1), stride, 2 * vectors);
        let first = (row & 1) * (side / 2);
        let mut to = ChannelsMut::<S, CHANNELS>::new(simd, to, first, next_stride, vectors);
        let quarter = simd.splat(0.25);
        for vector in 0..vectors {
            for channel in 0..CHANNELS {
                let left = upper.load(2 * vector, channel) + lower.load(2 * vector, channel);
                let right = upper.load(2 * vector + 1, channel) + lower.load(2 * vector + 1, channel);
                to.store(vector, channel, left.pair_sums(right, quarter));
            }
        }
    }
}

/// Takes in a row that is in its slot: the second of two is written to the maps with the first, and they become a row of the
/// next level.
pub struct Absorb<'a, 'm> {
    /// Whose slots.
    pub pyramid: &'a Pyramid,
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
        while row & 1 == 1 && level < top {
            pack(simd, pyramid, level, row - 1..row + 1, kept, maps);
            pyramid.halve(simd, level, row / 2, kept);
            level += 1;
            row /= 2;
        }
        if level == top {
            pack(simd, pyramid, level, row..row + 1, kept, maps);
        }
    }
}

/// The levels above those that bands make by themselves.
pub struct Top<'a, 'm> {
    /// The grid's.
    pub pyramid: &'a Pyramid,
    /// Rows in a band.
    pub band: usize,
    /// The bands' top rows, [`Top::len`] numbers each, from [`Pyramid::copy_top`].
    pub tops: &'a [f32],
    /// Working space, [`Pyramid::scratch_len`].
    pub kept: &'a mut [f32],
    /// The whole maps.
    pub maps: &'a mut BandMaps<'m>,
}

impl Top<'_, '_> {
    /// Numbers that a band of a grid of `n` x `n` keeps: at most the row of level 1 of a band of two rows.
    pub const fn len(n: usize) -> usize {
        CHANNELS * n / 2
    }
}

impl Pyramid {
    /// Copies the one row of `level`, a band's top, to `to`, channel after channel.
    pub fn copy_top(&self, level: usize, kept: &[f32], to: &mut [f32]) {
        let (side, stride) = (self.n >> level, self.stride(level));
        for (channel, to) in to.chunks_exact_mut(side).take(CHANNELS).enumerate() {
            to.copy_from_slice(&kept[self.slot(level, 0) + channel * stride..][..side]);
        }
    }
}

impl Kernel for Top<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let pyramid = self.pyramid;
        let n = pyramid.n;
        let (level, last) = (self.band.ilog2() as usize, mip_levels(n) - 1);
        let side = n >> level;
        for (index, top) in self.tops.chunks_exact(Self::len(n)).take(n / self.band).enumerate() {
            for (channel, top) in top.chunks_exact(side).take(CHANNELS).enumerate() {
                let at = pyramid.slot(level, index) + channel * pyramid.stride(level);
                self.kept[at..][..side].copy_from_slice(top);
            }
            if index & 1 == 1 {
                pyramid.halve(simd, level, index / 2, self.kept);
                let (kept, maps) = (&mut *self.kept, &mut *self.maps);
                simd.run(Absorb { pyramid, level: level + 1, row: index / 2, top: last, kept, maps });
            }
        }
    }
}
