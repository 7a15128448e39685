//! `XR_FB_space_warp`: looks at what comes with a frame, writes it down, and takes it away before the other runtime's eyes.
use super::{Made, Pretended, say, state, wrong};
use crate::runtime::real;
use openxr::sys::{self, Handle as _, Result as Xr, pfn};
use std::ptr;
use std::slice;

/// What is recommended, pixels.
const SIZE: [u32; 2] = [160, 120];
/// `VK_FORMAT_R16G16B16A16_SFLOAT`.
const VECTORS: i64 = 97;
/// `VK_FORMAT_D32_SFLOAT`.
const DEPTH: i64 = 126;

/// # Safety
///
/// `properties` begins with a type that says what it is.
pub unsafe fn tell(properties: *mut sys::BaseOutStructure) {
    // SAFETY: the caller's promise.
    unsafe {
        if (*properties).ty == sys::SystemSpaceWarpPropertiesFB::TYPE {
            let warp = &mut *properties.cast::<sys::SystemSpaceWarpPropertiesFB>();
            [
                warp.recommended_motion_vector_image_rect_width,
                warp.recommended_motion_vector_image_rect_height,
            ] = SIZE;
        }
    }
}

pub unsafe extern "system" fn end_frame(session: sys::Session, info: *const sys::FrameEndInfo) -> Xr {
    // SAFETY: the caller's structures; the copies of them that are passed on live past the call.
    unsafe {
        let end = real::<pfn::EndFrame>(c"xrEndFrame");
        let layers: &[*const sys::CompositionLayerBaseHeader] = match (*info).layer_count {
            0 => return end(session, info),
            count => slice::from_raw_parts((*info).layers, count as usize),
        };
        let [layer] = layers else { return wrong("space warp: more than one layer") };
        if (**layer).ty != sys::CompositionLayerProjection::TYPE {
            return wrong("space warp: a layer that is no projection");
        }
        let mut projection = *layer.cast::<sys::CompositionLayerProjection>();
        let mut views = slice::from_raw_parts(projection.views, projection.view_count as usize).to_vec();
        let mut warps = Vec::new();
        for view in &mut views {
            // Ours is the first of the chain.
            let warp = view.next.cast::<sys::CompositionLayerSpaceWarpInfoFB>();
            if !warp.is_null() && (*warp).ty == sys::CompositionLayerSpaceWarpInfoFB::TYPE {
                view.next = (*warp).next;
                warps.push(*warp);
            }
        }
        let problem = state(|pretended| {
            pretended.shown += 1;
            if warps.is_empty() { None } else { look(pretended, &warps, views.len()) }
        });
        if let Some(problem) = problem {
            return wrong(&format!("space warp: {problem}"));
        }
        projection.views = views.as_ptr();
        let passed: *const sys::CompositionLayerBaseHeader = ptr::from_ref(&projection).cast();
        let mut info = *info;
        info.layers = &passed;
        end(session, &info)
    }
}

/// What is wrong with `warps`, one for each of `views`, if anything is; writes down what is not.
fn look(
    pretended: &mut Pretended,
    warps: &[sys::CompositionLayerSpaceWarpInfoFB],
    views: usize,
) -> Option<String> {
    if warps.len() != views {
        return Some(format!("{} of {views} views have it", warps.len()));
    }
    for (index, warp) in warps.iter().enumerate() {
        let vectors = image(pretended, &warp.motion_vector_sub_image, index);
        let depth = image(pretended, &warp.depth_sub_image, index);
        let (vectors, depth) = match (vectors, depth) {
            (Ok(vectors), Ok(depth)) => (vectors, depth),
            (Err(problem), _) | (_, Err(problem)) => return Some(problem),
        };
        let sampled = sys::SwapchainUsageFlags::SAMPLED;
        if vectors.format != VECTORS
            || !vectors.usage.contains(sys::SwapchainUsageFlags::COLOR_ATTACHMENT | sampled)
        {
            return Some("motion vectors of another format or use".to_owned());
        }
        if depth.format != DEPTH
            || !depth.usage.contains(sys::SwapchainUsageFlags::DEPTH_STENCIL_ATTACHMENT | sampled)
        {
            return Some("depth of another format or use".to_owned());
        }
        let (least, most) = (warp.min_depth, warp.max_depth);
        if !(0.0 <= least && least < most && most <= 1.0) {
            return Some(format!("depths from {least} to {most}"));
        }
        if !(warp.near_z > 0.0 && warp.far_z > 0.0) || warp.near_z == warp.far_z {
            return Some(format!("distances from {} to {}", warp.near_z, warp.far_z));
        }
        let (p, q) = (warp.app_space_delta_pose.position, warp.app_space_delta_pose.orientation);
        let length = (q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w).sqrt();
        if (length - 1.0).abs() > 1e-4 || !(p.x + p.y + p.z).is_finite() {
            return Some(format!("the pose {p:?} {q:?}"));
        }
        let one = &warps[0];
        let (p0, q0) = (one.app_space_delta_pose.position, one.app_space_delta_pose.orientation);
        if [p.x, p.y, p.z, q.x, q.y, q.z, q.w] != [p0.x, p0.y, p0.z, q0.x, q0.y, q0.z, q0.w]
            || warp.layer_flags != one.layer_flags
        {
            return Some("another step for each view".to_owned());
        }
    }
    let warp = &warps[0];
    for image in [warp.motion_vector_sub_image, warp.depth_sub_image] {
        let made = pretended.swapchains.get_mut(&image.swapchain.into_raw());
        if !made.is_some_and(|made| std::mem::take(&mut made.fresh)) {
            return Some("an image that was not drawn for this frame".to_owned());
        }
    }
    let (p, q) = (warp.app_space_delta_pose.position, warp.app_space_delta_pose.orientation);
    let skip = warp.layer_flags.contains(sys::CompositionLayerSpaceWarpInfoFlagsFB::FRAME_SKIP);
    say(&format!(
        "space_warp {} skip={} near={} far={} pose={},{},{},{},{},{},{}",
        pretended.shown,
        if skip { "yes" } else { "no" },
        warp.near_z,
        warp.far_z,
        p.x,
        p.y,
        p.z,
        q.x,
        q.y,
        q.z,
        q.w
    ));
    None
}

/// The swapchain of an image of view `view`: the whole of one of the recommended size.
fn image(pretended: &Pretended, image: &sys::SwapchainSubImage, view: usize) -> Result<Made, String> {
    let made = pretended.swapchains.get(&image.swapchain.into_raw());
    let made = *made.ok_or("an image of no swapchain")?;
    let (offset, extent) = (image.image_rect.offset, image.image_rect.extent);
    let whole = (offset.x, offset.y) == (0, 0)
        && [extent.width, extent.height].map(|side| u32::try_from(side).unwrap_or(0)) == made.size;
    if made.size != SIZE || !whole || made.layers as usize <= view {
        return Err(format!("{extent:?} at {offset:?} of {} layers of {:?}", made.layers, made.size));
    }
    if image.image_array_index as usize != view {
        return Err(format!("layer {} for view {view}", image.image_array_index));
    }
    Ok(made)
}
