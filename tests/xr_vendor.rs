//! What vendors add, on a runtime that pretends it around Monado: the right calls with the right values, as often as they
//! should come and in order, and pictures that do not change. Absence is what `xr_session` sees with Monado alone.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use glam::{DVec3, Quat, Vec3};
use std::fs;
use support::faults::{self, Calls};
use support::headset::{Seen, Watcher, settings};
use support::monado::{Devices, Service, Settings};
use support::program::Said;
use support::remote::{Body, Remote};
use support::stage::shipped;
use swell::host::HeadsetSettings;
use swell::raft::Horizon;
use swell::scene::Scene;

const WARP: &str = "XR_FB_space_warp";
const CLOCKS: &str = "XR_EXT_performance_settings";
const RATES: &str = "XR_FB_display_refresh_rate";
/// All of foveation but what ties it to Vulkan.
const FOVEATION: [&str; 3] =
    ["XR_FB_swapchain_update_state", "XR_FB_foveation", "XR_FB_foveation_configuration"];
/// The line of a swapchain of motion vectors, and of their depth.
const WARP_IMAGES: [&str; 2] = [
    "create_swapchain 160x120 layers=2 samples=1 format=97 ",
    "create_swapchain 160x120 layers=2 samples=1 format=126 ",
];

/// What the ignored test `name` did on a runtime with `extensions`, where `faults` struck.
fn met(name: &str, extensions: &[&str], faults: &str, devices: Devices) -> (Calls, Said) {
    let service = Service::start(Settings { devices, ..Settings::default() });
    let _remote = (devices == Devices::Remote).then(|| Remote::start(&service, body));
    faults::passes(&service, name, extensions, faults)
}

/// Glides ahead and turns, in flicks where turns are snaps.
fn body(time: f32) -> Body {
    let mut body = Body::standing();
    let [left, right] = &mut body.hands;
    left.thumbstick = [0.0, 1.0];
    right.thumbstick = [if time % 0.6 < 0.3 { 0.9 } else { 0.0 }, 0.0];
    body
}

/// Waves that tilt the raft, and a raft that tilts its rider.
fn tilting() -> Scene {
    let mut scene = shipped("open_ocean");
    scene.raft.horizon = Horizon::Rides;
    scene.raft.smooth_turn = 0.6;
    scene.raft.vignette = 0.0;
    scene
}

fn warping(frames: u64) -> HeadsetSettings {
    HeadsetSettings { space_warp: true, ..settings(frames) }
}

fn watch(watcher: &mut Watcher, scene: &Scene, settings: &HeadsetSettings) {
    let report = watcher.try_watch(scene, settings).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(report.said, Vec::<String>::new());
    assert_eq!(report.shown, settings.frames.unwrap());
}

/// Frames of the log, in order: whether each showed something, whether its motion, and how many images were given back.
fn frames(calls: &Calls) -> Vec<(bool, bool, usize)> {
    let (mut warped, mut released) = (false, 0);
    let mut frames = Vec::new();
    for line in &calls.0 {
        warped |= line.starts_with("space_warp ");
        released += usize::from(line.starts_with("release_image"));
        if line.starts_with("end_frame ") {
            frames.push((line.contains(" layers=1 "), warped, released));
            (warped, released) = (false, 0);
        }
    }
    frames
}

#[test]
fn with_everything_offered() {
    let offered = [&[WARP, CLOCKS, RATES][..], &FOVEATION].concat();
    let (calls, said) = met("everything", &offered, "should_render_false@15", Devices::Remote);
    calls.come_in_order(&[
        "create_session 1",
        "create_swapchain 320x240 ",
        WARP_IMAGES[0],
        WARP_IMAGES[1],
        "request_refresh_rate 120",
        "performance CPU SUSTAINED_HIGH",
        "performance GPU SUSTAINED_HIGH",
        "refresh_rate_changed 72 120",
        "wait_frame",
        "space_warp 2 skip=no near=inf far=0.1 pose=",
        "space_warp 30 skip=no near=inf far=0.1 pose=",
        "request_exit",
    ]);
    for once in
        ["request_refresh_rate", "event DISPLAY_REFRESH_RATE_CHANGED_FB", WARP_IMAGES[0], WARP_IMAGES[1]]
    {
        assert_eq!(calls.count(once), 1, "{once}: {calls:#?}");
    }
    assert_eq!(calls.count("performance"), 2, "{calls:#?}");
    // The device has no density maps, and the runtime none to give.
    assert_eq!((calls.count("create_foveation"), calls.count("update_swapchain")), (0, 0), "{calls:#?}");
    moved_on_from_the_frame_before(&calls);
    for used in ["120 Hz", "sustained clocks", "space warp from 160x120"] {
        assert!(said.err.contains(used), "{used}: {}", said.err);
    }
    assert!(!said.err.contains("foveation High"), "{}", said.err);
}

