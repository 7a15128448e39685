//! Frames that run late on Monado: smaller views, then a coarser preset, then small waves in turns, each drawn right.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use std::sync::Arc;
use std::thread;
use std::time::Duration;
use support::headset::{Watcher, settings};
use support::monado::{Service, Settings};
use support::program::run;
use support::stage::shipped;
use swell::gpu::Device;
use swell::host::{Guest, HeadsetFrame, HeadsetSettings, HostError, headset};
use swell::lod::Quality;

#[test]
fn late_frames_are_made_less_finely() {
    let service = Service::start(Settings::default());
    let said = run(&mut service.reexec("late_frames"));
    assert!(said.status == Some(0) && said.out.contains("1 passed"), "{said:?}");
    let levels: Vec<_> = said.err.lines().filter(|line| line.starts_with("level ")).collect();
    let [third, fourth, fifth] = levels[..] else { panic!("{levels:?}") };
    assert!(third.starts_with("level 3 of 5: 9 of ") && third.ends_with("quality Medium"), "{third}");
    assert!(fourth.starts_with("level 4 of 5: ") && fourth.ends_with("quality Low"), "{fourth}");
    assert!(
        fifth.starts_with("level 5 of 5: ") && fifth.ends_with("small waves every second frame"),
        "{fifth}"
    );
}

/// Late with every frame; looks at the first picture and at one of each level, and ends some frames into the last.
struct Dawdler {
    watcher: Watcher,
    levels: Vec<usize>,
    frames_since: usize,
}

/// After so many frames of a level a picture is looked at.
const SETTLED: usize = 10;

impl Guest for Dawdler {
    fn goes_on(&mut self) -> bool {
        self.levels.last() != Some(&5) || self.frames_since <= SETTLED
    }

    fn looks(&self) -> bool {
        true
    }

    fn opened(&mut self, device: &Arc<Device>) -> Result<(), HostError> {
        self.watcher.opened(device)
    }

    fn closing(&mut self) {
        self.watcher.closing();
    }

    fn level(&mut self, number: usize) {
        self.levels.push(number);
        self.frames_since = 0;
    }

    fn frame(&mut self, frame: &HeadsetFrame<'_>) -> Result<(), HostError> {
        thread::sleep(Duration::from_millis(80));
        self.frames_since += usize::from(frame.drawn.is_some());
        self.watcher.every = if self.frames_since == SETTLED { 1 } else { usize::MAX };
        self.watcher.frame(frame)
    }
}

#[test]
#[ignore = "runs in a process of its own"]
fn late_frames() {
    let scene = shipped("open_ocean");
    let mut guest = Dawdler { watcher: Watcher::new(1), levels: Vec::new(), frames_since: 0 };
    let wish = HeadsetSettings { fallback: Some(2), ..settings(1000) };
    let report = headset(&scene, &wish, &mut guest).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(report.said, Vec::<String>::new());
    assert_eq!((report.level, &guest.levels[..]), (5, &[2, 3, 4, 5][..]));
    let mut looked = guest.watcher;
    looked.seen.retain(|seen| seen.pictures.is_some());
    // The last level's small waves are a frame old, which a lone camera's are not.
    let qualities = [Quality::Medium, Quality::Medium, Quality::Medium, Quality::Low];
    let sizes = [[256, 192], [256, 192], [224, 168], [224, 168], [224, 168]];
    let all = std::mem::take(&mut looked.seen);
    assert_eq!(all.iter().map(|seen| seen.pictures.as_ref().unwrap()[0].size).collect::<Vec<_>>(), sizes);
    let triangles: Vec<_> = all.iter().map(|seen| seen.counts.triangles).collect();
    assert!(triangles[3] < triangles[2], "{triangles:?}");
    for (seen, quality) in all.into_iter().zip(qualities) {
        let mut scene = scene.clone();
        scene.lod.quality = quality;
        looked.seen = vec![seen];
        looked.sees_what_a_lone_camera_sees(&scene);
    }
}
