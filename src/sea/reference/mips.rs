//! The box filter, eq (52), and the chain's offsets, eq (55).

/// The next level of an n x n map.
pub fn halve(map: &[[f64; 4]], n: usize) -> Vec<[f64; 4]> {
    let half = n / 2;
    (0..half * half)
        .map(|at| {
            let (x, y) = (at % half, at / half);
            let mut sum = [0.0; 4];
            for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                let texel = map[(2 * y + j) * n + 2 * x + i];
                for (sum, part) in sum.iter_mut().zip(texel) {
                    *sum += 0.25 * part;
                }
            }
            sum
        })
        .collect()
}

/// Texels of all levels before `level`, counted one by one.
pub fn offset(n: usize, level: usize) -> usize {
    (0..level).map(|above| (n >> above) * (n >> above)).sum()
}
