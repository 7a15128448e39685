//! The layer that injects faults, met by a small client on Monado: each fault arrives as it should, and nothing else.
//! A test starts a service and runs the ignored test of the same name on it, in a process of its own.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic")]
#[path = "fault_layer/client/mod.rs"]
mod client;
mod support;

use client::{Client, Frame, extensions, instance, instance_with};
use openxr::SessionState;
use openxr::sys::Result as Xr;
use support::faults::{self, Calls};
use support::monado::{Service, Settings};
use support::program::run;

/// What the client `name` did where `faults` struck; it has to do it without core validation's objection.
fn met(name: &str, faults: &str) -> Calls {
    let service = Service::start(Settings::default());
    let mut client = service.reexec(name);
    let record = faults::between(&service, &mut client, faults);
    let said = run(&mut client);
    let calls = record.calls();
    assert!(said.status == Some(0) && said.out.contains("1 passed"), "{said:?}\n{calls:#?}");
    assert_eq!(record.objections(), [""; 0]);
    calls
}

fn started() -> Client {
    let mut client = Client::new(instance().unwrap()).unwrap();
    client.until(SessionState::READY).unwrap();
    client
}

/// `count` frames that go well.
fn frames(client: &mut Client, count: u32) {
    for _ in 0..count {
        client.frame().unwrap();
        client.poll().unwrap();
    }
}

/// Asks to end and does as it is told.
fn ended(mut client: Client) {
    client.session.request_exit().unwrap();
    for _ in 0..100 {
        let told = client.poll().unwrap();
        if told.contains(&"EXITING".to_owned()) {
            return;
        }
        if told.contains(&"STOPPING".to_owned()) {
            return client.until(SessionState::EXITING).unwrap();
        }
        client.frame().unwrap();
    }
    panic!("never STOPPING");
}

#[test]
fn without_faults_a_session_runs_and_ends() {
    let calls = met("without_faults", "");
    assert_eq!(calls.count("fault"), 0, "{calls:#?}");
    assert!(!calls.0.iter().any(|line| line.contains("->")), "{calls:#?}");
    assert_eq!(calls.count("create_swapchain 64x64 layers=2 samples=1 format=43 "), 1, "{calls:#?}");
    calls.come_in_order(&[
        "create_instance 1",
        "get_system 1",
        "create_session 1",
        "state READY",
        "begin_session",
        "wait_frame 1 render=no",
        "begin_frame",
        "end_frame 1 layers=0 views=0 depth=no time=",
        "state FOCUSED",
        "wait_frame 2 render=yes",
        "begin_frame",
        "locate_views",
        "acquire_image 1",
        "wait_image 1",
        "release_image",
        "end_frame 2 layers=1 views=2 depth=no time=",
        "request_exit",
        "state STOPPING",
        "end_session",
        "state EXITING",
        "destroy_session",
        "destroy_instance",
    ]);
}

#[test]
#[ignore = "run by the test above"]
fn without_faults() {
    let mut client = started();
    frames(&mut client, 5);
    ended(client);
}

#[test]
fn a_session_is_lost_until_destroyed() {
    let calls = met("session_lost", "session_lost@3");
    assert_eq!(calls.count("fault session_lost 3"), 1, "{calls:#?}");
    calls.come_in_order(&["fault session_lost 3", "end_frame 3", "wait_frame 4 -> ERROR_SESSION_LOST"]);
    assert_eq!((calls.count("create_instance"), calls.count("create_session 2")), (1, 1), "{calls:#?}");
}

#[test]
#[ignore = "run by the test above"]
fn session_lost() {
    let mut client = started();
    frames(&mut client, 2);
    assert_eq!(client.frame().unwrap_err(), Xr::ERROR_SESSION_LOST);
    assert_eq!(client.frame().unwrap_err(), Xr::ERROR_SESSION_LOST);
    assert_eq!(client.session.end().unwrap_err(), Xr::ERROR_SESSION_LOST);
    let instance = client.instance.clone();
    drop(client);
    let mut client = Client::new(instance).unwrap();
    client.until(SessionState::READY).unwrap();
    frames(&mut client, 3);
    ended(client);
}

#[test]
fn a_loss_is_announced_before_it_comes() {
    let calls = met("loss_pending", "loss_pending@2");
    calls.come_in_order(&["end_frame 2", "state LOSS_PENDING", "wait_frame 3 -> ERROR_SESSION_LOST"]);
    assert_eq!(calls.count("create_session"), 2, "{calls:#?}");
}

#[test]
#[ignore = "run by the test above"]
fn loss_pending() {
    let mut client = started();
    frames(&mut client, 1);
    client.frame().unwrap();
    assert_eq!(client.poll().unwrap()[0], "LOSS_PENDING");
    assert_eq!(client.frame().unwrap_err(), Xr::ERROR_SESSION_LOST);
    let instance = client.instance.clone();
    drop(client);
    ended({
        let mut client = Client::new(instance).unwrap();
        client.until(SessionState::READY).unwrap();
        client
    });
}

#[test]
fn an_instance_is_lost_until_destroyed_and_once_in_a_process() {
    let calls = met("instance_lost", "instance_lost@2,instance_loss_pending@4");
    assert_eq!(calls.count("fault"), 2, "{calls:#?}");
    assert_eq!((calls.count("create_instance"), calls.count("destroy_instance")), (3, 3), "{calls:#?}");
}

