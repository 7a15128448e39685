//! Averaged texels as the maps hold them, eqs (50)-(53).
use super::{
    gradient::{jacobian_byte, length, smoothness, to_byte},
    mips::{BandMaps, CHANNELS, Pyramid},
    simd::{Channels, Float, MAX_LANES, Simd},
};
use half::f16;
use std::ops::Range;

/// Texels of the two longest rows above level 0.
const LONGEST: usize = 512;

/// Numbers of working space.
pub const SCRATCH: usize = LONGEST;

/// Packs `rows` of `level`, two or one, into the maps, in short passes as [`super::shade`] does.
#[inline(always)]
pub fn pack<S: Simd>(
    simd: S,
    pyramid: &Pyramid,
    level: usize,
    rows: Range<usize>,
    kept: &mut [f32],
    maps: &mut BandMaps<'_>,
) {
    let (side, stride) = (pyramid.n >> level, pyramid.stride(level));
    let texels = rows.start * side..rows.end * side;
    let displacement = &mut maps.displacement[level][texels.clone()];
    let gradient = &mut maps.gradient[level][texels.clone()];
    let vectors = texels.len().div_ceil(S::LANES);
    let (kept, scratch) = kept.split_at_mut(pyramid.slots());
    let first = pyramid.slot(level, rows.start);
    let from = Channels::<S, CHANNELS>::new(simd, kept, first, stride, vectors);
    let lengths = &mut scratch[..LONGEST];
    for vector in 0..vectors {
        let normal = [from.load(vector, 0), from.load(vector, 1), from.load(vector, 2)];
        length(simd, normal).store(&mut lengths[vector * S::LANES..]);
    }
    let (one, unit) = (simd.splat(1.0), simd.splat(pyramid.normal_length));
    let byte_scale = simd.splat(pyramid.byte_scale);
    for vector in 0..vectors {
        let at = vector * S::LANES;
        let long = simd.load(&lengths[at..]);
        let inverse = one / long;
        let bytes = [
            to_byte(simd, from.load(vector, 0) * inverse),
            to_byte(simd, from.load(vector, 2) * inverse),
            jacobian_byte(simd, from.load(vector, 3), byte_scale),
            smoothness(simd, long * unit),
        ];
        let halves = [from.load(vector, 4), from.load(vector, 5), from.load(vector, 6), from.load(vector, 7)];
        if at + S::LANES <= texels.len() {
            S::F32::store_bytes(bytes, &mut gradient[at..]);
            S::F32::store_halves(halves, &mut displacement[at..]);
        } else {
            let (mut wide_halves, mut wide_bytes) = ([[f16::ZERO; 4]; MAX_LANES], [[0; 4]; MAX_LANES]);
            S::F32::store_bytes(bytes, &mut wide_bytes);
            S::F32::store_halves(halves, &mut wide_halves);
            let len = texels.len() - at;
            gradient[at..].copy_from_slice(&wide_bytes[..len]);
            displacement[at..].copy_from_slice(&wide_halves[..len]);
        }
    }
}
