//! What `swell info` tells about a scene.
use crate::scene::Scene;
use serde::Serialize;

/// A scene in a few numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneSummary {
    /// Four standard deviations of the height, metres: close to the mean of the highest third of the waves.
    pub significant_wave_height: f64,
    /// Largest height culling allows for, metres.
    pub max_height: Option<f64>,
    /// Largest horizontal displacement culling allows for, metres.
    pub reach: f64,
    /// Patch size in metres and resolution of each cascade.
    pub cascades: Vec<CascadeSummary>,
}

/// A cascade in a few numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CascadeSummary {
    /// Side of the patch, metres.
    pub patch_size: f64,
    /// Grid points along a side.
    pub resolution: usize,
    /// Smallest wave number carried, rad/m.
    pub from: f64,
    /// Wave number at which the cascade ends, rad/m: its band's end, or its grid's Nyquist number where that is less.
    pub to: f64,
}

impl SceneSummary {
    /// Sums up `scene`.
    pub fn new(scene: &Scene) -> Self {
        let cascades = scene.sea.cascades.iter().map(|cascade| {
            let nyquist = std::f64::consts::PI * cascade.resolution as f64 / cascade.patch_size;
            CascadeSummary {
                patch_size: cascade.patch_size,
                resolution: cascade.resolution,
                from: cascade.band[0],
                to: cascade.band[1].min(nyquist),
            }
        });
        Self {
            significant_wave_height: 4.0 * scene.sea.expected_rms_height(),
            max_height: scene.lod.max_height,
            reach: scene.lod.reach,
            cascades: cascades.collect(),
        }
    }
}
