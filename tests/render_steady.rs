//! The frames of `swell render` allocate nothing, on any thread: not the frame loop, the workers of the sea, or the
//! thread that compresses and writes pictures.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use glam::DVec3;
use stats_alloc::{INSTRUMENTED_SYSTEM, StatsAlloc};
use std::alloc::System;
use std::fmt::Write;
use std::thread;
use std::time::{Duration, Instant};
use support::program::{on_vulkan, run};
use support::stage::eye;
use swell::commands::{Clock, Frames, RenderOptions, render};
use swell::draw::{Fov, Look};
use swell::gpu::Validation;
use swell::host::{Headless, HeadlessSettings};
use swell::lod::{SignalSettings, Tessellation};
use swell::scene::{Scene, Shadows};

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// By then everything has its size: both frames in flight, both buffers of the sea, each thread's own things.
const WARM: u64 = 100;
const COUNTED: u64 = 300;
const SIZE: [u32; 2] = [96, 64];

/// Two cascades, large enough for every worker to have had its part before the counting begins (each makes its working
/// space when it first has one), foam with a memory (a tick every third frame), levels of detail, a buoy, shadows.
const SPECTRAL: &str = "[sea]\nresolution = 128\nwind_speed = 9\n[sea.foam]\nfade_time = 1.0\n[[sea.cascade]]\npatch_size = 90.0\n\
                        [[sea.cascade]]\npatch_size = 17.0\nrotation_deg = 20.0\n[lod]\nquality = \"low\"\nsize = 512.0\nlevels = 4\n\
                        [water]\nshadows = \"on\"\nshadow_resolution = 256\n[[buoy]]\nat = [3.0, -6.0]\n";

/// Waves and octaves with foam, to be layered on a sea.
const LAYERS: &str = "[[layer]]\n[[layer.wave]]\nkind = 'gerstner'\nwavelength = 30\nsteepness = 0.3\n\
                      [[layer.wave]]\nkind = 'circular'\nwavelength = 4\namplitude = 0.1\ncentre = [3, -20]\n\
                      [[layer]]\nmodel = 'fbm'\noctaves = 4\namplitude = 0.2\n";

/// A sea of nothing but formulas, without shadows.
const FORMULAS: &str = "[sea]\nmodel = 'waves'\n[[sea.wave]]\nkind = 'peaked'\nwavelength = 25\namplitude = 0.4\n\
                        [lod]\nquality = 'low'\nsize = 512.0\nlevels = 4\n[[buoy]]\nat = [3.0, -6.0]\n";

fn scene() -> Scene {
    Scene::parse(SPECTRAL, "steady").unwrap()
}

/// Everything that any thread has asked of the allocator so far.
fn asked() -> usize {
    let stats = ALLOCATOR.stats();
    stats.allocations + stats.reallocations + stats.deallocations
}

/// Runs an ignored test of this file in a process of its own: the counters are the process's, and what the harness
/// keeps of a captured output would be counted too.
fn alone(name: &str) {
    // Not `current_exe`, which is the dynamic loader under the runner.
    let mut child = on_vulkan(std::env::args_os().next().unwrap());
    let said = run(child.args([name, "--exact", "--ignored", "--nocapture", "--test-threads=1"]));
    print!("{}", said.out);
    assert!(said.status == Some(0) && said.out.contains("1 passed"), "{said:?}");
}

#[test]
fn a_flight_allocates_nothing() {
    alone("frames_of_a_flight");
}

#[test]
fn a_flight_by_the_wave_signal_allocates_nothing() {
    alone("frames_of_a_flight_by_the_wave_signal");
}

#[test]
fn a_flight_over_layers_in_shadow_allocates_nothing() {
    alone("frames_of_a_flight_over_layers_in_shadow");
}

#[test]
fn a_flight_over_formulas_allocates_nothing() {
    alone("frames_of_a_flight_over_formulas");
}

#[test]
fn the_command_allocates_nothing() {
    alone("frames_of_the_command");
}

#[test]
#[ignore = "runs in a process of its own"]
fn frames_of_a_flight() {
    fly(&scene());
}

