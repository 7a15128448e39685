//! Sessions that are lost and frames that go wrong, injected by the layer of `tests/fault_layer`: each is survived, or
//! ends the run with one clear line and status 1. Validation listens in both APIs, and above the faults core validation
//! of its own. `docs/faults.md` lists what is said.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use serde_json::Value;
use support::faults::{self, Calls};
use support::live::{ended, goes_on, own, shown, swell_xr};
use support::monado::{Service, Settings};
use support::program::Said;

/// A run of `frames` frames met by `faults`.
struct Met {
    said: Said,
    frames: Vec<Value>,
    calls: Calls,
}

fn met(frames: &str, faults: &str) -> Met {
    let service = Service::start(Settings::default());
    let mut command = swell_xr(&service, &["--frames", frames]);
    let record = faults::between(&service, &mut command, faults);
    let (said, frames) = ended(&service, command);
    let calls = record.calls();
    assert_eq!(record.objections(), [""; 0], "{said:?}");
    // Whatever happened, everything is given back.
    for (made, gone) in [
        ("create_instance", "destroy_instance"),
        ("create_session", "destroy_session"),
        ("create_swapchain", "destroy_swapchain"),
    ] {
        let made = calls.0.iter().filter(|line| line.starts_with(made) && !line.contains("->")).count();
        assert_eq!(made, calls.count(gone), "{gone}: {calls:#?}");
    }
    Met { said, frames, calls }
}

impl Met {
    /// All `count` frames were shown, in sessions of which `anew` were begun anew; returns how many were left empty.
    fn survived(&self, count: usize, anew: u32) -> u64 {
        assert_eq!((self.said.status, shown(&self.frames)), (Some(0), count), "{:?}", self.said);
        goes_on(&self.frames);
        let lines = own(&self.said.err);
        let lost = lines.iter().filter(|line| **line == "the session was lost; beginning another").count();
        assert!(lost == anew as usize && lines.len() == lost + 1, "{lines:#?}");
        let report = lines[lost];
        assert!(report.starts_with(&format!("{count} frames shown, ")), "{report}");
        assert!(report.ends_with(&format!("; {anew} sessions begun anew")), "{report}");
        let empty = report.split(", ").nth(1).unwrap().split(' ').next().unwrap();
        self.ended_in_order();
        empty.parse().unwrap()
    }

    fn ended_in_order(&self) {
        self.calls.come_in_order(&[
            "request_exit",
            "state STOPPING",
            "end_session",
            "state EXITING",
            "destroy_session",
            "destroy_instance",
        ]);
    }

    /// It ended with `line` and nothing else.
    fn failed(&self, line: &str) {
        assert_eq!(self.said.status, Some(1), "{:?}", self.said);
        assert_eq!(own(&self.said.err), [format!("swell: {line}")]);
    }
}

#[test]
fn a_lost_session_is_begun_anew() {
    let met = met("20", "session_lost@8");
    met.survived(20, 1);
    met.calls.come_in_order(&[
        "create_session 1",
        "end_frame 7",
        "fault session_lost 8",
        "destroy_swapchain",
        "destroy_session",
        "create_session 2",
        "begin_session",
    ]);
    assert_eq!(met.calls.count("create_instance"), 1);
}

#[test]
fn a_session_whose_loss_is_announced_is_begun_anew() {
    let met = met("20", "loss_pending@8");
    met.survived(20, 1);
    met.calls.come_in_order(&["end_frame 8", "state LOSS_PENDING", "destroy_session", "create_session 2"]);
    // What is announced is believed: nothing was tried on the session that is going.
    assert_eq!(met.calls.failed("ERROR_SESSION_LOST"), 0, "{:#?}", met.calls);
}

