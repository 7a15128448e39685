//! What a sea's settings promise: its spectrum and its heights. Worth a thread of its own: it visits every wave there is.

use crate::sea::{CascadeSettings, SeaSettings, expected_variance, spectrum, waves::Model};
use std::f64::consts::TAU;

/// Bins of a spectrum for each factor of ten in the wave number.
const BINS: f64 = 12.0;
/// Least wave number, rad/m, as its logarithm to base 10, and how many factors of ten there are from it.
const FIRST: f64 = -4.0;
const DECADES: f64 = 8.0;

/// Of a sea, by cascade.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facts {
    /// log10 of the wave number (rad/m) and the height's variance in m^2 for each factor of ten: what of the sea is where.
    pub spectra: Vec<Vec<[f64; 2]>>,
    /// Standard deviations of the height, metres.
    pub heights: Vec<f64>,
    /// Sides of the patches, metres.
    pub patches: Vec<f64>,
    /// log10 of the wave number (rad/m) and the height's variance, m^2, of each wave that is a formula.
    pub waves: Vec<[f64; 2]>,
    /// Variance of the heights of all formulas, m^2.
    pub formulas: f64,
}

impl Facts {
    /// Of the sea in `settings`.
    pub fn of(settings: &SeaSettings) -> Self {
        let gravity = settings.gravity;
        Self {
            spectra: settings.cascades.iter().map(|cascade| spectrum_of(cascade, gravity)).collect(),
            heights: settings
                .cascades
                .iter()
                .map(|cascade| expected_variance(cascade, gravity).sqrt())
                .collect(),
            patches: settings.cascades.iter().map(|cascade| cascade.patch_size).collect(),
            waves: settings
                .models
                .iter()
                .flat_map(Model::waves)
                .map(|wave| [(TAU / wave.wavelength()).log10(), wave.variance()])
                .collect(),
            formulas: settings.models.iter().map(Model::variance).sum(),
        }
    }

    /// Standard deviation of the whole sea's height, metres.
    pub fn height(&self) -> f64 {
        (self.heights.iter().map(|height| height * height).sum::<f64>() + self.formulas).sqrt()
    }
}

fn spectrum_of(cascade: &CascadeSettings, gravity: f64) -> Vec<[f64; 2]> {
    let half = cascade.resolution as i32 / 2;
    let mut bins = vec![0.0; (BINS * DECADES) as usize];
    for j in 1 - half..half {
        for i in 1 - half..half {
            let power = spectrum::power(cascade, gravity, i, j);
            if power > 0.0 {
                let k = TAU / cascade.patch_size * f64::from(i * i + j * j).sqrt();
                let bin = ((k.log10() - FIRST) * BINS).max(0.0) as usize;
                if let Some(bin) = bins.get_mut(bin) {
                    // P(k) and P(-k) both reach the variance.
                    *bin += 2.0 * power;
                }
            }
        }
    }
    let middle = |bin: usize| FIRST + (bin as f64 + 0.5) / BINS;
    bins.iter()
        .enumerate()
        .filter(|(_, sum)| **sum > 0.0)
        .map(|(bin, sum)| [middle(bin), sum * BINS])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spectrum_holds_all_of_the_variance() {
        let facts = Facts::of(&SeaSettings::default());
        let sum: f64 = facts.spectra[0].iter().map(|[_, density]| density / BINS).sum();
        assert!((sum - facts.height().powi(2)).abs() < 1e-9 * sum, "{sum} {}", facts.height());
        assert!(facts.spectra[0].windows(2).all(|pair| pair[0][0] < pair[1][0]));
    }
}
