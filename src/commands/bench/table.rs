//! The report on a terminal.
use super::report::{Report, Row};
use std::io::{self, Write};

const HEAD: [&str; 14] = [
    "name", "n", "casc", "thr", "isa", "median", "min", "max us", "spread", "ns/point", "GB/s", "GFLOP/s",
    "/fftw3", "samples",
];

/// Writes all rows, columns as wide as they must be, a line between sizes.
///
/// # Errors
/// Those of `out`.
pub fn write(report: &Report, out: &mut impl Write) -> io::Result<()> {
    let lines: Vec<_> = report.rows.iter().map(|row| cells(report, row)).collect();
    let mut widths = HEAD.map(str::len);
    for line in &lines {
        for (width, cell) in widths.iter_mut().zip(line) {
            *width = (*width).max(cell.len());
        }
    }
    write_line(out, &widths, &HEAD.map(str::to_owned))?;
    let mut n = 0;
    for (row, line) in report.rows.iter().zip(&lines) {
        if n > 0 && row.label.n > 0 && n != row.label.n {
            writeln!(out)?;
        }
        n = n.max(row.label.n);
        write_line(out, &widths, line)?;
    }
    out.flush()
}

fn cells(report: &Report, row: &Row) -> [String; 14] {
    let label = &row.label;
    let count = |number: usize| if number == 0 { String::new() } else { number.to_string() };
    let optional =
        |number: Option<f64>, digits: usize| number.map_or(String::new(), |x| format!("{x:.digits$}"));
    let time = |microseconds: f64| format!("{microseconds:.2}");
    [
        label.name.clone(),
        count(label.n),
        count(label.cascades),
        count(label.threads),
        label.isa.to_owned(),
        time(row.time.median),
        time(row.time.min),
        time(row.time.max),
        format!("{:.1} %", row.time.spread),
        optional(row.per_point(), 3),
        optional(row.bandwidth(), 1),
        optional(row.speed(), 1),
        optional(report.ratio(row), 3),
        row.time.count.to_string(),
    ]
}

/// Names to the left, numbers to the right.
fn write_line(out: &mut impl Write, widths: &[usize; 14], cells: &[String; 14]) -> io::Result<()> {
    let mut line = String::new();
    for (column, (cell, &width)) in cells.iter().zip(widths).enumerate() {
        let gap = if column == 0 { "" } else { "  " };
        line += &match column {
            0 | 4 => format!("{gap}{cell:<width$}"),
            _ => format!("{gap}{cell:>width$}"),
        };
    }
    writeln!(out, "{}", line.trim_end())
}
