//! The panel in a window, and files that change while it is open: scenes and shaders.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic")]
mod support;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};
use support::limit::Limit;
use support::picture::Picture;
use support::program::{Said, names, swell};
use support::xvfb::{F1, Window, Xvfb};
use tempfile::TempDir;

const SIZE: [u32; 2] = [640, 400];
const F10: u32 = F1 + 9;
/// Long, for a busy machine: nobody waits for it unless something is wrong.
const PATIENCE: Duration = Duration::from_secs(180);

fn project(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// `swell run` on a copy of a scene; validation listens.
struct Running {
    child: Child,
    folder: TempDir,
}

impl Running {
    fn start(screen: &Xvfb, folder: TempDir, more: &[&str]) -> Self {
        fs::copy(project("scenes/calm.toml"), folder.path().join("scene.toml")).unwrap();
        let mut command = swell();
        let size = format!("{}x{}", SIZE[0], SIZE[1]);
        command.args(["run", "--validate", "--quality", "low", "--scene", "scene.toml", "--size", &size]);
        command.args(more).current_dir(&folder).stdout(Stdio::piped()).stderr(Stdio::piped());
        Self { child: screen.show(&mut command).spawn().unwrap(), folder }
    }

    fn scene(&self) -> PathBuf {
        self.folder.path().join("scene.toml")
    }

    /// Replaced at once, as editors do.
    fn write_scene(&self, text: &str) {
        let aside = self.folder.path().join("aside");
        fs::write(&aside, text).unwrap();
        fs::rename(&aside, self.scene()).unwrap();
    }

    /// How it ended, which it has been given a reason to do.
    fn end(mut self) -> (Said, TempDir) {
        let started = Instant::now();
        while self.child.try_wait().unwrap().is_none() {
            if started.elapsed() > PATIENCE {
                kill(Pid::from_raw(self.child.id().try_into().unwrap()), Signal::SIGABRT).unwrap();
                panic!("it does not end: {:?}", self.child.wait_with_output());
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        let output = self.child.wait_with_output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (
            Said { status: output.status.code(), out: text(output.stdout), err: text(output.stderr) },
            self.folder,
        )
    }
}

/// Mean brightness of the rectangle from (x0, y0) to (x1, y1), each a share of the picture.
fn mean(picture: &Picture, [x0, y0, x1, y1]: [f64; 4]) -> [f64; 3] {
    let at = |share: f64, side: u32| (share * f64::from(side)) as u32;
    let (mut sum, mut count) = ([0.0; 3], 0.0);
    for y in at(y0, picture.size[1])..at(y1, picture.size[1]) {
        for x in at(x0, picture.size[0])..at(x1, picture.size[0]) {
            let pixel = picture.pixel(x, y);
            sum = [0, 1, 2].map(|part| sum[part] + f64::from(pixel[part]));
            count += 1.0;
        }
    }
    sum.map(|part| part / count)
}

const SKY: [f64; 4] = [0.0, 0.0, 0.3, 0.2];
/// Where the panel is.
const RIGHT: [f64; 4] = [0.6, 0.0, 0.99, 0.9];

fn wait(screen: &Xvfb, window: &Window<'_>, is_right: impl Fn(&Picture) -> bool) {
    screen.screenshot_when(|_| is_right(&window.picture()));
}

fn bright(picture: &Picture, part: [f64; 4]) -> f64 {
    mean(picture, part).iter().sum::<f64>() / 3.0
}

#[test]
fn a_key_shows_the_panel_and_hides_it() {
    let screen = Xvfb::start([700, 450]);
    let running = Running::start(&screen, tempfile::tempdir().unwrap(), &[]);
    let window = screen.window("Swell");
    wait(&screen, &window, |picture| bright(picture, RIGHT) > 80.0);
    window.focus();
    let press = |key: u32| {
        screen.key(key, true);
        screen.key(key, false);
    };
    press(F10);
    wait(&screen, &window, |picture| bright(picture, RIGHT) < 60.0);
    window.picture().save(&Path::new(env!("CARGO_TARGET_TMPDIR")).join("panel.png"));
    press(F10);
    wait(&screen, &window, |picture| bright(picture, RIGHT) > 80.0);
    window.close();
    let (said, folder) = running.end();
    assert_eq!((said.status, said.out.as_str(), said.err.as_str()), (Some(0), "", ""));
    let text = fs::read_to_string(folder.path().join("scene.toml")).unwrap();
    assert_eq!(text, fs::read_to_string(project("scenes/calm.toml")).unwrap(), "nothing was saved");
}

/// The row of the horizon, left of the panel, where there is one.
fn horizon(picture: &Picture) -> Option<u32> {
    let row = |y: u32| -> f64 {
        let left = (0..picture.size[0] / 5).map(|x| picture.pixel(x, y));
        left.map(|pixel| pixel.iter().map(|&part| f64::from(part)).sum::<f64>()).sum::<f64>()
    };
    let fall = |y: u32| (row(y - 1) - row(y)) / f64::from(picture.size[0] / 5 * 3);
    (1..picture.size[1]).find(|&y| fall(y) > 8.0)
}

#[test]
fn a_pull_that_begins_on_the_panel_turns_no_view() {
    let screen = Xvfb::start([700, 450]);
    let limit = Limit::new(screen.id(), 2 * PATIENCE);
    limit.now("the start of swell");
    let running = Running::start(&screen, tempfile::tempdir().unwrap(), &[]);
    let window = screen.window("Swell");
    limit.now("the first picture");
    wait(&screen, &window, |picture| bright(picture, RIGHT) > 80.0 && horizon(picture).is_some());
    window.focus();
    let press_f10 = || {
        screen.key(F10, true);
        screen.key(F10, false);
    };
    limit.now("the panel's coming");
    screen.point(60, 300);
    press_f10();
    wait(&screen, &window, |picture| bright(picture, RIGHT) < 60.0);
    let before = horizon(&window.picture()).unwrap();

    // From beside the panel onto it, with the button down at once. Events are taken in order: when the panel has gone, all have been.
    limit.now("a pull on the panel");
    screen.pull([500, 320], [500, 160]);
    press_f10();
    wait(&screen, &window, |picture| bright(picture, RIGHT) > 80.0);
    let picture = window.picture();
    let seen = Path::new(env!("CARGO_TARGET_TMPDIR")).join("pull_on_panel.png");
    picture.save(&seen);
    let after = horizon(&picture);
    assert!(
        after.is_some_and(|after| after.abs_diff(before) <= 2),
        "the horizon was in row {before} and is in {after:?} now: see {}",
        seen.display()
    );

    // The same from the panel to beside it does turn it, though egui thinks that the mouse is on the panel.
    limit.now("the panel's coming again");
    press_f10();
    wait(&screen, &window, |picture| bright(picture, RIGHT) < 60.0);
    limit.now("a pull beside the panel");
    screen.pull([60, 320], [60, 160]);
    wait(&screen, &window, |picture| horizon(picture).is_none_or(|now| now.abs_diff(before) > 20));
    limit.now("the end");
    window.close();
    let (said, _folder) = running.end();
    assert_eq!((said.status, said.out.as_str(), said.err.as_str()), (Some(0), "", ""));
}

#[test]
fn a_scene_that_is_written_is_shown_and_a_broken_one_is_told() {
    let screen = Xvfb::start([700, 450]);
    let running = Running::start(&screen, tempfile::tempdir().unwrap(), &[]);
    let window = screen.window("Swell");
    wait(&screen, &window, |picture| bright(picture, SKY) > 80.0);
    let text = fs::read_to_string(running.scene()).unwrap();
    let dark: String =
        text.lines().filter(|line| !line.starts_with("exposure")).fold(String::new(), |all, line| {
            let more = if line == "[sky]" { "\nexposure = -6.0" } else { "" };
            format!("{all}{line}{more}\n")
        });
    running.write_scene(&dark);
    wait(&screen, &window, |picture| bright(picture, SKY) < 40.0);
    running.write_scene(&dark.replace("exposure = -6.0", "exposure = \"bright\""));
    std::thread::sleep(Duration::from_secs(3));
    assert!(bright(&window.picture(), SKY) < 40.0, "the old one is shown still");
    // Another sea: its spectrum is made while the old one is shown.
    running.write_scene(&text.replace("patch_size", "amplitude = 2.0\npatch_size"));
    wait(&screen, &window, |picture| bright(picture, SKY) > 80.0);
    window.close();
    let (said, _folder) = running.end();
    assert_eq!((said.status, said.out.as_str()), (Some(0), ""));
    let lines: Vec<&str> = said.err.lines().collect();
    assert!(
        matches!(lines[..], [line] if line.contains("sky.exposure") && line.contains("scene.toml:")),
        "{said:?}"
    );
}

#[test]
fn a_shader_that_is_written_is_drawn_with_and_a_broken_one_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let shaders = folder.path().join("shaders");
    fs::create_dir(&shaders).unwrap();
    for entry in fs::read_dir(project("shaders")).unwrap() {
        let path = entry.unwrap().path();
        fs::copy(&path, shaders.join(path.file_name().unwrap())).unwrap();
    }
    let screen = Xvfb::start([700, 450]);
    let running = Running::start(&screen, folder, &["--shaders", "shaders"]);
    let window = screen.window("Swell");
    wait(&screen, &window, |picture| bright(picture, SKY) > 80.0);
    let sky = shaders.join("sky.wgsl");
    let text = fs::read_to_string(&sky).unwrap();
    let entry = text.find("@fragment").unwrap();
    let body = entry + text[entry..].find('{').unwrap() + 1;
    let magenta = format!(
        "{}\n    if frame.tone.x > -1.0 {{ return vec4f(1.0, 0.0, 1.0, 1.0); }}{}",
        &text[..body],
        &text[body..]
    );
    fs::write(&sky, &magenta).unwrap();
    let is_magenta = |picture: &Picture| {
        let [red, green, blue] = mean(picture, SKY);
        red > 200.0 && green < 60.0 && blue > 200.0
    };
    wait(&screen, &window, is_magenta);
    fs::write(&sky, magenta.replace("vec4f(1.0, 0.0, 1.0, 1.0)", "vec3f(1.0, 0.0, 1.0)")).unwrap();
    std::thread::sleep(Duration::from_secs(4));
    assert!(is_magenta(&window.picture()), "the old one is drawn with still");
    fs::write(&sky, &text).unwrap();
    wait(&screen, &window, |picture| !is_magenta(picture));
    window.close();
    let (said, _folder) = running.end();
    assert_eq!((said.status, said.out.as_str()), (Some(0), ""));
    assert!(said.err.contains("sky.wgsl:") && said.err.lines().count() == 1, "{said:?}");
}

#[test]
fn a_session_plays_itself_and_is_recorded() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("frames")).unwrap();
    let script = "panel\nwait 10\ndrag sea.wind_speed 0.1 0.3\nwait 5\nclick sea.model\nchoose waves\nwait 5\n\
                  click preset three waves\nwait 20\nundo\nundo\nwait 20\nclick Save\nwait 5\n";
    fs::write(folder.path().join("session.txt"), script).unwrap();
    let screen = Xvfb::start([700, 450]);
    let running = Running::start(&screen, folder, &["--play", "session.txt", "--record", "frames"]);
    let before = fs::read_to_string(running.scene()).unwrap();
    let (said, folder) = running.end();
    assert_eq!((said.status, said.out.as_str(), said.err.as_str()), (Some(0), "", ""));
    let after = fs::read_to_string(folder.path().join("scene.toml")).unwrap();
    let differing: Vec<_> = before.lines().zip(after.lines()).filter(|(a, b)| a != b).collect();
    assert!(
        matches!(differing[..], [(a, b)] if a.starts_with("wind_speed") && b.starts_with("wind_speed")),
        "{differing:?}"
    );
    assert_eq!(before.lines().count(), after.lines().count());
    let frames = names(&folder.path().join("frames"));
    assert!(frames.len() > 100 && frames[7] == "frame_0007.png", "{}", frames.len());
    let picture = |index: usize| Picture::load(&folder.path().join("frames").join(&frames[index]));
    assert!(bright(&picture(frames.len() - 1), RIGHT) < 60.0, "the panel is in the pictures");
    for (name, index) in [("session_first.png", 20), ("session_last.png", frames.len() - 1)] {
        picture(index).save(&Path::new(env!("CARGO_TARGET_TMPDIR")).join(name));
    }
}

#[test]
fn a_script_that_says_nothing_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("session.txt"), "panel\njump\n").unwrap();
    let screen = Xvfb::start([700, 450]);
    let (said, _folder) = Running::start(&screen, folder, &["--play", "session.txt"]).end();
    said.fails_with(1, &["session.txt:2:", "jump", "wait FRAMES"]);
}
