//! How the log calls things.
use crate::next::Next;
use openxr::sys::{self, Result as Xr};
use std::ffi::{CStr, c_char};
use std::ptr;

/// An event: `state FOCUSED`, or `event` and its type.
///
/// # Safety
///
/// `buffer` holds an event.
pub unsafe fn event(buffer: *const sys::EventDataBuffer) -> String {
    // SAFETY: the type says what else is there.
    unsafe {
        let ty = (*buffer).ty;
        if ty == sys::StructureType::EVENT_DATA_SESSION_STATE_CHANGED {
            return format!("state {:?}", (*buffer.cast::<sys::EventDataSessionStateChanged>()).state);
        }
        format!("event {ty:?}").replace("EVENT_DATA_", "")
    }
}

/// What a frame shows: how many layers, of how many views the projection is, whether every one of them has depth.
///
/// # Safety
///
/// Layers and their chains are valid.
pub unsafe fn frame(info: &sys::FrameEndInfo) -> String {
    let (mut views, mut with_depth) = (0, 0);
    for layer in 0..info.layer_count as usize {
        // SAFETY: the caller's array of pointers to layers; the type says what a layer is, and its views are an array
        // with a chain of structures at each, a type in front of every one.
        unsafe {
            let layer = *info.layers.add(layer);
            if (*layer).ty != sys::StructureType::COMPOSITION_LAYER_PROJECTION {
                continue;
            }
            let projection = &*layer.cast::<sys::CompositionLayerProjection>();
            for view in 0..projection.view_count as usize {
                views += 1;
                let mut more = (*projection.views.add(view)).next.cast::<sys::BaseInStructure>();
                while !more.is_null() {
                    with_depth +=
                        u32::from((*more).ty == sys::StructureType::COMPOSITION_LAYER_DEPTH_INFO_KHR);
                    more = (*more).next;
                }
            }
        }
    }
    let depth = if views > 0 && with_depth == views { "yes" } else { "no" };
    let time = info.display_time.as_nanos();
    format!("layers={} views={views} depth={depth} time={time}", info.layer_count)
}

/// A path's text; `-` for none.
pub fn path(next: Next, instance: sys::Instance, path: sys::Path) -> String {
    let mut text = [0 as c_char; 256];
    let mut length = 0;
    // SAFETY: the instance lives, and the buffer has the length that is passed.
    let result =
        unsafe { (next.path_to_string)(instance, path, 256, ptr::from_mut(&mut length), text.as_mut_ptr()) };
    if path == sys::Path::NULL || result != Xr::SUCCESS {
        return "-".to_owned();
    }
    // SAFETY: on success the buffer holds a C string.
    unsafe { CStr::from_ptr(text.as_ptr()) }.to_string_lossy().into_owned()
}
