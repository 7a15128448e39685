//! Time against N, both logarithmic, as SVG: the sea's transforms and steps by instruction set, and the rivals, one thread
//! each.
use super::report::{Report, Row};
use std::fmt::Write as _;

/// Pixels of the picture, and of the frame within it: left, right, top, bottom.
const SIZE: [f64; 2] = [960.0, 600.0];
const FRAME: [f64; 4] = [80.0, 710.0, 60.0, 530.0];

/// What is drawn, in the legend's order: a name of the report, the line's dashes, whether its marks are squares.
const LINES: [(&str, &str, bool); 5] = [
    ("paper_step", "2 4", true),
    ("step", "", true),
    ("fftw3", "8 4", false),
    ("rustfft2", "8 3 2 3", false),
    ("fft3", "", false),
];

/// Colours that stay apart for eyes that see few, by instruction set; rivals have none and are grey.
const COLOURS: [(&str, &str); 6] = [
    ("avx512", "#0072b2"),
    ("avx2", "#d55e00"),
    ("sse", "#009e73"),
    ("neon", "#cc79a7"),
    ("scalar", "#e69f00"),
    ("", "#555555"),
];

/// One line of the plot: points (N, microseconds) by ascending N.
struct Line {
    legend: String,
    colour: &'static str,
    dashes: &'static str,
    square: bool,
    points: Vec<[f64; 2]>,
}

/// The plot of `report`.
pub fn draw(report: &Report) -> Vec<u8> {
    let lines = lines(&report.rows);
    let points = || lines.iter().flat_map(|line| &line.points);
    let (from, to) = (f64::INFINITY, f64::NEG_INFINITY);
    let across = points().fold([from, to], |[a, b], [n, _]| [a.min(*n), b.max(*n)]);
    let up = points().fold([from, to], |[a, b], [_, time]| [a.min(*time), b.max(*time)]);
    let axes = Axes {
        n: if across[0] <= across[1] { across } else { [64.0, 512.0] }.map(f64::log2),
        // Whole decades.
        time: if up[0] <= up[1] { [up[0].log10().floor(), up[1].log10().ceil()] } else { [0.0, 1.0] },
    };
    let mut svg = String::new();
    let [width, height] = SIZE;
    // Writing to a string cannot fail.
    let _ = writeln!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"14\" fill=\"#222\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>"
    );
    text(
        &mut svg,
        [FRAME[0], 24.0],
        "start",
        "Time of one cascade's step and transforms against N, one thread",
    );
    text(&mut svg, [FRAME[0], 44.0], "start", &escaped(&report.machine.processor));
    axes.draw(&mut svg);
    for (place, line) in lines.iter().enumerate() {
        line.draw(&mut svg, &axes, place);
    }
    svg += "</svg>\n";
    svg.into_bytes()
}

fn lines(rows: &[Row]) -> Vec<Line> {
    let mut lines = Vec::new();
    for (name, dashes, square) in LINES {
        for (isa, colour) in COLOURS {
            let own = rows
                .iter()
                .filter(|row| row.label.name == name && row.label.isa == isa && row.label.threads == 1);
            let mut points: Vec<[f64; 2]> = own.map(|row| [row.label.n as f64, row.time.median]).collect();
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            if !points.is_empty() {
                let legend = format!("{name} {isa}").trim_end().to_owned();
                lines.push(Line { legend, colour, dashes, square, points });
            }
        }
    }
    lines
}

/// Ends of the axes: log2 N and log10 of microseconds.
struct Axes {
    n: [f64; 2],
    time: [f64; 2],
}

impl Axes {
    /// Where a point lies in the picture.
    fn place(&self, [n, time]: [f64; 2]) -> [f64; 2] {
        let share =
            |value: f64, [from, to]: [f64; 2]| if to > from { (value - from) / (to - from) } else { 0.5 };
        let [left, right, top, bottom] = FRAME;
        // Room beside the first and the last N.
        let x = 0.04 + 0.92 * share(n.log2(), self.n);
        [left + x * (right - left), bottom - share(time.log10(), self.time) * (bottom - top)]
    }

