//! Seas to begin with, by the source that describes them.

use super::Panel;
use crate::scene::{Address, Document};
use egui::{CollapsingHeader, Ui};

/// A sea with a name.
#[derive(Clone, Copy, Debug)]
pub struct Preset {
    /// For people.
    pub name: &'static str,
    /// Whose sea it is.
    pub source: &'static str,
    /// The key that picks it while the panel is shown.
    pub key: Option<char>,
    /// Sections of a scene, which take the place of the scene's own.
    pub text: &'static str,
}

const SPECTRAL: &str = "Aebi, \"VR Ocean\": spectra";
const FRACTAL: &str = "An article on procedural water: fractal sums";
const GERSTNER: &str = "A tutorial on Gerstner waves";
const SINES: &str = "Wu and Luk: sums of sines, by keys 8, 9 and 0";

/// All of them, those of a source together.
const PRESETS: [Preset; 11] = [
    Preset { name: "calm", source: SPECTRAL, key: None, text: include_str!("presets/calm.toml") },
    Preset { name: "fresh breeze", source: SPECTRAL, key: None, text: include_str!("presets/breeze.toml") },
    Preset { name: "gale", source: SPECTRAL, key: None, text: include_str!("presets/gale.toml") },
    Preset { name: "sines", source: FRACTAL, key: None, text: include_str!("presets/fbm_sine.toml") },
    Preset {
        name: "sharp crests",
        source: FRACTAL,
        key: None,
        text: include_str!("presets/fbm_exp_sine.toml"),
    },
    Preset { name: "one wave", source: GERSTNER, key: None, text: include_str!("presets/gerstner_one.toml") },
    Preset {
        name: "three waves",
        source: GERSTNER,
        key: None,
        text: include_str!("presets/gerstner_three.toml"),
    },
    Preset {
        name: "on a swell",
        source: GERSTNER,
        key: None,
        text: include_str!("presets/gerstner_layer.toml"),
    },
    Preset { name: "gentle", source: SINES, key: Some('8'), text: include_str!("presets/sines_gentle.toml") },
    Preset { name: "peaked", source: SINES, key: Some('9'), text: include_str!("presets/sines_peaked.toml") },
    Preset { name: "rings", source: SINES, key: Some('0'), text: include_str!("presets/rings.toml") },
];

/// The presets there are.
pub fn presets() -> Vec<Preset> {
    PRESETS.to_vec()
}

impl Panel {
    /// Takes over the sections of `preset`: one step of the history.
    pub fn take_preset(&mut self, preset: &Preset) {
        if let Ok(other) = Document::parse(preset.text, preset.name) {
            // What lies on the sea before would lie on this one too.
            self.document.unset(&Address::root(), "layer");
            self.document.take_over(&other);
            self.history.settle();
            self.changed_about(&format!("preset {}", preset.name));
            self.note = Some(format!("preset: {}", preset.name));
        }
    }

    pub(super) fn show_presets(&mut self, ui: &mut Ui) {
        let header = CollapsingHeader::new("Presets").default_open(true).show(ui, |ui| {
            let mut picked = None;
            let presets = presets();
            for group in presets.chunk_by(|a, b| a.source == b.source) {
                ui.weak(group[0].source);
                ui.horizontal_wrapped(|ui| {
                    for preset in group {
                        let label = preset
                            .key
                            .map_or_else(|| preset.name.to_owned(), |key| format!("{} ({key})", preset.name));
                        let button = ui.button(label);
                        self.note_place(format!("preset {}", preset.name), &button);
                        if button.clicked() {
                            picked = Some(*preset);
                        }
                    }
                });
            }
            picked
        });
        if let Some(preset) = header.body_returned.flatten() {
            self.take_preset(&preset);
        }
    }
}
