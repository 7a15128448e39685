//! Headsets that are computers of their own, and what is asked of each before anything is measured there.
//!
//! [`TABLE`] is the only place with these numbers. None was measured on a headset; [`crate::host::fallback`] corrects what is
//! too much.

use crate::lod::Quality;
use crate::scene::Scene;
use crate::sea::split_bands;
use crate::xr::vendor::FoveationLevel;

/// What a headset begins with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Defaults {
    /// As Android names the model (`ro.product.model`).
    pub model: &'static str,
    /// The finest preset of the quadtree; a scene may ask for less.
    pub quality: Quality,
    /// N, the most grid points along a cascade's side; a scene may ask for fewer.
    pub resolution: usize,
    /// The most cascades, the largest patches first.
    pub cascades: usize,
    /// Refresh rate, hertz.
    pub refresh_rate: f32,
    /// Factor on the size that the runtime recommends for a view.
    pub scale: f32,
    /// How coarse the rim of a view may be.
    pub foveation: FoveationLevel,
    /// Clocks that last, `SUSTAINED_HIGH`, for processor and GPU.
    pub sustained: bool,
    /// The scheduler is told which threads make the frame.
    pub thread_hints: bool,
    /// Worker threads of the sea: 0 for one a core that the app may use.
    pub threads: usize,
}

/// The first row is for models that are not in the table. 120 Hz is offered by Quest 2, 3 and 3S and asked for by none: a
/// frame would have 8.3 ms.
///
/// | | why |
/// |---|---|
/// | quality | triangles of both eyes at `medium`, 0.19 M, are a fifth of what a Quest 2 draws at 72 Hz; at `high`, 0.87 M, half of what a Quest 3 does: `docs/frame-cost.md` |
/// | resolution | a step of N = 256 is estimated at 1.4 to 3.1 ms a cascade on one core like theirs, at 128 a quarter: `docs/performance.md` |
/// | cascades | three, as the flagship scene has: each costs two fetches a pixel |
/// | refresh rate | 13.9 ms a frame for the older GPU, 11.1 ms for the newer |
/// | foveation | `high` lets the runtime choose up to its coarsest rim, frame by frame |
pub static TABLE: [Defaults; 4] = [
    Defaults {
        model: "Quest 2",
        quality: Quality::Medium,
        resolution: 128,
        cascades: 3,
        refresh_rate: 72.0,
        scale: 1.0,
        foveation: FoveationLevel::High,
        sustained: true,
        thread_hints: true,
        threads: 0,
    },
    Defaults {
        model: "Quest Pro",
        quality: Quality::Medium,
        resolution: 128,
        cascades: 3,
        refresh_rate: 72.0,
        scale: 1.0,
        foveation: FoveationLevel::High,
        sustained: true,
        thread_hints: true,
        threads: 0,
    },
    Defaults {
        model: "Quest 3",
        quality: Quality::High,
        resolution: 256,
        cascades: 3,
        refresh_rate: 90.0,
        scale: 1.0,
        foveation: FoveationLevel::High,
        sustained: true,
        thread_hints: true,
        threads: 0,
    },
    Defaults {
        model: "Quest 3S",
        quality: Quality::High,
        resolution: 256,
        cascades: 3,
        refresh_rate: 90.0,
        scale: 1.0,
        foveation: FoveationLevel::High,
        sustained: true,
        thread_hints: true,
        threads: 0,
    },
];

/// The row of `model`, or the first.
pub fn defaults(model: &str) -> &'static Defaults {
    let model = model.trim();
    TABLE.iter().find(|row| row.model.eq_ignore_ascii_case(model)).unwrap_or(&TABLE[0])
}

impl Defaults {
    /// Brings `scene` within what the headset is asked for. Where cascades get coarser, their bands of wave numbers are
    /// divided anew.
    pub fn limit(&self, scene: &mut Scene) {
        scene.lod.quality = scene.lod.quality.min(self.quality);
        let cascades = &mut scene.sea.cascades;
        cascades.truncate(self.cascades);
        let coarser = cascades.iter().any(|cascade| cascade.resolution > self.resolution);
        if !coarser {
            return;
        }
        for cascade in cascades.iter_mut() {
            cascade.resolution = cascade.resolution.min(self.resolution);
        }
        let patches: Vec<_> =
            cascades.iter().map(|cascade| (cascade.patch_size, cascade.resolution)).collect();
        let bands = split_bands(&patches);
        // Bands that a scene chose by hand may leave no room: they stay where dividing anew would empty one.
        if bands.iter().all(|[low, high]| low < high) {
            for (cascade, band) in cascades.iter_mut().zip(bands) {
                cascade.band = band;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sea::Sea;
    use crate::sea::settings::MAX_CASCADES;

    #[test]
    fn models_are_found_by_name_and_strangers_get_the_first_row() {
        for (name, row) in [("Quest 3", 2), ("quest 3s", 3), ("Quest 2\n", 0), ("Pico 4", 0), ("", 0)] {
            assert!(std::ptr::eq(defaults(name), &TABLE[row]), "{name}");
        }
    }

    #[test]
    fn every_row_is_within_what_is_possible() {
        for (index, row) in TABLE.iter().enumerate() {
            assert!(row.resolution.is_power_of_two() && (16..=512).contains(&row.resolution));
            assert!((1..=MAX_CASCADES).contains(&row.cascades));
            assert!([72.0, 90.0, 120.0].contains(&row.refresh_rate) && (0.5..=1.5).contains(&row.scale));
            assert!(TABLE[..index].iter().all(|other| other.model != row.model));
        }
    }

    #[test]
    fn a_scene_is_limited_and_its_sea_keeps_its_height() {
        for row in &TABLE {
            let plain = Scene::flagship().unwrap();
            let mut scene = plain.clone();
            row.limit(&mut scene);
            assert!(scene.lod.quality <= row.quality && scene.sea.cascades.len() <= row.cascades);
            assert!(scene.sea.cascades.iter().all(|cascade| cascade.resolution <= row.resolution));
            assert!(
                scene.sea.cascades.windows(2).all(|pair| pair[0].band[1] == pair[1].band[0]),
                "bands join"
            );
            Sea::new(&scene.sea).unwrap();
            let ratio = scene.sea.expected_rms_height() / plain.sea.expected_rms_height();
            assert!((ratio - 1.0).abs() < 0.01, "{}: {ratio}", row.model);
        }
    }

    #[test]
    fn what_a_scene_asks_less_of_stays() {
        let mut scene = Scene::flagship().unwrap();
        scene.lod.quality = Quality::Low;
        scene.sea.cascades.truncate(1);
        scene.sea.cascades[0].resolution = 64;
        let before = scene.clone();
        TABLE[2].limit(&mut scene);
        assert_eq!(scene, before);
    }
}
