//! Shadows that the sun casts.

/// Where shadows are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shadows {
    /// Nowhere.
    #[default]
    Off,
    /// On screens and in pictures, not in headsets, which have less time for a frame.
    Screen,
    /// In headsets too.
    On,
}

/// Shadows that the sea and what floats on it cast on each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadowSettings {
    /// Where there are any.
    pub shadows: Shadows,
    /// Texels along each side of the sun's map, a power of two.
    pub resolution: u32,
    /// From the viewer to where shadows have faded, metres.
    pub distance: f64,
}

impl ShadowSettings {
    /// Before the schema's defaults.
    pub(super) const BLANK: Self = Self { shadows: Shadows::Off, resolution: 0, distance: 0.0 };
}
