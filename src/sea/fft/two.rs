//! Three real fields from half their spectra, in two separable passes.
//!
//! The first pass runs along u for the N/2 rows kv = 0..N/2 (the row at -N/2 is zero, the others are conjugate
//! mirrors). The second runs along v and lets every complex transform carry two real fields: h + i Du, and Dv of two
//! neighbouring groups of columns. That is three transforms of half a grid in each direction.
use super::{Fft, LANES, Lane, Planes};
use crate::sea::evolve::{TileSpectra, evolve};
use crate::sea::spectrum::Modes;
use std::cell::RefCell;

/// Grid columns in one job of the second pass: two groups of lanes, so that their Dv share a transform.
pub const COLUMNS: usize = 2 * LANES;

/// Working space of one thread, grown once to the largest transform it has seen.
#[derive(Default)]
struct Scratch {
    planes: [Vec<Lane>; 8],
}

thread_local! {
    static SCRATCH: RefCell<Scratch> = RefCell::default();
}

fn with_scratch(len: usize, work: impl FnOnce(&mut [Vec<Lane>; 8])) {
    SCRATCH.with_borrow_mut(|scratch| {
        for plane in &mut scratch.planes {
            if plane.len() < len {
                plane.resize(len, [0.0; LANES]);
            }
        }
        work(&mut scratch.planes);
    });
}

/// Length, in [`Lane`]s, of what [`along_u`] writes for one tile of eight kv.
pub const fn half_tile_len(n: usize) -> usize {
    3 * 2 * n
}

/// Length, in [`Lane`]s, of what [`along_v`] writes for one tile of sixteen columns.
pub const fn column_tile_len(n: usize) -> usize {
    3 * n * COLUMNS / LANES
}

/// Evolves one tile of eight kv and transforms it along u.
///
/// `modes` are the tile's N entries; `out` has [`half_tile_len`] lanes: for each of h, Du, Dv, for the real and then the
/// imaginary part, eight rows kv of N values along u.
pub fn along_u(fft: &Fft, modes: &[Modes], rotations: &[[f32; 2]], out: &mut [Lane]) {
    let n = fft.len();
    with_scratch(n, |planes| {
        let [h_re, h_im, u_re, u_im, v_re, v_im, re, im] = planes.each_mut().map(|plane| &mut plane[..n]);
        let mut spectra = TileSpectra { height: [h_re, h_im], du: [u_re, u_im], dv: [v_re, v_im] };
        evolve(modes, rotations, &mut spectra);
        let TileSpectra { height, du, dv } = spectra;
        for ([field_re, field_im], out) in [height, du, dv].into_iter().zip(out.chunks_exact_mut(2 * n)) {
            let data = Planes { re: field_re, im: field_im };
            let result = fft.inverse(data, Planes { re: &mut *re, im: &mut *im });
            let (out_re, out_im) = out.split_at_mut(n);
            transpose(result.re, out_re);
            transpose(result.im, out_im);
        }
    });
}

/// `[u][kv lane]` to `[kv][u]`.
fn transpose(from: &[Lane], to: &mut [Lane]) {
    let per_row = from.len() / LANES;
    for (block, rows) in from.chunks_exact(LANES).enumerate() {
        for lane in 0..LANES {
            to[lane * per_row + block] = std::array::from_fn(|u| rows[u][lane]);
        }
    }
}

/// Transforms sixteen columns along v and separates the real fields.
///
/// `half` holds the N/16 tiles of [`along_u`], `tile` is the number of the sixteen columns; `out` has
/// [`column_tile_len`] lanes: for each of h, Du, Dv, N rows v of sixteen values.
pub fn along_v(fft: &Fft, half: &[Lane], tile: usize, out: &mut [Lane]) {
    let n = fft.len();
    let (height, rest) = out.split_at_mut(2 * n);
    let (du, dv) = rest.split_at_mut(2 * n);
    with_scratch(n, |planes| {
        let [re, im, scratch_re, scratch_im, ..] = planes;
        for group in 0..2 {
            let column = 2 * tile + group;
            pair(n, [re, im], |kv| [row(half, n, 0, kv, column), row(half, n, 1, kv, column)]);
            let result = fft.inverse(Planes { re, im }, Planes { re: scratch_re, im: scratch_im });
            store(result.re, group, height);
            store(result.im, group, du);
        }
        pair(n, [re, im], |kv| [row(half, n, 2, kv, 2 * tile), row(half, n, 2, kv, 2 * tile + 1)]);
        let result = fft.inverse(Planes { re, im }, Planes { re: scratch_re, im: scratch_im });
        store(result.re, 0, dv);
        store(result.im, 1, dv);
    });
}

/// Real and imaginary part of eight neighbouring columns of a field at row kv of the half spectrum.
#[inline(always)]
fn row(half: &[Lane], n: usize, field: usize, kv: usize, column: usize) -> [Lane; 2] {
    let per_row = n / LANES;
    let at = kv / LANES * half_tile_len(n) + field * 2 * n + kv % LANES * per_row + column;
    [half[at], half[at + n]]
}

/// The spectrum of a + i b along v, from the halves kv >= 0 of the Hermitian a and b.
#[inline(always)]
fn pair(n: usize, [re, im]: [&mut Vec<Lane>; 2], load: impl Fn(usize) -> [[Lane; 2]; 2]) {
    // At kv = 0 a real field's transform is real; what is left of the imaginary part is rounding.
    let [[a, _], [b, _]] = load(0);
    re[0] = a;
    im[0] = b;
    for kv in 1..n / 2 {
        let [[a_re, a_im], [b_re, b_im]] = load(kv);
        for lane in 0..LANES {
            re[kv][lane] = a_re[lane] - b_im[lane];
            im[kv][lane] = a_im[lane] + b_re[lane];
        }
        for lane in 0..LANES {
            re[n - kv][lane] = a_re[lane] + b_im[lane];
            im[n - kv][lane] = b_re[lane] - a_im[lane];
        }
    }
    re[n / 2] = [0.0; LANES];
    im[n / 2] = [0.0; LANES];
}

fn store(from: &[Lane], group: usize, to: &mut [Lane]) {
    for (to, from) in to.chunks_exact_mut(2).zip(from) {
        to[group] = *from;
    }
}
