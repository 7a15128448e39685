//! The runtime that the tests of headsets stand on: it starts, ends and is alone.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use support::monado::{Service, Settings};

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