/// A frame has motion exactly if one of ours came right before it, and all its images are given back first.
fn moved_on_from_the_frame_before(calls: &Calls) {
    let (mut before, mut gaps) = (false, 0);
    for (index, (shown, warped, released)) in frames(calls).into_iter().enumerate() {
        assert_eq!(warped, shown && before, "frame {index}: {calls:#?}");
        let wanted = 2 * usize::from(shown) + 2 * usize::from(warped);
        assert_eq!(released, wanted, "frame {index}: {calls:#?}");
        gaps += usize::from(before && !shown);
        before = shown;
    }
    // The one that was injected, and the end.
    assert_eq!(gaps, 2, "{calls:#?}");
}

#[test]
#[ignore = "runs in a process of its own"]
fn everything() {
    let scene = tilting();
    let mut watcher = Watcher::new(13);
    watch(&mut watcher, &scene, &warping(30));
    watcher.sees_what_a_lone_camera_sees(&scene);
    let (first, second) = (watcher.seen[0].counts, watcher.seen[1].counts);
    assert!(second.draws > first.draws && second.patches > first.patches, "{first:?} {second:?}");
    steps_are_the_riders(&watcher.seen);
}

/// Steps of play space as the runtime was told them: by number of the frame, metres and a rotation.
fn told() -> Vec<(usize, DVec3, Quat, bool)> {
    let text = fs::read_to_string(std::env::var_os("SWELL_FAULT_LOG").unwrap()).unwrap();
    let lines = text.lines().filter(|line| line.starts_with("space_warp "));
    lines
        .map(|line| {
            let (head, pose) = line.split_once(" pose=").unwrap();
            let [x, y, z, i, j, k, w] =
                pose.split(',').map(|word| word.parse().unwrap()).collect::<Vec<f32>>()[..]
            else {
                panic!("{line}");
            };
            let number = head.split(' ').nth(1).unwrap().parse().unwrap();
            (number, Vec3::new(x, y, z).as_dvec3(), Quat::from_xyzw(i, j, k, w), head.contains("skip=yes"))
        })
        .collect()
}

/// The head stands still in play space, so what moves between two frames is play space.
fn steps_are_the_riders(seen: &[Seen]) {
    let head = DVec3::new(0.0, 1.6, 0.0);
    let middle = |seen: &Seen| (seen.eyes[0].position + seen.eyes[1].position) * 0.5;
    let (mut way, mut turned, mut tilted, mut steps) = (DVec3::ZERO, 0.0f32, 0.0f32, 0);
    for (number, place, turn, skipped) in told() {
        let [before, now] = [&seen[number - 2], &seen[number - 1]];
        let back = before.eyes[0].axes.transpose();
        // Where the head is now, in play space of the frame before.
        let wanted = head + back.as_dmat3() * (middle(now) - middle(before));
        let off = place + turn.as_dquat() * head - wanted;
        assert!(off.length() < 2e-4, "frame {number}: {off}");
        let wanted = Quat::from_mat3(&(back * now.eyes[0].axes));
        let off = (turn.conjugate() * wanted).to_scaled_axis();
        assert!(off.length() < 5e-4, "frame {number}: turned {off} otherwise");
        assert!(!skipped, "frame {number} is left out");
        way += place;
        turned += turn.to_scaled_axis().y;
        tilted += turn.to_scaled_axis().x.abs() + turn.to_scaled_axis().z.abs();
        steps += 1;
    }
    println!("{steps} steps, {way} m, turned {turned}, tilted by {tilted} in all");
    assert!(steps > 20 && way.z < -0.5 && turned < -0.1 && tilted > 1e-3, "{steps} {way} {turned} {tilted}");
}

#[test]
fn with_nothing_offered() {
    let (calls, said) = met("everything_wished", &[], "", Devices::Simulated);
    for never in ["space_warp", "performance", "request_refresh_rate", "create_foveation", "update_swapchain"]
    {
        assert_eq!(calls.count(never), 0, "{never}: {calls:#?}");
    }
    // Colour and depth, and no more.
    assert_eq!(calls.count("create_swapchain"), 2, "{calls:#?}");
    assert!(!said.err.contains("space warp from"), "{}", said.err);
}

#[test]
#[ignore = "runs in a process of its own"]
fn everything_wished() {
    let scene = shipped("calm");
    let mut watcher = Watcher::new(5);
    watch(&mut watcher, &scene, &warping(6));
    watcher.sees_what_a_lone_camera_sees(&scene);
}

