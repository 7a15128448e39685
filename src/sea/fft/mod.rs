//! The inverse transform of eq (1) along one axis: eight signals side by side, one per lane.
//!
//! Stockham's form of the fast Fourier transform, radix 8 and 4, decimation in frequency: every pass reads one pair
//! of planes in order and writes the other in order, and the result comes out sorted, with no bit reversal.
pub mod two;

use super::error::SeaError;
use std::f64::consts::TAU;

/// Signals transformed together.
pub const LANES: usize = 8;
/// One sample of each of them.
pub type Lane = [f32; LANES];

/// Real and imaginary parts of `N` samples of [`LANES`] signals.
pub struct Planes<'a> {
    /// Real parts.
    pub re: &'a mut [Lane],
    /// Imaginary parts.
    pub im: &'a mut [Lane],
}

/// One pass over the data.
#[derive(Clone, Debug)]
struct Pass {
    radix: usize,
    /// Sub-transforms before this pass: the run of samples that share a twiddle factor.
    stride: usize,
    /// e^{2 pi i p j / n} as (re, im), `twiddles[p * (radix - 1) + j - 1]`.
    twiddles: Vec<[f32; 2]>,
}

/// A planned transform X_x = sum over k of x_k e^{+2 pi i k x / N}, unscaled.
#[derive(Clone, Debug)]
pub struct Fft {
    len: usize,
    passes: Vec<Pass>,
}

impl Fft {
    /// Plans a transform of `len` points.
    ///
    /// # Errors
    /// [`SeaError::TransformSize`] unless `len` is a power of two in 16..=512.
    pub fn new(len: usize) -> Result<Self, SeaError> {
        let radices: &[usize] = match len {
            16 => &[4, 4],
            32 => &[8, 4],
            64 => &[8, 8],
            128 => &[8, 4, 4],
            256 => &[8, 8, 4],
            512 => &[8, 8, 8],
            size => return Err(SeaError::TransformSize { size }),
        };
        let mut stride = 1;
        let passes = radices
            .iter()
            .map(|&radix| {
                let pass = Pass { radix, stride, twiddles: twiddles(len / stride, radix) };
                stride *= radix;
                pass
            })
            .collect();
        Ok(Self { len, passes })
    }

    /// N.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Never: the smallest transform has 16 points.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Transforms `data`, using both pairs of planes as working space, and returns the pair that holds the result.
    ///
    /// # Panics
    /// When a plane has fewer than N samples.
    pub fn inverse<'a>(&self, data: Planes<'a>, scratch: Planes<'a>) -> Planes<'a> {
        let n = self.len;
        let mut from = Planes { re: &mut data.re[..n], im: &mut data.im[..n] };
        let mut to = Planes { re: &mut scratch.re[..n], im: &mut scratch.im[..n] };
        for pass in &self.passes {
            if pass.radix == 8 {
                radix8(pass, &from, &mut to);
            } else {
                radix4(pass, &from, &mut to);
            }
            std::mem::swap(&mut from, &mut to);
        }
        from
    }
}

fn twiddles(n: usize, radix: usize) -> Vec<[f32; 2]> {
    let groups = n / radix;
    (0..groups)
        .flat_map(|p| (1..radix).map(move |j| (p * j % n) as f64 / n as f64))
        .map(|turn| {
            let (sin, cos) = libm::sincos(TAU * turn);
            [cos as f32, sin as f32]
        })
        .collect()
}

/// Complex numbers, one per lane.
#[derive(Clone, Copy)]
struct Complex {
    re: Lane,
    im: Lane,
}

impl Complex {
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            re: std::array::from_fn(|l| self.re[l] + other.re[l]),
            im: std::array::from_fn(|l| self.im[l] + other.im[l]),
        }
    }

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self {
            re: std::array::from_fn(|l| self.re[l] - other.re[l]),
            im: std::array::from_fn(|l| self.im[l] - other.im[l]),
        }
    }

    /// Times i.
    #[inline(always)]
    fn turned(self) -> Self {
        Self { re: self.im.map(|x| -x), im: self.re }
    }

    /// Times e^{i pi/4}.
    #[inline(always)]
    fn turned_eighth(self) -> Self {
        const S: f32 = std::f32::consts::FRAC_1_SQRT_2;
        Self {
            re: std::array::from_fn(|l| (self.re[l] - self.im[l]) * S),
            im: std::array::from_fn(|l| (self.re[l] + self.im[l]) * S),
        }
    }

    #[inline(always)]
    fn times(self, [cos, sin]: [f32; 2]) -> Self {
        Self {
            re: std::array::from_fn(|l| self.re[l] * cos - self.im[l] * sin),
            im: std::array::from_fn(|l| self.re[l] * sin + self.im[l] * cos),
        }
    }
}

/// Four-point transform with e^{+i}.
#[inline(always)]
fn butterfly4([a, b, c, d]: [Complex; 4]) -> [Complex; 4] {
    let (ac, ac_minus) = (a.add(c), a.sub(c));
    let (bd, bd_minus) = (b.add(d), b.sub(d).turned());
    [ac.add(bd), ac_minus.add(bd_minus), ac.sub(bd), ac_minus.sub(bd_minus)]
}

fn radix4(pass: &Pass, from: &Planes<'_>, to: &mut Planes<'_>) {
    let stride = pass.stride;
    let quarter = from.re.len() / 4;
    let groups = to.re.chunks_exact_mut(4 * stride).zip(to.im.chunks_exact_mut(4 * stride));
    for ((p, (to_re, to_im)), twiddles) in groups.enumerate().zip(pass.twiddles.chunks_exact(3)) {
        for q in 0..stride {
            let at = p * stride + q;
            let x = std::array::from_fn(|arm| Complex {
                re: from.re[at + arm * quarter],
                im: from.im[at + arm * quarter],
            });
            let y = butterfly4(x);
            to_re[q] = y[0].re;
            to_im[q] = y[0].im;
            for arm in 1..4 {
                let turned = y[arm].times(twiddles[arm - 1]);
                to_re[q + arm * stride] = turned.re;
                to_im[q + arm * stride] = turned.im;
            }
        }
    }
}

fn radix8(pass: &Pass, from: &Planes<'_>, to: &mut Planes<'_>) {
    let stride = pass.stride;
    let eighth = from.re.len() / 8;
    let groups = to.re.chunks_exact_mut(8 * stride).zip(to.im.chunks_exact_mut(8 * stride));
    for ((p, (to_re, to_im)), twiddles) in groups.enumerate().zip(pass.twiddles.chunks_exact(7)) {
        for q in 0..stride {
            let at = p * stride + q;
            let load =
                |arm: usize| Complex { re: from.re[at + arm * eighth], im: from.im[at + arm * eighth] };
            let even = butterfly4([load(0), load(2), load(4), load(6)]);
            let odd = butterfly4([load(1), load(3), load(5), load(7)]);
            let odd = [odd[0], odd[1].turned_eighth(), odd[2].turned(), odd[3].turned_eighth().turned()];
            for arm in 0..4 {
                let mut low = even[arm].add(odd[arm]);
                if arm > 0 {
                    low = low.times(twiddles[arm - 1]);
                }
                to_re[q + arm * stride] = low.re;
                to_im[q + arm * stride] = low.im;
                let high = even[arm].sub(odd[arm]).times(twiddles[arm + 3]);
                to_re[q + (arm + 4) * stride] = high.re;
                to_im[q + (arm + 4) * stride] = high.im;
            }
        }
    }
}
