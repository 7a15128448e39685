//! Events that the runtime never sent.
use crate::state::State;
use openxr::sys;
use std::ptr;

#[derive(Clone, Copy)]
pub enum Event {
    LossPending,
    InstanceLossPending,
    MaskChanged { view: u32 },
    Recentre,
    ProfileChanged,
}

impl Event {
    /// Writes the event where the program will read it; returns its type. The loss that an event announces comes.
    ///
    /// # Safety
    ///
    /// `buffer` is an `XrEventDataBuffer` of the caller's.
    pub unsafe fn deliver(self, layer: &mut State, buffer: *mut sys::EventDataBuffer) -> sys::StructureType {
        let (session, time) = (layer.session(), layer.display_time);
        let next = ptr::null();
        // SAFETY: a buffer has space for any event, and alignment for its pointers.
        unsafe {
            match self {
                Self::LossPending => {
                    layer.lose_session();
                    write(
                        buffer,
                        sys::EventDataSessionStateChanged {
                            ty: sys::EventDataSessionStateChanged::TYPE,
                            next,
                            session,
                            state: sys::SessionState::LOSS_PENDING,
                            time,
                        },
                    );
                }
                Self::InstanceLossPending => {
                    layer.announce_loss();
                    write(
                        buffer,
                        sys::EventDataInstanceLossPending {
                            ty: sys::EventDataInstanceLossPending::TYPE,
                            next,
                            loss_time: time,
                        },
                    );
                }
                Self::MaskChanged { view } => write(
                    buffer,
                    sys::EventDataVisibilityMaskChangedKHR {
                        ty: sys::EventDataVisibilityMaskChangedKHR::TYPE,
                        next,
                        session,
                        view_configuration_type: sys::ViewConfigurationType::PRIMARY_STEREO,
                        view_index: view,
                    },
                ),
                Self::Recentre => write(
                    buffer,
                    sys::EventDataReferenceSpaceChangePending {
                        ty: sys::EventDataReferenceSpaceChangePending::TYPE,
                        next,
                        session,
                        reference_space_type: sys::ReferenceSpaceType::LOCAL_FLOOR,
                        change_time: time,
                        pose_valid: sys::TRUE,
                        pose_in_previous_space: sys::Posef {
                            orientation: sys::Quaternionf { x: 0.0, y: 0.0, z: 0.0, w: 1.0 },
                            position: sys::Vector3f { x: 1.0, y: 0.0, z: 0.0 },
                        },
                    },
                ),
                Self::ProfileChanged => write(
                    buffer,
                    sys::EventDataInteractionProfileChanged {
                        ty: sys::EventDataInteractionProfileChanged::TYPE,
                        next,
                        session,
                    },
                ),
            }
            (*buffer).ty
        }
    }
}

/// # Safety
///
/// `E` is an event, which no buffer is too small for.
pub unsafe fn write<E>(buffer: *mut sys::EventDataBuffer, event: E) {
    // SAFETY: the caller's promise.
    unsafe { buffer.cast::<E>().write(event) }
}
