//! Which Vulkan devices there are, what they lack, and which one to take.

use super::error::{Doing, GpuError};
use super::instance::{API_VERSION, Instance};
use ash::vk;
use std::ffi::CStr;

/// A Vulkan device of this machine, judged.
#[derive(Clone, Debug)]
pub struct PhysicalDevice {
    /// Vulkan's handle.
    pub raw: vk::PhysicalDevice,
    /// The driver's name for it.
    pub name: String,
    /// Discrete, integrated, virtual, CPU.
    pub kind: vk::PhysicalDeviceType,
    /// Version of Vulkan it speaks.
    pub api_version: u32,
    /// Name and version of the driver, where it tells.
    pub driver: String,
    /// The first queue family that draws and copies.
    pub queue_family: Option<u32>,
    /// Names of its extensions, sorted.
    pub extensions: Vec<String>,
    /// Everything Swell needs and this device lacks; empty for a usable one.
    pub lacks: Vec<String>,
    /// Lines can be drawn instead of triangles (`--debug wireframe`).
    pub wireframe: bool,
    /// Anisotropic sampling.
    pub anisotropy: bool,
    /// Multisampled depth can be resolved in a pass.
    pub depth_resolve: bool,
    /// Passes may have a fragment density map.
    pub density_maps: bool,
    /// They may have one also where their images are not subsampled.
    pub density_maps_on_whole_images: bool,
    /// Memory that a tiled GPU gives only to attachments that leave the tile.
    pub lazy_memory: Option<u32>,
    /// Limits.
    pub limits: vk::PhysicalDeviceLimits,
    /// Identifies the pipeline cache that fits.
    pub cache_id: [u8; vk::UUID_SIZE],
}

impl PhysicalDevice {
    /// All devices of `instance`, in the loader's order.
    ///
    /// # Errors
    /// The listing itself failed.
    pub fn all(instance: &Instance) -> Result<Vec<Self>, GpuError> {
        // SAFETY: the instance lives.
        let handles = unsafe { instance.raw.enumerate_physical_devices() }.doing("listing Vulkan devices")?;
        handles.into_iter().map(|raw| Self::describe(instance, raw)).collect()
    }

    /// The device whose name contains `wanted` (in any case), or the best usable one.
    ///
    /// # Errors
    /// No device, none of that name, or the one named lacks something.
    pub fn choose(instance: &Instance, wanted: Option<&str>) -> Result<Self, GpuError> {
        let all = Self::all(instance)?;
        if all.is_empty() {
            return Err(GpuError::NoDevice(
                "the driver offers none (Debian: apt-get install mesa-vulkan-drivers)".to_owned(),
            ));
        }
        let names = all.iter().map(|device| device.name.as_str()).collect::<Vec<_>>().join(", ");
        if let Some(wanted) = wanted {
            let matches = |device: &&Self| device.name.to_lowercase().contains(&wanted.to_lowercase());
            let device = all
                .iter()
                .find(matches)
                .ok_or(GpuError::UnknownDevice { wanted: wanted.to_owned(), present: names })?;
            return match device.lacks.first() {
                None => Ok(device.clone()),
                Some(_) => {
                    Err(GpuError::Missing { device: device.name.clone(), feature: device.lacks.join(", ") })
                }
            };
        }
        let usable = all.iter().filter(|device| device.lacks.is_empty());
        usable.min_by_key(|device| rank(device.kind)).cloned().ok_or_else(|| {
            let faults =
                all.iter().map(|device| format!("{:?} lacks {}", device.name, device.lacks.join(", ")));
            GpuError::NoDevice(faults.collect::<Vec<_>>().join("; "))
        })
    }

    /// Judges the device that somebody else chose.
    ///
    /// # Errors
    /// It cannot be asked, or lacks something.
    pub fn given(instance: &Instance, raw: vk::PhysicalDevice) -> Result<Self, GpuError> {
        let device = Self::describe(instance, raw)?;
        if device.lacks.is_empty() {
            return Ok(device);
        }
        Err(GpuError::Missing { device: device.name, feature: device.lacks.join(", ") })
    }

