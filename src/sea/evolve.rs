//! Waves at a moment: eqs (19)-(24), and the spectra of the horizontal displacement.
use super::{
    clock::Phase,
    fft::{
        butterfly::Complex,
        columns::{Rows, Source, StoredRows},
        layout::{Layout, ROW, TILE},
    },
    simd::{Float, Kernel, Simd, Strided, StridedMut},
    spectrum::SpectrumTile,
};
use std::f64::consts::TAU;

/// Fills a table with (cos, sin) of every harmonic at a moment: far fewer than there are wave vectors.
pub struct Rotations<'a> {
    /// The harmonics.
    pub harmonics: &'a [u32],
    /// The moment.
    pub phase: Phase,
    /// Their table.
    pub table: &'a mut [[f32; 2]],
}

impl Kernel for Rotations<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        for (entry, &harmonic) in self.table.iter_mut().zip(self.harmonics) {
            *entry = cos_sin(self.phase.turned(harmonic));
        }
    }
}

/// (cos, sin) of `turn` / 2^32 of a circle, to 1e-9 before they are rounded.
///
/// Taylor's series in `f64` up to an eighth of a circle, without fused or library operations: the same bits everywhere. And
/// without branches, so that the compiler can make vectors of it.
#[inline(always)]
pub fn cos_sin(turn: u32) -> [f32; 2] {
    const QUARTER: u32 = 1 << 30;
    let quadrant = turn.wrapping_add(QUARTER / 2) / QUARTER;
    let rest = turn.wrapping_sub(quadrant * QUARTER).cast_signed();
    let x = f64::from(rest) * (TAU / 4_294_967_296.0);
    // A quotient is as many instructions as all the rest: 1 / n! is known beforehand.
    const fn over(n: u32) -> f64 {
        let (mut product, mut i) = (1.0, 2);
        while i <= n {
            product *= i as f64;
            i += 1;
        }
        1.0 / product
    }
    const SIN: [f64; 6] = [1.0, -over(3), over(5), -over(7), over(9), -over(11)];
    const COS: [f64; 7] = [1.0, -over(2), over(4), -over(6), over(8), -over(10), over(12)];
    let x2 = x * x;
    let sin = x * SIN.iter().rev().fold(0.0, |sum, term| sum * x2 + term);
    let cos = COS.iter().rev().fold(0.0, |sum, term| sum * x2 + term);
    // Each quarter of a turn: (cos, sin) becomes (-sin, cos).
    let (cos, sin) = (cos as f32, sin as f32);
    let [cos, sin] = if quadrant & 1 == 0 { [cos, sin] } else { [sin, cos] };
    let sign = |turned: u32| (turned & 2) << 30;
    [f32::from_bits(cos.to_bits() ^ sign(quadrant + 1)), f32::from_bits(sin.to_bits() ^ sign(quadrant))]
}

/// The spectrum of the height of one tile, h(k, t) = h0(k) e^{-i w t} + conj(h0(-k)) e^{i w t}, so that waves run along +k.
///
/// `rotations` is the table of [`Rotations`], `out` a tile of N = `R1` x `R2` rows.
#[inline(always)]
pub fn evolve<S: Simd, const R1: usize, const R2: usize>(
    simd: S,
    spectrum: SpectrumTile<'_>,
    rotations: &[[f32; 2]],
    out: &mut [f32],
) {
    let layout = Layout::of(R1, R2);
    let n = layout.n;
    let harmonic = &spectrum.harmonic[..(n / 2 + 1) * TILE];
    let out = &mut out[..layout.tile_len()];
    for lane in (0..TILE).step_by(S::LANES) {
        // k and its mirror image along v turn equally fast.
        for kv in 0..n / 2 {
            let turn = simd.pairs(rotations, &harmonic[kv * TILE + lane..]);
            wave(simd, spectrum.amplitudes, turn, kv, lane, &mut out[layout.row(kv)..]);
            if kv > 0 {
                wave(simd, spectrum.amplitudes, turn, n - kv, lane, &mut out[layout.row(n - kv)..]);
            }
        }
        let nyquist = &mut out[layout.row(n / 2) + lane..];
        simd.splat(0.0).store(nyquist);
        simd.splat(0.0).store(&mut nyquist[TILE..]);
    }
}

