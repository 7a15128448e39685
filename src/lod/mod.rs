//! Level of detail: which patches of sea are drawn, and how densely.
pub mod settings;
pub use settings::{LodSettings, Preset, Quality};
