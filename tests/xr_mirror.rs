//! A window beside the headset: it shows what an eye sees, and whatever happens to it costs the headset nothing.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use support::monado::{Compositor, Devices, Service, Settings};
use support::picture::Picture;
use support::program::Said;
use support::remote::{Body, Pose, Remote};
use support::xvfb::Xvfb;

const TITLE: &str = "Swell: mirror";
const PATIENCE: Duration = Duration::from_secs(120);

/// A sea without wind under a head that keeps still: every frame is the same picture.
fn motionless(folder: &Path) -> PathBuf {
    let file = folder.join("motionless.toml");
    fs::write(&file, "[sea]\nwind_speed = 0.0\nresolution = 32\n[[buoy]]\nat = [0.5, -4.0]\nradius = 0.4\n")
        .unwrap();
    file
}

fn still_head() -> Service {
    Service::start(Settings { devices: Devices::Remote, ..Settings::default() })
}

fn looking_down(_: f32) -> Body {
    Body { head: Pose::at(0.0, 1.6, 0.0), ..Body::standing() }
}

/// A run that goes on while the test looks on.
struct Running(std::process::Child);

fn start(command: &mut Command) -> Running {
    Running(command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap())
}

impl Running {
    fn end(self) -> Said {
        let output = self.0.wait_with_output().unwrap();
        let text = |bytes| String::from_utf8_lossy(bytes).into_owned();
        Said { status: output.status.code(), out: text(&output.stdout), err: text(&output.stderr) }
    }
}

fn wait_until(what: &str, mut is_so: impl FnMut() -> bool) {
    let started = Instant::now();
    while !is_so() {
        assert!(started.elapsed() < PATIENCE, "{what}: not after {PATIENCE:?}");
        std::thread::sleep(Duration::from_millis(50));
    }
}

/// Lines of a frame log so far that say that a frame was shown.
fn shown(log: &Path) -> usize {
    fs::read_to_string(log).unwrap_or_default().matches("\"shown\":true").count()
}

#[test]
fn the_mirror_is_what_the_eye_sees() {
    let (screen, service) = (Xvfb::start([800, 600]), still_head());
    let _remote = Remote::start(&service, looking_down);
    let scene = motionless(service.folder());
    for (mirror, views) in [("right", 1), ("both", 2)] {
        let kept = service.folder().join(format!("{mirror}.png"));
        let size = format!("{}x240", 320 * views);
        let arguments = ["run", "--xr", "--validate", "--frames", "40", "--mirror", mirror, "--size", &size];
        let mut command = service.swell();
        command.args(arguments).arg("--scene").arg(&scene).arg("--screenshot").arg(&kept);
        let running = start(screen.show(&mut command));
        let seen = screen.window(TITLE);
        wait_until("the mirror shows something", || seen.is_shown() && seen.picture().colours() > 1000);
        let mirrored = seen.picture();
        let said = running.end();
        assert_eq!(said.status, Some(0), "{said:?}");
        assert!(!said.err.contains("validation: "), "{said:?}");
        let eye = Picture::load(&kept);
        assert_eq!(eye.size, [320 * views, 240]);
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("xr_mirror");
        mirrored.save(&folder.join(format!("{mirror}_mirror.png")));
        eye.save(&folder.join(format!("{mirror}_eye.png")));
        assert_eq!(mirrored.size, eye.size);
        let difference = mirrored.difference(&eye);
        println!("{mirror}: mean {}, 99th percentile {}", difference.mean, difference.high);
        assert!(difference.mean < 1e-4 && difference.high < 1e-3, "{} {}", difference.mean, difference.high);
    }
}

#[test]
fn a_mirror_minimised_resized_and_closed_costs_no_frame() {
    let (screen, service) = (Xvfb::start([800, 600]), still_head());
    let _remote = Remote::start(&service, looking_down);
    let scene = motionless(service.folder());
    let log = service.folder().join("frames.jsonl");
    let mut command = service.swell();
    let arguments =
        ["run", "--xr", "--validate", "--frames", "150", "--xr-scale", "0.2", "--size", "320x240"];
    command.args(arguments).arg("--scene").arg(&scene).arg("--frame-log").arg(&log);
    let running = start(screen.show(&mut command));
    let mirror = screen.window(TITLE);
    wait_until("the mirror shows something", || mirror.is_shown() && mirror.picture().colours() > 100);
    let frames_go_on = || {
        let before = shown(&log);
        // The log is written in blocks of some frames.
        wait_until("the headset goes on", || shown(&log) > before + 15);
    };
    mirror.minimise();
    frames_go_on();
    mirror.restore();
    for size in [[100, 80], [700, 500], [1, 1], [320, 240]] {
        mirror.resize(size);
        std::thread::sleep(Duration::from_millis(100));
    }
    frames_go_on();
    mirror.close();
    let said = running.end();
    assert_eq!(said.status, Some(0), "{said:?}");
    assert!(said.err.contains("the mirror ends, the headset goes on: its window was closed"), "{said:?}");
    assert!(!said.err.contains("validation: "), "{said:?}");
    assert!(said.err.contains("150 frames shown"), "{said:?}");
    assert_eq!(shown(&log), 150);
}

#[test]
fn a_compositor_that_shows_it_shows_a_sea_to_each_eye() {
    let (screen, desk) = (Xvfb::start([640, 360]), Xvfb::start([700, 400]));
    let compositor = Compositor::Window { display: screen.display().to_owned() };
    let service = Service::start(Settings { compositor, ..Settings::default() });
    let mut command = service.swell();
    let arguments = ["run", "--xr", "--validate", "--frames", "60", "--mirror", "both", "--size", "640x240"];
    let running = start(desk.show(command.args(arguments).args(["--xr-scale", "0.4"])));
    let half = |picture: &Picture, view| picture.part(view, 2);
    let is_sea = |view: &Picture| {
        let mean = |rows: std::ops::Range<u32>| {
            let [width, _] = view.size;
            let pixels = rows.clone().flat_map(|y| (width / 4..width * 3 / 4).map(move |x| (x, y)));
            let sum: u64 = pixels.map(|(x, y)| view.pixel(x, y).map(u64::from).iter().sum::<u64>()).sum();
            sum as f64 / f64::from(width / 2 * (rows.end - rows.start)) / 3.0
        };
        let height = view.size[1];
        view.colours() > 1000 && mean(height / 4..height * 2 / 5) > 1.5 * mean(height * 3 / 5..height * 3 / 4)
    };
    let composed = screen.screenshot_when(|picture| [0, 1].iter().all(|&view| is_sea(&half(picture, view))));
    let mirrored = desk.screenshot_when(|picture| picture.colours() > 1000);
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("xr_mirror");
    composed.save(&folder.join("compositor.png"));
    mirrored.save(&folder.join("window.png"));
    let said = running.end();
    assert_eq!(said.status, Some(0), "{said:?}");
    assert!(!said.err.contains("validation: "), "{said:?}");
    assert!(half(&composed, 0).difference(&half(&composed, 1)).mean > 0.01, "both eyes see the same");
}
