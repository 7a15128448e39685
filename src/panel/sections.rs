//! The sections of a scene, made from the schema: keys that others add there appear here by themselves.

use super::{Panel, widgets};
use crate::scene::{Address, Field, Part, Value};
use egui::{CollapsingHeader, Grid, RichText, Ui};

/// A change of the document, made once nothing of it is borrowed.
enum Change {
    Set(Address, &'static str, Value),
    Unset(Address, &'static str),
    Add(Address, String),
    Remove(Address, String, usize),
}

impl Panel {
    /// Shows every section, and makes the change that a widget asked for.
    pub(super) fn show_sections(&mut self, ui: &mut Ui) {
        let mut changes = Vec::new();
        // Lent while widgets are shown, since places of widgets are noted meanwhile.
        let parts = std::mem::take(&mut self.parts);
        for part in parts.iter().filter(|part| parent_of(part, &parts).is_none()) {
            self.show_part(ui, &parts, part, &Address::root(), &mut changes);
        }
        self.parts = parts;
        for change in changes {
            self.make(change);
        }
    }

    fn make(&mut self, change: Change) {
        let about = match change {
            Change::Set(address, key, value) => {
                self.document.set(&address, key, &value);
                format!("{address}.{key}")
            }
            Change::Unset(address, key) => {
                self.document.unset(&address, key);
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

    /// Shows `part` of the table at `around`.
    fn show_part(
        &mut self,
        ui: &mut Ui,
        parts: &[Part],
        part: &Part,
        around: &Address,
        changes: &mut Vec<Change>,
    ) {
        let name = part.path.rsplit('.').next().unwrap_or_default();
        if !part.several {
            let address = around.table(name);
            self.collapsing(ui, &format!("[{}]", part.path), &address, |panel, ui| {
                panel.show_table(ui, parts, part, &address, changes);
            });
            return;
        }
        let count = self.document.count(around, name);
        for index in 0..count {
            let address = around.element(name, index);
            let title = format!("[[{}]] {}", part.path, index + 1);
            self.collapsing(ui, &title, &address, |panel, ui| {
                let remove = ui.small_button("Remove");
                panel.places.insert(format!("{address} remove"), remove.rect);
                if remove.clicked() {
                    changes.push(Change::Remove(around.clone(), name.to_owned(), index));
                }
                panel.show_table(ui, parts, part, &address, changes);
            });
        }
        let add = ui.small_button(format!("Add [[{}]]", part.path));
        self.places.insert(format!("{} add", around.table(name)), add.rect);
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
        self.places.insert(format!("[{address}]"), shown.header_response.rect);
    }

    /// The keys of one table, then the sections in it.
    fn show_table(
        &mut self,
        ui: &mut Ui,
        parts: &[Part],
        part: &Part,
        address: &Address,
        changes: &mut Vec<Change>,
    ) {
        Grid::new(address.to_string()).num_columns(3).striped(true).show(ui, |ui| {
            for field in &part.fields {
                self.show_field(ui, address, field, changes);
                ui.end_row();
            }
        });
        for inner in parts.iter().filter(|inner| parent_of(inner, parts) == Some(part.path)) {
            self.show_part(ui, parts, inner, address, changes);
        }
    }

    /// Name, widget, and a way back to the default.
    fn show_field(&mut self, ui: &mut Ui, address: &Address, field: &Field, changes: &mut Vec<Change>) {
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
                changes.extend(new.map(|new| Change::Set(address.clone(), field.name, new)));
                response.labelled_by(label.id)
            }
            None => {
                let set = ui.small_button("set").labelled_by(label.id).on_hover_text(&field.default_text);
                if set.clicked() {
                    let first = widgets::first_value(&field.kind);
                    let first = field.kind.fit(&first).unwrap_or(first);
                    changes.push(Change::Set(address.clone(), field.name, first));
                }
                set
            }
        };
        if self.sought.as_deref() == Some(path.as_str()) {
            response.scroll_to_me(Some(egui::Align::Center));
        }
        self.places.insert(path, response.rect);
        if is_set && ui.small_button("x").on_hover_text(format!("back to {}", field.default_text)).clicked() {
            changes.push(Change::Unset(address.clone(), field.name));
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

/// The section that `part` is a section of, where there is one.
fn parent_of(part: &Part, parts: &[Part]) -> Option<&'static str> {
    let (parent, _) = part.path.rsplit_once('.')?;
    parts.iter().map(|part| part.path).find(|path| *path == parent)
}
