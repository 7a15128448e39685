//! What shaders cost on an Adreno: a device that is not there, who listens to the driver, and limits.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic")]
pub mod budget;
pub mod frame;
pub mod listener;
pub mod spirv;
pub mod ways;

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A chip, by its name and the number its driver goes by.
pub struct Chip {
    pub name: &'static str,
    number: &'static str,
    pub headset: &'static str,
}

/// Those of the headsets.
pub const CHIPS: [Chip; 2] = [
    Chip { name: "740", number: "0x43050b00", headset: "Quest 3" },
    Chip { name: "650", number: "0x06050002", headset: "Quest 2" },
];

/// What one stage of a pipeline was compiled to.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// The vertex stage's shader, by which a pipeline is known; before it the way the fragment stage shades, where that is not the
    /// usual one.
    pub pipeline: String,
    /// Cascades that it was compiled for.
    pub cascades: usize,
    /// "vertex" or "fragment".
    pub stage: String,
    pub instructions: i64,
    pub nops: i64,
    /// Of four 32-bit numbers.
    pub registers: i64,
    /// At once on a processor of the GPU.
    pub waves: i64,
    /// Threads of a wave: 64, or twice that where registers allow.
    pub width: i64,
    /// Stores to memory for want of registers, and loads from there.
    pub spills: i64,
    /// Fewest and most instructions once around its innermost loop, which is a wave that is a formula; 0 where there is none.
    pub around: [i64; 2],
}

impl Cost {
    pub fn line(&self) -> String {
        let Self { pipeline, cascades, stage, instructions, nops, registers, waves, width, spills, around } =
            self;
        let [fewest, most] = around;
        format!(
            "cost {pipeline} {cascades} {stage} {instructions} {nops} {registers} {waves} {width} {spills} {fewest} {most}"
        )
    }

    fn read(line: &str) -> Option<Self> {
        let mut words = line.strip_prefix("cost ")?.split(' ');
        let (pipeline, cascades) = (words.next()?.to_owned(), words.next()?.parse().ok()?);
        let stage = words.next()?.to_owned();
        let mut number = || words.next()?.parse().ok();
        let [instructions, nops, registers] = [number()?, number()?, number()?];
        let [waves, width, spills] = [number()?, number()?, number()?];
        let around = [number()?, number()?];
        Some(Self { pipeline, cascades, stage, instructions, nops, registers, waves, width, spills, around })
    }
}

/// The script that runs programs where the only device is a pretended Adreno.
pub fn script() -> Command {
    let mut command = Command::new(concat!(env!("CARGO_MANIFEST_DIR"), "/scripts/adreno"));
    command.stdin(Stdio::null());
    command
}

/// What the ignored test `name` of this file measures on `chip`, and the driver's own name.
pub fn measure(chip: &Chip, name: &str) -> (String, Vec<Cost>) {
    // Not `current_exe`, which is the dynamic loader under the runner.
    let program = std::env::args_os().next().unwrap();
    let output = script()
        .env("SWELL_ADRENO_CHIP", chip.number)
        .env("SWELL_ADRENO_DEVICE", device())
        .arg(program)
        .args([name, "--exact", "--ignored", "--nocapture", "--test-threads=1"])
        .output()
        .unwrap();
    let text = |bytes| String::from_utf8_lossy(bytes).into_owned();
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    assert!(output.status.success(), "measuring on Adreno {} failed:\n{err}{out}", chip.name);
    let driver = out.lines().find_map(|line| line.split_once("driver ").map(|(_, name)| name.to_owned()));
    (driver.expect("a driver that says its name"), out.lines().filter_map(Cost::read).collect())
}

/// The library of `tests/adreno_device`, which cargo puts beside this program.
fn device() -> PathBuf {
    let program = std::env::args_os().next().unwrap();
    let folder = Path::new(&program).parent().and_then(Path::parent).unwrap();
    folder.join("examples/libswell_adreno_device.so")
}
