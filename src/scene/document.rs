//! A scene file that is being changed: one value after the other, with everything else, comments included, left as it is.
use super::{Address, Scene, SceneError, Value, error::Place};
use toml_edit::{Array, ArrayOfTables, DocumentMut, InlineTable, Item, Table, TableLike, Value as Toml};

/// Digits of a number that a panel writes: a slider's position has no more.
const DIGITS: i32 = 7;

/// The text of a scene file, open for changes.
#[derive(Clone, Debug)]
pub struct Document {
    /// The comment that the file begins with. It is no table's, which could be replaced or removed.
    head: String,
    tree: DocumentMut,
}

impl Document {
    /// Opens `text`, of the file named `origin`, which need not be a whole scene.
    ///
    /// # Errors
    /// [`SceneError::Syntax`].
    pub fn parse(text: &str, origin: &str) -> Result<Self, SceneError> {
        let (head, body) = split_head(text);
        let tree = body.parse::<DocumentMut>().map_err(|error| {
            let at = head.len() + error.span().unwrap_or(0..0).start;
            SceneError::Syntax {
                place: Place::of(origin, text, at),
                message: error.message().replace('\n', "; "),
                near: "this place".to_owned(),
            }
        })?;
        Ok(Self { head: head.replace("\r\n", "\n"), tree })
    }

    /// The text as it would be saved.
    pub fn text(&self) -> String {
        let body = self.tree.to_string();
        // What stands first now may have had an empty line above it.
        let is_parted = self.head.lines().next_back().is_none_or(|line| line.trim().is_empty());
        let body = if is_parted { body.trim_start_matches('\n') } else { &body };
        format!("{}{body}", self.head)
    }

    /// The scene it says, by the reader that files go through.
    ///
    /// # Errors
    /// Those of [`Scene::parse`].
    pub fn scene(&self, origin: &str) -> Result<Scene, SceneError> {
        Scene::parse(&self.text(), origin)
    }

    /// The value of `key` in the table at `address`; nothing where it is absent or of a type that no key has.
    pub fn get(&self, address: &Address, key: &str) -> Option<Value> {
        value(self.table(address)?.get(key)?.as_value()?)
    }

    /// Gives `key` in the table at `address` a value. A table that is not there is made. What stands around a value that was
    /// there, a comment at the line's end, stays.
    pub fn set(&mut self, address: &Address, key: &str, new: &Value) {
        let Some(table) = self.table_mut(address) else { return };
        let mut item = toml(new);
        if let Some(old) = table.get(key).and_then(Item::as_value) {
            if value(old).as_ref() == Some(new) {
                return;
            }
            *item.decor_mut() = old.decor().clone();
        }
        match table.get_mut(key) {
            Some(place) => *place = Item::Value(item),
            None => {
                table.insert(key, Item::Value(item));
            }
        }
    }

    /// Removes `key` from the table at `address`: its default holds.
    pub fn unset(&mut self, address: &Address, key: &str) {
        if self.table(address).is_some()
            && let Some(table) = self.table_mut(address)
        {
            table.remove(key);
        }
    }

    /// Removes from the table at `address` whatever `may_stay` does not name.
    pub fn retain(&mut self, address: &Address, may_stay: impl Fn(&str) -> bool) {
        let Some(table) = self.table(address) else { return };
        let unwanted: Vec<String> =
            table.iter().map(|(name, _)| name.to_owned()).filter(|name| !may_stay(name)).collect();
        if let Some(table) = self.table_mut(address) {
            for name in unwanted {
                table.remove(&name);
            }
        }
    }

    /// How many tables the array `name` in the table at `address` has.
    pub fn count(&self, address: &Address, name: &str) -> usize {
        let item = self.table(address).and_then(|table| table.get(name));
        item.map_or(0, |item| match (item.as_array_of_tables(), item.as_array()) {
            (Some(tables), _) => tables.len(),
            (_, Some(array)) => array.len(),
            _ => 0,
        })
    }

    /// Adds a table without keys to the array `name` in the table at `address`.
    pub fn add(&mut self, address: &Address, name: &str) {
        let Some(table) = self.table_mut(address) else { return };
        let item = table.entry(name).or_insert_with(|| Item::ArrayOfTables(ArrayOfTables::new()));
        if let Some(tables) = item.as_array_of_tables_mut() {
            let mut new = Table::new();
            new.decor_mut().set_prefix("\n");
            tables.push(new);
        } else if let Some(array) = item.as_array_mut() {
            array.push(InlineTable::new());
        }
    }

    /// Removes table `index` of the array `name` in the table at `address`, and the array with the last of them.
    pub fn remove(&mut self, address: &Address, name: &str, index: usize) {
        let count = self.count(address, name);
        if index >= count {
            return;
        }
        let Some(table) = self.table_mut(address) else { return };
        if count == 1 {
            table.remove(name);
        } else if let Some(item) = table.get_mut(name) {
            if let Some(tables) = item.as_array_of_tables_mut() {
                tables.remove(index);
            } else if let Some(array) = item.as_array_mut() {
                array.remove(index);
            }
        }
    }

