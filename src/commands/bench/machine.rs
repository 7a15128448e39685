//! The machine that a report was made on: its name, and the two walls that code runs against.
use super::{peak, samples::Samples};
use crate::sea::simd::Isa;
use serde_json::{Value, json};
use std::fmt;
use std::hint::black_box;
use std::time::Instant;

/// Floats of a buffer that no cache holds.
const LARGE: usize = 16 << 20;
/// Floats of a buffer that a second-level cache holds twice.
const SMALL: usize = 48 << 10;

/// What limits a kernel.
#[derive(Clone, Debug)]
pub struct Machine {
    /// The processor, as the system names it.
    pub processor: String,
    /// Threads that this process may run at once.
    pub cores: usize,
    /// Caches of the first core, as "L1d 32K".
    pub caches: Vec<String>,
    /// Bytes read and written by one thread that copies within memory, GB/s.
    pub copy: f64,
    /// The same within a buffer of 192 KiB.
    pub copy_near: f64,
    /// Most billions of floating-point operations a second of one thread, by instruction set.
    pub peaks: Vec<(&'static str, f64)>,
}

impl Machine {
    /// Looks and measures; takes about a second.
    pub fn measure(isas: &[Isa]) -> Self {
        Self {
            processor: processor(),
            cores: std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
            caches: caches(),
            copy: copy(LARGE, 1, 7),
            copy_near: copy(SMALL, 400, 50),
            peaks: isas.iter().map(|&isa| (isa.name(), peak::measure(isa))).collect(),
        }
    }

    /// As an object of the report.
    pub fn json(&self) -> Value {
        let peaks: serde_json::Map<_, _> =
            self.peaks.iter().map(|&(isa, peak)| (isa.to_owned(), json!(peak))).collect();
        json!({
            "cpu": self.processor,
            "arch": std::env::consts::ARCH,
            "os": std::env::consts::OS,
            "cores": self.cores,
            "caches": self.caches,
            "copy_gb_per_s": self.copy,
            "copy_near_gb_per_s": self.copy_near,
            "fma_gflop_per_s": peaks,
        })
    }
}

impl fmt::Display for Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}, {} cores, {}", self.processor, self.cores, self.caches.join(", "))?;
        write!(f, "one thread copies {:.1} GB/s in memory, {:.1} GB/s in cache", self.copy, self.copy_near)?;
        for (isa, peak) in &self.peaks {
            write!(f, ", {isa} {peak:.0} GFLOP/s")?;
        }
        writeln!(f, " (bytes read and written, both counted)")
    }
}

/// The name in Linux' list, or else the architecture's.
fn processor() -> String {
    let list = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = list.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    name.map_or_else(|| std::env::consts::ARCH.to_owned(), |(_, name)| name.trim().to_owned())
}

/// Level, kind and size of every data cache that Linux tells of.
fn caches() -> Vec<String> {
    let read = |index: usize, what: &str| {
        let text = std::fs::read_to_string(format!("/sys/devices/system/cpu/cpu0/cache/index{index}/{what}"));
        text.ok().map(|text| text.trim().to_owned())
    };
    let cache = |index| {
        let (level, kind, size) = (read(index, "level")?, read(index, "type")?, read(index, "size")?);
        let suffix = if kind == "Data" { "d" } else { "" };
        (kind != "Instruction").then(|| format!("L{level}{suffix} {size}"))
    };
    (0..8).filter_map(cache).collect()
}

/// Median GB/s of `samples` measurements of `calls` copies of `len` floats.
fn copy(len: usize, calls: usize, samples: usize) -> f64 {
    let from = vec![1.0_f32; len];
    let mut to = vec![0.0_f32; len];
    let mut times = Samples::default();
    for _ in 0..samples {
        let start = Instant::now();
        for _ in 0..calls {
            black_box(&mut to[..]).copy_from_slice(black_box(&from));
        }
        times.push(start.elapsed());
    }
    let bytes = (2 * size_of::<f32>() * len * calls) as f64;
    times.summary().map_or(0.0, |time| 1e-3 * bytes / time.median)
}
