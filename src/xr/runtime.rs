//! The OpenXR loader, the runtime behind it, and its headset.

use super::error::{Doing, XrError};
use super::extensions;
use super::messages::Messenger;
use super::notice::Notice;
use super::platform::Platform;
use crate::gpu::{Messages, Validation};
use openxr::{self as xr, sys};
use std::sync::Arc;

const VALIDATION_LAYER: &str = "XR_APILAYER_LUNARG_core_validation";

/// Views of a headset: one for each eye.
pub const VIEWS: usize = 2;

/// The only configuration of views that Swell draws.
pub(super) const CONFIGURATION: xr::ViewConfigurationType = xr::ViewConfigurationType::PRIMARY_STEREO;

/// What a view may be drawn at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ViewSize {
    /// Pixels that the runtime recommends.
    pub recommended: [u32; 2],
    /// Pixels at most.
    pub most: [u32; 2],
}

/// A runtime and its headset.
pub struct Runtime {
    /// Dropped first: its callback is the instance's.
    messenger: Option<Messenger>,
    pub(super) instance: xr::Instance,
    pub(super) system: xr::SystemId,
    /// The runtime's name and version.
    pub name: String,
    /// The headset's name.
    pub headset: String,
    /// Extensions that are enabled.
    pub extensions: xr::ExtensionSet,
    /// What each eye may be drawn at: the same for both.
    pub size: ViewSize,
    pub(super) blend: xr::EnvironmentBlendMode,
}

impl Runtime {
    /// Loads OpenXR on `platform` and finds a headset.
    ///
    /// # Errors
    /// No loader, no runtime, no headset, no Vulkan, or no stereo.
    pub fn new(platform: Platform, validation: Validation) -> Result<Arc<Self>, XrError> {
        let (name, instance, wanted, messenger) = connect(platform, validation)?;
        let system = match instance.system(xr::FormFactor::HEAD_MOUNTED_DISPLAY) {
            Err(sys::Result::ERROR_FORM_FACTOR_UNAVAILABLE | sys::Result::ERROR_FORM_FACTOR_UNSUPPORTED) => {
                return Err(XrError::NoHeadset { runtime: name });
            }
            other => other.doing("looking for a headset")?,
        };
        let headset = instance.system_properties(system).doing("asking about the headset")?;
        let missing = |what: &str| XrError::Missing { runtime: name.clone(), what: what.to_owned() };
        let kinds = instance.enumerate_view_configurations(system).doing("listing view configurations")?;
        if !kinds.contains(&CONFIGURATION) {
            return Err(missing("stereo views"));
        }
        let views = instance
            .enumerate_view_configuration_views(system, CONFIGURATION)
            .doing("asking for the sizes of views")?;
        let [left, right] = views[..] else { return Err(missing("two views, one for each eye")) };
        let graphics = headset.graphics_properties;
        let both = |pick: fn(&xr::ViewConfigurationView) -> [u32; 2], join: fn(u32, u32) -> u32| {
            let (a, b) = (pick(&left), pick(&right));
            [join(a[0], b[0]), join(a[1], b[1])]
        };
        // One array image holds both eyes: the larger wish, the smaller limit.
        let most = both(|v| [v.max_image_rect_width, v.max_image_rect_height], u32::min);
        let limit = [graphics.max_swapchain_image_width, graphics.max_swapchain_image_height];
        let most = [0, 1].map(|side| most[side].min(limit[side]).max(1));
        let recommended =
            both(|v| [v.recommended_image_rect_width, v.recommended_image_rect_height], u32::max);
        let recommended = [0, 1].map(|side| recommended[side].clamp(1, most[side]));
        let blends =
            instance.enumerate_environment_blend_modes(system, CONFIGURATION).doing("listing blend modes")?;
        // A sea hides the room. Where the display can only add light to it, that is how it has to be.
        let opaque = xr::EnvironmentBlendMode::OPAQUE;
        let blend = if blends.contains(&opaque) { Some(opaque) } else { blends.first().copied() };
        let blend = blend.ok_or_else(|| missing("any blend mode"))?;
        Ok(Arc::new(Self {
            messenger,
            headset: headset.system_name,
            size: ViewSize { recommended, most },
            blend,
            instance,
            system,
            name,
            extensions: wanted,
        }))
    }

    /// Whether the room is hidden behind the sea.
    pub fn is_opaque(&self) -> bool {
        self.blend == xr::EnvironmentBlendMode::OPAQUE
    }

