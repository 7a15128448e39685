//! Mip chains: their layout, eq (55), and their filter, eq (52).
use super::{
    gradient::{GradientParams, Two, inverse_sqrt, jacobian_byte, smoothness, square, to_byte},
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
        pyramid.slot(mip_levels(n), 0)
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

    /// Level 1's slot for row `row` of level 0 and its neighbour: the even one, which comes first, fills it, the odd one
    /// adds to it.
    #[inline(always)]
    pub fn first_level<'k, S: Simd>(&self, simd: S, row: usize, kept: &'k mut [f32]) -> Halved<'k, S> {
        let (first, stride) = (self.slot(1, row / 2), self.stride(1));
        let vectors = (self.n / 2).div_ceil(S::LANES);
        let reach = (CHANNELS - 1) * stride;
        Halved {
            slot: StridedMut::reaching(simd, kept, first, S::LANES, vectors, reach),
            stride,
            add: row & 1 == 1,
        }
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

    /// Packs row `row` of `level` into the maps.
    #[inline(always)]
    fn emit<S: Simd>(&self, simd: S, level: usize, row: usize, kept: &[f32], maps: &mut BandMaps<'_>) {
        let (side, stride) = (self.n >> level, self.stride(level));
        let displacement = &mut maps.displacement[level][row * side..][..side];
        let gradient = &mut maps.gradient[level][row * side..][..side];
        let vectors = side.div_ceil(2 * S::LANES) * 2;
        let reach = (CHANNELS - 1) * stride;
        let from = Strided::reaching(simd, kept, self.slot(level, row), S::LANES, vectors, reach);
        for pair in 0..vectors / 2 {
            let mut texels = [[simd.splat(0.0); CHANNELS]; 2];
            for (half, texel) in texels.iter_mut().enumerate() {
                for (channel, value) in texel.iter_mut().enumerate() {
                    *value = from.load_after(2 * pair + half, channel * stride);
                }
            }
            let bytes = pack(simd, texels, simd.splat(self.normal_length), simd.splat(self.byte_scale));
            for half in 0..2 {
                let column = (2 * pair + half) * S::LANES;
                let [.., du, height, dv, compression] = texels[half];
                let halves = [du, height, dv, compression];
                if column + S::LANES <= side {
                    S::F32::store_halves(halves, &mut displacement[column..]);
                    S::F32::store_bytes(bytes[half], &mut gradient[column..]);
                } else if column < side {
                    let (mut wide_halves, mut wide_bytes) =
                        ([[f16::ZERO; 4]; MAX_LANES], [[0; 4]; MAX_LANES]);
                    S::F32::store_halves(halves, &mut wide_halves);
                    S::F32::store_bytes(bytes[half], &mut wide_bytes);
                    displacement.copy_from_slice(&wide_halves[..side]);
                    gradient.copy_from_slice(&wide_bytes[..side]);
                }
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
pub struct Halved<'k, S> {
    slot: StridedMut<'k, S>,
    stride: usize,
    add: bool,
}

impl<S: Simd> Halved<'_, S> {
    /// A quarter of the sums of neighbours in two vectors of level 0.
    #[inline(always)]
    pub fn add(&mut self, simd: S, vector: usize, left: [S::F32; CHANNELS], right: [S::F32; CHANNELS]) {
        let quarter = simd.splat(0.25);
        if self.add {
            for channel in 0..CHANNELS {
                let means = left[channel].pair_sums(right[channel], quarter);
                let before = self.slot.load_after(simd, vector, channel * self.stride);
                self.slot.store_after(vector, channel * self.stride, before + means);
            }
        } else {
            for channel in 0..CHANNELS {
                let means = left[channel].pair_sums(right[channel], quarter);
                self.slot.store_after(vector, channel * self.stride, means);
            }
        }
    }
}

/// (n_u, n_v, J, smoothness) as numbers 0..=255, eqs (50)(51), of two vectors of texels whose unit normals were averaged;
/// where they agree, the normal is `length` long. Areas times `byte_scale` are 127.5 J.
#[inline(always)]
pub fn pack<S: Simd>(
    simd: S,
    texels: Two<[S::F32; CHANNELS]>,
    length: S::F32,
    byte_scale: S::F32,
) -> Two<[S::F32; 4]> {
    let [[x, y, z, area, ..], [x_, y_, z_, area_, ..]] = texels;
    let squares = [square([x, y, z]), square([x_, y_, z_])];
    let inverse = inverse_sqrt(simd, squares);
    let lengths = [squares[0] * inverse[0] * length, squares[1] * inverse[1] * length];
    let smooth = smoothness(simd, lengths);
    let jacobians = [jacobian_byte(simd, area, byte_scale), jacobian_byte(simd, area_, byte_scale)];
    [
        [to_byte(simd, x * inverse[0]), to_byte(simd, z * inverse[0]), jacobians[0], smooth[0]],
        [to_byte(simd, x_ * inverse[1]), to_byte(simd, z_ * inverse[1]), jacobians[1], smooth[1]],
    ]
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