#[test]
#[ignore = "run by the test above"]
fn instance_lost() {
    let mut client = started();
    frames(&mut client, 1);
    assert_eq!(client.frame().unwrap_err(), Xr::ERROR_INSTANCE_LOST);
    assert_eq!(client.poll().unwrap_err(), Xr::ERROR_INSTANCE_LOST);
    assert_eq!(client.frame().unwrap_err(), Xr::ERROR_INSTANCE_LOST);
    drop(client);
    let mut client = started();
    frames(&mut client, 2); // the second and third that end
    client.frame().unwrap();
    assert_eq!(client.poll().unwrap()[0], "instance loss pending");
    assert_eq!(client.frame().unwrap_err(), Xr::ERROR_INSTANCE_LOST);
    drop(client);
    let mut client = started();
    frames(&mut client, 3);
    ended(client);
}

#[test]
fn calls_of_a_frame_fail_and_the_next_go_well() {
    let calls = met(
        "failing_calls",
        "wait_fails@3,end_fails@4,acquire_fails@4,wait_image_timeout@5..7,should_render_false@9..11",
    );
    assert_eq!(calls.count("fault"), 7, "{calls:#?}");
    assert_eq!(calls.failed("FRAME_DISCARDED"), 2, "{calls:#?}");
    assert_eq!(calls.failed("TIMEOUT_EXPIRED"), 2, "{calls:#?}");
}

#[test]
#[ignore = "run by the test above"]
fn failing_calls() {
    let mut client = started();
    frames(&mut client, 2);
    assert_eq!(client.frame().unwrap_err(), Xr::ERROR_RUNTIME_FAILURE, "wait 3");
    frames(&mut client, 1); // wait 4, end 3
    assert_eq!(client.frame().unwrap_err(), Xr::ERROR_RUNTIME_FAILURE, "wait 5, end 4");
    // The frame that did not end is discarded, and this one, which acquires the fourth image, will be too.
    assert_eq!(client.frame().unwrap_err(), Xr::ERROR_RUNTIME_FAILURE, "wait 6, acquire 4");
    assert_eq!(client.frame().unwrap().0, Frame::Shown, "wait 7");
    assert_eq!(client.frame().unwrap().0, Frame::Late, "wait 8");
    assert_eq!(client.frame().unwrap().0, Frame::Empty, "wait 9");
    assert_eq!(client.frame().unwrap().0, Frame::Empty, "wait 10");
    assert_eq!(client.frame().unwrap().0, Frame::Shown, "wait 11");
    ended(client);
}

#[test]
fn events_that_nobody_sent_arrive_once() {
    let calls = met("events", "mask_changed@2,recentre@3,profile_changed@4");
    assert_eq!(calls.count("event VISIBILITY_MASK_CHANGED_KHR"), 2);
    assert_eq!(calls.count("event REFERENCE_SPACE_CHANGE_PENDING"), 1);
    assert_eq!(calls.count("event INTERACTION_PROFILE_CHANGED"), 1);
}

#[test]
#[ignore = "run by the test above"]
fn events() {
    let mut client = started();
    frames(&mut client, 1);
    client.frame().unwrap();
    assert_eq!(client.poll().unwrap()[..2], ["mask 0", "mask 1"]);
    client.frame().unwrap();
    assert_eq!(client.poll().unwrap(), ["recentre 1"]);
    client.frame().unwrap();
    assert_eq!(client.poll().unwrap(), ["profile"]);
    client.frame().unwrap();
    assert_eq!(client.poll().unwrap(), [""; 0]);
    ended(client);
}

#[test]
fn a_headset_is_missing_and_a_session_refused() {
    let calls = met("missing", "no_system@2,create_session_fails");
    assert_eq!((calls.count("get_system"), calls.count("create_session")), (4, 2));
}

#[test]
#[ignore = "run by the test above"]
fn missing() {
    let instance = instance().unwrap();
    let error = || Client::new(instance.clone()).err();
    assert_eq!(error(), Some(Xr::ERROR_FORM_FACTOR_UNAVAILABLE));
    assert_eq!(error(), Some(Xr::ERROR_FORM_FACTOR_UNAVAILABLE));
    assert_eq!(error(), Some(Xr::ERROR_RUNTIME_FAILURE));
    assert_eq!(error(), None);
}

#[test]
fn a_fault_of_no_known_name_ends_the_program() {
    for faults in ["sesion_lost@2", "session_lost@0", "session_lost@5..5", "session_lost@x"] {
        let service = Service::start(Settings::default());
        let mut client = service.reexec("without_faults");
        faults::between(&service, &mut client, faults);
        let said = run(&mut client);
        assert!(said.status != Some(0) && said.err.contains(faults), "{said:?}");
    }
}

#[test]
fn an_extension_is_hidden_and_cannot_be_had() {
    let service = Service::start(Settings::default());
    let mut client = service.reexec("hidden_extension");
    faults::hidden(&service, &mut client, &["XR_KHR_composition_layer_depth", "XR_MND_headless"]);
    let said = run(&mut client);
    assert!(said.status == Some(0) && said.out.contains("1 passed"), "{said:?}");
}

#[test]
#[ignore = "run by the test above"]
fn hidden_extension() {
    let mut known = extensions();
    assert!(!known.khr_composition_layer_depth && !known.mnd_headless, "{known:?}");
    assert!(known.khr_vulkan_enable2 && known.ext_hand_tracking, "{known:?}");
    known.khr_composition_layer_depth = true;
    assert_eq!(instance_with(&known).err(), Some(Xr::ERROR_EXTENSION_NOT_PRESENT));
    let mut client = started();
    frames(&mut client, 2);
    ended(client);
}