/// Density follows the flight.
#[test]
#[ignore = "runs in a process of its own"]
fn frames_of_a_flight_by_the_wave_signal() {
    let mut scene = scene();
    scene.lod.tessellation = Tessellation::Signal(SignalSettings {
        frequency: 0.4,
        density: 1.0,
        fresnel: [0.3, 1.0],
        distance: [0.0, 200.0],
    });
    fly(&scene);
}

/// Formulas on the spectral sea, which cast shadows and receive them.
#[test]
#[ignore = "runs in a process of its own"]
fn frames_of_a_flight_over_layers_in_shadow() {
    let scene = Scene::parse(&format!("{SPECTRAL}{LAYERS}"), "layers").unwrap();
    assert!(scene.water.shadows.shadows == Shadows::On && scene.sea.spectral && scene.sea.models.len() == 2);
    fly(&scene);
}

/// No spectrum and nothing to simulate, with a layer and without shadows.
#[test]
#[ignore = "runs in a process of its own"]
fn frames_of_a_flight_over_formulas() {
    let scene = Scene::parse(&format!("{FORMULAS}{LAYERS}"), "formulas").unwrap();
    assert!(!scene.sea.spectral && scene.sea.models.len() == 3);
    fly(&scene);
}

/// The host alone, with an eye that flies, so that patches come and go.
fn fly(scene: &Scene) {
    let settings = HeadlessSettings {
        size: SIZE,
        stereo: true,
        look: Look::Water,
        device: None,
        validation: Validation::Off,
        threads: 2,
        cache: None,
    };
    let mut host = Headless::new(scene, &settings, 0.0).unwrap();
    let (mut patches, mut taken) = ([u32::MAX, 0], 0);
    let mut before = 0;
    for frame in 0..WARM + COUNTED {
        let count = asked();
        assert!(frame <= WARM || count == before, "frame {}: {} calls", frame - 1, count - before);
        before = count;
        let time = frame as f64 / 30.0;
        let place = DVec3::new(40.0 * time.sin(), 4.0 + 40.0 * (0.7 * time).sin().powi(2), -15.0 * time);
        let fov = Fov::symmetric(1.2, SIZE[0] as f32 / SIZE[1] as f32);
        let seen = [-0.03, 0.03].map(|side| eye(place + DVec3::X * side, [time, -0.3, 0.0], fov));
        host.set_eyes(&seen);
        host.set_scenery(&[], 0.3);
        let drawn = host.run([time], |frame| {
            taken += frame.pixels.len();
            patches = [patches[0].min(frame.counts.patches), patches[1].max(frame.counts.patches)];
            Ok(())
        });
        drawn.unwrap();
    }
    assert!(patches[1] > patches[0] + 10 && taken > 0, "the same patches all along: {patches:?}");
}

/// The command as it is, with its writer; counted from one written picture to another.
#[test]
#[ignore = "runs in a process of its own"]
fn frames_of_the_command() {
    let folder = tempfile::tempdir().unwrap();
    let frames = 0..WARM + COUNTED + 100;
    let options = RenderOptions {
        out: folder.path().to_owned(),
        frames: Frames::new(frames).unwrap(),
        clock: Clock::new(0.0, 30.0).unwrap(),
        size: SIZE,
        stereo: true,
        look: Look::Water,
        device: None,
        validate: false,
        threads: 2,
        cache: None,
    };
    let calls = thread::scope(|scope| {
        let command = scope.spawn(|| render(&scene(), &options));
        // Who counts must not be counted: all memory is taken beforehand.
        let (mut path, mut name) = (folder.path().join("frame_0000.png.and.room"), String::with_capacity(64));
        let mut calls = Vec::with_capacity(1000);
        let mut before = ALLOCATOR.stats();
        for frame in 0..=WARM + COUNTED {
            name.clear();
            write!(name, "frame_{frame:04}.png").unwrap();
            path.set_file_name(&name);
            let patience = Instant::now() + Duration::from_secs(50);
            while !path.exists() {
                assert!(Instant::now() < patience && !command.is_finished(), "{name} is not there");
                thread::sleep(Duration::from_millis(1));
            }
            let now = ALLOCATOR.stats();
            if frame > WARM && now != before {
                calls.push((frame, now - before));
            }
            before = now;
        }
        command.join().unwrap().unwrap();
        calls
    });
    assert!(calls.is_empty(), "calls of the allocator, by picture: {calls:#?}");
}
