//! A small program for a headset, which shows red to the left eye and green to the right: enough to meet every fault.
//! Part of tests, not of the layer; it is here because OpenXR's own calls are unsafe.
#![allow(dead_code, reason = "each test uses a part")]
mod vulkan;

use openxr as xr;
use vulkan::Vulkan;
use xr::sys;

pub struct Client {
    pub instance: xr::Instance,
    pub session: xr::Session<xr::Vulkan>,
    waiter: xr::FrameWaiter,
    stream: xr::FrameStream<xr::Vulkan>,
    swapchain: xr::Swapchain<xr::Vulkan>,
    images: Vec<u64>,
    local: xr::Space,
    floor: xr::Space,
    head: xr::Space,
    /// Last, so that it outlives the session.
    vulkan: Vulkan,
}

/// What happened to a frame.
#[derive(Debug, PartialEq, Eq)]
pub enum Frame {
    Shown,
    /// The runtime wanted no picture.
    Empty,
    /// No image in time; the frame was empty too.
    Late,
}

pub const SIZE: u32 = 64;
const VIEWS: xr::ViewConfigurationType = xr::ViewConfigurationType::PRIMARY_STEREO;

fn entry() -> xr::Entry {
    // SAFETY: the loader of the sysroot or the machine conforms.
    unsafe { xr::Entry::load(&()) }.expect("no OpenXR loader")
}

/// What the runtime offers.
pub fn extensions() -> xr::ExtensionSet {
    entry().enumerate_extensions().expect("no runtime")
}

pub fn instance() -> xr::Result<xr::Instance> {
    let mut extensions = xr::ExtensionSet::default();
    extensions.khr_vulkan_enable2 = true;
    instance_with(&extensions)
}

pub fn instance_with(extensions: &xr::ExtensionSet) -> xr::Result<xr::Instance> {
    let application = xr::ApplicationInfo { application_name: "swell tests", ..Default::default() };
    entry().create_instance(&application, extensions, &[], &())
}

impl Client {
    pub fn new(instance: xr::Instance) -> xr::Result<Self> {
        let system = instance.system(xr::FormFactor::HEAD_MOUNTED_DISPLAY)?;
        instance.graphics_requirements::<xr::Vulkan>(system)?;
        let vulkan = Vulkan::new(&instance, system)?;
        // SAFETY: the handles are valid, and stay so: `vulkan` goes last.
        let (session, waiter, stream) =
            unsafe { instance.create_session::<xr::Vulkan>(system, &vulkan.binding) }?;
        let swapchain = session.create_swapchain(&xr::SwapchainCreateInfo {
            create_flags: xr::SwapchainCreateFlags::EMPTY,
            usage_flags: xr::SwapchainUsageFlags::COLOR_ATTACHMENT | xr::SwapchainUsageFlags::TRANSFER_DST,
            format: vulkan::FORMAT,
            sample_count: 1,
            width: SIZE,
            height: SIZE,
            face_count: 1,
            array_size: 2,
            mip_count: 1,
        })?;
        let images = swapchain.enumerate_images()?;
        let space = |ty| session.create_reference_space(ty, xr::Posef::IDENTITY);
        let local = space(xr::ReferenceSpaceType::LOCAL)?;
        let floor = space(xr::ReferenceSpaceType::STAGE)?;
        let head = space(xr::ReferenceSpaceType::VIEW)?;
        Ok(Self { instance, session, waiter, stream, swapchain, local, floor, head, images, vulkan })
    }

    /// Polls until nothing is left to tell, beginning and ending the session as it is told to; events by name.
    pub fn poll(&mut self) -> xr::Result<Vec<String>> {
        let mut told = Vec::new();
        let mut buffer = xr::EventDataBuffer::new();
        while let Some(event) = self.instance.poll_event(&mut buffer)? {
            told.push(match event {
                xr::Event::SessionStateChanged(change) => {
                    match change.state() {
                        xr::SessionState::READY => drop(self.session.begin(VIEWS)?),
                        xr::SessionState::STOPPING => drop(self.session.end()?),
                        _ => (),
                    }
                    format!("{:?}", change.state())
                }
                xr::Event::InstanceLossPending(_) => "instance loss pending".to_owned(),
                xr::Event::ReferenceSpaceChangePending(change) => {
                    assert_eq!(change.reference_space_type(), xr::ReferenceSpaceType::LOCAL_FLOOR);
                    assert!(change.pose_valid());
                    format!("recentre {}", change.pose_in_previous_space().position.x)
                }
                xr::Event::VisibilityMaskChangedKHR(change) => format!("mask {}", change.view_index()),
                xr::Event::InteractionProfileChanged(_) => "profile".to_owned(),
                _ => "other".to_owned(),
            });
        }
        Ok(told)
    }

