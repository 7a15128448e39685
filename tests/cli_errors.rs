//! A wrong command line, scene or place to write: one line that says which, what was given and what is allowed.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use std::fs;
use std::path::Path;
use std::process::Command;
use support::program::{SWELL, Said, names, run, swell, swell_alone};
use tempfile::tempdir;

const SMALL: [&str; 2] = ["--size", "64x36"];

fn render(out: &Path, arguments: &[&str]) -> Said {
    run(swell().arg("render").arg("--out").arg(out).args(arguments))
}

/// What `render` says of a scene file with this text, and that it wrote nothing.
fn says_of_scene(text: &str, words: &[&str]) {
    let folder = tempdir().unwrap();
    let file = folder.path().join("broken.toml");
    fs::write(&file, text).unwrap();
    for command in ["render", "bake"] {
        let out = folder.path().join("out");
        let said = run(swell_alone().arg(command).arg("--scene").arg(&file).arg("--out").arg(&out));
        said.fails_with(2, words);
        said.fails_with(2, &["broken.toml"]);
        assert_eq!(names(folder.path()), ["broken.toml"], "{said:?}");
    }
}

#[test]
fn broken_scenes_are_told_with_place_value_and_range() {
    says_of_scene("[sea]\nwind_sped = 3\n", &[":2:1:", "wind_sped"]);
    says_of_scene("[sea]\nwind_speed = 'strong'\n", &[":2:14:", "wind_speed", "strong"]);
    says_of_scene("[sea]\n\nwind_speed = 61\n", &[":3:14:", "wind_speed", "61", "0 to 60 m/s"]);
    says_of_scene("[sea]\nwind_speed = nan\n", &[":2:14:", "wind_speed", "nan", "not a finite number"]);
    says_of_scene("[sea]\nwind_speed = -inf\n", &[":2:14:", "wind_speed", "-inf", "not a finite number"]);
    says_of_scene("[sea]\nresolution = 100\n", &[":2:14:", "resolution", "100", "power of two", "16 to 512"]);
    says_of_scene("[sea]\nresolution = 1024\n", &[":2:14:", "resolution", "1024", "16 to 512"]);
    says_of_scene("[lod]\nquality = 'best'\n", &[":2:11:", "quality", "best", "ultra"]);
    says_of_scene("[sky]\nmodel = 'cubemap'\nfile = 'none.png'\n", &[":3:8:", "file", "none.png"]);
    says_of_scene("[sea\n", &[":1:"]);
    says_of_scene("[camera]\neye = [1, 2]\n", &[":2:7:", "eye"]);
}

#[test]
fn a_missing_scene_is_told_by_name() {
    let folder = tempdir().unwrap();
    for command in ["render", "bake"] {
        run(swell_alone().args([command, "--scene", "no/such.toml", "--out"]).arg(folder.path().join("out")))
            .fails_with(2, &["no/such.toml", "cannot read", "--scene"]);
    }
    assert!(names(folder.path()).is_empty());
}

#[test]
fn wrong_options_are_told_with_value_and_range() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("out.png");
    let says = |arguments: &[&str], words: &[&str]| {
        render(&out, arguments).fails_with(2, words);
        assert!(names(folder.path()).is_empty(), "{arguments:?}");
    };
    says(&["--size", "0x5"], &["--size", "0x5", "1 to 16384"]);
    says(&["--size", "20000x5"], &["--size", "20000x5", "1 to 16384"]);
    says(&["--size", "wide"], &["--size", "wide"]);
    says(&["--frames", "5..5"], &["--frames", "5..5", "holds no frame"]);
    says(&["--frames", "0"], &["--frames", "holds no frame"]);
    says(&["--frames", "many"], &["--frames", "many"]);
    says(&["--frames", "2"], &["out.png", "--frames 1"]);
    says(&["--fps", "nan"], &["NaN", "frames a second", "0.001 to 10000"]);
    says(&["--fps", "0"], &["0", "frames a second", "0.001 to 10000"]);
    says(&["--start", "1e10"], &["start", "10000000000", "-1e9 to 1e9"]);
    says(&["--debug", "nonsense"], &["--debug", "nonsense", "wireframe", "holes"]);
    says(&["--eye", "1,2"], &["--eye", "1,2", "-1e9 to 1e9"]);
    says(&["--eye", "1,2,nan"], &["--eye", "nan", "-1e9 to 1e9"]);
    says(&["--eye", "1,2,3", "--look", "1,2,3"], &["--look", "--eye", "1,2,3"]);
    says(&["--threads", "1000000"], &["--threads", "1000000", "1024"]);
    says(&["--colour", "red"], &["--colour"]);
}

#[test]
fn heights_need_their_view() {
    let folder = tempdir().unwrap();
    render(&folder.path().join("out.exr"), &SMALL).fails_with(2, &["out.exr", "--debug height"]);
    assert!(names(folder.path()).is_empty());
}

#[test]
fn an_unknown_device_is_told_with_those_there_are() {
    let folder = tempdir().unwrap();
    let said = render(&folder.path().join("out.png"), &["--device", "Voodoo 2"]);
    said.fails_with(1, &["--device", "Voodoo 2", "there are: "]);
    assert!(names(folder.path()).is_empty());
}

#[test]
fn a_place_below_a_file_is_told() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("file"), b"").unwrap();
    for out in ["file/below", "file/below.png"] {
        render(&folder.path().join(out), &SMALL).fails_with(1, &["cannot make the folder", "file", "--out"]);
    }
    run(swell_alone().args(["bake", "--out"]).arg(folder.path().join("file/below")))
        .fails_with(1, &["cannot make the folder", "file/below", "--out"]);
    render(&folder.path().join("file"), &["--size", "64x36", "--frames", "2"])
        .fails_with(2, &["file", "name a folder"]);
    assert_eq!(names(folder.path()), ["file"]);
}

#[test]
fn without_room_nothing_is_half_written() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("bake");
    // Files limited to 8 KiB are seen as a full disk is: as an error of the system in the middle of writing.
    let mut cramped = Command::new("bash");
    cramped.args(["-c", "trap '' XFSZ; ulimit -f 8; exec \"$@\"", "bash", SWELL, "bake", "--out"]);
    run(cramped.arg(&out)).fails_with(1, &["cannot write", "_0_0000.npy", "make room"]);
    assert!(names(&out).iter().all(|name| name == "bake.json"), "{:?}", names(&out));
}

#[test]
fn a_picture_that_cannot_get_its_name_leaves_nothing() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("picture.png");
    fs::create_dir(&out).unwrap();
    let said = render(&out, &SMALL);
    assert_eq!(said.status, Some(1), "{said:?}");
    assert!(said.err.contains("cannot write") && said.err.contains("picture.png"), "{said:?}");
    assert_eq!(names(folder.path()), ["picture.png"]);
}

#[test]
fn answers_that_nobody_takes_are_an_error() {
    let full = fs::File::options().write(true).open("/dev/full").unwrap();
    run(swell_alone().args(["query", "--time", "1", "--at", "1,2"]).stdout(full))
        .fails_with(1, &["cannot write the answers"]);
}