    /// Takes every table at the top of `other` for its own table of that name, all where the first of its own stood.
    pub fn take_over(&mut self, other: &Self) {
        let place = other.tree.iter().filter_map(|(name, _)| place(self.tree.get(name)?)).min();
        for (name, item) in other.tree.iter() {
            let mut item = item.clone();
            move_to(&mut item, place);
            if let Some(table) = item.as_table_mut() {
                let own = self.tree.get(name).and_then(Item::as_table);
                let above = own.and_then(|own| own.decor().prefix().cloned());
                table.decor_mut().set_prefix(above.unwrap_or_else(|| "\n".into()));
            }
            self.tree.insert(name, item);
        }
    }

    fn table(&self, address: &Address) -> Option<&dyn TableLike> {
        let mut table: &dyn TableLike = self.tree.as_table();
        for (name, index) in address.steps() {
            let item = table.get(name)?;
            table = match index {
                None => item.as_table_like()?,
                Some(index) => match item.as_array_of_tables() {
                    Some(tables) => tables.get(*index)?,
                    None => item.as_array()?.get(*index)?.as_inline_table()?,
                },
            };
        }
        Some(table)
    }

    /// The same for changes; tables on the way that are not there are made, elements of arrays are not.
    fn table_mut(&mut self, address: &Address) -> Option<&mut dyn TableLike> {
        let mut table: &mut dyn TableLike = self.tree.as_table_mut();
        let last = address.steps().len();
        for (at, (name, index)) in address.steps().iter().enumerate() {
            let item = table.entry(name).or_insert_with(|| {
                let mut new = Table::new();
                new.decor_mut().set_prefix("\n");
                // One that holds but other tables needs no header; it gets one with its first value.
                new.set_implicit(at + 1 < last);
                Item::Table(new)
            });
            table = match index {
                None => {
                    if let (Some(table), true) = (item.as_table_mut(), at + 1 == last) {
                        table.set_implicit(false);
                    }
                    item.as_table_like_mut()?
                }
                Some(index) if item.is_array_of_tables() => item.as_array_of_tables_mut()?.get_mut(*index)?,
                Some(index) => item.as_array_mut()?.get_mut(*index)?.as_inline_table_mut()?,
            };
        }
        Some(table)
    }
}

/// The comment and the empty lines that `text` begins with, and the rest.
fn split_head(text: &str) -> (&str, &str) {
    let says_nothing = |line: &&str| {
        let rest = line.trim_start_matches([' ', '\t']);
        rest.starts_with('#') || ["", "\n", "\r\n"].contains(&rest)
    };
    text.split_at(text.split_inclusive('\n').take_while(says_nothing).map(str::len).sum())
}

/// Which of a file's tables, counted from its beginning, the first table of `item` is.
fn place(item: &Item) -> Option<isize> {
    match item {
        Item::Table(table) => {
            table.position().or_else(|| table.iter().filter_map(|(_, item)| place(item)).min())
        }
        Item::ArrayOfTables(tables) => tables.iter().filter_map(Table::position).min(),
        _ => None,
    }
}

/// Has all tables of `item` written at `place`, one after the other.
fn move_to(item: &mut Item, place: Option<isize>) {
    let move_table = |table: &mut Table| {
        table.set_position(place);
        table.iter_mut().for_each(|(_, item)| move_to(item, place));
    };
    match item {
        Item::Table(table) => move_table(table),
        Item::ArrayOfTables(tables) => tables.iter_mut().for_each(move_table),
        _ => {}
    }
}

/// A value of the file's as one of ours.
fn value(toml: &Toml) -> Option<Value> {
    let number = |toml: &Toml| toml.as_float().or_else(|| toml.as_integer().map(|integer| integer as f64));
    match toml {
        Toml::String(text) => Some(Value::Text(text.value().clone())),
        Toml::Integer(integer) => {
            let whole = u64::try_from(*integer.value()).ok().map(Value::Integer);
            whole.or_else(|| number(toml).map(Value::Number))
        }
        Toml::Float(float) => Some(Value::Number(*float.value())),
        Toml::Array(array) => array.iter().map(number).collect::<Option<_>>().map(Value::Numbers),
        _ => None,
    }
}

/// One of our values as the file's.
fn toml(value: &Value) -> Toml {
    match value {
        Value::Number(number) => rounded(*number).into(),
        Value::Integer(integer) => i64::try_from(*integer).unwrap_or(i64::MAX).into(),
        Value::Numbers(numbers) => numbers.iter().map(|number| rounded(*number)).collect::<Array>().into(),
        Value::Text(text) => text.as_str().into(),
    }
}

/// A number with as many digits as anybody wants to read.
fn rounded(number: f64) -> f64 {
    if number == 0.0 || !number.is_finite() {
        return if number.is_finite() { 0.0 } else { number };
    }
    let text = format!("{number:.*e}", (DIGITS - 1) as usize);
    text.parse().unwrap_or(number)
}
