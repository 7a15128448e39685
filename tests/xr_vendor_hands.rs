//! Hands without controllers are drawn where a runtime that pretends to track them says, and foveation's profiles arrive
//! at one as they were meant.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use ash::vk;
use glam::{DVec3, Quat, Vec3};
use support::faults;
use support::headset::{Seen, Watcher};
use support::monado::{Devices, Service, Settings};
use support::stage::{Stage, seen_at, shipped};
use swell::draw::{Look, Shape, Solid};
use swell::gpu::{Device, DeviceNeeds, Instance, Opener as _, Validation};
use swell::raft::Horizon;
use swell::scene::Scene;
use swell::xr::vendor::{Foveation, FoveationLevel, JOINTS};
use swell::xr::{Runtime, Session, Swapchain, SwapchainInfo, Usage};

const HANDS: &str = "XR_EXT_hand_tracking";

/// Place in play space and radius of a joint, metres: those of `tests/fault_layer/pretend/hands.rs`.
fn joint(right: bool, index: usize) -> (Vec3, f32) {
    let (column, row) = ((index % 5) as f32, (index / 5) as f32);
    let side = if right { 1.0 } else { -1.0 };
    (Vec3::new(side * (0.08 + 0.03 * column), 1.4 + 0.03 * row, -0.5), 0.006 + 0.0002 * index as f32)
}

/// The rider is kept still, so that play space lies where the scene's camera says.
fn still() -> Scene {
    let mut scene = shipped("calm");
    scene.raft.horizon = Horizon::Still;
    scene.raft.held_heave = 0.0;
    scene
}

/// Whether `solid` is a joint's ball: smaller than anything else that is round.
fn is_joint(solid: &Solid) -> bool {
    solid.shape == Shape::Sphere && solid.size.x < 0.025
}

#[test]
fn joints_are_drawn_where_hands_are() {
    let service = Service::start(Settings { devices: Devices::HeadOnly, ..Settings::default() });
    let (calls, said) = faults::passes(&service, "empty_hands", &[HANDS], "");
    calls.come_in_order(&[
        "create_hand_tracker LEFT",
        "create_hand_tracker RIGHT",
        "end_frame",
        "destroy_hand",
    ]);
    assert_eq!((calls.count("create_hand_tracker"), calls.count("destroy_hand_tracker")), (2, 2));
    assert!(said.err.contains("hands tracked"), "{}", said.err);
}

#[test]
#[ignore = "runs in a process of its own"]
fn empty_hands() {
    let scene = still();
    let mut watcher = Watcher::new(4);
    watcher.watch(&scene, 9);
    watcher.sees_what_a_lone_camera_sees(&scene);
    // The simulated head looks about, and not at both hands in every frame.
    let mut found = [0; 2];
    for seen in watcher.seen.iter().filter(|seen| seen.pictures.is_some()) {
        joints_are_there(&scene, seen, &mut found);
    }
    println!("{found:?} joints found");
    assert!(found.iter().all(|&found| found > JOINTS), "{found:?}");
}

