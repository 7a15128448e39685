//! What a sea's height is a sum of, as far as density has to know.

/// One wave, or all waves of one octave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Component {
    /// Waves a metre, 1/m; of an octave, its highest.
    pub frequency: f64,
    /// Amplitude of the height, metres; of an octave, that of the one sine with the octave's variance.
    pub amplitude: f64,
}

/// The components of a sea, in any order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Signal(pub Vec<Component>);

impl Signal {
    /// The highest frequency, 1/m, of the components whose amplitude is `threshold` metres or more; 0 where none is.
    pub fn highest_frequency(&self, threshold: f64) -> f64 {
        let displaces =
            |component: &&Component| component.amplitude >= threshold && component.amplitude > 0.0;
        self.0.iter().filter(displaces).map(|component| component.frequency).fold(0.0, f64::max)
    }
}
