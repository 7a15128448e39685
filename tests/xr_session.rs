//! Sessions on Monado: from IDLE to EXITING, each eye's picture what a mono camera there sees, everybody silent.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use support::headset::Watcher;
use support::monado::{Service, Settings};
use support::program::run;
use support::stage::shipped;

#[test]
fn a_session_of_forty_frames() {
    let service = Service::start(Settings::default());
    let said = run(&mut service.reexec("forty_frames"));
    assert!(said.status == Some(0) && said.out.contains("1 passed"), "{said:?}");
    // Said once, not once a frame.
    for line in ["headset: ", "extensions found: ", "extensions missing: ", "in use: "] {
        assert_eq!(said.err.lines().filter(|said| said.starts_with(line)).count(), 1, "{line} {}", said.err);
    }
    let line = |start| said.err.lines().find(|line| line.starts_with(start)).unwrap();
    for there in ["XR_KHR_vulkan_enable2", "XR_KHR_composition_layer_depth", "XR_FB_display_refresh_rate"] {
        assert!(line("extensions found: ").contains(there), "{there}: {}", said.err);
    }
    // What Monado lacks is missed by nobody.
    for absent in [
        "XR_FB_foveation",
        "XR_FB_foveation_configuration",
        "XR_FB_foveation_vulkan",
        "XR_FB_swapchain_update_state",
        "XR_EXT_performance_settings",
        "XR_FB_space_warp",
        "XR_META_vulkan_swapchain_create_info",
    ] {
        assert!(line("extensions missing: ").contains(absent), "{absent}: {}", said.err);
    }
    assert!(line("in use: ").contains("Hz") && line("in use: ").contains("depth submitted"), "{}", said.err);
    assert!(!line("in use: ").contains("foveation"), "{}", said.err);
}

#[test]
#[ignore = "runs in a process of its own"]
fn forty_frames() {
    let scene = shipped("open_ocean");
    let mut watcher = Watcher::new(13);
    let report = watcher.watch(&scene, 40);
    assert_eq!((report.shown, report.recovered), (40, 0));
    assert_eq!(watcher.seen.len(), 40);
    let states = [
        "IDLE",
        "READY",
        "SYNCHRONIZED",
        "VISIBLE",
        "FOCUSED",
        "VISIBLE",
        "SYNCHRONIZED",
        "STOPPING",
        "IDLE",
        "EXITING",
    ];
    assert_eq!(watcher.states, states);
    assert!(
        watcher.seen.windows(2).all(|pair| pair[0].time < pair[1].time),
        "time stands still or runs back"
    );
    watcher.sees_what_a_lone_camera_sees(&scene);
}
