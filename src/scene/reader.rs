//! Checks the tables of a parsed file against the schema and stores their values.
use super::error::{Place, SceneError};
use super::key::{Key, Kind, quoted};
use super::section;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

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

    /// Stores the value of each of `keys` that `table` has; the others keep what `into` holds.
    pub fn read<T>(&mut self, path: &str, table: &DeTable<'_>, keys: &[Key<T>], into: &mut T) {
        for key in keys {
            if let Some(item) = table.get(key.name) {
                self.read_key(&join(path, key.name), item, key, into);
            }
        }
    }

    fn read_key<T>(&mut self, path: &str, item: &Item<'_>, key: &Key<T>, into: &mut T) {
        match key.kind {
            Kind::Number { range, set, .. } => {
                if let Some(value) = self.number(path, item, range, key) {
                    set(into, value);
                }
            }
            Kind::Angle { range, set, .. } => {
                if let Some(value) = self.number(path, item, range, key) {
                    set(into, value.to_radians());
                }
            }
            Kind::Integer { range, set, .. } => {
                if let Some(value) = self.integer(path, item, range, key) {
                    set(into, value);
                }
            }
            Kind::PowerOfTwo { range, set, .. } => match self.integer(path, item, range, key) {
                Some(value) if value.is_power_of_two() => set(into, value),
                Some(_) => self.out_of_range(path, item, "not a power of two", key),
                None => {}
            },
            Kind::Pair { range, set, .. } => {
                if let Some([a, b]) = self.array(path, item, key)
                    && let Some(a) = self.number(path, a, range, key)
                    && let Some(b) = self.number(path, b, range, key)
                {
                    set(into, [a, b]);
                }
            }
            Kind::Triple { range, set, .. } => {
                if let Some([a, b, c]) = self.array(path, item, key)
                    && let Some(a) = self.number(path, a, range, key)
                    && let Some(b) = self.number(path, b, range, key)
                    && let Some(c) = self.number(path, c, range, key)
                {
                    set(into, [a, b, c]);
                }
            }
            Kind::Band { set, .. } => {
                if let Some([low, high]) = self.array(path, item, key)
                    && let Some(low) = self.number(path, low, [0.0, f64::MAX], key)
                    && let Some(high) = self.number_or_infinity(path, high, [0.0, f64::INFINITY], key)
                {
                    if low < high {
                        set(into, [low, high]);
                    } else {
                        self.out_of_range(path, item, "out of range", key);
                    }
                }
            }
            Kind::Word { words, .. } => {
                let DeValue::String(given) = item.get_ref() else {
                    return self.wrong_type_for(path, item, key);
                };
                match words.iter().find(|(word, _)| word == given) {
                    Some((_, set)) => set(into),
                    None => {
                        let span = item.span();
                        let error = SceneError::UnknownWord {
                            place: self.place(&span),
                            key: path.to_owned(),
                            value: self.excerpt(&span),
                            words: quoted(words.iter().map(|(word, _)| *word)),
                        };
                        self.fault(&span, error);
                    }
                }
            }
            Kind::Path { set, .. } => match item.get_ref() {
                DeValue::String(given) => set(into, given),
                _ => self.wrong_type_for(path, item, key),
            },
        }
    }

    fn number<T>(&mut self, path: &str, item: &Item<'_>, range: [f64; 2], key: &Key<T>) -> Option<f64> {
        let value = self.number_or_infinity(path, item, range, key)?;
        if value.is_infinite() {
            self.out_of_range(path, item, "not a finite number", key);
            return None;
        }
        Some(value)
    }

    fn number_or_infinity<T>(
        &mut self,
        path: &str,
        item: &Item<'_>,
        [min, max]: [f64; 2],
        key: &Key<T>,
    ) -> Option<f64> {
        let value = match item.get_ref() {
            DeValue::Float(float) => float.as_str().parse().unwrap_or(f64::NAN),
            // An integer too long for 128 bits is out of every range there is.
            DeValue::Integer(integer) => {
                i128::from_str_radix(integer.as_str(), integer.radix()).map_or(f64::MAX, |value| value as f64)
            }
            _ => {
                self.wrong_type_for(path, item, key);
                return None;
            }
        };
        if value.is_nan() || (value.is_infinite() && max.is_finite()) {
            self.out_of_range(path, item, "not a finite number", key);
            None
        } else if value < min || value > max {
            self.out_of_range(path, item, "out of range", key);
            None
        } else {
            Some(value)
        }
    }

    fn integer<T>(&mut self, path: &str, item: &Item<'_>, [min, max]: [u64; 2], key: &Key<T>) -> Option<u64> {
        let DeValue::Integer(integer) = item.get_ref() else {
            self.wrong_type_for(path, item, key);
            return None;
        };
        let value = u64::from_str_radix(integer.as_str(), integer.radix());
        match value {
            Ok(value) if (min..=max).contains(&value) => Some(value),
            _ => {
                self.out_of_range(path, item, "out of range", key);
                None
            }
        }
    }

    fn array<'t, 'i, T, const N: usize>(
        &mut self,
        path: &str,
        item: &'t Item<'i>,
        key: &Key<T>,
    ) -> Option<[&'t Item<'i>; N]> {
        if let DeValue::Array(array) = item.get_ref()
            && let Ok(elements) = array.iter().collect::<Vec<_>>().try_into()
        {
            return Some(elements);
        }
        self.wrong_type_for(path, item, key);
        None
    }

    fn out_of_range<T>(&mut self, path: &str, item: &Item<'_>, problem: &'static str, key: &Key<T>) {
        let span = item.span();
        let error = SceneError::OutOfRange {
            place: self.place(&span),
            key: path.to_owned(),
            value: self.excerpt(&span),
            problem,
            range: key.range(),
        };
        self.fault(&span, error);
    }

    fn wrong_type_for<T>(&mut self, path: &str, item: &Item<'_>, key: &Key<T>) {
        self.wrong_type(path.to_owned(), item, format!("{}: {}", key.type_name(), key.range()));
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
