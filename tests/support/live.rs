//! `swell run --xr` on a service, watched while it runs: its log, what it says, its end.
use super::monado::Service;
use super::program::Said;
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use serde_json::Value;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// As little sea as can be drawn.
const SCENE: &str = "
[sea]
wind_speed = 6.0
fetch = 20_000.0
resolution = 32
seed = 3
[[sea.cascade]]
patch_size = 60.0
[lod]
size = 1024.0
levels = 4
[camera]
eye = [0.0, 2.5, 0.0]
look = [0.0, 0.2, -30.0]
";

/// Long, for a busy machine: nobody waits for it unless something is wrong.
const PATIENCE: Duration = Duration::from_secs(90);

/// Everything is checked, nothing mirrored; `more` goes to the command line.
pub fn swell_xr(service: &Service, more: &[&str]) -> Command {
    let scene = service.folder().join("scene.toml");
    fs::write(&scene, SCENE).unwrap();
    let mut command = service.swell();
    command.args(["run", "--xr", "--mirror", "none", "--validate", "--threads", "1", "--scene"]).arg(scene);
    command.args(["--xr-scale", "0.2"]).args(more);
    command
}

/// A program that runs; dropping it kills it.
pub struct Live {
    child: Child,
    log: PathBuf,
    out: PathBuf,
    err: PathBuf,
}

impl Live {
    /// Starts `command`, whose files are called `name` in the service's folder.
    pub fn start(service: &Service, name: &str, mut command: Command) -> Self {
        let file = |kind: &str| service.folder().join(format!("{name}.{kind}"));
        let (log, out, err) = (file("log"), file("out"), file("err"));
        command.arg("--frame-log").arg(&log);
        command.stdout(File::create(&out).unwrap()).stderr(File::create(&err).unwrap());
        Self { child: command.stdin(Stdio::null()).spawn().unwrap(), log, out, err }
    }

    /// Waits until `done`, called `what`; the program may end meanwhile only where it `may_end`.
    fn wait(&mut self, what: &str, may_end: bool, mut done: impl FnMut(&mut Self) -> bool) {
        let begun = Instant::now();
        while !done(self) {
            let ended = self.child.try_wait().unwrap();
            assert!(may_end || ended.is_none(), "{what}: it ended before, {ended:?}: {}", self.err());
            if begun.elapsed() > PATIENCE {
                let (frames, err) = (self.frames(), self.err());
                panic!("{what} does not come; {} frames, the last {:?}; {err}", frames.len(), frames.last());
            }
            std::thread::sleep(Duration::from_millis(10));
        }
    }

    /// Waits until so many frames were shown in all.
    pub fn until_shown(&mut self, count: usize) {
        self.wait(&format!("frame {count}"), false, |live| shown(&live.frames()) >= count);
    }

    /// Waits until frames so far satisfy `done`.
    pub fn until_frames(&mut self, what: &str, done: impl Fn(&[Value]) -> bool) {
        self.wait(what, false, |live| done(&live.frames()));
    }

    /// Waits until it said a line that holds `words`.
    pub fn until_said(&mut self, words: &str) {
        self.wait(words, false, |live| live.err().contains(words));
    }

    /// The log so far, a line that is being written left out.
    pub fn frames(&self) -> Vec<Value> {
        let text = fs::read_to_string(&self.log).unwrap_or_default();
        let whole = text.rfind('\n').map_or("", |end| &text[..end]);
        whole.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
    }

    /// What it said so far on standard error.
    pub fn err(&self) -> String {
        String::from_utf8_lossy(&fs::read(&self.err).unwrap_or_default()).into_owned()
    }

    pub fn signal(&self, signal: Signal) {
        kill(Pid::from_raw(self.child.id().try_into().unwrap()), signal).unwrap();
    }

    /// `signal` again and again, until it has ended.
    pub fn signal_until_ended(&mut self, signal: Signal) {
        self.wait("the end", true, |live| {
            let ended = live.child.try_wait().unwrap().is_some();
            if !ended {
                live.signal(signal);
            }
            ended
        });
    }

    /// Its end, which is its own, and its whole log.
    pub fn end(mut self) -> (Said, Vec<Value>) {
        self.wait("the end", true, |live| live.child.try_wait().unwrap().is_some());
        let text = fs::read_to_string(&self.log).unwrap();
        assert!(text.is_empty() || text.ends_with('\n'), "half a line: {text:?}");
        let status = self.child.wait().unwrap();
        let said =
            Said { status: status.code(), out: fs::read_to_string(&self.out).unwrap(), err: self.err() };
        assert!(!said.err.contains("panicked"), "{said:?}");
        (said, self.frames())
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        let _ended = self.child.kill();
        let _status = self.child.wait();
    }
}

/// Runs to its own end.
pub fn ended(service: &Service, command: Command) -> (Said, Vec<Value>) {
    Live::start(service, "swell", command).end()
}

/// How many frames of a log were shown.
pub fn shown(frames: &[Value]) -> usize {
    frames.iter().filter(|frame| frame["shown"] == true).count()
}

/// The sea's time never runs back nor stands still.
pub fn goes_on(frames: &[Value]) {
    let times: Vec<f64> = frames.iter().map(|frame| frame["time"].as_f64().unwrap()).collect();
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "{times:?}");
}

/// Lines that are Swell's own and tell of more than what was found at the start. Monado's client library, the loader and
/// core validation speak in the same process.
pub fn own(err: &str) -> Vec<&str> {
    let usual = [
        "headset: ",
        "extensions found: ",
        "extensions missing: ",
        "in use: ",
        "left hand: ",
        "right hand: ",
    ];
    let others = [
        "ERROR [",
        "Error [",
        "#",
        "Core Validation output type",
        // Of an instance that could not be made.
        "INTERNAL VALIDATION LAYER ERROR: Null handle",
    ];
    let skipped = |line: &&str| {
        ![&usual[..], &others].concat().iter().any(|start| line.trim_start().starts_with(start))
    };
    err.lines().filter(skipped).filter(|line| !line.is_empty()).collect()
}

/// Files of a folder whose names end so.
pub fn files(folder: &Path, end: &str) -> Vec<PathBuf> {
    let all = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    all.filter(|path| path.to_string_lossy().ends_with(end)).collect()
}
