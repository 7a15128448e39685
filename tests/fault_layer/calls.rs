//! The calls this layer stands before. Each asks whether a fault strikes, calls down if not, and writes a line.
use crate::describe;
use crate::events::Event;
use crate::next::Next;
use crate::plan::Fault;
use crate::state::{State, with};
use openxr::sys::{self, Result as Xr};

/// `error` returned, or what `call` makes of the functions below; written down as `line`.
fn answer(error: Option<Xr>, line: &str, call: impl FnOnce(Next) -> Xr) -> Xr {
    let next = with(|layer| layer.next());
    let result = error.unwrap_or_else(|| call(next));
    with(|layer| layer.say_call(line, result));
    result
}

/// The same for a call that needs the session and can only fail with it.
fn on_session(line: &str, call: impl FnOnce(Next) -> Xr) -> Xr {
    answer(with(|layer| layer.session_error()), line, call)
}

/// A call number and the error it gets from a session that is lost, or from `fault`.
fn counted(function: &'static str, fault: impl FnOnce(&mut State, u32) -> Option<Xr>) -> (u32, Option<Xr>) {
    with(|layer| {
        let call = layer.count(function);
        let error = layer.session_error().or_else(|| fault(layer, call));
        (call, error)
    })
}

pub unsafe extern "system" fn destroy_instance(instance: sys::Instance) -> Xr {
    // SAFETY: the caller's arguments, passed on as they are.
    let result = answer(None, "destroy_instance", |next| unsafe { (next.destroy_instance)(instance) });
    with(|layer| layer.instance_gone());
    result
}

pub unsafe extern "system" fn get_system(
    instance: sys::Instance,
    info: *const sys::SystemGetInfo,
    system: *mut sys::SystemId,
) -> Xr {
    let (call, error) = with(|layer| {
        let call = layer.count("get_system");
        let none = Xr::ERROR_FORM_FACTOR_UNAVAILABLE;
        (call, layer.instance_error().or_else(|| layer.fails(Fault::NoSystem, call, none)))
    });
    // SAFETY: as above.
    answer(error, &format!("get_system {call}"), |next| unsafe { (next.get_system)(instance, info, system) })
}

pub unsafe extern "system" fn poll_event(instance: sys::Instance, buffer: *mut sys::EventDataBuffer) -> Xr {
    let own = with(|layer| match layer.instance_error() {
        Some(error) => Some(error),
        None => layer.pending.pop_front().map(|event| {
            // SAFETY: the caller's buffer.
            unsafe { event.deliver(layer, buffer) };
            Xr::SUCCESS
        }),
    });
    // SAFETY: as above.
    let result = own.unwrap_or_else(|| unsafe { (with(|layer| layer.next()).poll_event)(instance, buffer) });
    match result {
        // SAFETY: on success the buffer holds an event.
        Xr::SUCCESS => with(|layer| layer.say(&unsafe { describe::event(buffer) })),
        Xr::EVENT_UNAVAILABLE => with(State::all_events_read),
        error => with(|layer| layer.say_call("poll_event", error)),
    }
    result
}

pub unsafe extern "system" fn create_session(
    instance: sys::Instance,
    info: *const sys::SessionCreateInfo,
    session: *mut sys::Session,
) -> Xr {
    let (call, error) = counted("create_session", |layer, call| {
        layer.fails(Fault::CreateSessionFails, call, Xr::ERROR_RUNTIME_FAILURE)
    });
    // SAFETY: as above; a session that was made has a handle.
    let result = answer(error, &format!("create_session {call}"), |next| unsafe {
        (next.create_session)(instance, info, session)
    });
    if result == Xr::SUCCESS {
        // SAFETY: as above.
        with(|layer| layer.session_made(unsafe { *session }));
    }
    result
}

pub unsafe extern "system" fn destroy_session(session: sys::Session) -> Xr {
    // SAFETY: as above.
    let result = answer(None, "destroy_session", |next| unsafe { (next.destroy_session)(session) });
    with(|layer| layer.session_gone());
    result
}

