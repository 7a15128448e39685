//! The spectral sea.
pub mod settings;
pub use settings::{CascadeSettings, FoamSettings, NormalKind, SeaSettings, Spectrum};
