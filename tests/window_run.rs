//! `swell run` in a window: what is on the screen, what keys do, and how it ends.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic")]
mod support;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};
use support::picture::Picture;
use support::program::{Said, names, run, swell};
use support::random::Random;
use support::xvfb::{ESCAPE, F1, Window, Xvfb};
use tempfile::TempDir;

const SIZE: [u32; 2] = [320, 200];
/// Long, for a busy machine: nobody waits for it unless something is wrong.
const PATIENCE: Duration = Duration::from_secs(120);

/// `swell run` in a folder of its own; validation listens.
struct Running {
    child: Child,
    folder: TempDir,
}

impl Running {
    fn start(screen: &Xvfb, more: &[&str]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mut command = swell();
        command.args([
            "run",
            "--validate",
            "--quality",
            "low",
            "--size",
            &format!("{}x{}", SIZE[0], SIZE[1]),
        ]);
        command.args(more).current_dir(&folder).stdout(Stdio::piped()).stderr(Stdio::piped());
        Self { child: screen.show(&mut command).spawn().unwrap(), folder }
    }

    fn signal(&self, signal: Signal) {
        kill(Pid::from_raw(self.child.id().try_into().unwrap()), signal).unwrap();
    }

    /// How it ended, which it has been given a reason to do.
    fn end(mut self) -> Said {
        let started = Instant::now();
        while self.child.try_wait().unwrap().is_none() {
            if started.elapsed() > PATIENCE {
                self.signal(Signal::SIGABRT);
                panic!("it does not end: {:?}", self.child.wait_with_output());
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        let output = self.child.wait_with_output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Said { status: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
    }

    fn ends_quietly(self) {
        let said = self.end();
        assert_eq!((said.status, said.out.as_str(), said.err.as_str()), (Some(0), "", ""));
    }
}

fn mean(picture: &Picture, rows: std::ops::Range<u32>) -> [f64; 3] {
    let row = 3 * picture.size[0] as usize;
    let part = &picture.rgb[rows.start as usize * row..rows.end as usize * row];
    [0, 1, 2].map(|channel| {
        let values = part.iter().skip(channel).step_by(3);
        values.clone().map(|&value| f64::from(value)).sum::<f64>() / values.count() as f64
    })
}

/// The flagship's picture: a bright smooth sky over darker water of many colours, and a level line between.
fn is_the_sea(picture: &Picture) -> bool {
    let [width, height] = picture.size;
    let (sky, water) = (mean(picture, 0..height / 4), mean(picture, 3 * height / 4..height));
    let row = |y: u32| mean(picture, y..y + 1)[0];
    let horizon = (1..height).find(|&y| row(y - 1) - row(y) > 8.0);
    let level = horizon.is_some_and(|y| y.abs_diff(height * 11 / 25) <= 2);
    let colours = picture.colours() as u32 > width * height / 60;
    level && colours && sky[0] > water[0] + 30.0 && sky[2] > water[2] + 30.0
}

fn whole(window: &Window<'_>) -> Picture {
    window.picture()
}

/// Waits for the sea in `window`.
fn sea_in(screen: &Xvfb, window: &Window<'_>) -> Picture {
    screen.screenshot_when(|_| is_the_sea(&whole(window)));
    whole(window)
}

#[test]
fn it_shows_the_sea_and_closing_it_ends_in_order() {
    let screen = Xvfb::start([400, 300]);
    let running = Running::start(&screen, &[]);
    let window = screen.window("Swell");
    assert_eq!(window.frame().1, SIZE);
    let picture = sea_in(&screen, &window);
    picture.save(&Path::new(env!("CARGO_TARGET_TMPDIR")).join("window.png"));
    window.close();
    running.ends_quietly();
    assert_eq!(screen.titles(), [""; 0], "no window is left");
}

/// The lines of a log.
fn lines(log: &Path) -> Vec<serde_json::Value> {
    let text = std::fs::read_to_string(log).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn so_many_frames_a_log_and_the_last_picture() {
    let screen = Xvfb::start([400, 300]);
    let folder = tempfile::tempdir().unwrap();
    let [last, log] = ["last.png", "log.jsonl"].map(|name| folder.path().join(name));
    let [to_last, to_log] = [&last, &log].map(|path| path.to_str().unwrap());
    let more = ["--frames", "30", "--screenshot", to_last, "--frame-log", to_log];
    Running::start(&screen, &more).ends_quietly();
    assert_eq!(names(folder.path()), ["last.png", "log.jsonl"]);
    let picture = Picture::load(&last);
    assert!(picture.size == SIZE && is_the_sea(&picture));
    let frames = lines(&log);
    assert_eq!(frames.len(), 30);
    let mut before = -1.0;
    for (index, frame) in frames.iter().enumerate() {
        let number = |key: &str| frame[key].as_f64().unwrap();
        assert_eq!(number("index"), index as f64);
        assert!(number("time") > before && (index > 0 || number("time") == 0.0), "time goes on from 0");
        before = number("time");
        for key in ["draws", "patches", "triangles", "uploaded"] {
            assert!(number(key) > 0.0, "{key} {frame}");
        }
    }
}

#[test]
fn the_sea_stands_still_while_nobody_can_see_it() {
    let screen = Xvfb::start([400, 300]);
    let running = Running::start(&screen, &["--frame-log", "log.jsonl"]);
    let log = running.folder.path().join("log.jsonl");
    let window = screen.window("Swell");
    sea_in(&screen, &window);
    window.focus();
    window.minimise();
    std::thread::sleep(Duration::from_secs(3));
    window.restore();
    window.focus();
    sea_in(&screen, &window);
    window.close();
    let Running { child, folder } = running;
    Running { child, folder: tempfile::tempdir().unwrap() }.ends_quietly();
    let frames = lines(&log);
    drop(folder);
    let number = |index: usize, key: &str| frames[index][key].as_f64().unwrap();
    let longest =
        (1..frames.len()).max_by(|&a, &b| number(a, "milliseconds").total_cmp(&number(b, "milliseconds")));
    let longest = longest.unwrap();
    assert!(number(longest, "milliseconds") > 1500.0, "it went on drawing: {}", frames[longest]);
    let step = number(longest + 1, "time") - number(longest, "time");
    assert!(step < 1.0, "the sea moved {step} s on: {}", frames[longest]);
}

#[test]
fn any_size_at_any_moment() {
    let screen = Xvfb::start([700, 500]);
    let running = Running::start(&screen, &[]);
    let window = screen.window("Swell");
    sea_in(&screen, &window);
    let mut random = Random(7);
    let mut side = |most: u32| random.between(1.0, f64::from(most)) as u32;
    for round in 0..200 {
        window.resize([side(640), side(440)]);
        // Now and then in the middle of a frame, now and then many for one frame.
        std::thread::sleep(Duration::from_millis(u64::from(side(30))));
        if round % 20 == 19 {
            window.minimise();
            std::thread::sleep(Duration::from_millis(u64::from(side(100))));
            window.restore();
        }
    }
    window.resize([333, 222]);
    let picture = sea_in(&screen, &window);
    assert_eq!(picture.size, [333, 222]);
    let outside = screen.screenshot();
    assert_eq!(outside.pixel(699, 499), [0; 3]);
    window.close();
    running.ends_quietly();
}

#[test]
fn a_kept_picture_is_what_was_on_the_screen() {
    let screen = Xvfb::start([400, 300]);
    let running = Running::start(&screen, &[]);
    let window = screen.window("Swell");
    sea_in(&screen, &window);
    window.focus();
    let mut shown = vec![whole(&window)];
    for down in [true, false] {
        screen.key(u32::from(b'p'), down);
    }
    let file = running.folder.path().join("swell_0000.png");
    let started = Instant::now();
    // The picture kept is the last that was drawn; it may be on the screen before the file is there, or after.
    let mut kept = None;
    while !kept.as_ref().is_some_and(|kept| shown.contains(kept)) {
        assert!(started.elapsed() < PATIENCE, "not one of {} pictures that were on the screen", shown.len());
        let now = whole(&window);
        if shown.last() != Some(&now) {
            shown.push(now);
        }
        if kept.is_none() && file.exists() {
            kept = Some(Picture::load(&file));
        }
    }
    running.signal(Signal::SIGTERM);
    let said = running.end();
    assert_eq!((said.status, said.err.as_str()), (Some(0), "swell_0000.png\n"));
}

#[test]
fn keys_change_looks_viewer_and_title() {
    let screen = Xvfb::start([400, 300]);
    let running = Running::start(&screen, &[]);
    let window = screen.window("Swell");
    let sea = sea_in(&screen, &window);
    window.focus();
    let press = |key: u32| {
        screen.key(key, true);
        screen.key(key, false);
    };
    let letter = |letter: u8| press(u32::from(letter));
    let unlike = |wanted: f32| screen.screenshot_when(|_| whole(&window).difference(&sea).mean > wanted);
    for look in [1, 2, 3, 4, 5, 6] {
        press(F1 + look);
        unlike(0.15);
    }
    press(F1);
    sea_in(&screen, &window);

    letter(b't');
    let started = Instant::now();
    while !screen.titles().iter().any(|title| title.contains("frames/s") && title.contains("triangles")) {
        assert!(started.elapsed() < PATIENCE, "titles: {:?}", screen.titles());
        std::thread::sleep(Duration::from_millis(20));
    }
    letter(b't');
    let started = Instant::now();
    while screen.titles() != ["Swell"] {
        assert!(started.elapsed() < PATIENCE, "titles: {:?}", screen.titles());
        std::thread::sleep(Duration::from_millis(20));
    }

    // Looking up by dragging: sky and no water. And back.
    screen.point(160, 100);
    screen.button(1, true);
    for y in (0..=90).rev().step_by(10) {
        screen.point(160, y);
    }
    screen.button(1, false);
    screen.point(160, 180);
    screen.button(1, true);
    for y in (0..=180).rev().step_by(10) {
        screen.point(160, y);
    }
    screen.button(1, false);
    screen.screenshot_when(|_| !is_the_sea(&whole(&window)));
    letter(b'r');
    sea_in(&screen, &window);
    letter(b'o');
    screen.key(u32::from(b'w'), true);
    std::thread::sleep(Duration::from_millis(300));
    screen.key(u32::from(b'w'), false);
    letter(b'r');
    sea_in(&screen, &window);
    press(ESCAPE);
    running.ends_quietly();
}

#[test]
fn whoever_stops_it_gets_an_orderly_end() {
    let screen = Xvfb::start([400, 300]);
    let running = Running::start(&screen, &[]);
    sea_in(&screen, &screen.window("Swell"));
    running.signal(Signal::SIGINT);
    running.ends_quietly();

    let running = Running::start(&screen, &["--frames", "100000"]);
    sea_in(&screen, &screen.window("Swell"));
    running.signal(Signal::SIGTERM);
    running.end().fails_with(1, &["ended after", "of 100000 frames"]);
}

#[test]
fn a_display_that_goes_away_ends_it_with_one_line() {
    let screen = Xvfb::start([400, 300]);
    let running = Running::start(&screen, &[]);
    sea_in(&screen, &screen.window("Swell"));
    drop(screen);
    // Who notices first says so: the X library, winit or Vulkan.
    running.end().fails_with(1, &[]);
}

#[test]
fn without_a_display_a_clip_is_rendered() {
    let folder = tempfile::tempdir().unwrap();
    let clip = |display: Option<&str>| {
        let mut command = swell();
        command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
        // Nor a headset.
        command
            .env_remove("SWELL_XR")
            .env("XR_RUNTIME_JSON", "/there/is/none.json")
            .env("XR_LOADER_DEBUG", "none");
        command.args([
            "run",
            "--size",
            "32x24",
            "--frames",
            "2",
            "--out",
            "clip",
            "--screenshot",
            "last.png",
        ]);
        command.envs(display.map(|display| ("DISPLAY", display))).current_dir(&folder);
        run(&mut command)
    };
    for display in [None, Some(":987")] {
        let said = clip(display);
        assert_eq!((said.status, said.out.as_str()), (Some(0), "clip\n"), "{said:?}");
        let first = said.err.lines().next().unwrap();
        assert!(first.starts_with("no display (") && first.ends_with("rendering a clip instead"), "{first}");
        assert_eq!(names(folder.path()), ["clip", "last.png"]);
        assert_eq!(names(&folder.path().join("clip")), ["frame_0000.png", "frame_0001.png"]);
        let [last, frame] = ["last.png", "clip/frame_0001.png"].map(|name| folder.path().join(name));
        assert!(Picture::load(&last) == Picture::load(&frame));
    }
}
