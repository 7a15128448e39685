//! How much each octave of wave numbers moves the surface.
use super::settings::{CascadeSettings, SeaSettings};
use super::spectrum::power;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// The waves of one octave, from half its wave number to that itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Octave {
    /// Its end, a power of two, rad/m.
    pub wave_number: f64,
    /// Variance of the height, m^2, that the spectra promise: that of one sine of the amplitude sqrt(2 variance).
    pub variance: f64,
}

/// The octaves of the spectral sea that have waves, ascending; their variances add up to the sea's.
pub fn octaves(sea: &SeaSettings) -> Vec<Octave> {
    let mut sums = BTreeMap::new();
    for (octave, variance) in sea.cascades.iter().flat_map(|cascade| of_cascade(cascade, sea.gravity)) {
        *sums.entry(octave).or_default() += variance;
    }
    let octave = |(octave, variance)| Octave { wave_number: libm::exp2(f64::from(octave) + 1.0), variance };
    sums.into_iter().map(octave).collect()
}

/// Binary logarithm of the beginning of each octave, and its variance.
fn of_cascade(cascade: &CascadeSettings, gravity: f64) -> BTreeMap<i32, f64> {
    let half = cascade.resolution as i32 / 2;
    let row = |j: i32| {
        let mut sums: BTreeMap<i32, f64> = BTreeMap::new();
        for i in 1 - half..half {
            // P(k) and P(-k) both are on the grid, and each counts for both.
            let variance = 2.0 * power(cascade, gravity, i, j);
            if variance > 0.0 {
                let k = TAU / cascade.patch_size * f64::from(i * i + j * j).sqrt();
                *sums.entry(libm::log2(k).floor() as i32).or_default() += variance;
            }
        }
        sums
    };
    // Collected in order: a parallel sum would depend on the number of threads.
    let rows: Vec<_> = (1 - half..half).into_par_iter().map(row).collect();
    let mut sums = BTreeMap::new();
    for (octave, variance) in rows.into_iter().flatten() {
        *sums.entry(octave).or_default() += variance;
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sea::expected_variance;

    #[test]
    fn octaves_share_the_variance() {
        let steep = CascadeSettings { wind_speed: 12.0, patch_size: 300.0, ..CascadeSettings::default() };
        let small = CascadeSettings { patch_size: 20.0, band: [2.0, f64::INFINITY], ..steep.clone() };
        let large = CascadeSettings { band: [0.0, 2.0], ..steep };
        let sea = SeaSettings { cascades: vec![large, small], ..SeaSettings::default() };
        let octaves = octaves(&sea);
        let whole: f64 = sea.cascades.iter().map(|cascade| expected_variance(cascade, sea.gravity)).sum();
        let sum: f64 = octaves.iter().map(|octave| octave.variance).sum();
        assert!((sum - whole).abs() < 1e-12 * whole, "{sum} {whole}");
        assert!(octaves.is_sorted_by(|a, b| 2.0 * a.wave_number <= b.wave_number), "{octaves:?}");
        // Behind the peak a wind sea falls with k^-3: an octave has about a quarter of the variance of the one before.
        let [.., before, last] = octaves[..octaves.len() - 1] else { panic!("{octaves:?}") };
        let ratio = last.variance / before.variance;
        assert!((0.15..0.35).contains(&ratio), "{ratio}");
    }

    #[test]
    fn a_flat_sea_has_none() {
        let calm = CascadeSettings { wind_speed: 0.0, ..CascadeSettings::default() };
        assert!(octaves(&SeaSettings { cascades: vec![calm], ..SeaSettings::default() }).is_empty());
    }
}
