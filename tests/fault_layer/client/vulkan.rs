//! Vulkan as the runtime wants it: the least that a session can be made and a colour shown with.
use ash::vk::{self, Handle as _};
use openxr as xr;
use openxr::sys::platform::VkGetInstanceProcAddr;

pub const FORMAT: u32 = vk::Format::R8G8B8A8_SRGB.as_raw() as u32;

pub struct Vulkan {
    _entry: ash::Entry,
    instance: ash::Instance,
    device: ash::Device,
    pool: vk::CommandPool,
    commands: vk::CommandBuffer,
    pub binding: xr::vulkan::SessionCreateInfo,
}

impl Vulkan {
    pub fn new(xr_instance: &xr::Instance, system: xr::SystemId) -> xr::Result<Self> {
        let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_1);
        let instance_info = vk::InstanceCreateInfo::default().application_info(&application);
        // SAFETY: Vulkan's loader conforms; structures live for the calls they are passed to; handles are used with the
        // instance or device they come from. A function pointer has the same type in both crates, by another name.
        unsafe {
            let entry = ash::Entry::load().expect("no Vulkan loader");
            let get = std::mem::transmute::<vk::PFN_vkGetInstanceProcAddr, VkGetInstanceProcAddr>(
                entry.static_fn().get_instance_proc_addr,
            );
            let made = xr_instance.create_vulkan_instance(system, get, (&raw const instance_info).cast())?;
            let raw = made.expect("no Vulkan instance");
            let instance = ash::Instance::load(entry.static_fn(), vk::Instance::from_raw(raw as u64));
            let physical_device = xr_instance.vulkan_graphics_device(system, raw)?;
            let queue = [vk::DeviceQueueCreateInfo::default().queue_priorities(&[1.0])];
            let info = vk::DeviceCreateInfo::default().queue_create_infos(&queue);
            let made =
                xr_instance.create_vulkan_device(system, get, physical_device, (&raw const info).cast())?;
            let device = made.expect("no Vulkan device");
            let binding = xr::vulkan::SessionCreateInfo {
                instance: raw,
                physical_device,
                device,
                queue_family_index: 0,
                queue_index: 0,
            };
            let device = ash::Device::load(instance.fp_v1_0(), vk::Device::from_raw(device as u64));
            let flags = vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER;
            let info = vk::CommandPoolCreateInfo::default().flags(flags);
            let pool = device.create_command_pool(&info, None).expect("no command pool");
            let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
            let commands = device.allocate_command_buffers(&info).expect("no command buffer")[0];
            Ok(Self { _entry: entry, instance, device, pool, commands, binding })
        }
    }

    /// Makes the first layer of a swapchain's image red and the second green, and waits for it.
    pub fn paint(&self, image: u64) {
        let image = vk::Image::from_raw(image);
        let layers = |first, count| {
            let range = vk::ImageSubresourceRange::default().base_array_layer(first).layer_count(count);
            range.aspect_mask(vk::ImageAspectFlags::COLOR).level_count(1)
        };
        let to = |old, new| {
            let barrier = vk::ImageMemoryBarrier::default().image(image).subresource_range(layers(0, 2));
            let access = vk::AccessFlags::MEMORY_READ | vk::AccessFlags::MEMORY_WRITE;
            let barrier =
                barrier.old_layout(old).new_layout(new).src_access_mask(access).dst_access_mask(access);
            let all = vk::PipelineStageFlags::ALL_COMMANDS;
            // SAFETY: recorded below, where the buffer is being recorded.
            unsafe {
                let none = vk::DependencyFlags::empty();
                self.device.cmd_pipeline_barrier(self.commands, all, all, none, &[], &[], &[barrier]);
            }
        };
        let (target, shown) =
            (vk::ImageLayout::TRANSFER_DST_OPTIMAL, vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL);
        // SAFETY: the image was waited for and is not released yet; the buffer is not in use, for the last submission
        // was waited for.
        unsafe {
            let begin = vk::CommandBufferBeginInfo::default();
            self.device.begin_command_buffer(self.commands, &begin).expect("begin");
            to(vk::ImageLayout::UNDEFINED, target);
            for (layer, float32) in [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0]].into_iter().enumerate() {
                let (colour, range) = (vk::ClearColorValue { float32 }, [layers(layer as u32, 1)]);
                self.device.cmd_clear_color_image(self.commands, image, target, &colour, &range);
            }
            to(target, shown);
            self.device.end_command_buffer(self.commands).expect("end");
            let queue = self.device.get_device_queue(0, 0);
            let submit = [vk::SubmitInfo::default().command_buffers(std::slice::from_ref(&self.commands))];
            self.device.queue_submit(queue, &submit, vk::Fence::null()).expect("submit");
            self.device.queue_wait_idle(queue).expect("wait");
        }
    }
}

impl Drop for Vulkan {
    fn drop(&mut self) {
        // SAFETY: the session, which used them, is gone, and nothing is being executed.
        unsafe {
            self.device.destroy_command_pool(self.pool, None);
            self.device.destroy_device(None);
            self.instance.destroy_instance(None);
        }
    }
}
