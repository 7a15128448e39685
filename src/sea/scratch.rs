//! Working space of one thread, grown once to the largest cascade it has met.
use super::{
    band::{self, Working},
    fft::{layout::Layout, rows},
    mips::Pyramid,
    simd::{Aligned, Isa},
};
use std::cell::RefCell;

/// What jobs of a step use and leave as it is.
#[derive(Default)]
pub struct Scratch {
    tile: Aligned<f32>,
    planes: Aligned<f32>,
    rows: Aligned<f32>,
    kept: Aligned<f32>,
}

thread_local! {
    static SCRATCH: RefCell<Scratch> = RefCell::default();
}

/// Makes the working space for grids up to `n` x `n` on every thread of the pool it is called in: a thread that has its
/// first job late asks for no memory then.
pub fn reserve(n: usize, isa: Isa) {
    rayon::broadcast(|_| {
        with_scratch(|scratch| {
            if let Some(layout) = Layout::new(n) {
                scratch.tile(layout);
            }
            scratch.band(n, isa);
        });
    });
}

/// Lends the calling thread's working space to `work`, which must not ask for it again.
pub fn with_scratch<R>(work: impl FnOnce(&mut Scratch) -> R) -> R {
    SCRATCH.with_borrow_mut(work)
}

/// The first `len` numbers of `buffer`, whatever they are.
fn grown(buffer: &mut Aligned<f32>, len: usize) -> &mut [f32] {
    if buffer.len() < len {
        *buffer = Aligned::zeros(len);
    }
    &mut buffer[..len]
}

impl Scratch {
    /// One tile.
    pub fn tile(&mut self, layout: Layout) -> &mut [f32] {
        grown(&mut self.tile, layout.tile_len())
    }

    /// What a band of a grid of `n` x `n` needs on `isa`.
    pub fn band(&mut self, n: usize, isa: Isa) -> Working<'_> {
        Working {
            planes: grown(&mut self.planes, band::window(n, isa.lanes()).numbers()),
            rows: grown(&mut self.rows, rows::scratch_len(n, isa.lanes())),
            kept: grown(&mut self.kept, Pyramid::scratch_len(n)),
        }
    }

    /// What the levels above all bands need.
    pub fn pyramid(&mut self, n: usize) -> &mut [f32] {
        grown(&mut self.kept, Pyramid::scratch_len(n))
    }
}