pub unsafe extern "system" fn begin_session(session: sys::Session, info: *const sys::SessionBeginInfo) -> Xr {
    // SAFETY: as above.
    on_session("begin_session", |next| unsafe { (next.begin_session)(session, info) })
}

pub unsafe extern "system" fn end_session(session: sys::Session) -> Xr {
    // SAFETY: as above.
    on_session("end_session", |next| unsafe { (next.end_session)(session) })
}

pub unsafe extern "system" fn request_exit_session(session: sys::Session) -> Xr {
    let (call, error) = counted("request_exit", |_, _| None);
    // SAFETY: as above.
    let result = answer(error, "request_exit", |next| unsafe { (next.request_exit_session)(session) });
    with(|layer| {
        if layer.strikes(Fault::LostAtExit, call) {
            layer.lose_session();
        }
    });
    result
}

pub unsafe extern "system" fn create_swapchain(
    session: sys::Session,
    info: *const sys::SwapchainCreateInfo,
    swapchain: *mut sys::Swapchain,
) -> Xr {
    // SAFETY: the caller's structure.
    let asked = unsafe { &*info };
    let line = format!(
        "create_swapchain {}x{} layers={} samples={} format={} flags={:?}",
        asked.width, asked.height, asked.array_size, asked.sample_count, asked.format, asked.create_flags
    );
    // SAFETY: as above.
    on_session(&line, |next| unsafe { (next.create_swapchain)(session, info, swapchain) })
}

pub unsafe extern "system" fn destroy_swapchain(swapchain: sys::Swapchain) -> Xr {
    // SAFETY: as above.
    answer(None, "destroy_swapchain", |next| unsafe { (next.destroy_swapchain)(swapchain) })
}

pub unsafe extern "system" fn acquire_swapchain_image(
    swapchain: sys::Swapchain,
    info: *const sys::SwapchainImageAcquireInfo,
    index: *mut u32,
) -> Xr {
    let (call, error) = counted("acquire_image", |layer, call| {
        layer.fails(Fault::AcquireFails, call, Xr::ERROR_RUNTIME_FAILURE)
    });
    // SAFETY: as above.
    answer(error, &format!("acquire_image {call}"), |next| unsafe {
        (next.acquire_swapchain_image)(swapchain, info, index)
    })
}

pub unsafe extern "system" fn wait_swapchain_image(
    swapchain: sys::Swapchain,
    info: *const sys::SwapchainImageWaitInfo,
) -> Xr {
    let (call, error) =
        counted("wait_image", |layer, call| layer.fails(Fault::WaitImageTimeout, call, Xr::TIMEOUT_EXPIRED));
    // SAFETY: as above.
    answer(error, &format!("wait_image {call}"), |next| unsafe {
        (next.wait_swapchain_image)(swapchain, info)
    })
}

pub unsafe extern "system" fn release_swapchain_image(
    swapchain: sys::Swapchain,
    info: *const sys::SwapchainImageReleaseInfo,
) -> Xr {
    // SAFETY: as above.
    on_session("release_image", |next| unsafe { (next.release_swapchain_image)(swapchain, info) })
}

pub unsafe extern "system" fn wait_frame(
    session: sys::Session,
    info: *const sys::FrameWaitInfo,
    frame: *mut sys::FrameState,
) -> Xr {
    let (call, error) = counted("wait_frame", |layer, call| {
        if layer.strikes(Fault::InstanceLost, call) {
            layer.lose_instance();
            return layer.instance_error();
        }
        layer.fails(Fault::WaitFails, call, Xr::ERROR_RUNTIME_FAILURE)
    });
    let next = with(|layer| layer.next());
    // SAFETY: as above.
    let result = error.unwrap_or_else(|| unsafe { (next.wait_frame)(session, info, frame) });
    with(|layer| {
        if result != Xr::SUCCESS {
            layer.say_call(&format!("wait_frame {call}"), result);
            return;
        }
        // SAFETY: on success the runtime has written the state.
        let frame = unsafe { &mut *frame };
        if layer.strikes(Fault::ShouldRenderFalse, call) {
            frame.should_render = sys::FALSE;
        }
        layer.display_time = frame.predicted_display_time;
        let render = if frame.should_render.into() { "yes" } else { "no" };
        let time = frame.predicted_display_time.as_nanos();
        layer.say(&format!("wait_frame {call} render={render} time={time}"));
    });
    result
}

