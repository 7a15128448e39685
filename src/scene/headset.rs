//! A scene as headsets show it, and how many waves they have time for.
use super::{Scene, Shadows};
use crate::sea::waves::Model;

/// How many waves a headset has time for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WaveLimit {
    /// The headset, a computer of its own.
    pub headset: &'static str,
    /// Frames a second that it is asked for, hertz.
    pub refresh_rate: u32,
    /// Waves and octaves of all models together.
    pub waves: usize,
}

/// The most waves with which a frame is done in time by the model of `docs/quest.md`, where the GPU reaches half of its peak:
/// with more it is late by that guess and by every worse one. `tests/shader_cost.rs` works them out from what a wave costs.
pub const WAVE_LIMITS: [WaveLimit; 2] = [
    WaveLimit { headset: "Quest 2", refresh_rate: 72, waves: 3 },
    WaveLimit { headset: "Quest 3", refresh_rate: 90, waves: 5 },
];

impl Scene {
    /// The same as headsets show it: without what is for screens alone, and with a warning where waves are too many for
    /// headsets that are computers of their own. All waves stay.
    #[must_use]
    pub fn in_headset(&self) -> Self {
        let mut scene = self.clone();
        if scene.water.shadows.shadows == Shadows::Screen {
            scene.water.shadows.shadows = Shadows::Off;
        }
        let told = too_many_waves(&scene.sea.models).filter(|warning| !scene.warnings.contains(warning));
        scene.warnings.extend(told);
        scene
    }
}

fn too_many_waves(models: &[Model]) -> Option<String> {
    let count: usize = models.iter().map(|model| model.waves().len()).sum();
    if WAVE_LIMITS.iter().all(|limit| count <= limit.waves) {
        return None;
    }
    let fits = WAVE_LIMITS.map(|WaveLimit { headset, refresh_rate, waves }| {
        format!("{waves} on a {headset} at {refresh_rate} Hz")
    });
    let fits = fits.join(", ");
    Some(format!(
        "{count} waves and octaves are more than a frame has time for: at most {fits}; give fewer, or frames come late"
    ))
}
