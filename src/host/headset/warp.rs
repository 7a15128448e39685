//! What space warp takes: small images of motion vectors and depth beside the views.

use super::stage::IMAGE_PATIENCE;
use crate::gpu::{DEPTH_FORMAT, Device, Lent, Target, TargetInfo, Turn};
use crate::host::HostError;
use crate::xr::{
    DepthRange, Motion, Session, SpaceStep, Swapchain, SwapchainInfo, Usage, VIEWS, XrError, vendor,
};
use ash::vk;
use std::sync::Arc;

/// What the extension recommends: signed, for motion goes both ways.
const VECTORS: vk::Format = vk::Format::R16G16B16A16_SFLOAT;

/// In the order they are dropped: views of images before the images.
pub struct Warp {
    target: Target,
    vectors: Swapchain,
    depth: Swapchain,
    /// The runtime's latest frame was one of ours, which this frame's vectors begin from.
    follows: bool,
    /// This frame's vectors are drawn.
    drawn: bool,
}

impl Warp {
    /// Images of the size that the runtime recommends, or nothing where it cannot warp.
    ///
    /// # Errors
    /// The session or the runtime has gone, or out of memory.
    pub fn new(
        session: &Session,
        device: &Arc<Device>,
        formats: &[vk::Format],
    ) -> Result<Option<Self>, HostError> {
        let Some(size) = vendor::motion_size(&session.runtime)? else { return Ok(None) };
        if !(formats.contains(&VECTORS) && formats.contains(&DEPTH_FORMAT)) {
            return Ok(None);
        }
        let info =
            SwapchainInfo { size, format: VECTORS, usage: Usage::Motion, foveated: false, subsampled: false };
        let vectors = Swapchain::new(session, info)?;
        let info = SwapchainInfo { format: DEPTH_FORMAT, usage: Usage::MotionDepth, ..info };
        let depth = Swapchain::new(session, info)?;
        let target = Target::over(
            device,
            TargetInfo {
                extent: vk::Extent2D { width: size[0], height: size[1] },
                views: VIEWS as u32,
                format: VECTORS,
                samples: vk::SampleCountFlags::TYPE_1,
            },
            &Lent { colors: vectors.images(), depths: depth.images(), ..Lent::default() },
        )?;
        Ok(Some(Self { target, vectors, depth, follows: false, drawn: false }))
    }

    /// What vectors are drawn into.
    pub const fn target(&self) -> &Target {
        &self.target
    }

    /// Pixels of a view.
    pub const fn size(&self) -> [u32; 2] {
        self.vectors.info.size
    }

    /// The images to draw this frame's vectors into; nothing where no frame of ours came right before, or an image did not
    /// come in time, which is waited for again in the next frame.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn acquire(&mut self) -> Result<Option<Turn>, XrError> {
        if !self.follows {
            return Ok(None);
        }
        let Some(color) = self.vectors.acquire(IMAGE_PATIENCE)? else { return Ok(None) };
        let Some(depth) = self.depth.acquire(IMAGE_PATIENCE)? else { return Ok(None) };
        self.drawn = true;
        Ok(Some(Turn { color, depth }))
    }

    /// Gives the images back, if both were drawn: one whose companion is late stays for the next frame.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn release(&mut self) -> Result<(), XrError> {
        if self.drawn {
            self.vectors.release()?;
            self.depth.release()?;
        }
        Ok(())
    }

    /// What the frame that is about to be shown tells of its motion.
    pub fn shown(&mut self, range: DepthRange, step: SpaceStep) -> Option<Motion<'_>> {
        self.follows = true;
        std::mem::take(&mut self.drawn).then_some(Motion {
            vectors: &self.vectors,
            depth: &self.depth,
            range,
            step,
        })
    }

    /// The runtime got an empty frame: the next one of ours has nothing to move on from.
    pub const fn interrupt(&mut self) {
        self.follows = false;
    }
}
