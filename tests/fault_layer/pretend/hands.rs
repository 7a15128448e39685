//! `XR_EXT_hand_tracking`: two hands that hold still where [`joint`] says, in whatever space.
use super::{say, state, wrong};
use openxr::sys::{self, Handle as _, Result as Xr};
use std::slice;

/// Place and radius of a joint, metres. `tests/xr_vendor.rs` has the same.
fn joint(right: bool, index: usize) -> (sys::Vector3f, f32) {
    let (column, row) = ((index % 5) as f32, (index / 5) as f32);
    let side = if right { 1.0 } else { -1.0 };
    let place = sys::Vector3f { x: side * (0.08 + 0.03 * column), y: 1.4 + 0.03 * row, z: -0.5 };
    (place, 0.006 + 0.0002 * index as f32)
}

/// # Safety
///
/// `properties` begins with a type that says what it is.
pub unsafe fn tell(properties: *mut sys::BaseOutStructure) {
    // SAFETY: the caller's promise.
    unsafe {
        if (*properties).ty == sys::SystemHandTrackingPropertiesEXT::TYPE {
            (*properties.cast::<sys::SystemHandTrackingPropertiesEXT>()).supports_hand_tracking = sys::TRUE;
        }
    }
}

pub unsafe extern "system" fn create(
    _session: sys::Session,
    info: *const sys::HandTrackerCreateInfoEXT,
    tracker: *mut sys::HandTrackerEXT,
) -> Xr {
    // SAFETY: the caller's structure, and space for a handle.
    unsafe {
        let hand = (*info).hand;
        say(&format!("create_hand_tracker {hand:?} {:?}", (*info).hand_joint_set));
        *tracker = sys::HandTrackerEXT::from_raw(state(|pretended| {
            let handle = pretended.handle();
            pretended.trackers.insert(handle, hand == sys::HandEXT::RIGHT);
            handle
        }));
    }
    Xr::SUCCESS
}

pub unsafe extern "system" fn destroy(tracker: sys::HandTrackerEXT) -> Xr {
    say("destroy_hand_tracker");
    state(|pretended| pretended.trackers.remove(&tracker.into_raw()));
    Xr::SUCCESS
}

pub unsafe extern "system" fn locate(
    tracker: sys::HandTrackerEXT,
    _info: *const sys::HandJointsLocateInfoEXT,
    locations: *mut sys::HandJointLocationsEXT,
) -> Xr {
    let Some(right) = state(|pretended| pretended.trackers.get(&tracker.into_raw()).copied()) else {
        return wrong("hand joints: no tracker");
    };
    // SAFETY: the caller's structure, with an array of as many joints as it says.
    unsafe {
        let locations = &mut *locations;
        if locations.joint_count as usize != sys::HAND_JOINT_COUNT_EXT {
            return wrong("hand joints: another number than the set has");
        }
        locations.is_active = sys::TRUE;
        let joints = slice::from_raw_parts_mut(locations.joint_locations, sys::HAND_JOINT_COUNT_EXT);
        for (index, told) in joints.iter_mut().enumerate() {
            let (position, radius) = joint(right, index);
            let orientation = sys::Quaternionf { x: 0.0, y: 0.0, z: 0.0, w: 1.0 };
            *told = sys::HandJointLocationEXT {
                location_flags: sys::SpaceLocationFlags::ORIENTATION_VALID
                    | sys::SpaceLocationFlags::POSITION_VALID
                    | sys::SpaceLocationFlags::ORIENTATION_TRACKED
                    | sys::SpaceLocationFlags::POSITION_TRACKED,
                pose: sys::Posef { orientation, position },
                radius,
            };
        }
    }
    Xr::SUCCESS
}
