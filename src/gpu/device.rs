//! The logical device, its one queue, its memory and its pipeline cache.

use super::error::{Doing, GpuError};
use super::instance::Instance;
use super::opener::{Directly, Opener};
use super::physical::PhysicalDevice;
use super::pipeline_cache::PipelineCache;
use ash::{ext, khr, vk};
use gpu_allocator::vulkan::{
    Allocation, AllocationCreateDesc, AllocationScheme, Allocator, AllocatorCreateDesc,
};
use gpu_allocator::{AllocationSizes, AllocatorDebugSettings, MemoryLocation};
use std::collections::HashMap;
use std::ffi::{CStr, CString};
use std::mem::ManuallyDrop;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A device shared by everything made on it: each resource keeps an `Arc`, so it outlives them all.
pub struct Device {
    /// Device-level commands.
    pub raw: ash::Device,
    /// The queue that draws and copies, for one thread at a time.
    queue: Mutex<vk::Queue>,
    /// Its family.
    pub queue_family: u32,
    /// What was chosen, with its limits.
    pub physical: PhysicalDevice,
    pub(super) cache: PipelineCache,
    allocator: ManuallyDrop<Mutex<Allocator>>,
    /// Modules that stand in for others.
    replaced: Mutex<Replacements>,
    /// There where depth can be resolved in a pass.
    pub(super) render_pass2: Option<khr::create_renderpass2::Device>,
    /// Whether passes may have a fragment density map.
    pub density_maps: bool,
    /// Whether it was opened with what windows need.
    pub(super) presents: bool,
    debug: Option<ext::debug_utils::Device>,
    instance: Arc<Instance>,
}

/// SPIR-V that stands in for the SPIR-V that was built in.
pub type Replacements = HashMap<&'static [u8], Vec<u8>>;

/// What a host asks of a device beyond what every device of Swell has.
pub struct DeviceNeeds<'a> {
    /// Extensions without which the host cannot work.
    pub extensions: &'a [&'static CStr],
    /// Whether the density of fragments is to vary where the device can (`VK_EXT_fragment_density_map`).
    pub foveation: bool,
    /// Where compiled pipelines are kept between runs.
    pub cache: Option<&'a Path>,
    /// Who creates the device.
    pub opener: &'a dyn Opener,
}

impl Default for DeviceNeeds<'_> {
    fn default() -> Self {
        Self { extensions: &[], foveation: false, cache: None, opener: &Directly }
    }
}

impl Device {
    /// Writes the pipelines compiled so far to their file, for the next run, where the process may end without another word.
    pub fn keep_pipelines(&self) {
        // SAFETY: the cache was made on this device.
        unsafe { self.cache.keep(&self.raw) };
    }

    /// Opens `physical` with what `needs` asks for.
    ///
    /// # Errors
    /// An extension asked for is missing, the device cannot be created, or is without memory.
    pub fn new(
        instance: Arc<Instance>,
        physical: PhysicalDevice,
        needs: &DeviceNeeds<'_>,
    ) -> Result<Arc<Self>, GpuError> {
        let queue_family = physical
            .queue_family
            .ok_or_else(|| GpuError::NoDevice(format!("{:?} has no graphics queue", physical.name)))?;
        let priorities = [1.0];
        let queues = [vk::DeviceQueueCreateInfo::default()
            .queue_family_index(queue_family)
            .queue_priorities(&priorities)];
        let features = vk::PhysicalDeviceFeatures::default()
            .fill_mode_non_solid(physical.wireframe)
            .sampler_anisotropy(physical.anisotropy);
        if let Some(missing) = needs.extensions.iter().find(|name| !physical.has(name)) {
            let feature = missing.to_string_lossy().into_owned();
            return Err(GpuError::Missing { device: physical.name.clone(), feature });
        }
        let density_maps = needs.foveation && physical.density_maps;
        let mut names: Vec<_> = needs.extensions.iter().map(|name| name.as_ptr()).collect();
        if physical.depth_resolve {
            names.extend([khr::create_renderpass2::NAME.as_ptr(), khr::depth_stencil_resolve::NAME.as_ptr()]);
        }
        if density_maps {
            names.push(ext::fragment_density_map::NAME.as_ptr());
        }
        let mut multiview = vk::PhysicalDeviceMultiviewFeatures::default().multiview(true);
        let mut density = vk::PhysicalDeviceFragmentDensityMapFeaturesEXT::default()
            .fragment_density_map(true)
            .fragment_density_map_non_subsampled_images(physical.density_maps_on_whole_images);
        let mut info = vk::DeviceCreateInfo::default()
            .queue_create_infos(&queues)
            .enabled_features(&features)
            .enabled_extension_names(&names)
            .push_next(&mut multiview);
        if density_maps {
            info = info.push_next(&mut density);
        }
        let opener = needs.opener;
        let raw = opener.create_device(&instance, physical.raw, &info)?;
        let (allocator, cache) = match equip(&instance, &raw, &physical, needs.cache) {
            Ok(equipment) => equipment,
            Err(error) => {
                // SAFETY: what failed left nothing behind on the device, and nobody else has it yet.
                unsafe { raw.destroy_device(None) };
                return Err(error);
            }
        };
        // SAFETY: the family was asked for with one queue.
        let queue = unsafe { raw.get_device_queue(queue_family, 0) };
        let render_pass2 =
            physical.depth_resolve.then(|| khr::create_renderpass2::Device::new(&instance.raw, &raw));
        let debug = instance.has_debug_utils().then(|| ext::debug_utils::Device::new(&instance.raw, &raw));
        Ok(Arc::new(Self {
            raw,
            queue: Mutex::new(queue),
            queue_family,
            physical,
            cache,
            allocator: ManuallyDrop::new(Mutex::new(allocator)),
            replaced: Mutex::default(),
            render_pass2,
            density_maps,
            presents: needs.extensions.contains(&khr::swapchain::NAME),
            debug,
            instance,
        }))
    }

