//! The panel in which a scene is authored: every key of the schema as a widget, presets, plots, undo, save.
//!
//! It knows egui and scenes, and neither Vulkan nor windows: whoever shows it asks [`Panel::changed`] for text to try, tells what
//! became of that, and feeds the plots. Values out of range cannot be given: widgets keep to the schema's ranges. See
//! `docs/panel.md`.

mod consequences;
mod facts;
mod plots;
mod pointer;
mod presets;
mod quick;
mod sections;
mod widgets;

pub use facts::Facts;
pub use plots::{Measured, SECTION_POINTS, SECTION_STEP};
pub use pointer::draw_pointer;
pub use presets::{Preset, presets};
pub use quick::{Knob, Quick};

use crate::output::atomic::write_whole;
use crate::scene::{Document, History, Part, SceneError, parts};
use egui::{Key, KeyboardShortcut, Modifiers, Rect, RichText, Ui};
use plots::Plots;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Where a scene is saved that came from no file.
const UNNAMED: &str = "swell_scene.toml";
/// Points.
const WIDTH: f32 = 390.0;

/// A scene's text, its history and what the panel shows of both.
pub struct Panel {
    file: PathBuf,
    /// Names the text in errors; relative paths in it start from its folder.
    origin: String,
    history: History,
    document: Document,
    parts: Vec<Part>,
    /// The text handed out last.
    told: String,
    /// Why the text is not what is drawn.
    trouble: Option<String>,
    /// What of it is allowed and hardly meant.
    warnings: Vec<String>,
    /// What happened last.
    note: Option<String>,
    /// Shaders that do not compile.
    shader_trouble: Option<String>,
    plots: Plots,
    facts: Facts,
    /// Readouts that keys 5 and 6 show.
    readouts: [bool; 2],
    /// Where each widget is, by its key's path: `sea.wind_speed`.
    places: HashMap<String, Rect>,
    /// The key to bring into view.
    sought: Option<String>,
}

/// A change asked for by a key and not by a widget.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edit {
    /// One step back.
    Undo,
    /// One step forth.
    Redo,
    /// To the file.
    Save,
}

impl Panel {
    /// For the scene in `text`, of the file `file` where there is one.
    ///
    /// # Errors
    /// [`SceneError::Syntax`], for text that no scene was read from.
    pub fn new(text: String, file: Option<&Path>) -> Result<Self, SceneError> {
        let file = file.map_or_else(|| PathBuf::from(UNNAMED), Path::to_owned);
        let origin = file.display().to_string();
        let document = Document::parse(&text, &origin)?;
        Ok(Self {
            file,
            origin,
            told: text.clone(),
            history: History::new(text),
            document,
            parts: parts(),
            trouble: None,
            warnings: Vec::new(),
            note: None,
            shader_trouble: None,
            plots: Plots::default(),
            facts: Facts::default(),
            readouts: [false; 2],
            places: HashMap::new(),
            sought: None,
        })
    }

    /// The text as it is.
    pub fn text(&self) -> &str {
        self.history.text()
    }

    /// The name of the text in errors.
    pub fn origin(&self) -> &str {
        &self.origin
    }

    /// The file that it is saved to.
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// The text, if it is another than at the last call: to be read, and drawn if it is a scene.
    pub fn changed(&mut self) -> Option<String> {
        if self.told == self.history.text() {
            return None;
        }
        self.history.text().clone_into(&mut self.told);
        Some(self.told.clone())
    }

    /// The text handed out last is drawn now; `warnings` tell what of it is hardly meant.
    pub fn accepted(&mut self, facts: Facts, warnings: &[String]) {
        (self.trouble, self.facts, self.warnings) = (None, facts, warnings.to_vec());
    }

    /// The text handed out last cannot be drawn: what was drawn before is drawn still.
    pub fn refused(&mut self, reason: String) {
        self.trouble = Some(reason);
    }

    /// Whether nobody has told it of the sea that is drawn.
    pub const fn wants_facts(&self) -> bool {
        self.facts.heights.is_empty()
    }

