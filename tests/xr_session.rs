//! Sessions on Monado: from IDLE to EXITING, both eyes right, everybody silent.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use support::headset::Watcher;
use support::monado::{Service, Settings};
use support::program::run;
use support::stage::{Stage, shipped};
use swell::draw::Look;

fn in_a_process_of_its_own(settings: Settings, name: &str) {
    let service = Service::start(settings);
    let said = run(&mut service.reexec(name));
    print!("{}{}", said.out, said.err);
    assert_eq!(said.status, Some(0), "{said:?}\n{}", service.log());
}

#[test]
fn a_session_of_forty_frames() {
    in_a_process_of_its_own(Settings::default(), "forty_frames");
}

#[test]
#[ignore = "runs in a process of its own"]
fn forty_frames() {
    let scene = shipped("open_ocean");
    let mut watcher = Watcher::new(13);
    let report = watcher.watch(&scene, 40);
    assert_eq!(report.shown, 40);
    assert_eq!(report.recovered, 0);
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
    println!("{} empty frames, {} steps anew", report.skipped, report.missed);
    let mut alone: Option<Stage> = None;
    for (index, seen) in watcher.seen.iter().enumerate() {
        let Some([left, right]) = &seen.pictures else { continue };
        let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("xr_session");
        left.save(&folder.join(format!("{index}_left.png")));
        right.save(&folder.join(format!("{index}_right.png")));
        let mono = alone.get_or_insert_with(|| Stage::new(&scene, left.size, 1, Look::Water, seen.time));
        mono.picture(seen.time, &[seen.eyes[0]]).save(&folder.join(format!("{index}_mono.png")));
    }
}