    /// Polls until the session is in `state`.
    pub fn until(&mut self, state: xr::SessionState) -> xr::Result<()> {
        let wanted = format!("{state:?}");
        for _ in 0..500 {
            if self.poll()?.contains(&wanted) {
                return Ok(());
            }
            std::thread::sleep(std::time::Duration::from_millis(10));
        }
        panic!("never {wanted}");
    }

    pub fn frame(&mut self) -> xr::Result<(Frame, xr::Time)> {
        let frame = self.waiter.wait()?;
        let time = frame.predicted_display_time;
        self.stream.begin()?;
        let opaque = xr::EnvironmentBlendMode::OPAQUE;
        if !frame.should_render {
            self.stream.end(time, opaque, &[])?;
            return Ok((Frame::Empty, time));
        }
        let (_, views) = self.session.locate_views(VIEWS, time, &self.local)?;
        let image = self.swapchain.acquire_image()?;
        if !self.wait_image()? {
            self.stream.end(time, opaque, &[])?;
            // An image that was acquired has to be waited for and released.
            while !self.wait_image()? {}
            self.release_image()?;
            return Ok((Frame::Late, time));
        }
        self.vulkan.paint(self.images[image as usize]);
        self.release_image()?;
        let eye = |index: usize| {
            let whole = xr::Rect2Di {
                offset: xr::Offset2Di { x: 0, y: 0 },
                extent: xr::Extent2Di { width: SIZE as i32, height: SIZE as i32 },
            };
            let image = xr::SwapchainSubImage::new().swapchain(&self.swapchain);
            xr::CompositionLayerProjectionView::new()
                .pose(views[index].pose)
                .fov(views[index].fov)
                .sub_image(image.image_array_index(index as u32).image_rect(whole))
        };
        let eyes = [eye(0), eye(1)];
        let layer = xr::CompositionLayerProjection::new().space(&self.local).views(&eyes);
        self.stream.end(time, opaque, &[&layer])?;
        Ok((Frame::Shown, time))
    }

    /// Where the head is above the floor.
    pub fn head(&self, time: xr::Time) -> xr::Result<xr::Posef> {
        Ok(self.head.locate(&self.floor, time)?.pose)
    }

    /// Ends a frame with a structure of another kind.
    pub fn end_wrongly(&self) -> sys::Result {
        let info = sys::FrameEndInfo {
            ty: sys::FrameState::TYPE,
            next: std::ptr::null(),
            display_time: sys::Time::from_nanos(1),
            environment_blend_mode: xr::EnvironmentBlendMode::OPAQUE,
            layer_count: 0,
            layers: std::ptr::null(),
        };
        // SAFETY: the structure has the size that its reader expects, whatever it says of itself.
        unsafe { (self.instance.fp().end_frame)(self.session.as_raw(), &info) }
    }

    /// False after a time-out, which the wrapper of `openxr` 0.22 takes for an image.
    fn wait_image(&self) -> xr::Result<bool> {
        let info = sys::SwapchainImageWaitInfo {
            ty: sys::SwapchainImageWaitInfo::TYPE,
            next: std::ptr::null(),
            timeout: sys::Duration::from_nanos(5_000_000_000),
        };
        // SAFETY: the swapchain lives.
        let result = unsafe { (self.instance.fp().wait_swapchain_image)(self.swapchain.as_raw(), &info) };
        match result {
            sys::Result::SUCCESS => Ok(true),
            sys::Result::TIMEOUT_EXPIRED => Ok(false),
            error => Err(error),
        }
    }

    fn release_image(&self) -> xr::Result<()> {
        // SAFETY: the swapchain lives.
        let result = unsafe {
            (self.instance.fp().release_swapchain_image)(self.swapchain.as_raw(), std::ptr::null())
        };
        if result == sys::Result::SUCCESS { Ok(()) } else { Err(result) }
    }
}
