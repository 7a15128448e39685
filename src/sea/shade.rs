//! Level 0 of both maps and level 1 before it is packed, two rows at a time.
//!
//! A processor looks some hundred instructions ahead. All that a texel needs is more than that, and much of it waits for
//! what comes before it: in one loop most of the processor would stand idle. So the work is cut into short passes over a
//! few texels, whose numbers stay in the first cache in between; the iterations of each overlap.
use super::{
    band::Shading,
    foam::{self, FrameFoam},
    gradient::{Rows, Tangents, jacobian_byte, length, smoothness, to_byte, upward},
    mips::{CHANNELS, Level1},
    simd::{Float, MAX_LANES, Simd, Strided, StridedMut},
};
use half::f16;

/// Texels that go through all passes together.
const CHUNK: usize = 64;
const _: () = assert!(CHUNK.is_multiple_of(2 * MAX_LANES), "whole pairs of vectors");

/// Numbers of a texel between passes: its normal along u and v, [`Tangents::area`], and its normal's length.
const NUMBERS: usize = 4;
const Z: usize = CHUNK;
const AREA: usize = 2 * CHUNK;
const LENGTH: usize = 3 * CHUNK;

/// Numbers of working space.
pub const SCRATCH: usize = 2 * NUMBERS * CHUNK;

/// What is the same for all texels, in registers.
#[derive(Clone, Copy)]
pub struct Constants<V> {
    /// What u grows by between two neighbours of a texel, metres.
    width: V,
    /// Turns areas into 127.5 J.
    byte_scale: V,
    /// Turns areas into `breaking` J.
    breaking_scale: V,
    /// The last byte of a normal that has not been averaged.
    smoothness: V,
    breaking: V,
    lost: V,
}

impl<V: Float> Constants<V> {
    /// Those of a cascade.
    #[inline(always)]
    pub fn new<S: Simd<F32 = V>>(simd: S, shading: &Shading<'_>, foam: Option<FrameFoam>) -> Self {
        let unit = shading.gradient.per_difference * shading.gradient.per_difference;
        Self {
            width: simd.splat(1.0 / shading.gradient.per_difference),
            byte_scale: simd.splat(127.5 * unit),
            breaking_scale: simd.splat(shading.breaking * unit),
            smoothness: smoothness(simd, simd.splat(shading.gradient.normal_length)),
            breaking: simd.splat(shading.breaking),
            lost: simd.splat(foam.map_or(0.0, |foam| foam.lost)),
        }
    }
}

/// Where a row of level 0 goes.
pub struct TexelRow<'a> {
    /// (Du, h, Dv, compression).
    pub displacement: &'a mut [[f16; 4]],
    /// (n_u, n_v, J, smoothness).
    pub gradient: &'a mut [[u8; 4]],
    /// Compression remembered.
    pub memory: &'a [f32],
}

/// Fills an even row and the one after it, and adds to level 1. `scratch` has [`SCRATCH`] numbers.
#[inline(always)]
pub fn shade<S: Simd, const SHEET: bool>(
    simd: S,
    n: usize,
    constants: Constants<S::F32>,
    [upper, lower]: [Rows<'_, S>; 2],
    [mut to_upper, mut to_lower]: [TexelRow<'_>; 2],
    scratch: &mut [f32],
    mut level_1: Level1<'_, S>,
) {
    let len = n.min(CHUNK) / S::LANES;
    let (above, below) = scratch[..SCRATCH].split_at_mut(NUMBERS * CHUNK);
    for first in (0..n / S::LANES).step_by(len) {
        tilt::<S, SHEET>(simd, constants, upper, first, len, above);
        tilt::<S, SHEET>(simd, constants, lower, first, len, below);
        let columns = first * S::LANES..(first + len) * S::LANES;
        let mut straight = [
            Straight::<S, SHEET>::new(simd, constants, len, above, &mut to_upper.gradient[columns.clone()]),
            Straight::<S, SHEET>::new(simd, constants, len, below, &mut to_lower.gradient[columns.clone()]),
        ];
        halve(simd, &mut straight, first, len, 0, &mut level_1);
        let mut displaced = [
            Displaced::new(simd, constants, upper, first, len, above, &mut to_upper),
            Displaced::new(simd, constants, lower, first, len, below, &mut to_lower),
        ];
        halve(simd, &mut displaced, first, len, CHANNELS / 2, &mut level_1);
    }
}

/// Areas, normals of no particular length, and that length.
#[inline(always)]
fn tilt<S: Simd, const SHEET: bool>(
    simd: S,
    constants: Constants<S::F32>,
    rows: Rows<'_, S>,
    first: usize,
    len: usize,
    scratch: &mut [f32],
) {
    let mut texels = StridedMut::reaching(simd, scratch, 0, S::LANES, len, LENGTH);
    for index in 0..len {
        let tangents = Tangents::new(&rows, first + index, constants.width);
        let normal = tangents.normal::<SHEET>(constants.width);
        texels.store(index, normal[0]);
        texels.store_after(index, Z, normal[2]);
        texels.store_after(index, AREA, tangents.area);
        texels.store_after(index, LENGTH, length(simd, normal));
    }
}

/// Half the channels of a row's texels, which end in one of the maps.
trait Finish<S: Simd> {
    /// Writes vector `index` to the map; what there is to be averaged of it.
    fn finish(&mut self, index: usize) -> [S::F32; CHANNELS / 2];
}

/// Unit normals and areas, and the gradient map.
struct Straight<'a, S: Simd, const SHEET: bool> {
    simd: S,
    constants: Constants<S::F32>,
    texels: Strided<'a, S>,
    gradient: &'a mut [[u8; 4]],
}

impl<'a, S: Simd, const SHEET: bool> Straight<'a, S, SHEET> {
    #[inline(always)]
    fn new(
        simd: S,
        constants: Constants<S::F32>,
        len: usize,
        scratch: &'a [f32],
        gradient: &'a mut [[u8; 4]],
    ) -> Self {
        let texels = Strided::reaching(simd, scratch, 0, S::LANES, len, LENGTH);
        Self { simd, constants, texels, gradient }
    }
}

impl<S: Simd, const SHEET: bool> Finish<S> for Straight<'_, S, SHEET> {
    #[inline(always)]
    fn finish(&mut self, index: usize) -> [S::F32; CHANNELS / 2] {
        let (simd, constants) = (self.simd, self.constants);
        let inverse = simd.splat(1.0) / self.texels.load_after(index, LENGTH);
        let area = self.texels.load_after(index, AREA);
        let x = self.texels.load_after(index, 0) * inverse;
        let y = upward::<_, SHEET>(area, constants.width) * inverse;
        let z = self.texels.load_after(index, Z) * inverse;
        let j = jacobian_byte(simd, area, constants.byte_scale);
        let bytes = [to_byte(simd, x), to_byte(simd, z), j, constants.smoothness];
        S::F32::store_bytes(bytes, &mut self.gradient[index * S::LANES..]);
        [x, y, z, area]
    }
}

