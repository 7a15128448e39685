//! What repeated measurement says: the middle, the ends, and how far they lie apart.
use std::time::Duration;

/// Times of one thing, each of one call.
#[derive(Clone, Debug, Default)]
pub struct Samples {
    seconds: Vec<f64>,
}

/// Order statistics of [`Samples`], microseconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// Half of the samples are below it.
    pub median: f64,
    /// The fastest.
    pub min: f64,
    /// The slowest: on a busy machine, how long somebody else's turn took.
    pub max: f64,
    /// Distance of the quartiles over the median, percent.
    pub spread: f64,
    /// How many samples.
    pub count: usize,
}

impl Samples {
    /// Adds one.
    pub fn push(&mut self, time: Duration) {
        self.seconds.push(time.as_secs_f64());
    }

    /// `None` without a sample.
    pub fn summary(&self) -> Option<Summary> {
        let mut sorted = self.seconds.clone();
        sorted.sort_by(f64::total_cmp);
        let count = sorted.len();
        // Between the two neighbours of a place that is not whole.
        let quantile = |share: f64| {
            let place = share * (count - 1) as f64;
            let (below, above) = (place.floor() as usize, place.ceil() as usize);
            1e6 * (sorted[below] + (sorted[above] - sorted[below]) * place.fract())
        };
        (count > 0).then(|| {
            let median = quantile(0.5);
            let spread = if median > 0.0 { 100.0 * (quantile(0.75) - quantile(0.25)) / median } else { 0.0 };
            Summary { median, min: quantile(0.0), max: quantile(1.0), spread, count }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_and_the_middle_lie_between_neighbours() {
        let mut samples = Samples::default();
        assert_eq!(samples.summary(), None);
        for microseconds in [4, 1, 3, 2] {
            samples.push(Duration::from_micros(microseconds));
        }
        let summary = samples.summary().unwrap();
        let near = |value: f64, wanted: f64| assert!((value - wanted).abs() < 1e-9, "{value} {wanted}");
        near(summary.median, 2.5);
        near(summary.min, 1.0);
        near(summary.max, 4.0);
        near(summary.spread, 60.0);
        assert_eq!(summary.count, 4);
    }
}
