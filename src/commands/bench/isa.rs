//! Instruction sets that the sea's kernels are written for.
use crate::sea::fft::{Fft, LANES, Lane, Planes, two};
use crate::sea::{Sea, SeaError, SeaSettings};
use rayon::prelude::*;

/// One of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Isa {
    /// What the compiler makes for any processor of this kind.
    Scalar,
}

impl Isa {
    /// Those that this machine has, the best first.
    pub fn available() -> impl Iterator<Item = Self> {
        [Self::Scalar].into_iter()
    }

    /// The fastest of them.
    pub fn best() -> Self {
        Self::Scalar
    }

    /// As reports have it.
    pub const fn name(self) -> &'static str {
        "scalar"
    }
}

impl std::str::FromStr for Isa {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "scalar" => Ok(Self::Scalar),
            _ => Err("wanted avx512, avx2, sse, neon or scalar".to_owned()),
        }
    }
}

/// A sea whose kernels use `isa`.
///
/// # Errors
/// As [`Sea::new`].
pub fn sea(settings: &SeaSettings, _isa: Isa) -> Result<Sea, SeaError> {
    Sea::new(settings)
}

/// Half spectra of three real fields, and the fields.
pub struct ThreeFields {
    fft: Fft,
    /// By tile of eight kv, by field: real and imaginary parts of N lanes.
    spectra: Vec<[Vec<Lane>; 6]>,
    half: Vec<Lane>,
    tiles: Vec<Lane>,
}

impl ThreeFields {
    /// Flat fields of `n` x `n`.
    ///
    /// # Errors
    /// [`SeaError::TransformSize`].
    pub fn new(n: usize, _isa: Isa) -> Result<Self, SeaError> {
        let flat = |len| vec![[0.0; LANES]; len];
        Ok(Self {
            fft: Fft::new(n)?,
            spectra: (0..n / (2 * LANES)).map(|_| std::array::from_fn(|_| flat(n))).collect(),
            half: flat(n / (2 * LANES) * two::half_tile_len(n)),
            tiles: flat(n / two::COLUMNS * two::column_tile_len(n)),
        })
    }

    /// Sets the spectra: `wave(field, ku, kv)` for kv below N/2.
    pub fn fill(&mut self, wave: impl Fn(usize, usize, usize) -> [f32; 2]) {
        for (tile, spectra) in self.spectra.iter_mut().enumerate() {
            for (field, parts) in spectra.chunks_exact_mut(2).enumerate() {
                let (first, second) = parts.split_at_mut(1);
                for (ku, (re, im)) in first[0].iter_mut().zip(&mut second[0]).enumerate() {
                    for (lane, (re, im)) in re.iter_mut().zip(im).enumerate() {
                        [*re, *im] = wave(field, ku, tile * LANES + lane);
                    }
                }
            }
        }
    }

    /// Transforms what was filled in.
    pub fn inverse(&mut self) {
        let (fft, n) = (&self.fft, self.fft.len());
        let out = self.half.par_chunks_mut(two::half_tile_len(n));
        out.zip(&self.spectra).for_each(|(out, spectra)| along_u(fft, spectra, out));
        let half = &self.half;
        let out = self.tiles.par_chunks_mut(two::column_tile_len(n)).enumerate();
        out.for_each(|(tile, out)| two::along_v(fft, half, tile, out));
    }
}

fn along_u(fft: &Fft, spectra: &[Vec<Lane>; 6], out: &mut [Lane]) {
    let n = fft.len();
    let [mut re, mut im, mut scratch_re, mut scratch_im] = std::array::from_fn(|_| vec![[0.0; LANES]; n]);
    for (parts, out) in spectra.chunks_exact(2).zip(out.chunks_exact_mut(2 * n)) {
        re.copy_from_slice(&parts[0]);
        im.copy_from_slice(&parts[1]);
        let data = Planes { re: &mut re, im: &mut im };
        let result = fft.inverse(data, Planes { re: &mut scratch_re, im: &mut scratch_im });
        for (plane, out) in [result.re, result.im].into_iter().zip(out.chunks_exact_mut(n)) {
            for (block, rows) in plane.chunks_exact(LANES).enumerate() {
                for lane in 0..LANES {
                    out[lane * n / LANES + block] = std::array::from_fn(|u| rows[u][lane]);
                }
            }
        }
    }
}
