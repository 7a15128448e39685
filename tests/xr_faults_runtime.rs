//! A runtime or a headset that goes, comes back, or was never there: one clear line and status 1, or, with `--xr-wait`,
//! the sea goes on where it was. `docs/faults.md` lists what is said.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use nix::sys::signal::Signal;
use serde_json::Value;
use std::time::{Duration, Instant};
use support::faults;
use support::live::{Live, ended, files, goes_on, own, shown, swell_xr};
use support::monado::{Service, Settings};
use support::picture::Picture;

const GONE: &str = "the OpenXR runtime has gone (while ";

#[test]
fn a_killed_runtime_ends_the_run() {
    let mut service = Service::start(Settings::default());
    let screenshot = service.folder().join("last.png");
    let command = swell_xr(&service, &["--screenshot", screenshot.to_str().unwrap()]);
    let mut live = Live::start(&service, "swell", command);
    live.until_shown(8);
    service.kill();
    let killed = Instant::now();
    let (said, frames) = live.end();
    // Promised to people, and long enough for a busy machine.
    assert!(killed.elapsed() < Duration::from_secs(5), "{:?}", killed.elapsed());
    assert_eq!(said.status, Some(1), "{said:?}");
    let lines = own(&said.err);
    assert_eq!(lines.len(), 1, "{said:?}");
    assert!(lines[0].starts_with(&format!("swell: {GONE}")), "{said:?}");
    assert!(lines[0].ends_with("); start it again, or wait for it with --xr-wait"), "{said:?}");
    assert!(shown(&frames) >= 8);
    // The last frame was copied before, so it is there, and whole.
    assert!(Picture::load(&screenshot).colours() > 100);
    assert!(files(service.folder(), ".part").is_empty());
}

#[test]
fn a_killed_runtime_that_returns_goes_on() {
    let mut service = Service::start(Settings::default());
    let mut live = Live::start(&service, "swell", swell_xr(&service, &["--xr-wait", "--frames", "40"]));
    live.until_shown(24);
    service.kill();
    live.until_said("no OpenXR runtime answers (");
    let before = live.frames();
    service.restart();
    let (said, frames) = live.end();
    assert_eq!(said.status, Some(0), "{said:?}");
    assert!((24..40).contains(&shown(&before)) && shown(&frames) == 40, "{said:?}");
    goes_on(&frames);
    // The first frame anew is the one after the last that was shown, though the runtime's clock begins anew.
    let time = |frame: &Value| frame["time"].as_f64().unwrap();
    let last = before.iter().rfind(|frame| frame["shown"] == true).unwrap();
    let pause = time(&frames[before.len()]) - time(last);
    assert!(pause > 0.0 && pause < 0.5, "{pause} s of the sea");
    let lines = own(&said.err);
    assert!(lines[0].starts_with(GONE) && lines[0].ends_with("); waiting"), "{said:?}");
    assert!(
        lines[1].starts_with("no OpenXR runtime answers (") && lines[1].ends_with("; waiting"),
        "{said:?}"
    );
    assert!(
        lines[2].starts_with("40 frames shown, ") && lines[2].ends_with("; 1 sessions begun anew"),
        "{said:?}"
    );
    assert_eq!(lines.len(), 3, "{said:?}");
}

#[test]
fn a_runtime_that_comes_late_is_waited_for() {
    let mut service = Service::start(Settings::default());
    service.kill();
    let mut live = Live::start(&service, "swell", swell_xr(&service, &["--xr-wait", "--frames", "5"]));
    live.until_said("; waiting");
    service.restart();
    let (said, frames) = live.end();
    assert_eq!((said.status, shown(&frames)), (Some(0), 5), "{said:?}");
    let lines = own(&said.err);
    assert!(
        lines[0].starts_with("no OpenXR runtime answers (") && lines[0].ends_with("); waiting"),
        "{said:?}"
    );
    assert!(
        lines[1].starts_with("5 frames shown, ") && lines[1].ends_with("; 0 sessions begun anew"),
        "{said:?}"
    );
    assert_eq!(lines.len(), 2, "{said:?}");
}

#[test]
fn who_waits_can_stop_waiting() {
    let mut service = Service::start(Settings::default());
    service.kill();
    let mut live = Live::start(&service, "swell", swell_xr(&service, &["--xr-wait"]));
    live.until_said("; waiting");
    live.signal(Signal::SIGINT);
    let (said, frames) = live.end();
    assert_eq!((said.status, frames.len()), (Some(0), 0), "{said:?}");
    assert!(own(&said.err)[1].starts_with("0 frames shown, "), "{said:?}");
}

#[test]
fn who_waits_again_can_stop_waiting() {
    let mut service = Service::start(Settings::default());
    let mut live = Live::start(&service, "swell", swell_xr(&service, &["--xr-wait"]));
    live.until_shown(3);
    service.kill();
    live.until_said("; waiting");
    live.signal(Signal::SIGTERM);
    let (said, frames) = live.end();
    assert!(said.status == Some(0) && shown(&frames) >= 3, "{said:?}");
}

