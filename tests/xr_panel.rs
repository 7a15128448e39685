//! The panel in a headset: a hand opens it, points, picks a sea and saves it, and the raft stays where it is.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use glam::{Quat, Vec3};
use std::fs;
use std::path::Path;
use std::process::{Child, Stdio};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use support::faults;
use support::headset::settings;
use support::monado::{Compositor, Devices, Service, Settings};
use support::picture::Picture;
use support::remote::{Body, Pose, Remote};
use support::xvfb::Xvfb;
use swell::host::{AuthoringSettings, Fit, Guest, HeadsetSettings, headset};
use swell::panel::{Panel, presets};
use swell::scene::Scene;

const PATIENCE: Duration = Duration::from_secs(90);
/// The panel in points, and in metres.
const POINTS: [f32; 2] = [420.0, 560.0];
const METRES: [f32; 2] = [0.66, 0.88];
/// Where it stands for a head at (0, 1.6, 0) that looks along -Z: its middle, and how far it leans back.
const MIDDLE: Vec3 = Vec3::new(0.0, 1.35, -1.0);

fn lean() -> Quat {
    Quat::from_rotation_x(-f32::atan2(0.25, 1.0))
}

/// A right hand that points at a place of the panel, in points.
fn aimed(at: [f32; 2]) -> Pose {
    let share = [at[0] / POINTS[0] - 0.5, 0.5 - at[1] / POINTS[1]];
    let place = MIDDLE + lean() * Vec3::new(share[0] * METRES[0], share[1] * METRES[1], 0.0);
    let hand = Vec3::new(0.2, 1.2, -0.4);
    let turn = Quat::from_rotation_arc(Vec3::NEG_Z, (place - hand).normalize());
    Pose { position: hand.into(), orientation: turn.into() }
}

/// A program in a headset, and what its wearer does.
struct Wearer {
    screen: Xvfb,
    service: Service,
    body: Arc<Mutex<Body>>,
    _remote: Remote,
}

impl Wearer {
    fn new() -> Self {
        // As large as the window that the compositor opens.
        let screen = Xvfb::start([960, 540]);
        let compositor = Compositor::Window { display: screen.display().to_owned() };
        let service =
            Service::start(Settings { compositor, devices: Devices::Remote, ..Settings::default() });
        let body = Arc::new(Mutex::new(Body::standing()));
        let own = Arc::clone(&body);
        let remote = Remote::start(&service, move |_| *own.lock().unwrap());
        Self { screen, service, body, _remote: remote }
    }

    fn does(&self, change: impl Fn(&mut Body)) {
        change(&mut self.body.lock().unwrap());
        // Some frames: two of egui's at least.
        std::thread::sleep(Duration::from_millis(300));
    }

    /// Y, down and up.
    fn asks_for_the_panel(&self) {
        self.does(|body| body.hands[0].b = true);
        self.does(|body| body.hands[0].b = false);
    }

    fn clicks(&self, at: [f32; 2]) {
        self.does(|body| body.hands[1].pose = aimed(at));
        self.does(|body| body.hands[1].trigger = 1.0);
        self.does(|body| body.hands[1].trigger = 0.0);
    }

    /// Does `act` again and again until `is_so`: a busy machine may miss it.
    fn until(&self, child: &mut Child, what: &str, act: impl Fn(), is_so: impl Fn() -> bool) {
        let started = Instant::now();
        loop {
            act();
            for _ in 0..40 {
                if is_so() {
                    return;
                }
                std::thread::sleep(Duration::from_millis(100));
            }
            assert!(child.try_wait().unwrap().is_none(), "{what}: the program has ended");
            if started.elapsed() > PATIENCE {
                let left = Path::new(env!("CARGO_TARGET_TMPDIR")).join("xr_panel.png");
                self.screen.screenshot().save(&left);
                panic!("{what}: not after {PATIENCE:?}; see {}", left.display());
            }
        }
    }
}

/// Where widgets are on the panel of `file`, by their names: as the headset lays it out.
fn places<const N: usize>(text: &str, file: &Path, names: [&str; N]) -> [[f32; 2]; N] {
    let mut panel = Panel::new(text.to_owned(), Some(file)).unwrap();
    let context = egui::Context::default();
    for _ in 0..3 {
        let mut input = egui::RawInput {
            screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, POINTS.into())),
            ..Default::default()
        };
        input.viewports.get_mut(&egui::ViewportId::ROOT).unwrap().native_pixels_per_point = Some(2.0);
        context.run_ui(input, |ui| panel.fill(ui)).textures_delta.clear();
    }
    names.map(|name| panel.place(name).unwrap().center().into())
}

/// The share of each eye's view that is as dark grey as the panel's ground, where the panel stands: below the middle.
fn covered(screen: &Picture) -> f32 {
    let [width, height] = screen.size;
    let grey = |[r, g, b]: [u8; 3]| r.abs_diff(27) < 4 && g.abs_diff(27) < 4 && b.abs_diff(27) < 4;
    let share = |view: u32| {
        let left = view * width / 2;
        let (xs, ys) = (left + width / 5..left + width * 3 / 10, height / 2..height * 2 / 3);
        let all = xs.len() * ys.len();
        let found =
            ys.flat_map(|y| xs.clone().map(move |x| (x, y))).filter(|&(x, y)| grey(screen.pixel(x, y)));
        found.count() as f32 / all as f32
    };
    share(0).min(share(1))
}

