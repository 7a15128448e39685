//! The keys of a scene as things that can be shown and changed: what a panel is made from.
use super::key::{Absent, Key, Kind};
use super::section;

/// What a key's value may be.
#[derive(Clone, Debug, PartialEq)]
pub enum FieldKind {
    /// A finite number within these bounds, ends included.
    Number([f64; 2]),
    /// A whole number within these bounds, ends included.
    Integer([u64; 2]),
    /// A power of two within these bounds, ends included.
    PowerOfTwo([u64; 2]),
    /// So many finite numbers, each within these bounds.
    Numbers([f64; 2], usize),
    /// A linear Rec. 709 colour, three numbers of 0 to 1.
    Color,
    /// Two ascending numbers, 0 or more; the second may be infinite.
    Band,
    /// One of these words.
    Word(Vec<&'static str>),
    /// The path of a file.
    Path,
}

/// A value of a key, as a scene file holds it: angles in degrees.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A whole number.
    Integer(u64),
    /// Several numbers.
    Numbers(Vec<f64>),
    /// A word, or the path of a file.
    Text(String),
}

/// One key of a section.
#[derive(Clone, Debug)]
pub struct Field {
    /// Name within its section.
    pub name: &'static str,
    /// Unit, empty where there is none.
    pub unit: &'static str,
    /// Type and range.
    pub kind: FieldKind,
    /// The range in words, without the unit.
    pub range: String,
    /// What holds where the key is absent; nothing where only words can say that.
    pub default: Option<Value>,
    /// The same in words.
    pub default_text: String,
    /// What it means, one line.
    pub meaning: &'static str,
    /// Where the key is absent, what the section around this one says holds.
    pub inherited: bool,
    /// The words of the key `kind` beside it with which it may stand; empty where any will do.
    pub kinds: Vec<&'static str>,
}

impl Field {
    /// Whether it may stand in a table of this kind.
    pub fn is_for(&self, kind: Option<&str>) -> bool {
        self.kinds.is_empty() || kind.is_some_and(|kind| self.kinds.contains(&kind))
    }
}

/// Keys that say the same in two ways: one alone, or two that need each other.
#[derive(Clone, Copy, Debug)]
pub struct Alternative {
    /// The word of the key `kind` with which it is so.
    pub kind: &'static str,
    /// The key that says it alone. Where none of the three is there, its default holds.
    pub alone: &'static str,
    /// The two keys, each with a value to begin with.
    pub together: [(&'static str, f64); 2],
}

/// One section of a scene file, or what one model adds to it.
#[derive(Clone, Debug)]
pub struct Part {
    /// `sea.cascade`.
    pub path: &'static str,
    /// Whether there may be several: `[[sea.cascade]]`.
    pub several: bool,
    /// The word of the key `model`, its own or that of the table around it, with which these keys may stand; nothing where the model
    /// makes no difference.
    pub model: Option<&'static str>,
    /// Tables that may stand in it with this model.
    pub children: &'static [&'static str],
    /// Its keys, in the order of the documentation.
    pub fields: Vec<Field>,
    /// Those of its keys that stand in place of each other.
    pub alternative: Option<Alternative>,
}

/// Every section of a scene file with every key, from the schema that files are checked against.
pub fn parts() -> Vec<Part> {
    let part = |section: section::Section| Part {
        path: section.path,
        several: section.header.starts_with("[["),
        model: section.model,
        children: section.children,
        fields: section.rows.into_iter().map(field).collect(),
        alternative: section.alternative,
    };
    section::all().into_iter().map(part).collect()
}

fn field(row: section::Row) -> Field {
    Field {
        name: row.name,
        unit: row.unit,
        kind: row.kind,
        range: row.range,
        default: row.value,
        default_text: row.default,
        meaning: row.meaning,
        inherited: row.inherited,
        kinds: row.kinds,
    }
}

/// The type and range of `key`.
pub(super) fn kind<T>(key: &Key<T>) -> FieldKind {
    match key.kind {
        Kind::Number { range, .. } | Kind::Angle { range, .. } => FieldKind::Number(range),
        Kind::Integer { range, .. } => FieldKind::Integer(range),
        Kind::PowerOfTwo { range, .. } => FieldKind::PowerOfTwo(range),
        Kind::Pair { range, .. } => FieldKind::Numbers(range, 2),
        Kind::Triple { .. } if key.name.ends_with("color") => FieldKind::Color,
        Kind::Triple { range, .. } => FieldKind::Numbers(range, 3),
        Kind::Band { .. } => FieldKind::Band,
        Kind::Word { words, .. } => FieldKind::Word(words.iter().map(|(word, _)| *word).collect()),
        Kind::Path { .. } => FieldKind::Path,
    }
}

/// The default of `key`, where it has one that is a value.
pub(super) fn default<T>(key: &Key<T>) -> Option<Value> {
    fn is<V>(absent: Absent<V>, make: impl Fn(V) -> Value) -> Option<Value> {
        match absent {
            Absent::Is(value) => Some(make(value)),
            Absent::Means(_) => None,
        }
    }
    match key.kind {
        Kind::Number { absent, .. } | Kind::Angle { absent, .. } => is(absent, Value::Number),
        Kind::Integer { absent, .. } | Kind::PowerOfTwo { absent, .. } => is(absent, Value::Integer),
        Kind::Pair { absent, .. } => is(absent, |pair| Value::Numbers(pair.to_vec())),
        Kind::Triple { absent, .. } => is(absent, |triple| Value::Numbers(triple.to_vec())),
        Kind::Word { words, absent } => {
            words.iter().any(|(word, _)| *word == absent).then(|| Value::Text(absent.to_owned()))
        }
        Kind::Band { .. } | Kind::Path { .. } => None,
    }
}

impl FieldKind {
    /// `value` brought within the bounds; nothing where it is of another type, or is no number.
    pub fn fit(&self, value: &Value) -> Option<Value> {
        let number = |value: f64, [low, high]: [f64; 2]| (!value.is_nan()).then(|| value.clamp(low, high));
        match (self, value) {
            (Self::Number(range), Value::Number(given)) => number(*given, *range).map(Value::Number),
            (Self::Number(range), Value::Integer(given)) => number(*given as f64, *range).map(Value::Number),
            (Self::Integer([low, high]), Value::Integer(given)) => {
                Some(Value::Integer((*given).clamp(*low, *high)))
            }
            (Self::PowerOfTwo([low, high]), Value::Integer(given)) => {
                let power =
                    if given.is_power_of_two() { *given } else { given.checked_next_power_of_two()? };
                Some(Value::Integer(power.clamp(*low, *high)))
            }
            (Self::Numbers(range, count), Value::Numbers(given)) if given.len() == *count => {
                given.iter().map(|given| number(*given, *range)).collect::<Option<_>>().map(Value::Numbers)
            }
            (Self::Color, Value::Numbers(given)) if given.len() == 3 => {
                let part = |given: &f64| number(*given, [0.0, 1.0]);
                given.iter().map(part).collect::<Option<_>>().map(Value::Numbers)
            }
            (Self::Band, Value::Numbers(given)) => match given[..] {
                [low, high] if 0.0 <= low && low < high => Some(value.clone()),
                _ => None,
            },
            (Self::Word(words), Value::Text(given)) => words.contains(&given.as_str()).then(|| value.clone()),
            (Self::Path, Value::Text(_)) => Some(value.clone()),
            _ => None,
        }
    }
}