    /// What OpenXR's validation says. Kept beyond the instance's end.
    pub fn heard(&self) -> Arc<Messages> {
        self.messenger.as_ref().map(Messenger::messages).unwrap_or_default()
    }

    /// The next event that matters, if there is one. Allocates nothing.
    ///
    /// # Errors
    /// The runtime has gone.
    pub fn poll(&self, buffer: &mut xr::EventDataBuffer) -> Result<Option<Notice>, XrError> {
        while let Some(event) = self.instance.poll_event(buffer).doing("listening for events")? {
            if let Some(notice) = Notice::of(&event) {
                return Ok(Some(notice));
            }
        }
        Ok(None)
    }
}

type Connection = (String, xr::Instance, xr::ExtensionSet, Option<Messenger>);

/// The runtime alone: its name, an instance, the extensions that are enabled.
fn connect(platform: Platform, validation: Validation) -> Result<Connection, XrError> {
    let (entry, found) = load(platform)?;
    let mut wanted = extensions::wanted(&found);
    let layers: &[&str] = match validation {
        Validation::Off => &[],
        Validation::On => {
            let present = entry.enumerate_layers().doing("listing OpenXR's layers")?;
            if !present.iter().any(|layer| layer.layer_name == VALIDATION_LAYER) {
                return Err(XrError::NoValidation);
            }
            &[VALIDATION_LAYER]
        }
    };
    wanted.ext_debug_utils = found.ext_debug_utils || validation == Validation::On;
    if !found.khr_vulkan_enable2 {
        let what = extensions::REQUIRED.to_owned();
        return Err(XrError::Missing { runtime: "that is installed".to_owned(), what });
    }
    let application = xr::ApplicationInfo {
        application_name: "Swell",
        application_version: 1,
        engine_name: "Swell",
        engine_version: 1,
        // Nothing newer is needed, and every runtime has it.
        api_version: xr::Version::new(1, 0, 0),
    };
    let instance = entry.create_instance(&application, &wanted, layers, &platform.info());
    let instance = instance.map_err(no_runtime)?;
    let about = instance.properties().doing("asking for the runtime's name")?;
    let name = format!("{} {}", about.runtime_name, about.runtime_version);
    let messenger = (validation == Validation::On).then(|| Messenger::new(&instance)).flatten();
    Ok((name, instance, wanted, messenger))
}

/// The loader and what the runtime behind it can do.
fn load(platform: Platform) -> Result<(xr::Entry, xr::ExtensionSet), XrError> {
    // SAFETY: loading the system's OpenXR loader (on Android the one beside this library) runs its initialisers, which are
    // trusted.
    let entry = unsafe { xr::Entry::load(&platform.info()) };
    let entry = entry.map_err(|error| XrError::NoLoader(error.to_string()))?;
    let found = entry.enumerate_extensions().map_err(no_runtime)?;
    Ok((entry, found))
}

fn no_runtime(result: sys::Result) -> XrError {
    match result {
        sys::Result::ERROR_API_VERSION_UNSUPPORTED
        | sys::Result::ERROR_OUT_OF_MEMORY
        | sys::Result::ERROR_LIMIT_REACHED => XrError::Call { doing: "creating the OpenXR instance", result },
        _ => XrError::NoRuntime(result),
    }
}

/// What `swell info` tells: the runtime's name, the headset's, its views, and for each known extension whether it is there.
#[cfg(not(target_os = "android"))]
pub struct About {
    /// Name and version.
    pub runtime: String,
    /// The headset and its views, or why there is none.
    pub headset: Result<(String, ViewSize), XrError>,
    /// Each of [`extensions::KNOWN`], found or not.
    pub extensions: Vec<(&'static str, &'static str, bool)>,
}

/// Asks without beginning anything.
///
/// # Errors
/// No loader or no runtime.
#[cfg(not(target_os = "android"))]
pub fn about() -> Result<About, XrError> {
    let (_, found) = load(Platform)?;
    let extensions =
        extensions::KNOWN.iter().map(|known| (known.name, known.purpose, known.is_in(&found))).collect();
    let (runtime, ..) = connect(Platform, Validation::Off)?;
    let headset =
        Runtime::new(Platform, Validation::Off).map(|runtime| (runtime.headset.clone(), runtime.size));
    Ok(About { runtime, headset, extensions })
}
