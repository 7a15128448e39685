//! Mip chains: their layout, eq (55), and their filter, eq (52).

/// Levels of the chain of an `n` x `n` map, `n` a power of two: log2 n + 1.
pub const fn mip_levels(n: usize) -> usize {
    n.ilog2() as usize + 1
}

/// Index of the first texel of `level` in the chain of an `n` x `n` map, eq (55). At `level == mip_levels(n)` it is the
/// chain's length.
pub const fn mip_offset(n: usize, level: usize) -> usize {
    let remaining = (1_usize << (2 * (mip_levels(n) - level))) - 1;
    (4 * n * n - 1) / 3 - remaining / 3
}

/// Averages squares of two by two texels, eq (52): `from` holds whole rows of `n` texels, `to` half as many rows of n/2.
///
/// Normals are averaged as they are, unnormalised: their length then tells how much they differ.
pub fn halve(from: &[[f32; 4]], n: usize, to: &mut [[f32; 4]]) {
    for (pair, to) in from.chunks_exact(2 * n).zip(to.chunks_exact_mut(n / 2)) {
        let (upper, lower) = pair.split_at(n);
        let squares = upper.chunks_exact(2).zip(lower.chunks_exact(2));
        for (to, (upper, lower)) in to.iter_mut().zip(squares) {
            *to = std::array::from_fn(|c| 0.25 * ((upper[0][c] + upper[1][c]) + (lower[0][c] + lower[1][c])));
        }
    }
}
