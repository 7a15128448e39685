//! How the wave numbers are shared out among cascades that do not say so themselves.
use std::f64::consts::PI;

/// A wave of which fewer fit into a patch belongs to the next larger patch: fewer would show the patch's repetition.
const WAVES_PER_PATCH: f64 = 6.0;

/// Share of a grid's Nyquist wave number, pi N / L, up to which its waves are well drawn: four points a wave.
const NYQUIST_SHARE: f64 = 0.5;

/// Disjoint bands `[low, high)` in rad/m for cascades given as (patch size in metres, resolution), by descending patch
/// size: the first begins at 0, each ends where the next begins, the last reaches infinity.
///
/// Cascade c ends at six waves of the next patch, `6 * 2 pi / L_(c+1)`, or at half its own Nyquist wave number,
/// `0.5 pi N_c / L_c`, whichever is less. Boundaries never descend, so a cascade that finds its waves taken has an
/// empty band.
pub fn split_bands(cascades: &[(f64, usize)]) -> Vec<[f64; 2]> {
    let mut low = 0.0;
    (0..cascades.len())
        .map(|c| {
            let (patch_size, resolution) = cascades[c];
            let high = cascades.get(c + 1).map_or(f64::INFINITY, |&(next_patch_size, _)| {
                let next_resolves = WAVES_PER_PATCH * 2.0 * PI / next_patch_size;
                let resolves = NYQUIST_SHARE * PI * resolution as f64 / patch_size;
                next_resolves.min(resolves).max(low)
            });
            let band = [low, high];
            low = high;
            band
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_join_without_gap_or_overlap() {
        let bands = split_bands(&[(421.0, 256), (97.3, 256), (18.7, 256)]);
        assert_eq!(bands[0][0], 0.0);
        assert_eq!(bands[0][1], bands[1][0]);
        assert_eq!(bands[1][1], bands[2][0]);
        assert_eq!(bands[2][1], f64::INFINITY);
        assert!((bands[0][1] - 12.0 * PI / 97.3).abs() < 1e-12);
        assert!((bands[1][1] - 12.0 * PI / 18.7).abs() < 1e-12);
    }

    #[test]
    fn a_coarse_grid_hands_over_at_half_its_nyquist() {
        let bands = split_bands(&[(400.0, 16), (10.0, 256)]);
        assert!((bands[0][1] - 0.5 * PI * 16.0 / 400.0).abs() < 1e-12);
    }

    #[test]
    fn one_cascade_carries_everything() {
        assert_eq!(split_bands(&[(100.0, 64)]), [[0.0, f64::INFINITY]]);
    }
}
