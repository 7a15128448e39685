//! What the tests of headsets stand on: a runtime for each test, which can be killed, told what to do, and validated.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic")]
#[path = "fault_layer/client/mod.rs"]
mod client;
mod support;

use client::{Client, instance};
use openxr as xr;
use std::process::Stdio;
use std::time::Duration;
use support::faults;
use support::monado::{Compositor, Devices, Service, Settings};
use support::program::run;
use support::remote::{Body, Pose, Remote};
use support::xvfb::Xvfb;

#[test]
fn services_run_side_by_side_and_come_back_after_being_killed() {
    let mut one = Service::start(Settings::default());
    let mut other = Service::start(Settings::default());
    assert_ne!(one.folder(), other.folder());
    one.kill();
    one.restart();
    other.stop();
    other.restart();
    for service in [one, other] {
        let starts = service.log().matches("The Monado service has started").count();
        assert_eq!(starts, 2, "{}", service.log());
    }
}

#[test]
fn a_killed_service_is_a_lost_instance() {
    let mut service = Service::start(Settings::default());
    let mut command = service.reexec("shows_frames_until_the_instance_is_lost");
    let record = faults::between(&service, &mut command, "");
    let mut client = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    while record.calls().count("end_frame 5") == 0 {
        assert!(client.try_wait().unwrap().is_none(), "{:#?}", record.calls());
        std::thread::sleep(Duration::from_millis(10));
    }
    service.kill();
    assert!(client.wait().unwrap().success(), "{:#?}", record.calls());
}

#[test]
#[ignore = "run by the test above"]
fn shows_frames_until_the_instance_is_lost() {
    let mut client = Client::new(instance().unwrap()).unwrap();
    client.until(xr::SessionState::READY).unwrap();
    let error = loop {
        if let Err(error) = client.frame().map(|_| ()).and_then(|()| client.poll().map(|_| ())) {
            break error;
        }
    };
    assert_eq!(error, xr::sys::Result::ERROR_INSTANCE_LOST);
}

/// Where the remote head is in the next test.
const HEAD: [f32; 3] = [0.5, 1.7, -0.25];
const YAW: f32 = 0.6;

#[test]
fn a_remote_head_is_where_it_is_told_to_be() {
    let service = Service::start(Settings { devices: Devices::Remote, ..Settings::default() });
    let head = Pose::at(HEAD[0], HEAD[1], HEAD[2]).turned(YAW);
    let _remote = Remote::start(&service, move |_| Body { head, ..Body::standing() });
    let said = run(&mut service.reexec("sees_the_remote_head"));
    assert!(said.status == Some(0) && said.out.contains("1 passed"), "{said:?}");
}

#[test]
#[ignore = "run by the test above"]
fn sees_the_remote_head() {
    let mut client = Client::new(instance().unwrap()).unwrap();
    client.until(xr::SessionState::READY).unwrap();
    let mut seen = Vec::new();
    for _ in 0..20 {
        let (_, time) = client.frame().unwrap();
        client.poll().unwrap();
        let pose = client.head(time).unwrap();
        let (place, turn) = (pose.position, pose.orientation);
        let wrong = (place.x - HEAD[0]).abs() + (place.y - HEAD[1]).abs() + (place.z - HEAD[2]).abs();
        if wrong < 1e-3
            && (turn.y - (YAW / 2.0).sin()).abs() < 1e-3
            && (turn.w - (YAW / 2.0).cos()).abs() < 1e-3
        {
            return;
        }
        seen.push(pose);
    }
    panic!("{seen:#?}");
}

#[test]
fn core_validation_hears_what_is_wrong_above_the_faults() {
    let service = Service::start(Settings::default());
    let mut command = service.reexec("ends_a_frame_wrongly");
    let record = faults::between(&service, &mut command, "");
    let said = run(&mut command);
    assert!(said.status == Some(0) && said.out.contains("1 passed"), "{said:?}");
    let objections = record.objections();
    assert!(objections.iter().any(|line| line.contains("VUID-XrFrameEndInfo-type-type")), "{objections:#?}");
    assert_eq!(record.calls().count("end_frame"), 0, "{:#?}", record.calls());
}

#[test]
#[ignore = "run by the test above"]
fn ends_a_frame_wrongly() {
    let mut client = Client::new(instance().unwrap()).unwrap();
    client.until(xr::SessionState::READY).unwrap();
    assert_eq!(client.end_wrongly(), xr::sys::Result::ERROR_VALIDATION_FAILURE);
}

#[test]
fn a_window_shows_what_either_eye_sees() {
    let screen = Xvfb::start([1024, 600]);
    let display = screen.display().to_owned();
    let compositor = Compositor::Window { display };
    let service = Service::start(Settings { compositor, hertz: Some(60), ..Settings::default() });
    let mut command = service.reexec("shows_frames_until_the_instance_is_lost");
    let mut client = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let window = screen.window("Monado");
    let (_, [width, height]) = window.frame();
    screen.screenshot_when(|_| {
        let shown = window.picture();
        let [left, right] = [1, 3].map(|quarter| shown.pixel(width * quarter / 4, height / 2));
        left == [255, 0, 0] && right == [0, 255, 0]
    });
    drop(service);
    assert!(client.wait().unwrap().success());
}
