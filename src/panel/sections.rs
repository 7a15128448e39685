//! The sections of a scene, made from the schema: keys that others add there appear here by themselves.

use super::{Panel, widgets};
use crate::scene::{Address, Field, Part, Value};
use egui::{CollapsingHeader, Grid, RichText, Ui};

/// A change of the document, made once nothing of it is borrowed.
enum Change {
    /// With the section's path.
    Set(Address, &'static str, &'static str, Value),
    Unset(Address, &'static str, &'static str),
    Add(Address, String),
    Remove(Address, String, usize),
}

impl Panel {
    /// Shows every section, and makes the change that a widget asked for.
    pub(super) fn show_sections(&mut self, ui: &mut Ui) {
        let mut changes = Vec::new();
        // Lent while widgets are shown, since places of widgets are noted meanwhile.
        let parts = std::mem::take(&mut self.parts);
        for name in names(&parts, "") {
            self.show_part(ui, &parts, name, &Address::root(), &mut changes);
        }
        for change in changes {
            self.make(&parts, change);
        }
        self.parts = parts;
    }

    fn make(&mut self, parts: &[Part], change: Change) {
        let about = match change {
            Change::Set(address, path, key, value) => {
                self.document.set(&address, key, &value);
                self.follow(parts, &address, path, key);
                format!("{address}.{key}")
            }
            Change::Unset(address, path, key) => {
                self.document.unset(&address, key);
                self.follow(parts, &address, path, key);
                format!("{address}.{key} unset")
            }
            Change::Add(address, name) => {
                self.document.add(&address, &name);
                format!("{address}.{name} added")
            }
            Change::Remove(address, name, index) => {
                self.document.remove(&address, &name, index);
                format!("{address}.{name}[{index}] removed")
            }
        };
        self.changed_about(&about);
    }

    /// Shows the tables of the section `path` in the table at `around`.
    fn show_part(
        &mut self,
        ui: &mut Ui,
        parts: &[Part],
        path: &'static str,
        around: &Address,
        changes: &mut Vec<Change>,
    ) {
        let name = path.rsplit('.').next().unwrap_or_default();
        if !parts.iter().any(|part| part.path == path && part.several) {
            let address = around.table(name);
            self.collapsing(ui, &format!("[{path}]"), &address, |panel, ui| {
                panel.show_table(ui, parts, path, &address, changes);
            });
            return;
        }
        let count = self.document.count(around, name);
        for index in 0..count {
            let address = around.element(name, index);
            let title = format!("[[{path}]] {}", index + 1);
            self.collapsing(ui, &title, &address, |panel, ui| {
                let remove = ui.small_button("Remove");
                panel.note_place(format!("{address} remove"), &remove);
                if remove.clicked() {
                    changes.push(Change::Remove(around.clone(), name.to_owned(), index));
                }
                panel.show_table(ui, parts, path, &address, changes);
            });
        }
        let add = ui.small_button(format!("Add [[{path}]]"));
        self.note_place(format!("{} add", around.table(name)), &add);
        if add.clicked() {
            changes.push(Change::Add(around.clone(), name.to_owned()));
        }
    }

    /// A section that can be closed; it is open while a key within it is sought.
    fn collapsing(
        &mut self,
        ui: &mut Ui,
        title: &str,
        address: &Address,
        show: impl FnOnce(&mut Self, &mut Ui),
    ) {
        let within = self.sought.as_ref().is_some_and(|sought| {
            sought.strip_prefix(&address.to_string()).is_some_and(|rest| rest.starts_with(['.', '[']))
        });
        let header = CollapsingHeader::new(title).id_salt(address.to_string()).open(within.then_some(true));
        let shown = header.show(ui, |ui| show(self, ui));
        self.note_place(format!("[{address}]"), &shown.header_response);
    }

