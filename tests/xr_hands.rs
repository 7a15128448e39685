//! A scripted head and scripted hands arrive: poses where they are, trigger and thumbstick at their actions.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use glam::{DVec3, Quat, Vec3};
use support::faults;
use support::headset::{Seen, Watcher};
use support::monado::{Devices, Service, Settings};
use support::program::run;
use support::remote::{Body, Pose, Remote};
use support::stage::shipped;
use swell::lod::Quality;
use swell::raft::Horizon;
use swell::scene::Scene;

/// Where the head is in turns, a second each.
fn places() -> [Pose; 3] {
    [Pose::at(0.0, 1.6, 0.0), Pose::at(0.25, 1.7, -0.3).turned(0.6), Pose::at(-0.2, 1.4, 0.35).turned(-0.9)]
}

/// Both are kept still, so that what is seen is what was sent.
fn still() -> Scene {
    let mut scene = shipped("calm");
    scene.raft.horizon = Horizon::Still;
    scene.raft.held_heave = 0.0;
    // Nobody looks at the sea.
    scene.lod.quality = Quality::Low;
    scene
}

fn watched(name: &str, body: impl Fn(f32) -> Body + Send + 'static) {
    let service = Service::start(Settings { devices: Devices::Remote, ..Settings::default() });
    let _remote = Remote::start(&service, body);
    let said = run(&mut service.reexec(name));
    print!("{}", said.out);
    assert!(said.status == Some(0) && said.out.contains("1 passed"), "{said:?}");
}

#[test]
fn a_scripted_head_is_seen_from() {
    watched("head", |time| Body { head: places()[time as usize % 3], ..Body::standing() });
}

#[test]
#[ignore = "runs in a process of its own"]
fn head() {
    let scene = still();
    let mut watcher = Watcher::new(0);
    watcher.watch(&scene, 70);
    let first = &watcher.seen[0];
    let heading = heading(&scene);
    for (place, pose) in places().into_iter().enumerate() {
        let turn = heading * Quat::from_array(pose.orientation);
        let wanted = heading * Vec3::from(pose.position) + Vec3::Y * scene.raft.freeboard as f32;
        let near = |seen: &&Seen| {
            let middle = middle(seen);
            let place = DVec3::new(scene.camera.eye[0], 0.0, scene.camera.eye[2]) + wanted.as_dvec3();
            let turned = Quat::from_mat3(&seen.eyes[0].axes).dot(turn).abs();
            (middle - place).length() < 0.002 && turned > 0.9999
        };
        let count = watcher.seen.iter().filter(near).count();
        println!("place {place}: {count} frames");
        assert!(
            count >= 3,
            "place {place}: nobody looked from {wanted}; the first frame from {}",
            middle(first)
        );
    }
    // The eyes stand apart to the right and left of the head, wherever it looks.
    for seen in &watcher.seen {
        let apart = (seen.eyes[1].position - seen.eyes[0].position).as_vec3();
        let along = apart.dot(seen.eyes[0].axes.x_axis);
        assert!(along > 0.05 && along < 0.08 && (apart.length() - along).abs() < 1e-4, "{apart}");
    }
}

fn heading(scene: &Scene) -> Quat {
    let ahead = DVec3::from(scene.camera.look) - DVec3::from(scene.camera.eye);
    Quat::from_rotation_y(f64::atan2(-ahead.x, -ahead.z) as f32)
}

fn middle(seen: &Seen) -> DVec3 {
    (seen.eyes[0].position + seen.eyes[1].position) * 0.5
}

/// Not in the middle of the raft, and not looking ahead.
fn aside() -> Body {
    Body { head: Pose::at(0.4, 1.6, -0.3).turned(0.6), ..Body::standing() }
}

#[test]
fn a_runtime_that_recentres_brings_the_raft_under_the_person() {
    let service = Service::start(Settings { devices: Devices::Remote, ..Settings::default() });
    let _remote = Remote::start(&service, |_| aside());
    let mut command = service.reexec("recentred");
    let record = faults::between(&service, &mut command, "recentre@12");
    let said = run(&mut command);
    print!("{}", said.out);
    assert!(said.status == Some(0) && said.out.contains("1 passed"), "{said:?}");
    assert_eq!(record.calls().count("fault recentre"), 1);
}

