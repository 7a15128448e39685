//! Evolution and the pass along columns of one tile, in one go: a wave vector is read once for all three fields.
use super::{
    evolve::{AlongU, AlongV, evolve},
    fft::{
        columns::{Columns, Stored},
        layout::{FIELDS, Layout},
    },
    simd::{Kernel, Simd},
    spectrum::SpectrumTile,
};

/// Fills one tile of the half spectra for a moment. N = `R1` x `R2`.
pub struct StepColumns<'a, const R1: usize, const R2: usize, const M: usize> {
    /// The tile's waves.
    pub spectrum: SpectrumTile<'a>,
    /// (cos, sin) of every harmonic.
    pub rotations: &'a [[f32; 2]],
    /// [`super::fft::twiddles::Twiddles::columns`].
    pub twiddles: &'a [f32],
    /// Working space: one tile.
    pub height: &'a mut [f32],
    /// The three fields' tiles.
    pub out: &'a mut [f32],
}

impl<const R1: usize, const R2: usize, const M: usize> Kernel for StepColumns<'_, R1, R2, M> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Self { spectrum, rotations, twiddles, height, out } = self;
        evolve::<S, R1, R2>(simd, spectrum, rotations, height);
        let height = &*height;
        let along_u = AlongU { height, spectrum };
        let tiles = out.chunks_exact_mut(Layout::of(R1, R2).tile_len());
        for (field, tile) in tiles.take(FIELDS).enumerate() {
            match field {
                0 => simd.run(Columns::<_, R1, R2> {
                    source: Stored { tile: height, far: false },
                    twiddles,
                    tile,
                }),
                1 => simd.run(Columns::<_, R1, R2> { source: along_u, twiddles, tile }),
                _ => simd.run(Columns::<_, R1, R2> { source: AlongV(along_u), twiddles, tile }),
            }
        }
    }
}
