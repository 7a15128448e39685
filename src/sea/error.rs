//! What can go wrong with a sea.

/// Errors of building and stepping a sea.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SeaError {
    /// A cascade's parameter is out of range.
    #[error("building cascade {cascade} of the sea: {key} is {value}; give {allowed}")]
    Cascade {
        /// Index into the sea's cascades.
        cascade: usize,
        /// Parameter's name.
        key: &'static str,
        /// The value given.
        value: String,
        /// The range that works.
        allowed: &'static str,
    },
    /// A parameter of the whole sea is out of range.
    #[error("building the sea: {key} is {value}; give {allowed}")]
    Sea {
        /// Parameter's name.
        key: &'static str,
        /// The value given.
        value: String,
        /// The range that works.
        allowed: &'static str,
    },
    /// No transform of this size exists.
    #[error("planning a Fourier transform of {size} points: give a power of two in 16..=512")]
    TransformSize {
        /// The size asked for.
        size: usize,
    },
    /// A time that is not a number.
    #[error("stepping the sea to time {time}: give a finite number of seconds")]
    Time {
        /// The time given.
        time: f64,
    },
    /// Maps of another sea.
    #[error("stepping the sea: these maps have other resolutions; make them with the sea's own new_maps")]
    Maps,
    /// A job panicked.
    #[error("stepping the sea to {time} s: a job panicked ({message}); this is a bug, please report it")]
    Panicked {
        /// Time of the step.
        time: f64,
        /// The panic's own words.
        message: String,
    },
    /// Maps were asked for although nothing was begun.
    #[error("waiting for a step of the sea: none was begun; call begin first, or name a following time")]
    NotBegun,
    /// The worker threads have gone.
    #[error("stepping the sea ahead: its worker thread has ended; build the sea again")]
    Gone,
}
