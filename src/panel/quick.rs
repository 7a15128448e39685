//! Quick picks by key: the wave keys and readouts of Wu and Luk's program, for whichever model the scene has.

use super::{Panel, presets};
use crate::scene::{Address, FieldKind, Part, Value};
use egui::{CollapsingHeader, Grid, Ui};

/// What a key asks for while the panel is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quick {
    /// 8, 9, 0: the preset with this key.
    Preset(char),
    /// 5 and 6: the parameters of each wave, or of all together.
    Readout(usize),
    /// U and J, I and K, O and L, M and N: more or less of what [`Knob`] says.
    Turn(Knob, bool),
}

/// What keys change of every wave at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Knob {
    /// Steepness; of the spectral sea its choppiness.
    Steepness,
    /// Wavelength; of the spectral sea the fetch, with which waves grow longer.
    Wavelength,
    /// Amplitude.
    Amplitude,
    /// Speed; of the spectral sea that of the wind.
    Speed,
}

/// One press.
const FACTOR: f64 = 1.1;

/// By model: where a knob's keys are, and whether they shrink when the knob grows.
const KEYS: [(&str, Knob, &str, &str, bool); 11] = [
    ("fft", Knob::Steepness, "sea", "choppiness", false),
    ("fft", Knob::Wavelength, "sea", "fetch", false),
    ("fft", Knob::Amplitude, "sea", "amplitude", false),
    ("fft", Knob::Speed, "sea", "wind_speed", false),
    ("waves", Knob::Steepness, "sea.wave", "steepness", false),
    ("waves", Knob::Wavelength, "sea.wave", "wavelength", false),
    ("waves", Knob::Amplitude, "sea.wave", "amplitude", false),
    ("waves", Knob::Speed, "sea.wave", "speed", false),
    ("fbm", Knob::Wavelength, "sea", "frequency", true),
    ("fbm", Knob::Amplitude, "sea", "amplitude", false),
    ("fbm", Knob::Speed, "sea", "speed", false),
];

impl Panel {
    /// Does what a key asks for.
    pub fn quick(&mut self, quick: Quick) {
        match quick {
            Quick::Preset(key) => {
                if let Some(preset) = presets().into_iter().find(|preset| preset.key == Some(key)) {
                    self.take_preset(&preset);
                }
            }
            Quick::Readout(which) => {
                if let Some(shown) = self.readouts.get_mut(which) {
                    *shown = !*shown;
                }
            }
            Quick::Turn(knob, up) => self.turn(knob, if up { FACTOR } else { 1.0 / FACTOR }),
        }
    }

    /// The model of the sea: the word, or what holds without one.
    fn model(&self) -> String {
        match self.document.get(&Address::root().table("sea"), "model") {
            Some(Value::Text(model)) => model,
            _ => "fft".to_owned(),
        }
    }

    fn turn(&mut self, knob: Knob, factor: f64) {
        let model = self.model();
        let keys = KEYS.iter().filter(|(of, own, ..)| *of == model && *own == knob);
        let mut about = String::new();
        for (_, _, path, key, inverse) in keys {
            let here = |part: &&Part| part.path == *path && part.model.is_none_or(|own| own == model);
            let mut fields = self.parts.iter().filter(here).flat_map(|part| &part.fields);
            let Some(field) = fields.find(|field| field.name == *key) else { continue };
            let (kind, default) = (field.kind.clone(), field.default.clone());
            let factor = if *inverse { 1.0 / factor } else { factor };
            for address in self.addresses(path) {
                // A wave's speed that follows from its length stays so.
                let Some(now) = self.document.get(&address, key).or_else(|| default.clone()) else {
                    continue;
                };
                let Some(Value::Number(number)) = kind.fit(&now) else { continue };
                if let Some(new) = kind.fit(&Value::Number(number * factor)) {
                    self.document.set(&address, key, &new);
                    about = format!("{path}.{key} turned");
                }
            }
        }
        if !about.is_empty() {
            self.history.settle();
            self.changed_about(&about);
        }
    }

    /// Every table at `path`, which has at most one array: its last name.
    fn addresses(&self, path: &str) -> Vec<Address> {
        let (around, name) = path.rsplit_once('.').unwrap_or(("", path));
        let parent = around
            .split('.')
            .filter(|name| !name.is_empty())
            .fold(Address::root(), |at, name| at.table(name));
        if self.parts.iter().any(|part| part.path == path && part.several) {
            (0..self.document.count(&parent, name)).map(|index| parent.element(name, index)).collect()
        } else {
            vec![parent.table(name)]
        }
    }

    /// What keys 5 and 6 show.
    pub(super) fn show_readouts(&self, ui: &mut Ui) {
        if self.readouts[0] {
            CollapsingHeader::new("Each wave").default_open(true).show(ui, |ui| self.each_wave(ui));
        }
        if self.readouts[1] {
            CollapsingHeader::new("All waves").default_open(true).show(ui, |ui| self.all_waves(ui));
        }
    }

    fn waves(&self) -> Vec<Address> {
        self.addresses(if self.model() == "waves" { "sea.wave" } else { "sea.cascade" })
    }

    /// A table of the numbers that the file gives each of them.
    fn each_wave(&self, ui: &mut Ui) {
        let path = if self.model() == "waves" { "sea.wave" } else { "sea.cascade" };
        let Some(part) = self.parts.iter().find(|part| part.path == path) else { return };
        Grid::new("each wave").striped(true).show(ui, |ui| {
            for address in self.waves() {
                ui.strong(address.to_string());
                for field in &part.fields {
                    if let Some(value) = self.document.get(&address, field.name) {
                        ui.label(format!("{} {}", field.name, words(&value)));
                    }
                }
                ui.end_row();
            }
        });
    }

    /// Sums of the numbers that the file gives, and what the spectra promise.
    fn all_waves(&self, ui: &mut Ui) {
        let path = if self.model() == "waves" { "sea.wave" } else { "sea.cascade" };
        let waves = self.waves();
        if let Some(part) = self.parts.iter().find(|part| part.path == path && self.model() == "waves") {
            for field in part.fields.iter().filter(|field| matches!(field.kind, FieldKind::Number(_))) {
                let numbers = waves.iter().filter_map(|address| self.document.get(address, field.name));
                let numbers: Vec<f64> = numbers
                    .filter_map(|value| match field.kind.fit(&value) {
                        Some(Value::Number(number)) => Some(number),
                        _ => None,
                    })
                    .collect();
                if !numbers.is_empty() {
                    let sum: f64 = numbers.iter().sum();
                    ui.label(format!("sum of {}: {sum:.4} {}", field.name, field.unit));
                }
            }
        }
        if !self.facts.heights.is_empty() {
            let height = self.facts.height();
            ui.label(format!("standard deviation of the height: {height:.3} m"));
            ui.label(format!("significant wave height: {:.3} m", 4.0 * height));
        }
    }
}

fn words(value: &Value) -> String {
    match value {
        Value::Number(number) => number.to_string(),
        Value::Integer(number) => number.to_string(),
        Value::Numbers(numbers) => format!("{numbers:?}"),
        Value::Text(text) => text.clone(),
    }
}