    /// The keys of one table, as its model and its kind have them, then the sections in it.
    fn show_table(
        &mut self,
        ui: &mut Ui,
        parts: &[Part],
        path: &'static str,
        address: &Address,
        changes: &mut Vec<Change>,
    ) {
        let model = self.model_of(parts, address, path);
        let kind = self.kind_of(parts, address, path);
        Grid::new(address.to_string()).num_columns(3).striped(true).show(ui, |ui| {
            for field in here(parts, path, model.as_deref()).flat_map(|part| &part.fields) {
                // One that the file has and should not have is there to be taken out.
                if field.is_for(kind.as_deref()) || self.document.get(address, field.name).is_some() {
                    self.show_field(ui, (address, path), field, changes);
                    ui.end_row();
                }
            }
        });
        let chosen = |part: &Part| part.path == path && part.model.is_some();
        for inner in names(parts, path) {
            let name = inner.rsplit('.').next().unwrap_or_default();
            let allowed = !parts.iter().any(chosen)
                || here(parts, path, model.as_deref()).any(|part| part.children.contains(&name));
            if allowed && here(parts, inner, model.as_deref()).next().is_some() {
                self.show_part(ui, parts, inner, address, changes);
            }
        }
    }

    /// Name, widget, and a way back to the default.
    fn show_field(
        &mut self,
        ui: &mut Ui,
        (address, section): (&Address, &'static str),
        field: &Field,
        changes: &mut Vec<Change>,
    ) {
        let path = format!("{address}.{}", field.name);
        let own = self.document.get(address, field.name);
        let is_set = own.is_some();
        let name = RichText::new(field.name);
        let label = ui.label(if is_set { name.strong() } else { name }).on_hover_ui(|ui| explain(ui, field));
        let value = own
            .or_else(|| field.inherited.then(|| self.document.get(&address.parent(), field.name)).flatten())
            .or_else(|| field.default.clone())
            .and_then(|value| field.kind.fit(&value));
        let response = match value {
            Some(value) => {
                let (response, new) = ui.push_id(&path, |ui| widgets::show(ui, field, &value)).inner;
                changes.extend(new.map(|new| Change::Set(address.clone(), section, field.name, new)));
                response.labelled_by(label.id)
            }
            None => {
                let set = ui.small_button("set").labelled_by(label.id).on_hover_text(&field.default_text);
                if set.clicked() {
                    let first = widgets::first_value(&field.kind);
                    let first = field.kind.fit(&first).unwrap_or(first);
                    changes.push(Change::Set(address.clone(), section, field.name, first));
                }
                set
            }
        };
        if is_set {
            let unset = ui.small_button("x").on_hover_text(format!("back to {}", field.default_text));
            self.note_place(format!("{path} unset"), &unset);
            if unset.clicked() {
                changes.push(Change::Unset(address.clone(), section, field.name));
            }
        }
        self.note_place(path, &response);
    }
}

/// What a key means, its range with its unit, and its default.
fn explain(ui: &mut Ui, field: &Field) {
    ui.set_max_width(360.0);
    ui.label(field.meaning);
    ui.weak(format!("{} {}", field.range, field.unit));
    let inherited = if field.inherited { "that of the section around it, or " } else { "" };
    ui.weak(format!("default: {inherited}{}", field.default_text));
}

/// What may stand in the section `path` with `model`.
pub(super) fn here<'p>(
    parts: &'p [Part],
    path: &'p str,
    model: Option<&'p str>,
) -> impl Iterator<Item = &'p Part> {
    parts.iter().filter(move |part| part.path == path && (part.model.is_none() || part.model == model))
}

/// Paths of the sections in the section `path`, each once.
fn names(parts: &[Part], path: &str) -> Vec<&'static str> {
    let mut names: Vec<&'static str> = Vec::new();
    for part in parts {
        let around = part.path.rsplit_once('.').map_or("", |(around, _)| around);
        if around == path && !names.contains(&part.path) {
            names.push(part.path);
        }
    }
    names
}