pub unsafe extern "system" fn begin_frame(session: sys::Session, info: *const sys::FrameBeginInfo) -> Xr {
    // SAFETY: as above.
    on_session("begin_frame", |next| unsafe { (next.begin_frame)(session, info) })
}

pub unsafe extern "system" fn end_frame(session: sys::Session, info: *const sys::FrameEndInfo) -> Xr {
    let (call, error) = counted("end_frame", |layer, call| {
        if layer.strikes(Fault::SessionLost, call) {
            layer.lose_session();
            return layer.session_error();
        }
        layer.fails(Fault::EndFails, call, Xr::ERROR_RUNTIME_FAILURE)
    });
    // SAFETY: the caller's structure, and what it points to.
    let line = format!("end_frame {call} {}", unsafe { describe::frame(&*info) });
    // SAFETY: as above.
    let result = answer(error, &line, |next| unsafe { (next.end_frame)(session, info) });
    with(|layer| {
        for (fault, events) in [
            (Fault::LossPending, &[Event::LossPending][..]),
            (Fault::InstanceLossPending, &[Event::InstanceLossPending]),
            (Fault::MaskChanged, &[Event::MaskChanged { view: 0 }, Event::MaskChanged { view: 1 }]),
            (Fault::Recentre, &[Event::Recentre]),
            (Fault::ProfileChanged, &[Event::ProfileChanged]),
        ] {
            if layer.strikes(fault, call) {
                layer.pending.extend(events);
            }
        }
    });
    result
}

pub unsafe extern "system" fn locate_views(
    session: sys::Session,
    info: *const sys::ViewLocateInfo,
    state: *mut sys::ViewState,
    capacity: u32,
    count: *mut u32,
    views: *mut sys::View,
) -> Xr {
    // SAFETY: the caller's structure.
    let line = format!("locate_views time={}", unsafe { (*info).display_time.as_nanos() });
    // SAFETY: as above.
    on_session(&line, |next| unsafe { (next.locate_views)(session, info, state, capacity, count, views) })
}

pub unsafe extern "system" fn get_visibility_mask(
    session: sys::Session,
    configuration: sys::ViewConfigurationType,
    view: u32,
    kind: sys::VisibilityMaskTypeKHR,
    mask: *mut sys::VisibilityMaskKHR,
) -> Xr {
    let below = with(|layer| layer.visibility_mask.expect("nobody was given this function"));
    // SAFETY: as above.
    on_session(&format!("get_visibility_mask {view}"), |_| unsafe {
        below(session, configuration, view, kind, mask)
    })
}

pub unsafe extern "system" fn sync_actions(session: sys::Session, info: *const sys::ActionsSyncInfo) -> Xr {
    let (call, error) = counted("sync_actions", |_, _| None);
    // SAFETY: as above.
    answer(error, &format!("sync_actions {call}"), |next| unsafe { (next.sync_actions)(session, info) })
}

pub unsafe extern "system" fn apply_haptic_feedback(
    session: sys::Session,
    info: *const sys::HapticActionInfo,
    haptic: *const sys::HapticBaseHeader,
) -> Xr {
    let (next, instance) = with(|layer| (layer.next(), layer.instance()));
    // SAFETY: the caller's structures; the type of the second says what it is.
    let line = unsafe {
        let whose = describe::path(next, instance, (*info).subaction_path);
        let mut line = format!("apply_haptics {whose}");
        if (*haptic).ty == sys::StructureType::HAPTIC_VIBRATION {
            let vibration = &*haptic.cast::<sys::HapticVibration>();
            line += &format!(" amplitude={} ns={}", vibration.amplitude, vibration.duration.as_nanos());
        }
        line
    };
    // SAFETY: as above.
    on_session(&line, |next| unsafe { (next.apply_haptic_feedback)(session, info, haptic) })
}
