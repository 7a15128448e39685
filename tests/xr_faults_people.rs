//! What people do to a session: Ctrl-C, the end of a service, another program that takes the focus, a last picture.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use nix::sys::signal::Signal;
use support::faults;
use support::live::{Live, ended, files, goes_on, own, shown, swell_xr};
use support::monado::{Service, Settings};
use support::picture::Picture;

#[test]
fn a_signal_ends_the_session_in_order() {
    for signal in [Signal::SIGINT, Signal::SIGTERM] {
        let service = Service::start(Settings::default());
        let screenshot = service.folder().join("last.png");
        let mut command = swell_xr(&service, &["--screenshot", screenshot.to_str().unwrap()]);
        let record = faults::between(&service, &mut command, "");
        let mut live = Live::start(&service, "swell", command);
        live.until_shown(5);
        live.signal(signal);
        let (said, frames) = live.end();
        assert!(said.status == Some(0) && shown(&frames) >= 5, "{signal}: {said:?}");
        assert!(own(&said.err).len() == 1, "{signal}: {said:?}");
        record.calls().come_in_order(&[
            "end_frame 5",
            "request_exit",
            "state VISIBLE",
            "state SYNCHRONIZED",
            "state STOPPING",
            "end_session",
            "state IDLE",
            "state EXITING",
            "destroy_swapchain",
            "destroy_session",
            "destroy_instance",
        ]);
        assert_eq!(record.objections(), [""; 0]);
        assert!(Picture::load(&screenshot).colours() > 100);
    }
}

#[test]
fn a_second_ctrl_c_ends_at_once() {
    let service = Service::start(Settings::default());
    let screenshot = service.folder().join("last.png");
    let mut command = swell_xr(&service, &["--screenshot", screenshot.to_str().unwrap()]);
    let record = faults::between(&service, &mut command, "");
    let mut live = Live::start(&service, "swell", command);
    live.until_shown(5);
    // Nothing ends in order while the runtime does not answer; and signals that come at once are one.
    service.signal(Signal::SIGSTOP);
    live.signal_until_ended(Signal::SIGINT);
    let ended = live.end();
    service.signal(Signal::SIGCONT);
    let (said, frames) = ended;
    assert!(said.status == Some(130) && shown(&frames) >= 5, "{said:?}");
    assert!(own(&said.err).is_empty(), "{said:?}");
    assert_eq!(record.calls().count("end_session"), 0);
    assert!(!screenshot.exists() && files(service.folder(), ".part").is_empty());
}

#[test]
fn the_focus_goes_to_another_and_comes_back() {
    let service = Service::start(Settings::default());
    let mut command = swell_xr(&service, &[]);
    let record = faults::between(&service, &mut command, "");
    let mut first = Live::start(&service, "first", command);
    first.until_frames("the focus", |frames| frames.last().is_some_and(|frame| frame["state"] == "FOCUSED"));
    let mut second = Live::start(&service, "second", swell_xr(&service, &[]));
    second.until_shown(5);
    first.until_frames("three frames without the focus", |frames| {
        let unseen = |frame: &&serde_json::Value| frame["state"] == "SYNCHRONIZED" && frame["shown"] == false;
        frames.iter().rev().take(3).filter(unseen).count() == 3
    });
    second.signal(Signal::SIGINT);
    let (said, _) = second.end();
    assert_eq!(said.status, Some(0), "{said:?}");
    let so_far = shown(&first.frames());
    first.until_shown(so_far + 5);
    first.signal(Signal::SIGINT);
    let (said, frames) = first.end();
    assert_eq!(said.status, Some(0), "{said:?}");
    assert_eq!(frames.last().unwrap()["state"], "FOCUSED");
    goes_on(&frames.iter().filter(|frame| frame["shown"] == true).cloned().collect::<Vec<_>>());
    assert_eq!(record.objections(), [""; 0]);
    // From the loss of the focus to its return no image is touched, and the sea is not looked at.
    let calls = record.calls().0;
    let focused = calls.iter().position(|line| line == "state FOCUSED").unwrap();
    let lost = focused + calls[focused..].iter().position(|line| line == "state SYNCHRONIZED").unwrap();
    let back = lost + calls[lost..].iter().position(|line| line == "state VISIBLE").unwrap();
    let meanwhile = &calls[lost..back];
    let frames = meanwhile.iter().filter(|line| line.starts_with("end_frame ")).count();
    assert!(frames >= 3, "{meanwhile:#?}");
    for line in meanwhile.iter().skip_while(|line| !line.starts_with("wait_frame ")) {
        assert!(
            !line.starts_with("acquire_image") && !line.contains(" layers=1 "),
            "{line} without anybody to see it: {meanwhile:#?}"
        );
    }
}

#[test]
fn the_last_frame_is_kept() {
    let service = Service::start(Settings::default());
    let screenshot = service.folder().join("last.png");
    let (said, frames) = ended(
        &service,
        swell_xr(&service, &["--frames", "40", "--screenshot", screenshot.to_str().unwrap()]),
    );
    assert_eq!((said.status, shown(&frames)), (Some(0), 40), "{said:?}");
    let both = Picture::load(&screenshot);
    // 0.2 of 320x240, twice.
    assert_eq!(both.size, [128, 48]);
    let eyes = [both.part(0, 2), both.part(1, 2)];
    assert!(eyes[0].difference(&eyes[1]).mean > 0.002, "the eyes see the same");
    for eye in eyes {
        assert!(eye.colours() > 200, "{} colours", eye.colours());
        // Sky above and sea below: the horizon is where the middle of the picture darkens.
        let brightness = |y: u32| -> u32 {
            (20..44).map(|x| eye.pixel(x, y).into_iter().map(u32::from).sum::<u32>()).sum::<u32>() / 24
        };
        let rows: Vec<u32> = (6..42).map(brightness).collect();
        let (sky, sea) = (rows[4], rows[31]);
        assert!(sky > sea + 100, "{rows:?}");
    }
}