    /// Makes pipelines of `replacements` from now on, in place of the modules they name. All were validated by naga.
    pub fn replace_shaders(&self, replacements: Replacements) {
        *self.replaced.lock().unwrap_or_else(PoisonError::into_inner) = replacements;
    }

    /// What stands in for `spirv`, or itself.
    pub(super) fn shader(&self, spirv: &[u8]) -> Vec<u8> {
        let replaced = self.replaced.lock().unwrap_or_else(PoisonError::into_inner);
        replaced.get(spirv).map_or_else(|| spirv.to_vec(), Clone::clone)
    }

    /// The instance it came from.
    pub fn instance(&self) -> &Instance {
        &self.instance
    }

    /// Gives `object` a name that validation messages and captures show.
    pub fn name<T: vk::Handle>(&self, object: T, name: &str) {
        let (Some(debug), Ok(name)) = (&self.debug, CString::new(name)) else { return };
        let info = vk::DebugUtilsObjectNameInfoEXT::default().object_handle(object).object_name(&name);
        // SAFETY: the object is alive and ours. A failure leaves it unnamed, which harms nothing.
        let _unnamed = unsafe { debug.set_debug_utils_object_name(&info) };
    }

    pub(super) fn begin_label(&self, commands: vk::CommandBuffer, name: &std::ffi::CStr) {
        if let Some(debug) = &self.debug {
            let label = vk::DebugUtilsLabelEXT::default().label_name(name);
            // SAFETY: the command buffer is recording.
            unsafe { debug.cmd_begin_debug_utils_label(commands, &label) };
        }
    }

    pub(super) fn end_label(&self, commands: vk::CommandBuffer) {
        if let Some(debug) = &self.debug {
            // SAFETY: the command buffer is recording and a label is open.
            unsafe { debug.cmd_end_debug_utils_label(commands) };
        }
    }

    /// Hands recorded `commands` to the queue, which signals `fence` (and `done`, where there is one) when they are done.
    pub(super) fn submit(
        &self,
        commands: vk::CommandBuffer,
        fence: vk::Fence,
        done: Option<vk::Semaphore>,
    ) -> Result<(), GpuError> {
        let buffers = [commands];
        let submits =
            [vk::SubmitInfo::default().command_buffers(&buffers).signal_semaphores(done.as_slice())];
        let queue = self.queue();
        // SAFETY: the lock keeps other threads from the queue; the commands are whole and the fence unsignalled.
        unsafe { self.raw.queue_submit(*queue, &submits, fence) }.doing("submitting a frame")
    }

    /// The queue, while nobody else uses it: whoever lets a runtime use it holds this meanwhile.
    pub(crate) fn queue(&self) -> MutexGuard<'_, vk::Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn allocator(&self) -> MutexGuard<'_, Allocator> {
        self.allocator.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn allocate(
        &self,
        name: &str,
        requirements: vk::MemoryRequirements,
        location: MemoryLocation,
        linear: bool,
    ) -> Result<Allocation, GpuError> {
        self.allocator()
            .allocate(&AllocationCreateDesc {
                name,
                requirements,
                location,
                linear,
                allocation_scheme: AllocationScheme::GpuAllocatorManaged,
            })
            .map_err(|source| GpuError::Memory { what: name.to_owned(), source })
    }

    pub(super) fn free(&self, allocation: Allocation) {
        // Freeing fails only for an allocation of another allocator; there is one here.
        let _foreign = self.allocator().free(allocation);
    }
}

/// What every device has: an allocator without memory so far, and the pipeline cache, the one Vulkan object, made last.
fn equip(
    instance: &Instance,
    raw: &ash::Device,
    physical: &PhysicalDevice,
    cache_dir: Option<&Path>,
) -> Result<(Allocator, PipelineCache), GpuError> {
    let allocator = Allocator::new(&AllocatorCreateDesc {
        instance: instance.raw.clone(),
        device: raw.clone(),
        physical_device: physical.raw,
        debug_settings: AllocatorDebugSettings::default(),
        buffer_device_address: false,
        allocation_sizes: AllocationSizes::default(),
    })
    .map_err(|source| GpuError::Memory { what: "the allocator".to_owned(), source })?;
    Ok((allocator, PipelineCache::open(raw, physical, cache_dir)?))
}

impl Drop for Device {
    fn drop(&mut self) {
        // SAFETY: every resource held an `Arc` of this device, so all are gone; the allocator goes before the device
        // whose memory it frees, and is not used again.
        unsafe {
            let _lost = self.raw.device_wait_idle();
            self.cache.close(&self.raw);
            ManuallyDrop::drop(&mut self.allocator);
            self.raw.destroy_device(None);
        }
    }
}
