//! Plots: the sea's spectrum, a cut through its surface, and what frames and jobs take.

use super::Facts;
use egui::{CollapsingHeader, Ui};
use egui_plot::{Corner, Legend, Line, Plot, Points};
use std::collections::VecDeque;

/// Points of the cut, and metres between two.
pub const SECTION_POINTS: usize = 160;
/// See [`SECTION_POINTS`].
pub const SECTION_STEP: f64 = 0.5;
/// Frames that are remembered.
const FRAMES: usize = 240;
/// Points, of a plot.
const HEIGHT: f32 = 130.0;

/// What a frame took, milliseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measured {
    /// From one frame to the next.
    pub frame: f64,
    /// The jobs that made its sea.
    pub sea: f64,
    /// The panel itself.
    pub panel: f64,
}

/// Numbers that frames bring.
#[derive(Debug, Default)]
pub struct Plots {
    measured: VecDeque<Measured>,
    /// Heights, metres, straight ahead.
    section: Vec<f64>,
    wants_section: bool,
}

impl Plots {
    /// Adds a frame's times.
    pub fn add(&mut self, measured: Measured) {
        if self.measured.len() == FRAMES {
            self.measured.pop_front();
        }
        self.measured.push_back(measured);
    }

    /// Whether somebody looks at the cut: it costs as many height queries as it has points.
    pub const fn wants_section(&self) -> bool {
        self.wants_section
    }

    /// The surface straight ahead of the eye: heights, metres, every [`SECTION_STEP`].
    pub fn set_section(&mut self, heights: impl Iterator<Item = f64>) {
        self.section.clear();
        self.section.extend(heights.take(SECTION_POINTS));
    }

    pub(super) fn show(&mut self, ui: &mut Ui, facts: &Facts) {
        CollapsingHeader::new("Spectrum").show(ui, |ui| spectrum(ui, facts));
        let cut = CollapsingHeader::new("Cross-section").show(ui, |ui| self.cut(ui));
        self.wants_section = cut.body_returned.is_some();
        CollapsingHeader::new("Times").show(ui, |ui| self.times(ui));
    }

    fn cut(&self, ui: &mut Ui) {
        ui.weak("height in metres, by metres straight ahead of the eye");
        let points = |(at, height): (usize, &f64)| [at as f64 * SECTION_STEP, *height];
        let line: Vec<[f64; 2]> = self.section.iter().enumerate().map(points).collect();
        plot("section").show(ui, |plot| plot.line(Line::new("height", line)));
    }

    fn times(&self, ui: &mut Ui) {
        ui.weak("milliseconds, over the frames before");
        let part = |name: &str, of: fn(&Measured) -> f64| {
            let point = |(at, measured): (usize, &Measured)| [at as f64, of(measured)];
            Line::new(name, self.measured.iter().enumerate().map(point).collect::<Vec<_>>())
        };
        plot("times").legend(Legend::default().position(Corner::LeftTop)).include_y(0.0).show(ui, |plot| {
            plot.line(part("frame", |measured| measured.frame));
            plot.line(part("sea's jobs", |measured| measured.sea));
            plot.line(part("panel", |measured| measured.panel));
        });
        if let Some(last) = self.measured.back() {
            ui.label(format!(
                "frame {:.1} ms, sea {:.1} ms, panel {:.1} ms",
                last.frame, last.sea, last.panel
            ));
        }
    }
}

fn spectrum(ui: &mut Ui, facts: &Facts) {
    ui.weak("height's variance in m^2 for each factor of ten, by log10 of the wave number in rad/m");
    plot("spectrum").legend(Legend::default().position(Corner::RightTop)).show(ui, |plot| {
        let spectra = facts.spectra.iter().zip(&facts.patches).filter(|(spectrum, _)| !spectrum.is_empty());
        for (spectrum, patch) in spectra {
            plot.line(Line::new(format!("patch of {patch} m"), spectrum.clone()));
        }
        if !facts.waves.is_empty() {
            plot.points(Points::new("waves, their own variance", facts.waves.clone()).radius(4.0));
        }
    });
}

/// A plot that nobody drags away by accident.
fn plot(name: &str) -> Plot<'static> {
    Plot::new(name.to_owned()).height(HEIGHT).allow_drag(false).allow_zoom(false).allow_scroll(false)
}
