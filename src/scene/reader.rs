//! Checks the tables of a parsed file, and gathers what is wrong with it. `values` reads what is in them by the schema.
use super::error::{Place, SceneError};
use super::section;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

mod values;

/// Most characters of a value that an error repeats.
const EXCERPT: usize = 60;

type Item<'i> = Spanned<DeValue<'i>>;

/// One file being read: gathers what is wrong with it, so that the first fault in the file is the one reported.
pub(super) struct Reader<'s> {
    file: &'s str,
    text: &'s str,
    first_fault: Option<(usize, SceneError)>,
    warnings: Vec<String>,
}

impl<'s> Reader<'s> {
    pub fn new(file: &'s str, text: &'s str) -> Self {
        Self { file, text, first_fault: None, warnings: Vec::new() }
    }

    /// The warnings, or the first fault found.
    pub fn finish(self) -> Result<Vec<String>, SceneError> {
        self.first_fault.map_or(Ok(self.warnings), |(_, error)| Err(error))
    }

    /// Notes something that is allowed and hardly meant.
    pub fn warn(&mut self, span: &Range<usize>, message: String) {
        self.warnings.push(format!("{}: {message}", self.place(span)));
    }

    /// Reports values that contradict one another, at the value of `key`.
    pub fn contradiction(&mut self, key: String, span: Range<usize>, problem: String) {
        let value = self.excerpt(&span);
        let place = self.place(&span);
        self.fault(&span, SceneError::Contradiction { place, key, value, problem });
    }

    /// Reports each key of `table` that is in none of `names`.
    pub fn check_names(
        &mut self,
        path: &str,
        table: &DeTable<'_>,
        names: &[&'static str],
        children: &[&'static str],
    ) {
        for key in table.keys() {
            let name: &str = key.get_ref();
            if !names.contains(&name) && !children.contains(&name) {
                let span = key.span();
                let error = SceneError::UnknownKey {
                    place: self.place(&span),
                    key: shorten(&join(path, name)),
                    hint: section::hint(path, name, &[names, children].concat()),
                };
                self.fault(&span, error);
            }
        }
    }

    /// The table `name` of `parent`, or nothing where it is absent or no table.
    pub fn table<'t, 'i>(
        &mut self,
        path: &str,
        parent: &'t DeTable<'i>,
        name: &str,
    ) -> Option<&'t DeTable<'i>> {
        let item = parent.get(name)?;
        match item.get_ref() {
            DeValue::Table(table) => Some(table),
            _ => {
                let path = join(path, name);
                self.wrong_type(path.clone(), item, format!("a table, [{path}]"));
                None
            }
        }
    }

    /// The tables of the array `name` of `parent`, each with its place.
    pub fn tables<'t, 'i>(
        &mut self,
        path: &str,
        parent: &'t DeTable<'i>,
        name: &str,
    ) -> Vec<(&'t DeTable<'i>, Range<usize>)> {
        let Some(item) = parent.get(name) else { return Vec::new() };
        let path = join(path, name);
        let wanted = format!("tables, each headed [[{path}]]");
        let DeValue::Array(array) = item.get_ref() else {
            self.wrong_type(path, item, wanted);
            return Vec::new();
        };
        let mut tables = Vec::new();
        for element in array.iter() {
            match element.get_ref() {
                DeValue::Table(table) => tables.push((table, element.span())),
                _ => self.wrong_type(path.clone(), element, wanted.clone()),
            }
        }
        tables
    }

    fn wrong_type(&mut self, key: String, item: &Item<'_>, wanted: String) {
        let span = item.span();
        let found = match item.get_ref() {
            DeValue::String(_) => "a string",
            DeValue::Integer(_) => "a whole number",
            DeValue::Float(_) => "a number with a fraction",
            DeValue::Boolean(_) => "a boolean",
            DeValue::Datetime(_) => "a date",
            DeValue::Array(_) => "an array",
            DeValue::Table(_) => "a table",
        };
        let error = SceneError::WrongType {
            place: self.place(&span),
            key,
            value: self.excerpt(&span),
            found,
            wanted,
        };
        self.fault(&span, error);
    }

    fn fault(&mut self, span: &Range<usize>, error: SceneError) {
        if self.first_fault.as_ref().is_none_or(|(offset, _)| span.start < *offset) {
            self.first_fault = Some((span.start, error));
        }
    }

    fn place(&self, span: &Range<usize>) -> Box<Place> {
        Place::of(self.file, self.text, span.start)
    }

    fn excerpt(&self, span: &Range<usize>) -> String {
        excerpt(self.text, span.clone())
    }
}

/// The text of `span` on one line and not too long.
pub(super) fn excerpt(text: &str, span: Range<usize>) -> String {
    shorten(text.get(span).unwrap_or_default())
}

fn shorten(text: &str) -> String {
    let mut letters = text.chars();
    let mut short = String::new();
    for letter in letters.by_ref().take(EXCERPT) {
        if letter.is_control() {
            short.extend(letter.escape_default());
        } else {
            short.push(letter);
        }
    }
    if letters.next().is_some() {
        short.push_str("...");
    }
    short
}

fn join(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") }
}
