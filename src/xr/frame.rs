//! The end of a frame: what the compositor is given.

use super::error::{Doing, XrError, check};
use super::runtime::VIEWS;
use super::session::{FrameTime, Pose, Session};
use super::swapchain::Swapchain;
use openxr as xr;
use openxr::sys::{self, Handle as _};

/// How depths become distances: reverse-Z with an infinite far plane.
#[derive(Clone, Copy, Debug)]
pub struct DepthRange {
    /// Distance where depth is 1, metres.
    pub near: f32,
}

/// What a frame shows.
pub struct Layer<'a> {
    /// Colour, one layer a view.
    pub color: &'a Swapchain,
    /// Depth, where the runtime takes it.
    pub depth: Option<(&'a Swapchain, DepthRange)>,
    /// What moves, where the runtime makes frames between frames of it.
    pub motion: Option<Motion<'a>>,
    /// What stands before all that.
    pub quad: Option<Quad<'a>>,
}

/// A rectangle in the space that poses are in, seen by both eyes.
pub struct Quad<'a> {
    /// The latest image of it that was given back.
    pub color: &'a Swapchain,
    /// Of its middle; it faces +Z.
    pub pose: Pose,
    /// Width and height, metres.
    pub size: [f32; 2],
}

/// Motion vectors for space warp.
pub struct Motion<'a> {
    /// Motion in clip space since the frame before.
    pub vectors: &'a Swapchain,
    /// Depth at the same resolution.
    pub depth: &'a Swapchain,
    /// Its range.
    pub range: DepthRange,
    /// How the person's own space moved since the frame before.
    pub step: SpaceStep,
}

/// How the space that poses are in moved in the world since the frame before, by the application's doing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpaceStep {
    /// Where the space is now, in what it was in the frame before.
    pub pose: Pose,
    /// It jumped: nothing is to be made of this step.
    pub jumped: bool,
}

impl Session {
    /// Ends the frame of `time` with `layer`, seen from where [`Session::locate`] last found the eyes, or with nothing.
    /// Allocates nothing.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn end(&mut self, time: FrameTime, layer: Option<&Layer<'_>>) -> Result<(), XrError> {
        let depth = |view: usize| layer?.depth.map(|(swapchain, range)| depth_info(swapchain, range, view));
        let depths: [Option<sys::CompositionLayerDepthInfoKHR>; VIEWS] = std::array::from_fn(depth);
        let warps: [Option<sys::CompositionLayerSpaceWarpInfoFB>; VIEWS] = std::array::from_fn(|view| {
            let next =
                depths[view].as_ref().map_or(std::ptr::null(), |depth| std::ptr::from_ref(depth).cast());
            layer?.motion.as_ref().map(|motion| warp_info(motion, view, next))
        });
        let located = *self.located();
        let views: [sys::CompositionLayerProjectionView; VIEWS] = std::array::from_fn(|view| {
            let next = match (&warps[view], &depths[view]) {
                (Some(warp), _) => std::ptr::from_ref(warp).cast(),
                (None, Some(depth)) => std::ptr::from_ref(depth).cast(),
                (None, None) => std::ptr::null(),
            };
            sys::CompositionLayerProjectionView {
                ty: sys::CompositionLayerProjectionView::TYPE,
                next,
                pose: located[view].pose,
                fov: located[view].fov,
                sub_image: layer.map_or(NOTHING, |layer| layer.color.sub_image(view)),
            }
        });
        let projection = sys::CompositionLayerProjection {
            ty: sys::CompositionLayerProjection::TYPE,
            next: std::ptr::null(),
            layer_flags: sys::CompositionLayerFlags::EMPTY,
            space: self.base().as_raw(),
            view_count: VIEWS as u32,
            views: views.as_ptr(),
        };
        let quad = layer.and_then(|layer| layer.quad.as_ref()).map(|quad| sys::CompositionLayerQuad {
            ty: sys::CompositionLayerQuad::TYPE,
            next: std::ptr::null(),
            layer_flags: sys::CompositionLayerFlags::EMPTY,
            space: self.base().as_raw(),
            eye_visibility: xr::EyeVisibility::BOTH,
            sub_image: quad.color.sub_image(0),
            pose: quad.pose.raw(),
            size: xr::Extent2Df { width: quad.size[0], height: quad.size[1] },
        });
        // In the order in which they cover each other.
        let header = std::ptr::from_ref(&projection).cast::<sys::CompositionLayerBaseHeader>();
        let layers = [header, quad.as_ref().map_or(std::ptr::null(), |quad| std::ptr::from_ref(quad).cast())];
        let info = sys::FrameEndInfo {
            ty: sys::FrameEndInfo::TYPE,
            next: std::ptr::null(),
            display_time: time.raw,
            environment_blend_mode: self.runtime.blend,
            layer_count: u32::from(layer.is_some()) + u32::from(quad.is_some()),
            layers: layers.as_ptr(),
        };
        let _queue = self.device.queue();
        // SAFETY: a frame was begun; every structure that is chained or pointed to is a local that lives past the call, and
        // the swapchains belong to this session.
        let ended = unsafe { (self.runtime.instance.fp().end_frame)(self.raw.as_raw(), &info) };
        check(ended).doing("ending a frame").map(|_| ())
    }
}

const NOTHING: sys::SwapchainSubImage = sys::SwapchainSubImage {
    swapchain: sys::Swapchain::NULL,
    image_rect: xr::Rect2Di {
        offset: xr::Offset2Di { x: 0, y: 0 },
        extent: xr::Extent2Di { width: 0, height: 0 },
    },
    image_array_index: 0,
};

fn depth_info(swapchain: &Swapchain, range: DepthRange, view: usize) -> sys::CompositionLayerDepthInfoKHR {
    sys::CompositionLayerDepthInfoKHR {
        ty: sys::CompositionLayerDepthInfoKHR::TYPE,
        next: std::ptr::null(),
        sub_image: swapchain.sub_image(view),
        min_depth: 0.0,
        max_depth: 1.0,
        // Reversed: the least depth, 0, is at infinity.
        near_z: f32::INFINITY,
        far_z: range.near,
    }
}

fn warp_info(
    motion: &Motion<'_>,
    view: usize,
    next: *const std::ffi::c_void,
) -> sys::CompositionLayerSpaceWarpInfoFB {
    use sys::CompositionLayerSpaceWarpInfoFlagsFB as Flags;
    sys::CompositionLayerSpaceWarpInfoFB {
        ty: sys::CompositionLayerSpaceWarpInfoFB::TYPE,
        next,
        layer_flags: if motion.step.jumped { Flags::FRAME_SKIP } else { Flags::EMPTY },
        motion_vector_sub_image: motion.vectors.sub_image(view),
        app_space_delta_pose: motion.step.pose.raw(),
        depth_sub_image: motion.depth.sub_image(view),
        min_depth: 0.0,
        max_depth: 1.0,
        near_z: f32::INFINITY,
        far_z: motion.range.near,
    }
}
