//! The `swell` program, and what it says.
use std::ffi::OsStr;
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// The built program's path.
pub const SWELL: &str = env!("CARGO_BIN_EXE_swell");

/// `program` with a Vulkan to draw on. A child is not wrapped by cargo's runner, so this wraps it; see docs/setup.md.
pub fn on_vulkan(program: impl AsRef<OsStr>) -> Command {
    let mut command = match std::env::var_os("SWELL_RUNNER") {
        Some(runner) => {
            let mut command = Command::new(runner);
            command.arg(program);
            command
        }
        None => Command::new(program),
    };
    command.stdin(Stdio::null());
    command
}

/// `swell` with a Vulkan to draw on.
pub fn swell() -> Command {
    let mut command = on_vulkan(SWELL);
    command.env("XDG_CACHE_HOME", env!("CARGO_TARGET_TMPDIR"));
    command
}

/// `swell` with the machine's own libraries, for whatever needs no Vulkan.
pub fn swell_alone() -> Command {
    let mut command = Command::new(SWELL);
    command.stdin(Stdio::null());
    command
}

/// How a program ended and what it printed.
#[derive(Debug)]
pub struct Said {
    /// Exit status; `None` after a signal.
    pub status: Option<i32>,
    pub out: String,
    pub err: String,
}

pub fn run(command: &mut Command) -> Said {
    let Output { status, stdout, stderr } = command.output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Said { status: status.code(), out: text(stdout), err: text(stderr) }
}

impl Said {
    /// It failed with `status` and one line that holds each of `words`.
    pub fn fails_with(&self, status: i32, words: &[&str]) {
        assert_eq!(self.status, Some(status), "{self:?}");
        assert_eq!(self.out, "", "{self:?}");
        // After a wrong command line clap adds the right form and where to read on; nothing else may be said.
        let lines: Vec<&str> = self
            .err
            .lines()
            .filter(|line| {
                !line.is_empty()
                    && !line.starts_with("Usage: ")
                    && !line.starts_with("For more information, try")
            })
            .collect();
        assert_eq!(lines.len(), 1, "one line is wanted: {self:?}");
        for word in words {
            assert!(lines[0].contains(word), "{word:?} is wanted: {self:?}");
        }
        assert!(!self.err.contains("panicked"), "{self:?}");
    }
}

/// Names in a folder, sorted; none where there is no folder.
pub fn names(folder: &Path) -> Vec<String> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}