/// Adds to `found` how many joints of each hand are in the middle of the picture, all of which have to be seen.
fn joints_are_there(scene: &Scene, seen: &Seen, found: &mut [usize; 2]) {
    let [eye, look] = [scene.camera.eye, scene.camera.look].map(DVec3::from);
    let ahead = look - eye;
    let heading = Quat::from_rotation_y(f64::atan2(-ahead.x, -ahead.z) as f32);
    let floor = DVec3::new(eye.x, scene.raft.freeboard, eye.z);
    let balls: Vec<&Solid> = seen.solids.iter().filter(|solid| is_joint(solid)).collect();
    assert_eq!(balls.len(), 2 * JOINTS);
    for (index, ball) in balls.iter().enumerate() {
        let (place, radius) = joint(index >= JOINTS, index % JOINTS);
        let off = ball.position - (floor + (heading * place).as_dvec3());
        assert!(off.length() < 1e-5, "joint {index}: {off}");
        assert!((ball.size - Vec3::splat(2.0 * radius)).length() < 1e-6, "joint {index}: {}", ball.size);
    }
    // Seen, too: the picture is another one there than without them.
    let others: Vec<Solid> = seen.solids.iter().filter(|solid| !is_joint(solid)).copied().collect();
    for (side, (view, eye)) in seen.pictures.as_ref().unwrap().iter().zip(seen.eyes).enumerate() {
        view.save(format!("{}/hands/{side}.png", env!("CARGO_TARGET_TMPDIR")).as_ref());
        let mut lone = Stage::new(scene, view.size, 1, Look::Water, seen.time);
        lone.host.set_scenery(&others, seen.vignette);
        let without = lone.picture(seen.time, &[eye]);
        for (index, ball) in balls.iter().enumerate() {
            let (at, depth) = seen_at(&eye, view.size, ball.position);
            // Not near the rim, which lenses hide.
            let inside = (0..2).all(|i| {
                let share = at[i] / f64::from(view.size[i]);
                share > 0.2 && share < 0.8
            });
            if depth > 0.0 && inside {
                let [x, y] = at.map(|side| side as u32);
                let apart = |i: usize| view.pixel(x, y)[i].abs_diff(without.pixel(x, y)[i]);
                assert!((0..3).any(|i| apart(i) > 15), "eye {side}: joint {index} is not seen at {at:?}");
                found[index / JOINTS] += 1;
            }
        }
    }
}

#[test]
fn who_holds_a_controller_sees_it() {
    let service = Service::start(Settings::default());
    faults::passes(&service, "full_hands", &[HANDS], "");
}

#[test]
#[ignore = "runs in a process of its own"]
fn full_hands() {
    let mut watcher = Watcher::new(2);
    watcher.watch(&still(), 5);
    for seen in watcher.seen.iter().filter(|seen| seen.pictures.is_some()) {
        assert!(seen.hands.iter().all(|hand| hand.grip.is_some()));
        assert_eq!(seen.solids.iter().filter(|solid| is_joint(solid)).count(), 0);
    }
}

#[test]
fn foveation_profiles_arrive() {
    let all = [
        "XR_FB_swapchain_update_state",
        "XR_FB_foveation",
        "XR_FB_foveation_configuration",
        "XR_FB_foveation_vulkan",
    ];
    let service = Service::start(Settings::default());
    let (calls, _) = faults::passes(&service, "profiles", &all, "");
    calls.come_in_order(&[
        "create_swapchain 64x48",
        "create_foveation_profile LOW offset=0 dynamic=DISABLED",
        "update_swapchain foveation",
        "destroy_foveation_profile",
        "create_foveation_profile MEDIUM offset=0 dynamic=DISABLED",
        "update_swapchain foveation",
        "destroy_foveation_profile",
        "create_foveation_profile HIGH offset=0 dynamic=LEVEL_ENABLED",
        "update_swapchain foveation",
        "destroy_foveation_profile",
    ]);
}

#[test]
#[ignore = "runs in a process of its own"]
fn profiles() {
    let runtime = Runtime::new(swell::xr::Platform, Validation::On).unwrap();
    let instance = Instance::new(Validation::On, &[], &*runtime).unwrap();
    let physical = runtime.choose(&instance, None).unwrap();
    let needs = DeviceNeeds { foveation: true, opener: &*runtime, ..DeviceNeeds::default() };
    let device = Device::new(instance, physical, &needs).unwrap();
    // The runtime would; lavapipe has no density maps.
    assert!(runtime.extensions.fb_foveation_vulkan && !Foveation::is_offered(&runtime, &device));
    let session = Session::new(&runtime, &device).unwrap();
    let info = SwapchainInfo {
        size: [64, 48],
        format: vk::Format::R8G8B8A8_SRGB,
        usage: Usage::Color { copied: false },
        foveated: false,
        subsampled: false,
    };
    let swapchain = Swapchain::new(&session, info).unwrap();
    for level in [FoveationLevel::Low, FoveationLevel::Medium, FoveationLevel::High] {
        Foveation::new(&session, level).unwrap().apply(&session, &swapchain).unwrap();
    }
    assert_eq!((device.instance().heard().all(), runtime.heard().all()), (vec![], vec![]));
}