/// A number of each frame in the log so far, by its name.
fn logged(log: &Path, name: &str) -> Vec<f64> {
    let text = fs::read_to_string(log).unwrap_or_default();
    let records = text.lines().filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok());
    records.filter_map(|record| record.pointer(name)?.as_f64()).collect()
}

#[test]
fn a_hand_opens_it_picks_a_sea_and_saves_it() {
    let wearer = Wearer::new();
    let file = wearer.service.folder().join("scene.toml");
    let text =
        "# Mine.\n[sea]\nwind_speed = 4.0\nresolution = 64\n[raft]\nfreeboard = 0.4\nhorizon = \"still\"\n";
    fs::write(&file, text).unwrap();
    let log = wearer.service.folder().join("frames.jsonl");
    let mut command = wearer.service.swell();
    command
        .args(["run", "--xr", "--validate", "--mirror", "none", "--xr-scale", "0.25", "--scene"])
        .arg(&file);
    command.arg("--frame-log").arg(&log);
    let mut child = command.stdout(Stdio::piped()).spawn().unwrap();

    let screen = || wearer.screen.screenshot();
    wearer.until(&mut child, "a sea", || (), || screen().colours() > 500 && covered(&screen()) < 0.1);
    let [preset, save] = places(text, &file, ["preset three waves", "Save"]);
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("xr_panel");
    let toggle = || wearer.asks_for_the_panel();
    let shown = |open| (covered(&screen()) > 0.3) == open;
    wearer.until(&mut child, "the panel opens", toggle, || shown(true));
    wearer.does(|body| body.hands[1].pose = aimed(preset));
    wearer.screen.screenshot().save(&folder.join("open.png"));

    // Formulas need no maps: next to nothing is uploaded once they are the sea.
    let uploaded = || logged(&log, "/uploaded").last().copied();
    let spectral = uploaded().unwrap();
    wearer.until(
        &mut child,
        "three waves",
        || wearer.clicks(preset),
        || uploaded().unwrap() < spectral / 4.0,
    );
    wearer.screen.screenshot().save(&folder.join("picked.png"));
    let saved = || fs::read_to_string(&file).unwrap();
    wearer.until(&mut child, "it is saved", || wearer.clicks(save), || saved() != text);
    wearer.until(&mut child, "the panel goes", toggle, || shown(false));

    // Nobody has glided: pulling the trigger on the panel is the panel's.
    let xs = logged(&log, "/eyes/0/position/0");
    let moved = xs.iter().map(|x| (x - xs[0]).abs()).fold(0.0, f64::max);
    assert!(moved < 0.2, "the raft moved by {moved} m");

    nix::sys::signal::kill(nix::unistd::Pid::from_raw(child.id().cast_signed()), nix::sys::signal::SIGTERM)
        .unwrap();
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && !said.contains("validation: "), "{said}");
    let scene = Scene::load(&file).unwrap();
    let preset = presets().into_iter().find(|preset| preset.name == "three waves").unwrap();
    assert_eq!(scene.sea, Scene::parse(preset.text, preset.name).unwrap().sea, "{}", saved());
    assert!(saved().contains("freeboard = 0.4"), "{}", saved());
}

/// Two sessions of a person who asks for the panel at once: the second shows it as the first did, where it stands.
#[test]
fn it_is_there_again_after_a_lost_session() {
    let service = Service::start(Settings { devices: Devices::Remote, ..Settings::default() });
    let _remote = Remote::start(&service, |_| Body::standing());
    let (calls, said) = faults::passes(&service, "shown_twice", &[], "session_lost@14");
    let ended = calls.0.iter().filter(|line| line.starts_with("end_frame") && line.contains("layers="));
    let frames: Vec<bool> = ended.map(|line| line.contains("layers=2")).collect();
    println!("{frames:?}\n{}", said.out);
    // The sea's two layers, of which the panel's follows once it is drawn; then again with images of the new session's.
    let (first, second) = frames.split_at(13.min(frames.len()));
    for session in [first, second] {
        let shown = session.iter().filter(|shown| **shown).count();
        assert!(shown >= 8, "{frames:?}");
    }
}

#[test]
#[ignore = "runs in a process of its own"]
fn shown_twice() {
    let folder = tempfile::tempdir().unwrap();
    let text = "[sea]\nwind_speed = 4.0\nresolution = 32\n";
    let file = folder.path().join("scene.toml");
    fs::write(&file, text).unwrap();
    let authoring = AuthoringSettings { text: text.to_owned(), file: Some(file), fit: Fit::new(|_| ()) };
    let settings = HeadsetSettings { authoring: Some(authoring), ..settings(28) };
    let mut curious = Curious { asked: false };
    let report = headset(&Scene::parse(text, "scene").unwrap(), &settings, &mut curious).unwrap();
    assert_eq!(report.said, Vec::<String>::new());
    assert_eq!((report.recovered, report.shown), (1, 28));
}

/// Asks for the panel once.
struct Curious {
    asked: bool,
}

impl Guest for Curious {
    fn goes_on(&mut self) -> bool {
        true
    }

    fn asks_for_panel(&mut self) -> bool {
        !std::mem::replace(&mut self.asked, true)
    }
}