#[test]
fn without_a_runtime_nothing_is_shown() {
    let mut service = Service::start(Settings::default());
    service.kill();
    let (said, frames) = ended(&service, swell_xr(&service, &[]));
    assert_eq!((said.status, frames.len()), (Some(1), 0), "{said:?}");
    let lines = own(&said.err);
    assert!(lines.len() == 1 && lines[0].starts_with("swell: no OpenXR runtime answers ("), "{said:?}");
    assert!(
        lines[0].ends_with("); start one (Monado: monado-service), or wait for it with --xr-wait"),
        "{said:?}"
    );
}

#[test]
fn a_lost_instance_ends_the_run() {
    for (fault, doing) in
        [("instance_lost@6", "waiting for a frame"), ("instance_loss_pending@6", "listening for events")]
    {
        let service = Service::start(Settings::default());
        let mut command = swell_xr(&service, &[]);
        let record = faults::between(&service, &mut command, fault);
        let (said, _) = ended(&service, command);
        assert_eq!(said.status, Some(1), "{fault}: {said:?}");
        let line = format!("swell: {GONE}{doing}); start it again, or wait for it with --xr-wait");
        assert_eq!(own(&said.err), [line], "{fault}");
        assert_eq!(record.objections(), [""; 0], "{fault}");
        // In order, though nobody listens any more.
        record.calls().come_in_order(&["fault", "destroy_swapchain", "destroy_session", "destroy_instance"]);
    }
}

#[test]
fn a_lost_instance_is_begun_anew_where_it_is_waited_for() {
    let service = Service::start(Settings::default());
    let mut command = swell_xr(&service, &["--xr-wait", "--frames", "20"]);
    let record = faults::between(&service, &mut command, "instance_lost@6,instance_loss_pending@14");
    let (said, frames) = ended(&service, command);
    assert_eq!((said.status, shown(&frames)), (Some(0), 20), "{said:?}");
    goes_on(&frames);
    let lines = own(&said.err);
    assert_eq!(
        lines[..2],
        ["waiting for a frame", "listening for events"].map(|doing| format!("{GONE}{doing}); waiting"))
    );
    assert!(lines.len() == 3 && lines[2].ends_with("; 2 sessions begun anew"), "{said:?}");
    let calls = record.calls();
    assert_eq!((calls.count("create_instance"), calls.count("destroy_instance")), (3, 3), "{calls:?}");
    assert_eq!(record.objections(), [""; 0]);
}

#[test]
fn a_failure_of_the_runtime_is_waited_for_too() {
    let service = Service::start(Settings::default());
    let mut command = swell_xr(&service, &["--xr-wait", "--frames", "12"]);
    let record = faults::between(&service, &mut command, "create_session_fails,wait_fails@6");
    let (said, frames) = ended(&service, command);
    assert_eq!((said.status, shown(&frames)), (Some(0), 12), "{said:?}");
    goes_on(&frames);
    let lines = own(&said.err);
    let waiting = |doing: &str| format!("{doing}: OpenXR says ERROR_RUNTIME_FAILURE; waiting");
    assert_eq!(lines[..2], [waiting("creating the session"), waiting("waiting for a frame")]);
    assert!(lines.len() == 3 && lines[2].ends_with("; 1 sessions begun anew"), "{said:?}");
    assert_eq!(record.objections(), [""; 0]);
}

#[test]
fn a_headset_that_is_not_there() {
    let service = Service::start(Settings::default());
    let mut command = swell_xr(&service, &[]);
    let record = faults::between(&service, &mut command, "no_system@1");
    let (said, frames) = ended(&service, command);
    assert_eq!((said.status, frames.len()), (Some(1), 0), "{said:?}");
    let lines = own(&said.err);
    assert!(lines.len() == 1 && lines[0].starts_with("swell: the OpenXR runtime Monado"), "{said:?}");
    let end = " has no headset ready; connect it, or wait for it with --xr-wait";
    assert!(lines[0].ends_with(end), "{said:?}");
    assert_eq!(record.calls().count("create_session"), 0);
}

#[test]
fn a_headset_that_comes_late_is_waited_for() {
    let service = Service::start(Settings::default());
    let mut command = swell_xr(&service, &["--xr-wait", "--frames", "5"]);
    let record = faults::between(&service, &mut command, "no_system@3");
    let (said, frames) = ended(&service, command);
    assert_eq!((said.status, shown(&frames)), (Some(0), 5), "{said:?}");
    let lines = own(&said.err);
    // Said once, not three times.
    assert!(lines.len() == 2 && lines[0].ends_with(" has no headset ready; waiting"), "{said:?}");
    let calls = record.calls();
    assert_eq!((calls.count("fault no_system"), calls.count("create_session")), (3, 1), "{calls:?}");
    assert_eq!(record.objections(), [""; 0]);
}
