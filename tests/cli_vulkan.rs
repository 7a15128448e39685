//! What the program says where Vulkan, or a part of it, is missing; and that a whole run pleases the validation layers.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use std::fs;
use std::process::{Command, Stdio};
use support::picture::Picture;
use support::program::{SWELL, names, run, swell, swell_alone};
use support::stage::{Stage, shipped};
use swell::draw::Look;
use tempfile::tempdir;

#[test]
fn without_a_loader_one_line_says_what_to_install() {
    let folder = tempdir().unwrap();
    // Should the machine have a loader, the search for libraries ends here, at a file that is none.
    for name in ["libvulkan.so.1", "libvulkan.so"] {
        fs::write(folder.path().join(name), b"").unwrap();
    }
    let out = folder.path().join("picture.png");
    run(swell_alone().env("LD_LIBRARY_PATH", folder.path()).arg("render").arg("--out").arg(&out))
        .fails_with(1, &["no Vulkan loader", "install", "libvulkan1"]);
    assert!(!out.exists());
    // What needs none works.
    let said = run(swell_alone()
        .env("LD_LIBRARY_PATH", folder.path())
        .args(["query", "--time", "1", "--at", "1,2"]));
    assert_eq!(said.status, Some(0), "{said:?}");
}

/// `swell` in the environment that the runner made for this test, so that parts of it can be changed: the runner
/// itself would set them anew. Under the sysroot the words before the test's own name start its dynamic loader.
fn swell_in_this_environment() -> Command {
    let line = fs::read("/proc/self/cmdline").unwrap();
    let words = line.split(|&byte| byte == 0).map(|word| String::from_utf8(word.to_vec()).unwrap());
    let is_test = |word: &String| word.rsplit('/').next().is_some_and(|name| name.starts_with("cli_vulkan-"));
    let mut words: Vec<String> = words.take_while(|word| !is_test(word)).collect();
    words.push(SWELL.to_owned());
    let mut command = Command::new(&words[0]);
    command.args(&words[1..]).env("XDG_CACHE_HOME", env!("CARGO_TARGET_TMPDIR")).stdin(Stdio::null());
    command
}

#[test]
fn without_a_driver_one_line_says_what_to_install() {
    let folder = tempdir().unwrap();
    let none = folder.path().join("none.json");
    let out = folder.path().join("picture.png");
    let mut command = swell_in_this_environment();
    command.env("VK_DRIVER_FILES", &none).env("VK_ICD_FILENAMES", &none);
    run(command.args(["render", "--size", "64x36", "--out"]).arg(&out))
        .fails_with(1, &["no usable Vulkan device", "driver", "mesa-vulkan-drivers"]);
    assert!(!out.exists());
}

#[test]
fn without_the_validation_layer_one_line_says_what_to_install() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("picture.png");
    let mut command = swell_in_this_environment();
    command.env("VK_LAYER_PATH", folder.path());
    run(command.args(["render", "--size", "64x36", "--validate", "--out"]).arg(&out))
        .fails_with(1, &["VK_LAYER_KHRONOS_validation", "not installed", "vulkan-validationlayers"]);
    assert!(!out.exists());
    // Where nobody asks for it, it is not missed.
    let mut command = swell_in_this_environment();
    command.env("VK_LAYER_PATH", folder.path());
    let said = run(command.args(["render", "--size", "64x36", "--out"]).arg(&out));
    assert_eq!(said.status, Some(0), "{said:?}");
}

#[test]
fn a_whole_run_pleases_the_validation_layers() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("clip");
    let arguments = ["render", "--validate", "--stereo", "--frames", "5", "--size", "64x48", "--out"];
    let said = run(swell().args(arguments).arg(&out));
    assert_eq!(said.status, Some(0), "{said:?}");
    // What is said while all is taken down comes too late for the exit status.
    assert!(!said.err.contains("validation:"), "{said:?}");
    let frames: Vec<String> = (0..5).map(|i| format!("frame_{i:04}.png")).collect();
    assert_eq!(names(&out), frames);
    let [first, last] = [0, 4].map(|i| Picture::load(&out.join(&frames[i])));
    assert_eq!(first.size, [128, 48]);
    assert!(first != last, "nothing moves");
}

#[test]
fn the_program_draws_what_the_library_draws() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("picture.png");
    let arguments = ["render", "--validate", "--start", "12.5", "--size", "160x90", "--out"];
    let said = run(swell().args(arguments).arg(&out));
    assert_eq!(said.status, Some(0), "{said:?}");
    let drawn = Stage::new(&shipped("open_ocean"), [160, 90], 1, Look::Water, 12.5).picture(12.5, &[]);
    let difference = drawn.difference(&Picture::load(&out));
    assert!(difference.mean < 1e-4 && difference.high < 1e-2, "{} {}", difference.mean, difference.high);
}
