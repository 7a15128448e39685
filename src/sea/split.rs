//! The maps of a cascade cut into bands of rows, each for a job of its own: no two share a texel.
use super::{
    band::top_level,
    maps::CascadeMaps,
    mips::{BandMaps, MAX_LEVELS, Top, mip_levels, mip_offset},
};
use std::ops::Range;

/// Most bands of a cascade.
pub const MAX_BANDS: usize = 8;

/// What belongs to one band alone.
pub struct Part<'a> {
    /// Its rows of level 0.
    pub range: Range<usize>,
    /// Its share of the maps.
    pub maps: BandMaps<'a>,
    /// Its share of the planes h, Du, Dv.
    pub planes: Option<[&'a mut [f32]; 3]>,
    /// Its share of the foam's memory.
    pub memory: &'a mut [f32],
    /// Where its top level goes.
    pub top: &'a mut [f32],
}

/// Cuts everything into bands of `rows` rows.
pub fn bands<'a>(
    n: usize,
    rows: usize,
    maps: &'a mut CascadeMaps,
    mut memory: &'a mut [f32],
    mut tops: &'a mut [f32],
) -> [Option<Part<'a>>; MAX_BANDS] {
    let mut displacement = levels(n, &mut maps.displacement);
    let mut gradient = levels(n, &mut maps.gradient);
    let planes = maps.planes.as_mut();
    let mut planes = planes.map(|planes| [&mut planes.height[..], &mut planes.du[..], &mut planes.dv[..]]);
    std::array::from_fn(|band| {
        (band < n / rows).then(|| Part {
            range: band * rows..(band + 1) * rows,
            maps: BandMaps {
                displacement: take_levels(n, rows, &mut displacement),
                gradient: take_levels(n, rows, &mut gradient),
            },
            planes: planes.as_mut().map(|planes| planes.each_mut().map(|plane| take(plane, rows * n))),
            memory: take(&mut memory, rows * n),
            top: take(&mut tops, Top::len(n)),
        })
    })
}

/// Both maps as one band.
pub fn whole(n: usize, maps: &mut CascadeMaps) -> BandMaps<'_> {
    BandMaps { displacement: levels(n, &mut maps.displacement), gradient: levels(n, &mut maps.gradient) }
}

/// A chain's levels; those that it does not have are empty.
fn levels<T>(n: usize, mut chain: &mut [T]) -> [&mut [T]; MAX_LEVELS] {
    std::array::from_fn(|level| {
        let len = if level < mip_levels(n) { mip_offset(n, level + 1) - mip_offset(n, level) } else { 0 };
        take(&mut chain, len)
    })
}

/// The next band of every level that bands make by themselves.
fn take_levels<'a, T>(
    n: usize,
    rows: usize,
    levels: &mut [&'a mut [T]; MAX_LEVELS],
) -> [&'a mut [T]; MAX_LEVELS] {
    std::array::from_fn(|level| {
        let len = if level <= top_level(rows) { (n >> level) * (rows >> level) } else { 0 };
        take(&mut levels[level], len)
    })
}

/// Takes the first `len` values away from `slice`.
fn take<'a, T>(slice: &mut &'a mut [T], len: usize) -> &'a mut [T] {
    slice.split_off_mut(..len).unwrap_or_default()
}