    fn draw(&self, svg: &mut String) {
        let [left, right, top, bottom] = FRAME;
        let mut rule = |colour: &str, [x1, y1, x2, y2]: [f64; 4]| {
            let _ = writeln!(
                svg,
                "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{colour}\"/>"
            );
        };
        for decade in self.time[0] as i32..=self.time[1] as i32 {
            for part in 1..10 {
                let time = f64::from(part) * 10_f64.powi(decade);
                let y = self.place([1.0, time])[1];
                if y > top - 1.0 {
                    rule(if part == 1 { "#bbbbbb" } else { "#eeeeee" }, [left, y, right, y]);
                }
            }
        }
        for digit in self.n[0].round() as i32..=self.n[1].round() as i32 {
            let x = self.place([2_f64.powi(digit), 1.0])[0];
            rule("#dddddd", [x, top, x, bottom]);
        }
        for sides in [[left, top, left, bottom], [left, bottom, right, bottom]] {
            rule("#222222", sides);
        }
        for decade in self.time[0] as i32..=self.time[1] as i32 {
            let time = 10_f64.powi(decade);
            let y = self.place([1.0, time])[1];
            text(svg, [left - 8.0, y + 5.0], "end", &in_words(time));
        }
        for digit in self.n[0].round() as i32..=self.n[1].round() as i32 {
            let n = 2_f64.powi(digit);
            text(svg, [self.place([n, 1.0])[0], bottom + 20.0], "middle", &n.to_string());
        }
        text(svg, [0.5 * (left + right), bottom + 46.0], "middle", "N, points along a side");
        let middle = 0.5 * (top + bottom);
        let _ = writeln!(
            svg,
            "<text x=\"20\" y=\"{middle}\" text-anchor=\"middle\" transform=\"rotate(-90 20 {middle})\">median time</text>"
        );
    }
}

impl Line {
    fn draw(&self, svg: &mut String, axes: &Axes, place: usize) {
        let spots: Vec<[f64; 2]> = self.points.iter().map(|&point| axes.place(point)).collect();
        self.stroke(svg, &spots, true);
        let y = FRAME[2] + 12.0 + 24.0 * place as f64;
        let x = FRAME[1] + 30.0;
        self.stroke(svg, &[[x, y], [x + 40.0, y]], false);
        self.mark(svg, [x + 20.0, y]);
        text(svg, [x + 52.0, y + 5.0], "start", &escaped(&self.legend));
    }

    fn stroke(&self, svg: &mut String, spots: &[[f64; 2]], marked: bool) {
        let Self { colour, dashes, .. } = self;
        let way: Vec<String> = spots.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        let _ = writeln!(
            svg,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\" stroke-dasharray=\"{dashes}\"/>",
            way.join(" ")
        );
        if marked {
            spots.iter().for_each(|&spot| self.mark(svg, spot));
        }
    }

    fn mark(&self, svg: &mut String, [x, y]: [f64; 2]) {
        let colour = self.colour;
        let _ = if self.square {
            let (x, y) = (x - 4.0, y - 4.0);
            writeln!(svg, "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"8\" height=\"8\" fill=\"{colour}\"/>")
        } else {
            writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.5\" fill=\"{colour}\"/>")
        };
    }
}

fn text(svg: &mut String, [x, y]: [f64; 2], anchor: &str, words: &str) {
    let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{words}</text>");
}

/// Microseconds in the unit that leaves few digits.
fn in_words(microseconds: f64) -> String {
    match microseconds {
        few if few < 1.0 => format!("{:.0} ns", few * 1e3),
        some if some < 1e3 => format!("{some:.0} \u{b5}s"),
        many if many < 1e6 => format!("{:.0} ms", many * 1e-3),
        most => format!("{:.0} s", most * 1e-6),
    }
}

fn escaped(words: &str) -> String {
    words.replace('&', "&amp;").replace('<', "&lt;")
}
