//! One runtime's part of a run: Vulkan as it wants it, what draws, and how all that goes.

use super::patience::gone;
use super::stage::Stage;
use super::{Guest, HeadsetSettings};
use crate::gpu::{Device, DeviceNeeds, GpuError, Instance, Opener};
use crate::host::HostError;
use crate::host::painter::Painter;
use crate::xr::Runtime;
use crate::xr::vendor::FoveationLevel;
use std::sync::Arc;

/// What lives as long as one runtime.
pub struct World {
    /// Dropped before the device it holds.
    pub painter: Painter,
    pub runtime: Arc<Runtime>,
}

/// Hands `guest` the latest picture, where the session drew one. Every frame is finished then.
pub fn keep(
    world: &World,
    stage: Option<&Stage>,
    drew: bool,
    guest: &mut dyn Guest,
) -> Result<(), HostError> {
    world.painter.wait_all()?;
    match stage.and_then(Stage::picture) {
        Some(picture) if drew => guest.last(picture),
        _ => Ok(()),
    }
}

/// Vulkan as the runtime wants it, and a first session with views `scale` times as large as `settings` say.
pub fn open(
    settings: &HeadsetSettings,
    runtime: &Arc<Runtime>,
    guest: &mut dyn Guest,
    scale: f32,
) -> Result<(Arc<Device>, Stage), HostError> {
    let instance = match Instance::new(settings.validation, guest.instance_extensions(), &**runtime) {
        // A window costs the headset nothing, not even where there can be none.
        Err(error @ GpuError::NoWindow(_)) => {
            guest.refused(&error);
            Instance::new(settings.validation, &[], &**runtime)
        }
        other => other,
    };
    let instance = instance.map_err(gone)?;
    let physical = runtime.choose(&instance, None).map_err(gone)?;
    // Where the runtime's device can show nothing in windows, the guest hears of it when it tries.
    let wanted: Vec<_> =
        guest.device_extensions().iter().copied().filter(|extension| physical.has(extension)).collect();
    let needs = DeviceNeeds {
        extensions: &wanted,
        foveation: settings.foveation != FoveationLevel::Off,
        cache: settings.cache.as_deref(),
        opener: &**runtime,
    };
    let device = Device::new(instance, physical, &needs).map_err(gone)?;
    guest.opened(&device)?;
    let stage = Stage::new(runtime, &device, settings, guest.looks(), scale)?;
    stage.tell(settings);
    Ok((device, stage))
}