#[test]
fn space_warp_is_a_choice() {
    let (calls, said) = met("a_rate_of_80", &[WARP, RATES], "", Devices::Simulated);
    assert_eq!((calls.count("space_warp"), calls.count("create_swapchain")), (0, 2), "{calls:#?}");
    assert_eq!(calls.count("request_refresh_rate 80"), 1, "{calls:#?}");
    assert_eq!(calls.count("request_refresh_rate"), 1, "{calls:#?}");
    assert!(said.err.contains("80 Hz") && !said.err.contains("space warp from"), "{}", said.err);
}

#[test]
#[ignore = "runs in a process of its own"]
fn a_rate_of_80() {
    let wish = HeadsetSettings { refresh_rate: Some(81.5), ..settings(4) };
    watch(&mut Watcher::new(0), &shipped("calm"), &wish);
}

#[test]
fn a_rate_that_is_there_is_not_asked_for() {
    let (calls, said) = met("a_rate_of_72", &[RATES], "", Devices::Simulated);
    assert_eq!(calls.count("request_refresh_rate"), 0, "{calls:#?}");
    assert!(said.err.contains("72 Hz"), "{}", said.err);
}

#[test]
#[ignore = "runs in a process of its own"]
fn a_rate_of_72() {
    let wish = HeadsetSettings { refresh_rate: Some(72.0), ..settings(4) };
    watch(&mut Watcher::new(0), &shipped("calm"), &wish);
}

/// Maps of fragment densities want both the runtime and the device, which is lavapipe.
#[test]
fn foveation_wants_the_device_too() {
    let all = [&FOVEATION[..], &["XR_FB_foveation_vulkan"]].concat();
    let (calls, said) = met("foveation_wished", &all, "", Devices::Simulated);
    assert_eq!((calls.count("create_foveation"), calls.count("update_swapchain")), (0, 0), "{calls:#?}");
    assert!(!said.err.contains("foveation High"), "{}", said.err);
}

#[test]
#[ignore = "runs in a process of its own"]
fn foveation_wished() {
    watch(&mut Watcher::new(0), &shipped("calm"), &settings(4));
}

#[test]
fn a_session_that_is_lost_asks_again() {
    let faults = "session_lost@12";
    let (calls, _) = met("lost", &[WARP, CLOCKS, RATES], faults, Devices::Simulated);
    calls.come_in_order(&[
        "create_session 1",
        "performance CPU",
        "performance GPU",
        "space_warp ",
        "create_session 2",
        WARP_IMAGES[0],
        "performance CPU",
        "performance GPU",
        "space_warp ",
    ]);
    assert_eq!((calls.count("performance"), calls.count(WARP_IMAGES[0])), (4, 2), "{calls:#?}");
    // The display has not forgotten.
    assert_eq!(calls.count("request_refresh_rate"), 1, "{calls:#?}");
}

#[test]
#[ignore = "runs in a process of its own"]
fn lost() {
    let mut watcher = Watcher::new(0);
    let report = watcher.try_watch(&shipped("calm"), &warping(20)).unwrap();
    assert_eq!((report.shown, report.recovered), (20, 1));
    assert_eq!(report.said, Vec::<String>::new());
}

/// The third frame's ninth image is that of its motion vectors, the fourth's the fourteenth that of their depth.
#[test]
fn an_image_that_is_late_leaves_out_the_motion_alone() {
    let faults = "wait_image_timeout@9,wait_image_timeout@13";
    let (calls, _) = met("late", &[WARP], faults, Devices::Simulated);
    let shown: Vec<_> = frames(&calls).into_iter().filter(|frame| frame.0).map(|(_, w, r)| (w, r)).collect();
    let (with, without) = ((true, 4), (false, 2));
    assert_eq!(shown[..6], [without, with, without, without, with, with], "{calls:#?}");
    // What was acquired stays so: nothing is acquired twice.
    let held = calls.count("acquire_image") - calls.count("release_image");
    assert_eq!(held, 0, "{calls:#?}");
}

#[test]
#[ignore = "runs in a process of its own"]
fn late() {
    let mut watcher = Watcher::new(1);
    let scene = shipped("calm");
    watch(&mut watcher, &scene, &warping(8));
    watcher.sees_what_a_lone_camera_sees(&scene);
}

/// The raft turns by a snap, which no frame between frames may carry on.
#[test]
fn a_snap_turn_is_not_carried_on() {
    met("snaps", &[WARP], "", Devices::Remote);
}

#[test]
#[ignore = "runs in a process of its own"]
fn snaps() {
    let mut scene = tilting();
    scene.raft.smooth_turn = 0.0;
    let mut watcher = Watcher::new(0);
    watch(&mut watcher, &scene, &warping(40));
    let mut snaps = 0;
    for (number, _, turn, skipped) in told() {
        let snapped = turn.to_scaled_axis().y.abs() > 0.3;
        assert_eq!(snapped, skipped, "frame {number}: {turn}");
        snaps += usize::from(snapped);
    }
    println!("{snaps} snap turns");
    assert!(snaps >= 2, "{snaps}");
}
