//! Android's entry: the activity's life around a headset's frames.
//!
//! All on android-activity's own thread, which is attached to Java's machine: between any two frames the activity's events are
//! heard, so none of its callbacks waits for longer than a frame. What an event means is said by
//! [`super::standalone::activity`], what a headset begins with by [`super::standalone::model`].

mod log;
mod watch;

use super::authoring::{AuthoringSettings, Fit};
use super::headset::{HeadsetSettings, headset};
use super::standalone::folders::{Folders, Found};
use super::standalone::model::{Defaults, defaults};
use super::standalone::settings::{Chosen, Kept};
use crate::draw::Look;
use crate::gpu::Validation;
use crate::host::HostError;
use crate::host::fallback::Ladder;
use crate::lod::Quality;
use crate::scene::{Scene, SceneError};
use crate::xr::Platform;
use android_activity::AndroidApp;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use watch::Watch;

/// Why the sea was not shown.
#[derive(Debug, thiserror::Error)]
enum EntryError {
    #[error("Android names no folder for the app's files")]
    NoFolder,
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Host(#[from] HostError),
}

/// Shows the sea until the activity, the person or the runtime wants the end. Returns in order whatever happens, a panic
/// included, and the activity finishes then. The process may go on and call this again.
pub fn main(app: &AndroidApp) {
    log::begin();
    match catch_unwind(AssertUnwindSafe(|| run(app))) {
        Ok(Ok(())) => ::log::info!("ended"),
        Ok(Err(error)) => ::log::error!("{error}"),
        Err(_told) => ::log::error!("ended by a panic (above)"),
    }
}

fn run(app: &AndroidApp) -> Result<(), EntryError> {
    let internal = app.internal_data_path().ok_or(EntryError::NoFolder)?;
    let folders = Folders { internal, external: app.external_data_path() };
    let model = android_properties::getprop("ro.product.model").value().unwrap_or_default();
    let defaults = defaults(&model);
    ::log::info!("{model:?}, begun with what is known of {}", defaults.model);
    let found = folders.scene()?;
    if let Some(wrong) = &found.wrong {
        ::log::error!("{wrong}; showing the scene that is built in");
    }
    let name = found.file.as_deref().map_or_else(|| "built in".to_owned(), name);
    ::log::info!("scene: {name}");
    for warning in &found.scene.in_headset().warnings {
        ::log::warn!("{warning}");
    }
    let chosen = folders.settings().map_or_else(Chosen::default, |file| {
        Chosen::load(&file).unwrap_or_else(|error| {
            ::log::error!("{error}; using defaults");
            Chosen::default()
        })
    });
    let quality: Option<Quality> = chosen.quality.map(Into::into);
    let fit = Fit::new(move |scene| {
        defaults.limit(scene);
        scene.lod.quality = quality.unwrap_or(scene.lod.quality);
    });
    let file = Some(folders.authored(&found));
    let Found { mut scene, text, .. } = found;
    fit.apply(&mut scene);
    let authoring = AuthoringSettings { text, file, fit };
    let kept = folders.kept();
    let mut settings = settings(app, &scene, defaults, &chosen, folders.cache(), &name, &kept);
    settings.authoring = Some(authoring);
    let mut watch = Watch::new(app.clone(), kept, name);
    if !watch.is_shown() {
        return Ok(());
    }
    let shown = headset(&scene, &settings, &mut watch);
    watch.keep();
    let report = shown?;
    ::log::info!(
        "{} frames shown, {} left empty; {} steps of the sea made anew; {} sessions begun anew; level {}",
        report.shown,
        report.skipped,
        report.missed,
        report.recovered,
        report.level
    );
    Ok(())
}

/// The table's, where nothing else was chosen, on the level that the run before has left.
fn settings(
    app: &AndroidApp,
    scene: &Scene,
    defaults: &Defaults,
    chosen: &Chosen,
    cache: PathBuf,
    name: &str,
    kept: &Path,
) -> HeadsetSettings {
    let level = Kept::load(kept).level(name, &Ladder::new(scene.lod.quality));
    // SAFETY: both are valid until the activity's `AndroidApp` goes, which outlives the run: its caller has it.
    let platform = unsafe { Platform::new(app.vm_as_ptr(), app.activity_as_ptr()) };
    HeadsetSettings {
        platform,
        look: Look::Water,
        validation: Validation::Off,
        threads: defaults.threads,
        cache: Some(cache),
        wait: false,
        frames: None,
        scale: chosen.scale.unwrap_or(defaults.scale),
        refresh_rate: Some(chosen.refresh_rate.unwrap_or(defaults.refresh_rate)),
        foveation: chosen.foveation.map_or(defaults.foveation, Into::into),
        sustained: defaults.sustained,
        thread_hints: defaults.thread_hints,
        space_warp: false,
        fallback: chosen.fallback.unwrap_or(true).then_some(level),
        authoring: None,
    }
}

fn name(file: &Path) -> String {
    file.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}
