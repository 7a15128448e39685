//! What was measured, as rows, and as JSON.
use super::harness::{Case, Label, Work};
use super::machine::Machine;
use super::samples::Summary;
use serde_json::{Value, json};

/// One line of the report.
#[derive(Clone, Debug)]
pub struct Row {
    /// What it is about.
    pub label: Label,
    /// How much one call does.
    pub work: Work,
    /// Its times.
    pub time: Summary,
}

impl Row {
    /// Rows of a measured case: the whole, then its parts that took any time.
    pub fn of_case(case: &Case) -> Vec<Self> {
        let whole =
            case.samples[0].summary().map(|time| Self { label: case.label.clone(), work: case.work, time });
        let parts = case.parts.iter().zip(&case.samples[1..]).filter_map(|(name, samples)| {
            let time = samples.summary().filter(|time| time.max > 0.0)?;
            let work = Work { points: case.work.points, ..Work::default() };
            Some(Self { label: Label { name: name.clone(), ..case.label.clone() }, work, time })
        });
        whole.into_iter().chain(parts).collect()
    }

    /// Nanoseconds for each point, where there are any.
    pub fn per_point(&self) -> Option<f64> {
        (self.work.points > 0.0).then(|| 1e3 * self.time.median / self.work.points)
    }

    /// Gigabytes a second that it moves at least.
    pub fn bandwidth(&self) -> Option<f64> {
        (self.work.bytes > 0.0).then(|| 1e-3 * self.work.bytes / self.time.median)
    }

    /// Billions of operations a second.
    pub fn speed(&self) -> Option<f64> {
        (self.work.flops > 0.0).then(|| 1e-3 * self.work.flops / self.time.median)
    }
}

/// Everything that a run says.
#[derive(Clone, Debug)]
pub struct Report {
    /// Where it was measured.
    pub machine: Machine,
    /// What was.
    pub rows: Vec<Row>,
}

/// FFTW's ways to three real fields: the cheapest of them is what it is compared by.
const WAYS: &str = "fftw3_";
/// The name under which that is listed.
const CHEAPEST: &str = "fftw3";

impl Report {
    /// Adds FFTW's cheapest way to `rows`, before the ways.
    pub fn new(machine: Machine, rows: Vec<Row>) -> Self {
        let mut all: Vec<Row> = Vec::with_capacity(rows.len() + 4);
        for row in &rows {
            let first = !all.iter().any(|earlier| earlier.label.n == row.label.n);
            if first {
                let ways =
                    rows.iter().filter(|way| way.label.n == row.label.n && way.label.name.starts_with(WAYS));
                let cheapest = ways.min_by(|a, b| a.time.median.total_cmp(&b.time.median));
                all.extend(cheapest.map(|way| {
                    let label = Label { name: CHEAPEST.to_owned(), ..way.label.clone() };
                    Row { label, ..way.clone() }
                }));
            }
            all.push(row.clone());
        }
        Self { machine, rows: all }
    }

    /// The row's median over that of FFTW's cheapest way to the three fields of the same size, if it is about points.
    pub fn ratio(&self, row: &Row) -> Option<f64> {
        let rival = |other: &&Row| other.label.name == CHEAPEST && other.label.n == row.label.n;
        row.per_point()?;
        Some(row.time.median / self.rows.iter().find(rival)?.time.median)
    }

    /// The JSON that `docs/performance.md` describes, with a line's end.
    pub fn json(&self) -> Vec<u8> {
        let results: Vec<Value> = self.rows.iter().map(|row| self.result(row)).collect();
        let report = json!({
            "swell": env!("CARGO_PKG_VERSION"),
            "machine": self.machine.json(),
            "results": results,
        });
        format!("{report:#}\n").into_bytes()
    }

    fn result(&self, row: &Row) -> Value {
        let Row { label, work, time } = row;
        json!({
            "name": label.name,
            "n": label.n,
            "cascades": label.cascades,
            "threads": label.threads,
            "isa": label.isa,
            "median_us": time.median,
            "min_us": time.min,
            "max_us": time.max,
            "spread_percent": time.spread,
            "samples": time.count,
            "points": work.points,
            "ns_per_point": row.per_point(),
            "gb_per_s": row.bandwidth(),
            "gflop_per_s": row.speed(),
            "over_fftw3": self.ratio(row),
        })
    }
}
