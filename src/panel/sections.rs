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

/// The key that says which other keys may stand beside it.
const MODEL: &str = "model";

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
                if key == MODEL {
                    self.leave_out(parts, &address, path);
                }
                format!("{address}.{key}")
            }
            Change::Unset(address, path, key) => {
                self.document.unset(&address, key);
                if key == MODEL {
                    self.leave_out(parts, &address, path);
                }
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

    /// The table at `address` has another model now: what that one does not know would be an error.
    fn leave_out(&mut self, parts: &[Part], address: &Address, path: &str) {
        let model = self.model_of(parts, address, path);
        let here: Vec<&Part> = here(parts, path, model.as_deref()).collect();
        self.document.retain(address, |name| {
            here.iter().any(|part| {
                part.children.contains(&name) || part.fields.iter().any(|field| field.name == name)
            })
        });
        // One of the same name may stand there with other keys in it.
        for child in
            parts.iter().filter(|part| part.path.rsplit_once('.').is_some_and(|(around, _)| around == path))
        {
            let name = child.path.rsplit('.').next().unwrap_or_default();
            if child.model.is_some() && self.document.get(&address.table(name), MODEL).is_none() {
                let inner = address.table(name);
                let known: Vec<&Part> = self::here(parts, child.path, model.as_deref()).collect();
                self.document.retain(&inner, |key| {
                    known.iter().any(|part| part.fields.iter().any(|field| field.name == key))
                });
            }
        }
    }

    /// The model of the table at `address`, a `path`, or else of the table around it.
    fn model_of(&self, parts: &[Part], address: &Address, path: &str) -> Option<String> {
        let field = parts.iter().filter(|part| part.path == path).flat_map(|part| &part.fields);
        let own = field.clone().find(|field| {
            field.name == MODEL && parts.iter().any(|part| part.path == path && part.model.is_some())
        });
        match own {
            Some(field) => match self.document.get(address, MODEL).or_else(|| field.default.clone()) {
                Some(Value::Text(model)) => Some(model),
                _ => None,
            },
            None => {
                let (around, _) = path.rsplit_once('.')?;
                self.model_of(parts, &address.parent(), around)
            }
        }
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

    /// The keys of one table, as its model has them, then the sections in it.
    fn show_table(
        &mut self,
        ui: &mut Ui,
        parts: &[Part],
        path: &'static str,
        address: &Address,
        changes: &mut Vec<Change>,
    ) {
        let model = self.model_of(parts, address, path);
        Grid::new(address.to_string()).num_columns(3).striped(true).show(ui, |ui| {
            for field in here(parts, path, model.as_deref()).flat_map(|part| &part.fields) {
                self.show_field(ui, (address, path), field, changes);
                ui.end_row();
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
        self.note_place(path, &response);
        if is_set && ui.small_button("x").on_hover_text(format!("back to {}", field.default_text)).clicked() {
            changes.push(Change::Unset(address.clone(), section, field.name));
        }
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
fn here<'p>(parts: &'p [Part], path: &'p str, model: Option<&'p str>) -> impl Iterator<Item = &'p Part> {
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
