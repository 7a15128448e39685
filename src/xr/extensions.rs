//! Every OpenXR extension that Swell knows: what it is for, whether the runtime has it.
//!
//! All but one are optional. What is enabled is what is found and listed here.

use openxr::ExtensionSet;

/// One extension.
pub struct Known {
    /// Its name.
    pub name: &'static str,
    /// What Swell does with it.
    pub purpose: &'static str,
    get: fn(&ExtensionSet) -> bool,
    set: fn(&mut ExtensionSet),
}

impl Known {
    /// Whether it is in `found`.
    pub fn is_in(&self, found: &ExtensionSet) -> bool {
        (self.get)(found)
    }
}

macro_rules! known {
    ($($(#[$only:meta])? $name:literal $field:ident $purpose:literal),* $(,)?) => {
        &[$($(#[$only])? Known {
            name: $name,
            purpose: $purpose,
            get: |set| set.$field,
            set: |set| set.$field = true,
        }),*]
    };
}

/// Without it there is no way to draw.
pub const REQUIRED: &str = "XR_KHR_vulkan_enable2";

/// All of them.
pub static KNOWN: &[Known] = known![
    "XR_KHR_vulkan_enable2" khr_vulkan_enable2 "drawing with Vulkan",
    #[cfg(target_os = "android")]
    "XR_KHR_android_create_instance" khr_android_create_instance "a session that follows the activity",
    "XR_EXT_debug_utils" ext_debug_utils "names and messages",
    "XR_KHR_composition_layer_depth" khr_composition_layer_depth "depth for reprojection",
    "XR_KHR_visibility_mask" khr_visibility_mask "nothing is drawn that lenses hide",
    "XR_EXT_local_floor" ext_local_floor "a floor where one stands",
    "XR_EXT_hand_tracking" ext_hand_tracking "hands without controllers",
    "XR_EXT_hand_interaction" ext_hand_interaction "pinching and pointing",
    "XR_META_touch_controller_plus" meta_touch_controller_plus "Quest 3's controllers",
    "XR_FB_display_refresh_rate" fb_display_refresh_rate "a chosen refresh rate",
    "XR_FB_swapchain_update_state" fb_swapchain_update_state "foveation",
    "XR_FB_foveation" fb_foveation "foveation",
    "XR_FB_foveation_configuration" fb_foveation_configuration "foveation",
    "XR_FB_foveation_vulkan" fb_foveation_vulkan "foveation",
    "XR_META_vulkan_swapchain_create_info" meta_vulkan_swapchain_create_info "subsampled images",
    "XR_EXT_performance_settings" ext_performance_settings "clocks for a sustained load",
    #[cfg(target_os = "android")]
    "XR_KHR_android_thread_settings" khr_android_thread_settings "scheduling of our threads",
    "XR_FB_space_warp" fb_space_warp "frames between frames",
];

/// Those of [`KNOWN`] that are in `found`, and nothing else.
pub fn wanted(found: &ExtensionSet) -> ExtensionSet {
    let mut set = ExtensionSet::default();
    for known in KNOWN.iter().filter(|known| known.is_in(found)) {
        (known.set)(&mut set);
    }
    set
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_found_and_known_is_wanted() {
        let mut found = ExtensionSet::default();
        (found.mnd_headless, found.khr_vulkan_enable2) = (true, true);
        assert!(wanted(&found).khr_vulkan_enable2 && !wanted(&found).mnd_headless);
        assert!(!wanted(&found).fb_space_warp);
        found.fb_space_warp = true;
        assert!(wanted(&found).fb_space_warp);
        assert_eq!(wanted(&ExtensionSet::default()), ExtensionSet::default());
    }

    #[test]
    fn each_has_its_own_name() {
        let mut names: Vec<_> = KNOWN.iter().map(|known| known.name).collect();
        assert!(names.contains(&REQUIRED));
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), KNOWN.len());
    }
}