    /// Why the text is not what is drawn, where it is not.
    pub fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref()
    }

    /// Shaders were compiled anew: the error, where there is one.
    pub fn shaders(&mut self, trouble: Option<String>) {
        self.note = trouble.is_none().then(|| "shaders compiled anew".to_owned());
        self.shader_trouble = trouble;
    }

    /// Numbers for the plots.
    pub const fn plots(&mut self) -> &mut Plots {
        &mut self.plots
    }

    /// The file has been written by somebody else, and says `text`: an undoable step. Nothing happens where the panel wrote it.
    pub fn reload(&mut self, text: String) {
        match Document::parse(&text, &self.origin) {
            Ok(document) => {
                if self.history.reload(text) {
                    self.document = document;
                    self.note = Some(format!("{} was changed and read again", self.origin));
                }
            }
            Err(error) => self.trouble = Some(error.to_string()),
        }
    }

    /// Does what a key asks for.
    pub fn edit(&mut self, edit: Edit) {
        match edit {
            Edit::Undo => {
                self.history.undo();
            }
            Edit::Redo => {
                self.history.redo();
            }
            Edit::Save => return self.save(),
        }
        self.note = None;
        self.read_history();
    }

    /// Writes the file, whole or not at all. A text that is no scene is not written.
    pub fn save(&mut self) {
        if let Some(trouble) = &self.trouble {
            self.note = Some(format!("not saved: {trouble}"));
            return;
        }
        let text = self.history.text();
        self.note = Some(match write_whole(&self.file, |sink| sink.write_all(text.as_bytes())) {
            Ok(()) => {
                let saved = format!("saved to {}", self.file.display());
                self.history.mark_saved();
                saved
            }
            Err(error) => error.to_string(),
        });
    }

    /// What happened last, for people.
    pub fn note(&self) -> Option<&str> {
        self.note.as_deref()
    }

    /// Where the widget of the key at `path` was shown last, in points.
    pub fn place(&self, path: &str) -> Option<Rect> {
        self.places.get(path).copied()
    }

    /// Where the word `text` of a list that is open was shown last, in points.
    pub fn choice(context: &egui::Context, text: &str) -> Option<Rect> {
        context.data(|data| data.get_temp(widgets::choice_id(text)))
    }

    /// Opens the sections around the key at `path` and scrolls to it, in the next frame.
    pub fn seek(&mut self, path: &str) {
        self.sought = Some(path.to_owned());
    }

    /// Notes where `widget` is, which `path` names, and scrolls to it if it is sought.
    fn note_place(&mut self, path: String, widget: &egui::Response) {
        if self.sought.as_ref() == Some(&path) {
            widget.scroll_to_me(Some(egui::Align::Center));
        }
        self.places.insert(path, widget.rect);
    }

    /// The document is the history's text again.
    fn read_history(&mut self) {
        // Every text in it was a document once.
        if let Ok(document) = Document::parse(self.history.text(), &self.origin) {
            self.document = document;
        }
    }

    /// The document was changed, in what `about` names.
    fn changed_about(&mut self, about: &str) {
        self.history.change(about, self.document.text());
        self.note = None;
    }

    /// Shows it at the right of `ui`.
    pub fn show(&mut self, ui: &mut Ui) {
        self.shortcuts(ui);
        let side = egui::Panel::right("swell panel").default_size(WIDTH).size_range(260.0..=900.0);
        side.show(ui, |ui| self.contents(ui));
    }

    /// Shows it in all of `ui`.
    pub fn fill(&mut self, ui: &mut Ui) {
        egui::CentralPanel::default().show(ui, |ui| self.contents(ui));
    }

    fn contents(&mut self, ui: &mut Ui) {
        self.places.clear();
        self.head(ui);
        ui.separator();
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            self.show_presets(ui);
            self.show_readouts(ui);
            self.show_sections(ui);
            self.plots.show(ui, &self.facts);
        });
        self.sought = None;
        if !ui.input(|input| input.pointer.any_down()) {
            self.history.settle();
        }
    }

    fn shortcuts(&mut self, ui: &Ui) {
        let redo = Modifiers::COMMAND | Modifiers::SHIFT;
        let keys = [
            (KeyboardShortcut::new(redo, Key::Z), Edit::Redo),
            (KeyboardShortcut::new(Modifiers::COMMAND, Key::Y), Edit::Redo),
            (KeyboardShortcut::new(Modifiers::COMMAND, Key::Z), Edit::Undo),
            (KeyboardShortcut::new(Modifiers::COMMAND, Key::S), Edit::Save),
        ];
        for (key, edit) in keys {
            if ui.input_mut(|input| input.consume_shortcut(&key)) {
                self.edit(edit);
            }
        }
    }

    /// Undo, redo, save, and what is wrong.
    fn head(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            let edits = [
                ("Undo", "Ctrl Z", Edit::Undo, self.history.can_undo()),
                ("Redo", "Ctrl Y, Ctrl Shift Z", Edit::Redo, self.history.can_redo()),
                ("Save", "Ctrl S", Edit::Save, true),
            ];
            for (label, keys, edit, possible) in edits {
                let button = ui.add_enabled(possible, egui::Button::new(label)).on_hover_text(keys);
                self.note_place(label.to_owned(), &button);
                if button.clicked() {
                    self.edit(edit);
                }
            }
            let changed = if self.history.is_changed() { " (changed)" } else { "" };
            ui.label(format!("{}{changed}", self.file.display()));
        });
        let wrong = ui.visuals().error_fg_color;
        for trouble in [&self.trouble, &self.shader_trouble].into_iter().flatten() {
            ui.label(RichText::new(trouble).color(wrong));
        }
        let doubtful = ui.visuals().warn_fg_color;
        for warning in &self.warnings {
            ui.label(RichText::new(warning).color(doubtful));
        }
        if let Some(note) = &self.note {
            ui.label(RichText::new(note).weak());
        }
    }
}
