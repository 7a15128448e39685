//! From transformed tiles to displacement planes, eq (44).
use super::fft::{Lane, two};

/// One real field's rows of the grid.
pub struct Rows<'a> {
    /// Displacement along u, metres.
    pub du: &'a mut [f32],
    /// Height, metres.
    pub height: &'a mut [f32],
    /// Displacement along v, metres.
    pub dv: &'a mut [f32],
}

/// Fills the rows of the grid beginning at `first_row` from the column tiles of [`two::along_v`].
///
/// The horizontal displacement is scaled by the choppiness lambda, eq (25). No sign is left to correct: the spectrum
/// was stored in FFT order.
pub fn assemble(tiles: &[Lane], n: usize, choppiness: f32, first_row: usize, rows: Rows<'_>) {
    let fields = [(rows.height, 1.0), (rows.du, choppiness), (rows.dv, choppiness)];
    for (field, (out, scale)) in fields.into_iter().enumerate() {
        for (row, out) in out.chunks_exact_mut(n).enumerate() {
            for (tile, out) in out.chunks_exact_mut(two::COLUMNS).enumerate() {
                let at = tile * two::column_tile_len(n) + (field * n + first_row + row) * 2;
                for (out, &value) in out.iter_mut().zip(tiles[at..at + 2].as_flattened()) {
                    *out = value * scale;
                }
            }
        }
    }
}