/// Displacement and compression, and the displacement map.
struct Displaced<'a, S: Simd> {
    simd: S,
    constants: Constants<S::F32>,
    rows: Rows<'a, S>,
    first: usize,
    areas: Strided<'a, S>,
    memory: Strided<'a, S>,
    displacement: &'a mut [[f16; 4]],
}

impl<'a, S: Simd> Displaced<'a, S> {
    #[inline(always)]
    fn new(
        simd: S,
        constants: Constants<S::F32>,
        rows: Rows<'a, S>,
        first: usize,
        len: usize,
        scratch: &'a [f32],
        out: &'a mut TexelRow<'_>,
    ) -> Self {
        let areas = Strided::new(simd, scratch, AREA, S::LANES, len);
        let memory = Strided::new(simd, out.memory, first * S::LANES, S::LANES, len);
        let displacement = &mut out.displacement[first * S::LANES..][..len * S::LANES];
        Self { simd, constants, rows, first, areas, memory, displacement }
    }
}

impl<S: Simd> Finish<S> for Displaced<'_, S> {
    #[inline(always)]
    fn finish(&mut self, index: usize) -> [S::F32; CHANNELS / 2] {
        let (simd, constants) = (self.simd, self.constants);
        let area = self.areas.load(index);
        let now = foam::compression(simd, area, constants.breaking_scale, constants.breaking);
        let compression = foam::fade(self.memory.load(index), constants.lost, now);
        let (rows, at) = (self.rows, self.first + index);
        let texel = [rows.value(1, at), rows.value(0, at), rows.value(2, at), compression];
        S::F32::store_halves(texel, &mut self.displacement[index * S::LANES..]);
        texel
    }
}

/// Finishes `len` vectors of two rows, and puts the mean of each four texels into the channels of level 1 from `channel` on.
#[inline(always)]
fn halve<S: Simd, F: Finish<S>>(
    simd: S,
    [upper, lower]: &mut [F; 2],
    first: usize,
    len: usize,
    channel: usize,
    level_1: &mut Level1<'_, S>,
) {
    for pair in 0..len / 2 {
        let (a, b) = (upper.finish(2 * pair), lower.finish(2 * pair));
        let (c, d) = (upper.finish(2 * pair + 1), lower.finish(2 * pair + 1));
        for i in 0..CHANNELS / 2 {
            let mean = (a[i] + b[i]).pair_sums(c[i] + d[i], simd.splat(0.25));
            level_1.store(first / 2 + pair, channel + i, mean);
        }
    }
}

/// A tick of the memory of one row.
#[inline(always)]
pub fn remember<S: Simd>(simd: S, rows: Rows<'_, S>, constants: Constants<S::F32>, memory: &mut [f32]) {
    for vector in 0..rows.vectors() {
        let tangents = Tangents::new(&rows, vector, constants.width);
        let (scale, breaking) = (constants.breaking_scale, constants.breaking);
        let now = foam::compression(simd, tangents.area, scale, breaking);
        let memory = &mut memory[vector * S::LANES..];
        foam::fade(simd.load(memory), constants.lost, now).store(memory);
    }
}
