//! `swell bake`: the same bytes whatever the threads and however often it was killed.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;
use support::program::{names, run, swell_alone};
use support::random::Random;
use tempfile::tempdir;

const SCENE: &str =
    "[sea]\nresolution = 128\n[[sea.cascade]]\npatch_size = 400\n[[sea.cascade]]\npatch_size = 61\n";

fn bake(scene: &Path, out: &Path, arguments: &[&str]) -> std::process::Command {
    let mut command = swell_alone();
    command.arg("bake").arg("--scene").arg(scene).arg("--out").arg(out).args(arguments);
    command
}

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    names(folder).into_iter().map(|name| (name.clone(), fs::read(folder.join(name)).unwrap())).collect()
}

#[test]
fn twice_and_with_other_threads_the_bytes_are_the_same() {
    let folder = tempdir().unwrap();
    // The flagship, as everybody bakes it first.
    let bakes: Vec<_> = [("a", "1"), ("b", "2"), ("c", "2")]
        .into_iter()
        .map(|(name, threads)| {
            let out = folder.path().join(name);
            let said =
                run(swell_alone().args(["bake", "--frames", "8", "--threads", threads, "--out"]).arg(&out));
            assert_eq!(said.status, Some(0), "{said:?}");
            files(&out)
        })
        .collect();
    assert_eq!(bakes[0].len(), 1 + 8 * 3 * 2);
    assert!(bakes[0] == bakes[1], "one thread and two differ");
    assert!(bakes[1] == bakes[2], "two runs differ");
}

#[test]
fn a_bake_that_is_killed_again_and_again_ends_as_one_that_was_not() {
    let folder = tempdir().unwrap();
    let scene = folder.path().join("scene.toml");
    fs::write(&scene, SCENE).unwrap();
    let frames = ["--frames", "40"];
    let whole = folder.path().join("whole");
    assert_eq!(run(&mut bake(&scene, &whole, &frames)).status, Some(0));
    let whole = files(&whole);

    let out = folder.path().join("killed");
    let mut random = Random(std::process::id().into());
    let mut interrupted = 0;
    for _ in 0..12 {
        let mut child = bake(&scene, &out, &frames).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(Duration::from_micros(random.between(1e3, 6e4) as u64));
        child.kill().unwrap();
        interrupted += usize::from(!child.wait().unwrap().success());
        for (name, bytes) in files(&out) {
            if let Some(want) = whole.get(&name).filter(|_| name != "bake.json") {
                assert!(bytes == *want, "{name} is not whole");
            } else {
                assert!(name == "bake.json" || name.ends_with(".part"), "{name}");
            }
        }
    }
    println!("{interrupted} of 12 bakes interrupted");
    assert!(interrupted > 0, "no bake was interrupted");
    let said = run(&mut bake(&scene, &out, &frames));
    assert_eq!(said.status, Some(0), "{said:?}");
    let mut ended = files(&out);
    // Parts of bake.json stay for a minute: another process may be writing them.
    ended.retain(|name, _| !(name.starts_with(".bake.json.") && name.ends_with(".part")));
    assert_eq!(ended.keys().collect::<Vec<_>>(), whole.keys().collect::<Vec<_>>());
    assert!(ended == whole, "the bake that was killed differs");
}
