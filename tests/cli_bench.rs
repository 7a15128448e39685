//! `swell bench`: what it writes, and what it refuses. Nothing here is about how long anything takes.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use support::program::{Said, names, run, swell_alone};
use tempfile::tempdir;

const ISAS: [&str; 5] = ["avx512", "avx2", "sse", "neon", "scalar"];
/// Cases that any build has, and that need no Vulkan.
const CASES: &str = "fft3,step,stages,step_2c,step_foam_tick,paper_step,quadtree,query,cores";

const SHORT: [&str; 2] = ["--time", "0.001"];

fn bench(arguments: &[&str]) -> Said {
    run(swell_alone().arg("bench").args(arguments))
}

fn number(row: &Value, key: &str) -> f64 {
    row[key].as_f64().unwrap_or_else(|| panic!("{key} of {row}"))
}

fn text<'a>(row: &'a Value, key: &str) -> &'a str {
    row[key].as_str().unwrap_or_else(|| panic!("{key} of {row}"))
}

/// The results of a report that was written to a file, which is the only one there.
fn results(arguments: &[&str]) -> (Vec<Value>, Value, Said) {
    let folder = tempdir().unwrap();
    let file = folder.path().join("bench.json");
    let said = bench(&[arguments, &SHORT, &["--json", file.to_str().unwrap()]].concat());
    assert_eq!(said.status, Some(0), "{said:?}");
    assert_eq!(names(folder.path()), ["bench.json"]);
    let report: Value = serde_json::from_slice(&fs::read(&file).unwrap()).unwrap();
    (report["results"].as_array().unwrap().clone(), report["machine"].clone(), said)
}

#[test]
fn the_report_keeps_its_contract() {
    let (results, machine, said) = results(&["--sizes", "32,16", "--threads", "2", "--only", CASES]);
    assert!(!text(&machine, "cpu").is_empty());
    assert!(number(&machine, "copy_gb_per_s") > 0.0);
    for row in &results {
        let (low, middle, high) = (number(row, "min_us"), number(row, "median_us"), number(row, "max_us"));
        assert!(0.0 <= low && low <= middle && middle <= high, "{row}");
        assert!(number(row, "samples") >= 1.0, "{row}");
        assert!(text(row, "name") == "cores" || number(row, "ns_per_point") >= 0.0, "{row}");
        assert!([1.0, 2.0].contains(&number(row, "threads")), "{row}");
        let name = text(row, "name");
        let of_the_sea = ["fft3", "step", "stage"].iter().any(|start| name.starts_with(start));
        let isa = text(row, "isa");
        assert!(if of_the_sea { ISAS.contains(&isa) } else { isa.is_empty() }, "{row}");
    }
    let found = |name: &str| {
        let rows = results.iter().filter(|row| text(row, "name") == name);
        let mut rows: Vec<_> =
            rows.map(|row| (row["n"].as_u64().unwrap(), row["threads"].as_u64().unwrap())).collect();
        rows.sort_unstable();
        rows
    };
    assert_eq!(found("step"), [(16, 1), (16, 2), (32, 1), (32, 2)]);
    assert_eq!(found("step_2c"), [(32, 1), (32, 2)]);
    assert_eq!(found("paper_step"), [(16, 1), (32, 1)]);
    assert_eq!(found("query"), [(32, 1)]);
    assert_eq!(found("quadtree").len(), 1);
    assert!(!found("fft3").is_empty());
    assert!(results.iter().any(|row| text(row, "name").starts_with("stage_")));
    // The machine's two lines, the head, a line between the sizes, and a row for each result.
    assert_eq!(said.out.lines().count(), 4 + results.len(), "{}", said.out);
    for row in &results {
        let name = text(row, "name");
        assert!(said.out.lines().any(|line| line.split_whitespace().next() == Some(name)), "{name}");
    }
}

#[test]
fn only_what_is_asked_for_is_measured() {
    let (results, ..) = results(&["--sizes", "16", "--threads", "1", "--only", "paper_step"]);
    let names: BTreeSet<_> = results.iter().map(|row| text(row, "name")).collect();
    assert_eq!(names, BTreeSet::from(["paper_step"]));
    assert_eq!(results.len(), 1);
}

#[test]
fn the_plot_shows_every_line_by_name() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("plot.svg");
    let arguments = ["--sizes", "16,32", "--only", "step,paper_step", "--plot", file.to_str().unwrap()];
    let said = bench(&[&arguments[..], &SHORT].concat());
    assert_eq!(said.status, Some(0), "{said:?}");
    let plot = fs::read_to_string(&file).unwrap();
    assert!(plot.starts_with("<svg ") && plot.ends_with("</svg>\n"));
    for words in [">paper_step<", ">step ", ">16<", ">32<", "points along a side", "median time"] {
        assert!(plot.contains(words), "{words}");
    }
    assert!(!plot.contains("NaN") && !plot.contains("inf"), "{plot}");
}

#[test]
fn wrong_options_are_told_with_value_and_range() {
    let says = |arguments: &[&str], words: &[&str]| bench(arguments).fails_with(2, words);
    says(&["--isa", "mmx"], &["--isa", "mmx", "scalar", "all"]);
    says(&["--only", "step,stepp"], &["--only", "stepp", "fft3", "paper_step"]);
    says(&["--sizes", "64,100"], &["--sizes", "100", "power of two", "16 to 512"]);
    says(&["--sizes", "1024"], &["--sizes", "1024", "16 to 512"]);
    says(&["--time", "0"], &["--time", "0", "0.001 to 60"]);
    says(&["--time", "nan"], &["--time", "nan"]);
    says(&["--threads", "9999"], &["--threads", "9999", "1024"]);
    says(&["--plot", "plot.png"], &["--plot", "plot.png", ".svg"]);
    let missing = if cfg!(target_arch = "x86_64") { "neon" } else { "avx2" };
    says(&["--isa", missing], &["--isa", missing, "scalar"]);
    #[cfg(not(feature = "rivals"))]
    says(&["--only", "fftw3"], &["--only fftw3", "./x bench"]);
}

#[test]
fn a_place_that_cannot_be_written_to_is_told_before_anything_is_measured() {
    let folder = tempdir().unwrap();
    for (option, name) in [("--json", "none/a.json"), ("--plot", "none/a.svg")] {
        let place = folder.path().join(name);
        bench(&["--time", "60", option, place.to_str().unwrap()])
            .fails_with(1, &[option, name, "cannot be written"]);
    }
    let file = folder.path().to_str().unwrap();
    bench(&["--time", "60", "--json", file]).fails_with(1, &["--json", file, "cannot be written"]);
    assert!(names(folder.path()).is_empty());
}

/// FFTW's cheapest way is one of its ways, and everything is compared with it.
#[cfg(feature = "rivals")]
#[test]
fn rivals_are_listed_with_the_cheapest_way() {
    let (results, ..) = results(&["--sizes", "16", "--threads", "1", "--only", "fftw3,rustfft2,fft3"]);
    let median = |name: &str| {
        let row = results.iter().find(|row| text(row, "name") == name).unwrap_or_else(|| panic!("{name}"));
        assert!(row["over_fftw3"].is_number(), "{row}");
        number(row, "median_us")
    };
    let ways = ["fftw3_2c2c", "fftw3_c2c_c2r", "fftw3_3c2r"].map(median);
    assert_eq!(median("fftw3"), ways.into_iter().fold(f64::INFINITY, f64::min));
    assert!(median("rustfft2") > 0.0 && median("fft3") > 0.0);
}