    fn describe(instance: &Instance, raw: vk::PhysicalDevice) -> Result<Self, GpuError> {
        // SAFETY: `raw` was enumerated from this living instance.
        let basic = unsafe { instance.raw.get_physical_device_properties(raw) };
        let name = text(&basic.device_name);
        // SAFETY: as above.
        let listed = unsafe { instance.raw.enumerate_device_extension_properties(raw) }
            .doing("listing a device's extensions")?;
        let mut extensions: Vec<String> = listed.iter().map(|e| text(&e.extension_name)).collect();
        extensions.sort();
        let mut device = Self {
            raw,
            name,
            kind: basic.device_type,
            api_version: basic.api_version,
            driver: String::new(),
            queue_family: None,
            extensions,
            lacks: Vec::new(),
            wireframe: false,
            anisotropy: false,
            depth_resolve: false,
            density_maps: false,
            density_maps_on_whole_images: false,
            lazy_memory: None,
            limits: basic.limits,
            cache_id: basic.pipeline_cache_uuid,
        };
        if basic.api_version < API_VERSION {
            device.lacks.push(format!("Vulkan 1.1 (it has {})", version(basic.api_version)));
            return Ok(device);
        }
        let mut driver = vk::PhysicalDeviceDriverProperties::default();
        let mut properties = vk::PhysicalDeviceProperties2::default();
        if device.has(ash::khr::driver_properties::NAME) {
            properties = properties.push_next(&mut driver);
        }
        // SAFETY: as above; the chain holds only structures this device knows.
        unsafe { instance.raw.get_physical_device_properties2(raw, &mut properties) };
        device.driver =
            format!("{} {}", text(&driver.driver_name), text(&driver.driver_info)).trim().to_owned();
        let mut multiview = vk::PhysicalDeviceMultiviewFeatures::default();
        let mut density = vk::PhysicalDeviceFragmentDensityMapFeaturesEXT::default();
        let mut features = vk::PhysicalDeviceFeatures2::default().push_next(&mut multiview);
        if device.has(ash::ext::fragment_density_map::NAME) {
            features = features.push_next(&mut density);
        }
        // SAFETY: as above.
        unsafe { instance.raw.get_physical_device_features2(raw, &mut features) };
        device.wireframe = features.features.fill_mode_non_solid == vk::TRUE;
        device.anisotropy = features.features.sampler_anisotropy == vk::TRUE;
        // Every driver that resolves depth can take the first sample.
        device.depth_resolve = device.has(ash::khr::create_renderpass2::NAME)
            && device.has(ash::khr::depth_stencil_resolve::NAME);
        // SAFETY: as above.
        let memory = unsafe { instance.raw.get_physical_device_memory_properties(raw) };
        device.lazy_memory = (0_u32..).zip(memory.memory_types_as_slice()).find_map(|(index, kind)| {
            kind.property_flags.contains(vk::MemoryPropertyFlags::LAZILY_ALLOCATED).then_some(index)
        });
        device.density_maps = density.fragment_density_map == vk::TRUE;
        device.density_maps_on_whole_images =
            device.density_maps && density.fragment_density_map_non_subsampled_images == vk::TRUE;
        if multiview.multiview == vk::FALSE {
            device.lacks.push("the multiview feature".to_owned());
        }
        // SAFETY: as above.
        let families = unsafe { instance.raw.get_physical_device_queue_family_properties(raw) };
        device.queue_family = (0_u32..)
            .zip(&families)
            .find(|(_, family)| family.queue_flags.contains(vk::QueueFlags::GRAPHICS))
            .map(|(index, _)| index);
        if device.queue_family.is_none() {
            device.lacks.push("a graphics queue".to_owned());
        }
        let both =
            basic.limits.framebuffer_color_sample_counts & basic.limits.framebuffer_depth_sample_counts;
        if !both.contains(vk::SampleCountFlags::TYPE_4) {
            device.lacks.push("4x MSAA for colour and depth".to_owned());
        }
        device.lack_formats(instance);
        Ok(device)
    }

    fn lack_formats(&mut self, instance: &Instance) {
        use vk::FormatFeatureFlags as F;
        let sampled = F::SAMPLED_IMAGE | F::SAMPLED_IMAGE_FILTER_LINEAR | F::TRANSFER_DST;
        let needs = [
            (vk::Format::R16G16B16A16_SFLOAT, sampled, "filtered RGBA16F textures"),
            (vk::Format::R8G8B8A8_UNORM, sampled, "filtered RGBA8 textures"),
            (vk::Format::R8G8B8A8_SRGB, F::COLOR_ATTACHMENT | F::TRANSFER_SRC, "RGBA8 sRGB targets"),
            (vk::Format::D32_SFLOAT, F::DEPTH_STENCIL_ATTACHMENT, "32-bit float depth"),
        ];
        for (format, features, what) in needs {
            // SAFETY: the handle was enumerated from this living instance.
            let found = unsafe { instance.raw.get_physical_device_format_properties(self.raw, format) };
            if !found.optimal_tiling_features.contains(features) {
                self.lacks.push(what.to_owned());
            }
        }
    }

    /// Whether the device has an extension.
    pub fn has(&self, extension: &CStr) -> bool {
        extension
            .to_str()
            .is_ok_and(|name| self.extensions.binary_search_by(|have| have.as_str().cmp(name)).is_ok())
    }
}

/// Real GPUs first, then whatever draws.
const fn rank(kind: vk::PhysicalDeviceType) -> u8 {
    match kind {
        vk::PhysicalDeviceType::DISCRETE_GPU => 0,
        vk::PhysicalDeviceType::INTEGRATED_GPU => 1,
        vk::PhysicalDeviceType::VIRTUAL_GPU => 2,
        vk::PhysicalDeviceType::CPU => 3,
        _ => 4,
    }
}

fn text(raw: &[std::ffi::c_char]) -> String {
    let bytes: Vec<u8> = raw.iter().map(|&c| c.to_ne_bytes()[0]).take_while(|&byte| byte != 0).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}

/// "1.3.281" from Vulkan's packed form.
pub fn version(packed: u32) -> String {
    format!(
        "{}.{}.{}",
        vk::api_version_major(packed),
        vk::api_version_minor(packed),
        vk::api_version_patch(packed)
    )
}
