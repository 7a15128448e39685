//! `XR_FB_space_warp`: the runtime makes every other frame from motion vectors and depth.

use crate::xr::XrError;
use crate::xr::error::{Doing, check};
use crate::xr::runtime::Runtime;
use openxr::sys;

/// Pixels of a view's motion vectors that the runtime recommends, or nothing where it cannot warp.
///
/// # Errors
/// The runtime has gone.
pub fn motion_size(runtime: &Runtime) -> Result<Option<[u32; 2]>, XrError> {
    if !runtime.extensions.fb_space_warp {
        return Ok(None);
    }
    let mut warp = sys::SystemSpaceWarpPropertiesFB {
        ty: sys::SystemSpaceWarpPropertiesFB::TYPE,
        next: std::ptr::null_mut(),
        recommended_motion_vector_image_rect_width: 0,
        recommended_motion_vector_image_rect_height: 0,
    };
    let mut properties = sys::SystemProperties::out(std::ptr::from_mut(&mut warp).cast());
    // SAFETY: the instance lives; both structures are locals that live past the call, chained by their own headers.
    check(unsafe {
        (runtime.instance.fp().get_system_properties)(
            runtime.instance.as_raw(),
            runtime.system,
            properties.as_mut_ptr(),
        )
    })
    .doing("asking about space warp")?;
    let size =
        [warp.recommended_motion_vector_image_rect_width, warp.recommended_motion_vector_image_rect_height];
    Ok((size[0] > 0 && size[1] > 0).then_some(size))
}
