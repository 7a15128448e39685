//! The transform by itself, on one thread: what benches and tests ask of it.
use super::{
    columns::{Columns, Stored},
    layout::{FIELDS, Layout, TILE},
    rows::{self, HalfSpectra, Rows, Window},
    run_sized,
    twiddles::Twiddles,
};
use crate::sea::{
    SeaError,
    simd::{Aligned, Isa, Kernel, Simd},
    spectrum::signed,
};

/// The largest grid whose spectra are close at hand, all in the second cache.
const LARGEST_AT_HAND: usize = 128;

/// Three stored half spectra and the planes they become.
#[derive(Clone, Debug)]
pub struct ThreeFields {
    isa: Isa,
    layout: Layout,
    twiddles: Twiddles,
    stored: Aligned<f32>,
    half: Aligned<f32>,
    scratch: Aligned<f32>,
    planes: Aligned<f32>,
    window: Window,
}

impl ThreeFields {
    /// Zeros of `n` x `n`, to be transformed on `isa`.
    ///
    /// # Errors
    /// [`SeaError::TransformSize`] unless `n` is a power of two in 16..=512.
    pub fn new(n: usize, isa: Isa) -> Result<Self, SeaError> {
        let layout = Layout::new(n).ok_or(SeaError::TransformSize { size: n })?;
        let window = Window { n, rows: n };
        let len = layout.tiles() * FIELDS * layout.tile_len();
        Ok(Self {
            isa,
            layout,
            twiddles: Twiddles::new(&layout),
            stored: Aligned::zeros(len),
            half: Aligned::zeros(len),
            scratch: Aligned::zeros(rows::scratch_len(n, isa.lanes())),
            planes: Aligned::zeros(window.numbers()),
            window,
        })
    }

    /// Stores `spectrum(field, ku, kv)` as (re, im), for the fields h, Du, Dv, ku in 0..N/2 and kv in -N/2 + 1..N/2. It is
    /// Hermitian: for ku = 0 the caller sees to it.
    pub fn fill(&mut self, mut spectrum: impl FnMut(usize, i32, i32) -> [f32; 2]) {
        let n = self.layout.n;
        for (tile, numbers) in self.stored.chunks_exact_mut(self.layout.tile_len()).enumerate() {
            for (row, lane) in (0..n * TILE).map(|at| (at / TILE, at % TILE)) {
                let at = self.layout.row(row) + lane;
                let ku = (tile / FIELDS * TILE + lane) as i32;
                let still = row == n / 2;
                let [re, im] = if still { [0.0; 2] } else { spectrum(tile % FIELDS, ku, signed(row, n)) };
                (numbers[at], numbers[at + TILE]) = (re, im);
            }
        }
    }

    /// Transforms what is stored, which stays, into the planes.
    pub fn inverse(&mut self) {
        run_sized!(
            self.isa,
            self.layout.n,
            Inverse {
                stored: &self.stored,
                half: &mut self.half,
                twiddles: &self.twiddles,
                scratch: &mut self.scratch,
                planes: &mut self.planes,
            }
        );
    }

    /// Row `v` of a field's plane, N numbers: 0 is h, 1 is Du, 2 is Dv.
    ///
    /// # Panics
    /// When there is no such field.
    pub fn row(&self, field: usize, v: usize) -> &[f32] {
        &self.planes[self.window.row(field, v)..][..self.layout.n]
    }

    /// Fills working space and planes with `value`: nothing of it must be seen again.
    pub fn soil(&mut self, value: f32) {
        self.half.fill(value);
        self.scratch.fill(value);
        self.planes.fill(value);
    }
}

struct Inverse<'a, const R1: usize, const R2: usize, const M: usize> {
    stored: &'a [f32],
    half: &'a mut [f32],
    twiddles: &'a Twiddles,
    scratch: &'a mut [f32],
    planes: &'a mut [f32],
}

impl<const R1: usize, const R2: usize, const M: usize> Kernel for Inverse<'_, R1, R2, M> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let layout = Layout::of(R1, R2);
        let tiles = self.stored.chunks_exact(layout.tile_len());
        for (tile, half) in tiles.zip(self.half.chunks_exact_mut(layout.tile_len())) {
            let twiddles = &self.twiddles.columns;
            simd.run(Columns::<_, R1, R2> {
                source: Stored { tile, far: R1 * R2 > LARGEST_AT_HAND },
                twiddles,
                tile: half,
            });
        }
        let window = Window { n: R1 * R2, rows: R1 * R2 };
        let from = HalfSpectra { tiles: self.half, twiddles: &self.twiddles.rows };
        let (planes, scratch) = (self.planes, self.scratch);
        simd.run(Rows::<R1, R2, M> { from, rows: 0..R1 * R2, window, planes, scratch });
    }
}
