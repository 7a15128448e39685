//! Whatever ends a run, nothing is destroyed while the device uses it, and nothing is left behind.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use support::stage::{Stage, shipped};
use swell::draw::Look;
use swell::host::{Headless, HostError};

fn stage() -> Stage {
    Stage::new(&shipped("calm"), [640, 360], 1, Look::Water, 0.0)
}

fn give_up(host: &mut Headless) {
    let ended = host.run([0.0, 1.0, 2.0], |_| Err(HostError::WriterGone));
    assert!(matches!(ended, Err(HostError::WriterGone)));
}

#[test]
fn a_run_that_is_given_up_ends_before_its_resources_do() {
    let mut stage = stage();
    // The first frame is refused while the second is being drawn.
    give_up(&mut stage.host);
    assert_eq!(stage.host.close(), Vec::<String>::new());
}

#[test]
fn a_run_that_was_given_up_leaves_no_trace_in_the_next() {
    let mut fresh = stage();
    let wanted = fresh.frame(5.0, &[]);
    assert_eq!(fresh.host.close(), Vec::<String>::new());
    let mut used = stage();
    give_up(&mut used.host);
    assert!(used.frame(5.0, &[]) == wanted, "another picture than a fresh host's");
    assert!(used.frame(7.0, &[]) != wanted, "the sea stands still");
}
