//! The values of a table's keys: each of the type and within the range that its row of the schema says.
use super::{Item, Reader, join};
use crate::scene::error::SceneError;
use crate::scene::key::{Key, Kind, quoted};
use toml::de::{DeTable, DeValue};

impl Reader<'_> {
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
}
