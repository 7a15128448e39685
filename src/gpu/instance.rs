//! The Vulkan loader and instance.

use super::error::{Doing, GpuError};
use super::messages::{self, Messages};
use super::opener::Opener;
use ash::{ext, vk};
use std::ffi::{CStr, CString, c_char};
use std::sync::Arc;

/// The least Vulkan that Swell runs on: multiview is core in it.
pub const API_VERSION: u32 = vk::API_VERSION_1_1;

const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// Whether the validation layers listen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Validation {
    /// No layers.
    #[default]
    Off,
    /// Core and synchronization validation; every message is kept in [`Instance::heard`].
    On,
}

/// An instance and what it was made from.
pub struct Instance {
    /// Instance-level commands.
    pub raw: ash::Instance,
    /// The loader.
    pub entry: ash::Entry,
    debug: Option<(ext::debug_utils::Instance, Option<vk::DebugUtilsMessengerEXT>)>,
    messages: Arc<Messages>,
}

impl Instance {
    /// Loads Vulkan and lets `opener` make an instance with the surface extensions in `extensions`.
    ///
    /// # Errors
    /// [`GpuError::NoLoader`] without a loader, [`GpuError::NoValidation`] where layers were asked for and are missing.
    pub fn new(
        validation: Validation,
        extensions: &[&CStr],
        opener: &dyn Opener,
    ) -> Result<Arc<Self>, GpuError> {
        // SAFETY: loading the system's Vulkan loader runs its initialisers, which are trusted.
        let entry = unsafe { ash::Entry::load()? };
        // SAFETY: no preconditions.
        let available = unsafe { entry.enumerate_instance_extension_properties(None) }
            .doing("listing the instance's extensions")?;
        let has = |name: &CStr| available.iter().any(|e| e.extension_name_as_c_str() == Ok(name));
        if let Some(missing) = extensions.iter().find(|name| !has(name)) {
            return Err(GpuError::NoWindow(format!(
                "Vulkan's loader or driver lacks {}",
                missing.to_string_lossy()
            )));
        }
        let mut names: Vec<*const c_char> = extensions.iter().map(|name| name.as_ptr()).collect();
        let debug_utils = has(ext::debug_utils::NAME);
        if debug_utils {
            names.push(ext::debug_utils::NAME.as_ptr());
        }
        let layers = match validation {
            Validation::Off => Vec::new(),
            Validation::On => {
                // SAFETY: no preconditions.
                let present = unsafe { entry.enumerate_instance_layer_properties() }
                    .doing("listing the instance's layers")?;
                if !present.iter().any(|layer| layer.layer_name_as_c_str() == Ok(VALIDATION_LAYER)) {
                    return Err(GpuError::NoValidation);
                }
                vec![VALIDATION_LAYER.as_ptr()]
            }
        };
        let messages = Arc::<Messages>::default();
        let name = CString::new(env!("CARGO_PKG_NAME")).unwrap_or_default();
        let application = vk::ApplicationInfo::default()
            .application_name(&name)
            .engine_name(&name)
            .engine_version(1)
            .api_version(API_VERSION);
        let enabled = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
        let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&enabled);
        let mut early = messages::messenger_info(&messages);
        let mut info = vk::InstanceCreateInfo::default()
            .application_info(&application)
            .enabled_extension_names(&names)
            .enabled_layer_names(&layers);
        if validation == Validation::On {
            info = info.push_next(&mut features);
            if debug_utils {
                info = info.push_next(&mut early);
            }
        }
        // The pointers in `info` refer to locals that live past the call.
        let raw = opener.create_instance(&entry, &info)?;
        let mut instance = Self { raw, entry, debug: None, messages };
        if debug_utils {
            let utils = ext::debug_utils::Instance::new(&instance.entry, &instance.raw);
            let messenger = match validation {
                Validation::On => {
                    Some(messages::listen(&utils, &instance.messages).doing("listening to validation")?)
                }
                Validation::Off => None,
            };
            instance.debug = Some((utils, messenger));
        }
        Ok(Arc::new(instance))
    }

    /// Whether objects can be named.
    pub(super) const fn has_debug_utils(&self) -> bool {
        self.debug.is_some()
    }

    /// What validation says. Kept beyond the instance's end, it tells of what was never destroyed as well.
    pub fn heard(&self) -> Arc<Messages> {
        Arc::clone(&self.messages)
    }

    /// What validation has said since the start.
    pub fn messages(&self) -> Vec<String> {
        self.messages.all()
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: devices hold an `Arc` of the instance, so none is left; the messenger is ours.
        unsafe {
            if let Some((utils, Some(messenger))) = &self.debug {
                utils.destroy_debug_utils_messenger(*messenger, None);
            }
            self.raw.destroy_instance(None);
        }
    }
}
