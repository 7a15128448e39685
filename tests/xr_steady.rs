//! A headset's frames allocate nothing, on any thread, for as long as they go on.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use stats_alloc::{INSTRUMENTED_SYSTEM, Stats, StatsAlloc};
use std::alloc::System;
use support::headset::settings;
use support::monado::{Compositor, Devices, Service, Settings};
use support::program::run;
use support::remote::{Body, Remote};
use support::xvfb::Xvfb;
use swell::gpu::Validation;
use swell::host::{AuthoringSettings, Fit, Guest, HeadsetFrame, HostError, headset};
use swell::scene::Scene;

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

const FRAMES: u64 = 600;
/// By then everything has its size: both frames in flight, both buffers of the sea, the first stick's first flick.
const WARM: u64 = 100;

#[test]
fn hundreds_of_frames_allocate_nothing() {
    // A window's rate can be chosen, and a null compositor's cannot.
    let screen = Xvfb::start([64, 64]);
    let compositor = Compositor::Window { display: screen.display().to_owned() };
    let settings = Settings { compositor, devices: Devices::Remote, hertz: Some(500) };
    let service = Service::start(settings);
    // Someone who glides, turns and looks about.
    let _remote = Remote::start(&service, |time| {
        let mut body = Body::standing();
        body.head = body.head.turned(time.sin());
        body.hands[0].thumbstick = [0.5 * (0.7 * time).sin(), 1.0];
        body.hands[1].thumbstick = [if time % 1.0 < 0.2 { 1.0 } else { 0.0 }, 0.0];
        body
    });
    let said = run(&mut service.reexec("frames_on_a_count"));
    print!("{}", said.out);
    assert!(said.status == Some(0) && said.out.contains("1 passed"), "{said:?}");
}

/// Looks at the counters once a frame.
struct Accountant {
    frames: u64,
    warm: Option<Stats>,
    end: Option<Stats>,
    worst: Option<(u64, usize)>,
    before: usize,
}

impl Guest for Accountant {
    fn goes_on(&mut self) -> bool {
        true
    }

    fn frame(&mut self, frame: &HeadsetFrame<'_>) -> Result<(), HostError> {
        self.frames += u64::from(frame.drawn.is_some());
        let stats = ALLOCATOR.stats();
        let count = stats.allocations + stats.reallocations;
        if self.warm.is_some() && self.worst.is_none() && count > self.before {
            self.worst = Some((self.frames, count - self.before));
        }
        self.before = count;
        if self.frames == WARM && self.warm.is_none() {
            self.warm = Some(stats);
        }
        if self.frames == FRAMES && self.end.is_none() {
            self.end = Some(stats);
        }
        Ok(())
    }
}

#[test]
#[ignore = "runs in a process of its own"]
fn frames_on_a_count() {
    let text = "[sea]\nresolution = 32\npatch_size = 50.0\n[lod]\nquality = \"low\"\nsize = 256.0\nlevels = 2\n[[buoy]]\nat = [3.0, -6.0]\n";
    let scene = Scene::parse(text, "steady").unwrap();
    let mut accountant = Accountant { frames: 0, warm: None, end: None, worst: None, before: 0 };
    let mut settings = settings(FRAMES);
    (settings.validation, settings.scale) = (Validation::Off, 0.1);
    // A panel that nobody has asked for, and a file that it watches.
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("steady.toml");
    std::fs::write(&file, text).unwrap();
    let fit = Fit::new(|_| ());
    settings.authoring = Some(AuthoringSettings { text: text.to_owned(), file: Some(file), fit });
    let report = headset(&scene, &settings, &mut accountant).unwrap();
    assert_eq!(report.shown, FRAMES);
    let (warm, end) = (accountant.warm.unwrap(), accountant.end.unwrap());
    println!("{warm:?}\n{end:?}\n{report:?}");
    let taken = end.allocations - warm.allocations + end.reallocations - warm.reallocations;
    assert_eq!(taken, 0, "the first in frame {:?}", accountant.worst);
    assert_eq!(end.deallocations, warm.deallocations);
}
