//! A machine that lacks what a headset needs: no loader, no runtime, no display either.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use std::fs;
use std::path::Path;
use std::process::Command;
use support::live::own;
use support::program::{Said, names, run, swell, swell_alone};
use tempfile::TempDir;

const SCENE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/calm.toml");

/// `swell run` where no runtime is installed, and no display.
fn without_runtime(mut command: Command) -> Command {
    for variable in ["SWELL_XR", "DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET", "XR_ENABLE_API_LAYERS"] {
        command.env_remove(variable);
    }
    command.env("XR_RUNTIME_JSON", "/nowhere/runtime.json");
    command.args(["run", "--scene", SCENE, "--threads", "1"]);
    command
}

/// Status 1 and one line of Swell's own, which begins and ends so.
fn fails(said: &Said, begins: &str, ends: &str) {
    let lines = own(&said.err);
    assert!(said.status == Some(1) && said.out.is_empty() && lines.len() == 1, "{said:?}");
    assert!(lines[0].starts_with(begins) && lines[0].ends_with(ends), "{said:?}");
    assert!(!said.err.contains("panicked"), "{said:?}");
}

#[test]
fn no_runtime_is_one_line() {
    let said = run(without_runtime(swell()).args(["--xr", "--mirror", "none"]));
    fails(
        &said,
        "swell: no OpenXR runtime answers (",
        "); start one (Monado: monado-service), or wait for it with --xr-wait",
    );
}

#[test]
fn no_loader_is_one_line_that_names_the_package() {
    // What is found first is no library, whatever the machine has.
    let folder = TempDir::new().unwrap();
    for name in ["libopenxr_loader.so", "libopenxr_loader.so.1"] {
        fs::write(folder.path().join(name), "").unwrap();
    }
    // Waiting would not install it.
    for more in [&["--xr"][..], &["--xr", "--xr-wait"]] {
        let mut command = without_runtime(swell_alone());
        command.env("LD_LIBRARY_PATH", folder.path()).args(["--mirror", "none"]).args(more);
        let end = "; install it (Debian: apt-get install libopenxr-loader1)";
        fails(&run(&mut command), "swell: no OpenXR loader: ", end);
    }
}

#[test]
fn without_display_and_runtime_a_clip_is_rendered() {
    let folder = TempDir::new().unwrap();
    let (out, last) = (folder.path().join("clip"), folder.path().join("last.png"));
    let mut command = without_runtime(swell());
    command.args(["--frames", "2", "--size", "64x48", "--validate", "--out"]).arg(&out);
    let said = run(command.arg("--screenshot").arg(&last));
    assert_eq!(said.status, Some(0), "{said:?}");
    assert_eq!(Path::new(said.out.trim_end()), out, "{said:?}");
    let lines: Vec<&str> = said.err.lines().filter(|line| line.starts_with("no display (")).collect();
    let end = ") and no OpenXR runtime with a headset: rendering a clip instead";
    assert!(lines.len() == 1 && lines[0].ends_with(end), "{said:?}");
    assert_eq!(names(&out), ["frame_0000.png", "frame_0001.png"]);
    assert_eq!(fs::read(&last).unwrap(), fs::read(out.join("frame_0001.png")).unwrap());
}