/// One vector of [`evolve`], to the row `out`.
#[inline(always)]
fn wave<S: Simd>(
    simd: S,
    amplitudes: &[f32],
    [cos, sin]: [S::F32; 2],
    row: usize,
    lane: usize,
    out: &mut [f32],
) {
    let parts = Strided::new(simd, amplitudes, 4 * row * TILE + lane, TILE, 4);
    let mut out = StridedMut::new(simd, out, lane, TILE, 2);
    out.store(0, parts.load(2).mul_add(sin, parts.load(0) * cos));
    out.store(1, parts.load(3).mul_add(sin, parts.load(1) * cos));
}

/// The spectrum of the displacement along u: i ku/|k| h times the choppiness, which with e^{+ik.x} draws points towards
/// crests.
#[derive(Clone, Copy, Debug)]
pub struct AlongU<'a> {
    /// h, from [`evolve`].
    pub height: &'a [f32],
    /// The tile it is of.
    pub spectrum: SpectrumTile<'a>,
}

/// The same along v.
#[derive(Clone, Copy, Debug)]
pub struct AlongV<'a>(pub AlongU<'a>);

impl Source for AlongU<'_> {
    #[inline(always)]
    fn rows<S: Simd, const R1: usize, const R2: usize>(self, simd: S, q: usize, lane: usize) -> impl Rows<S> {
        let component = simd.load(&COUNT) + simd.splat((self.spectrum.first_ku + lane) as f32);
        UnitRows::<S, R1, R2>::new(simd, self, q, lane, [component, simd.splat(0.0)])
    }
}

impl Source for AlongV<'_> {
    #[inline(always)]
    fn rows<S: Simd, const R1: usize, const R2: usize>(self, simd: S, q: usize, lane: usize) -> impl Rows<S> {
        UnitRows::<S, R1, R2>::new(simd, self.0, q, lane, [simd.splat(q as f32), simd.splat(R2 as f32)])
    }
}

/// 0, 1, 2, ..
const COUNT: [f32; TILE] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// Rows of i k/|k| h.
#[derive(Clone, Copy)]
struct UnitRows<'a, S: Simd, const R1: usize, const R2: usize> {
    simd: S,
    height: StoredRows<'a, S>,
    /// Choppiness over |k|, rows q + R2 p.
    inverse: Strided<'a, S>,
    /// The same backwards: rows of the negative frequencies are mirrored.
    mirrored: Strided<'a, S>,
    /// The component of k in the first row, and its growth from row to row.
    component: [S::F32; 2],
}

impl<'a, S: Simd, const R1: usize, const R2: usize> UnitRows<'a, S, R1, R2> {
    #[inline(always)]
    fn new(simd: S, waves: AlongU<'a>, q: usize, lane: usize, component: [S::F32; 2]) -> Self {
        let inverse = waves.spectrum.inverse;
        // The rows kv < N/2 are the first half of p; the others are N - kv = (R2 - q) + R2 (R1 - 1 - p).
        let half = R1 / 2;
        Self {
            simd,
            height: StoredRows::new(
                simd,
                waves.height,
                q * ROW + lane,
                Layout::of(R1, R2).group_len(),
                R1,
                false,
            ),
            inverse: Strided::new(simd, inverse, q * TILE + lane, R2 * TILE, half),
            mirrored: Strided::new(simd, inverse, (R2 - q) * TILE + lane, R2 * TILE, half),
            component,
        }
    }
}

impl<S: Simd, const R1: usize, const R2: usize> Rows<S> for UnitRows<'_, S, R1, R2> {
    #[inline(always)]
    fn load(self, p: usize) -> Complex<S::F32> {
        let (inverse, p_signed) = if p < R1 / 2 {
            (self.inverse.load(p), p as f32)
        } else {
            (self.mirrored.load(R1 - 1 - p), p as f32 - R1 as f32)
        };
        let unit = self.component[1].mul_add(self.simd.splat(p_signed), self.component[0]) * inverse;
        let height = self.height.load(p);
        Complex { re: -(unit * height.im), im: unit * height.re }
    }

    #[inline(always)]
    fn prefetch(self, _: usize) {}
}