#[test]
fn sessions_lost_again_and_again_end_the_run() {
    let met = met("20", "session_lost@1..100");
    let lines = own(&met.said.err);
    let (end, before) = lines.split_last().unwrap();
    assert_eq!(*end, "swell: the OpenXR session was lost 6 times without a frame in between; giving up");
    assert_eq!(before, ["the session was lost; beginning another"; 5]);
    assert_eq!((met.said.status, shown(&met.frames)), (Some(1), 0), "{:?}", met.said);
    assert_eq!(met.calls.count("create_session"), 6);
}

#[test]
fn a_session_lost_while_it_ends_is_not_begun_anew() {
    let met = met("10", "lost_at_exit");
    assert_eq!((met.said.status, shown(&met.frames)), (Some(0), 10), "{:?}", met.said);
    met.calls.come_in_order(&["request_exit", "fault lost_at_exit 1", "destroy_session", "destroy_instance"]);
    assert_eq!(met.calls.count("create_session"), 1, "{:#?}", met.calls);
}

#[test]
fn frames_that_nobody_would_see_are_left_empty() {
    let met = met("14", "should_render_false@6..11");
    assert!(met.survived(14, 0) >= 5);
    let calls = &met.calls.0;
    for frame in 6..11 {
        let at = calls.iter().position(|line| line.starts_with(&format!("wait_frame {frame} "))).unwrap();
        let rest = &calls[at..];
        let next = 1 + rest[1..].iter().position(|line| line.starts_with("wait_frame ")).unwrap();
        let frame: Vec<&String> = rest[..next].iter().filter(|line| !line.starts_with("fault ")).collect();
        assert!(frame.len() == 3 && frame[1] == "begin_frame", "{frame:?}");
        assert!(frame[2].contains(" layers=0 "), "{frame:?}");
    }
}

#[test]
fn an_image_that_does_not_come_is_waited_for_frame_after_frame() {
    // Images 3 of both swapchains are waited for with calls 5 and 6.
    for calls in ["5..8", "6..9"] {
        let met = met("12", &format!("wait_image_timeout@{calls}"));
        // The same image comes: nothing more is acquired for the three frames that were left empty.
        let empty = met.survived(12, 0);
        let timeouts = met.calls.failed("TIMEOUT_EXPIRED");
        assert_eq!(timeouts, 3);
        assert!(empty >= 4, "{empty}");
        let (acquired, released) = (met.calls.count("acquire_image"), met.calls.count("release_image"));
        assert_eq!((acquired, released), (24, 24), "{:#?}", met.calls);
        let layers = met.calls.0.iter().filter(|line| line.contains(" layers=1 ")).count();
        assert_eq!(layers, 12, "{:#?}", met.calls);
    }
}

#[test]
fn a_failing_call_ends_the_run() {
    for (fault, doing) in [
        ("wait_fails@6", "waiting for a frame"),
        ("acquire_fails@6", "acquiring an image"),
        ("end_fails@6", "ending a frame"),
        ("create_session_fails", "creating the session"),
    ] {
        let met = met("20", fault);
        assert_eq!(met.calls.count("fault"), 1, "{fault}");
        met.failed(&format!("{doing}: OpenXR says ERROR_RUNTIME_FAILURE"));
    }
}

#[test]
fn masks_origins_and_controllers_may_change() {
    let met = met("14", "mask_changed@4,recentre@6,profile_changed@8");
    met.survived(14, 0);
    assert_eq!(met.calls.count("fault"), 3);
    // Both are asked for again, not only told of.
    met.calls.come_in_order(&[
        "fault mask_changed 4",
        "event VISIBILITY_MASK_CHANGED_KHR",
        "get_visibility_mask 0",
        "get_visibility_mask 1",
        "end_frame 5",
    ]);
    met.calls.come_in_order(&["fault profile_changed 8", "event INTERACTION_PROFILE_CHANGED"]);
    // Each time, by Monado too, both hands are looked at.
    let told = met.said.err.lines().filter(|line| line.starts_with("left hand: ")).count();
    assert_eq!(told, met.calls.count("event INTERACTION_PROFILE_CHANGED"), "{:?}", met.said);
}