#[test]
#[ignore = "runs in a process of its own"]
fn recentred() {
    let scene = still();
    let mut watcher = Watcher::new(1);
    watcher.watch(&scene, 24);
    // From the deck's middle to under the head, and the cosine between the raft's front and the gaze.
    let raft = |seen: &Seen| {
        let planks = &seen.solids[..PLANKS];
        let deck = planks.iter().map(|plank| plank.position).sum::<DVec3>() / PLANKS as f64;
        let flat = |v: Vec3| v.with_y(0.0).normalize();
        let along = flat(planks[0].axes.z_axis).dot(flat(seen.eyes[0].axes.z_axis));
        ((middle(seen) - deck).with_y(0.0).length(), along)
    };
    let (first, last) = (&watcher.seen[3], watcher.seen.last().unwrap());
    let (before, after) = (raft(first), raft(last));
    println!("from the middle, and the cosine to the front: {before:?}, then {after:?}");
    assert!((before.0 - 0.5).abs() < 0.02 && (before.1 - 0.6f32.cos()).abs() < 0.01, "{before:?}");
    assert!(after.0 < 0.02 && after.1 > 0.999, "{after:?}");
    // The raft moves, and not the view.
    assert!((middle(last) - middle(first)).length() < 0.002);
}

/// A raft's planks come first of its solids, and the scene has no buoys before it.
const PLANKS: usize = swell::draw::RAFT_SOLIDS - 4;

#[test]
fn trigger_and_thumbstick_reach_their_actions() {
    watched("buttons", |time| {
        let mut body = Body::standing();
        let [left, right] = &mut body.hands;
        match time as usize % 4 {
            0 => left.thumbstick = [0.0, 1.0],
            1 => right.trigger = 0.5,
            2 => right.thumbstick = [1.0, 0.0],
            _ => left.squeeze = 1.0,
        }
        body
    });
}

#[test]
#[ignore = "runs in a process of its own"]
fn buttons() {
    let scene = still();
    let mut watcher = Watcher::new(0);
    watcher.watch(&scene, 110);
    let seen = &watcher.seen;
    let has = |what: &str, test: &dyn Fn(&Seen) -> bool| {
        let count = seen.iter().filter(|seen| test(seen)).count();
        println!("{what}: {count} frames");
        assert!(count >= 3, "{what} never arrives");
    };
    has("left stick", &|seen| seen.hands[0].stick == [0.0, 1.0]);
    has("right trigger", &|seen| (seen.hands[1].go - 0.5).abs() < 0.01);
    has("right stick", &|seen| seen.hands[1].stick == [1.0, 0.0]);
    has("left squeeze", &|seen| seen.hands[0].hold == 1.0);
    has("left hand's place", &|seen| {
        seen.hands[0]
            .grip
            .is_some_and(|grip| (Vec3::from(grip.position) - Vec3::new(-0.2, 1.3, -0.5)).length() < 0.05)
    });
    has("vignette", &|seen| seen.vignette > 0.1);
    // The left stick glided ahead, the right one turned by snaps about the head.
    let (first, last) = (middle(&seen[0]), middle(seen.last().unwrap()));
    let gone = (last - first).length();
    assert!(gone > 1.0, "gone {gone} m");
    let ahead = |seen: &Seen| -seen.eyes[0].axes.z_axis;
    let snap = scene.raft.snap_turn.cos() as f32;
    let mut snaps = 0;
    for pair in seen.windows(2) {
        let cos = ahead(&pair[0]).dot(ahead(&pair[1]));
        if cos < 0.999 {
            assert!((cos - snap).abs() < 1e-3, "turned by {} degrees", cos.acos().to_degrees());
            snaps += 1;
        }
    }
    println!("{gone:.2} m, {snaps} snap turns");
    assert!(snaps >= 1);
}
