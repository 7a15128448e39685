//! One key of a scene file: its name, type, unit, range, default, meaning, and where its value goes.

/// What holds when a key is absent.
#[derive(Clone, Copy)]
pub(super) enum Absent<V> {
    /// This value.
    Is(V),
    /// What these words say; nothing is set.
    Means(&'static str),
}

/// A word a key may have, and what it sets.
pub(super) type Word<T> = (&'static str, fn(&mut T));

/// Type, range and default of a key, and how its value is stored in a `T`.
pub(super) enum Kind<T: 'static> {
    /// A finite number within `range`, ends included.
    Number { range: [f64; 2], absent: Absent<f64>, set: fn(&mut T, f64) },
    /// The same in degrees; `set` receives radians.
    Angle { range: [f64; 2], absent: Absent<f64>, set: fn(&mut T, f64) },
    /// A whole number within `range`, ends included.
    Integer { range: [u64; 2], absent: Absent<u64>, set: fn(&mut T, u64) },
    /// A power of two within `range`, ends included.
    PowerOfTwo { range: [u64; 2], absent: Absent<u64>, set: fn(&mut T, u64) },
    /// Two finite numbers, each within `range`.
    Pair { range: [f64; 2], absent: Absent<[f64; 2]>, set: fn(&mut T, [f64; 2]) },
    /// Three finite numbers, each within `range`.
    Triple { range: [f64; 2], absent: Absent<[f64; 3]>, set: fn(&mut T, [f64; 3]) },
    /// Two numbers, `0 <= low < high`, of which the second may be infinite.
    Band { absent: &'static str, set: fn(&mut T, [f64; 2]) },
    /// One of a few words.
    Word { words: &'static [Word<T>], absent: &'static str },
    /// The path of a file.
    Path { absent: &'static str, set: fn(&mut T, &str) },
}

/// One row of the schema.
pub(super) struct Key<T: 'static> {
    /// Name within its section.
    pub name: &'static str,
    /// Unit, empty when there is none.
    pub unit: &'static str,
    /// Type, range, default, destination.
    pub kind: Kind<T>,
    /// One line for the reader of `docs/scene.md`.
    pub meaning: &'static str,
}

impl<T> Key<T> {
    /// Stores the default in `into`; does nothing where the default is described in words.
    pub fn apply_default(&self, into: &mut T) {
        match self.kind {
            Kind::Number { absent: Absent::Is(value), set, .. } => set(into, value),
            Kind::Angle { absent: Absent::Is(value), set, .. } => set(into, value.to_radians()),
            Kind::Integer { absent: Absent::Is(value), set, .. }
            | Kind::PowerOfTwo { absent: Absent::Is(value), set, .. } => set(into, value),
            Kind::Pair { absent: Absent::Is(value), set, .. } => set(into, value),
            Kind::Triple { absent: Absent::Is(value), set, .. } => set(into, value),
            Kind::Word { words, absent } => {
                if let Some((_, set)) = words.iter().find(|(word, _)| *word == absent) {
                    set(into);
                }
            }
            _ => {}
        }
    }

    /// The type, for people: "a number".
    pub fn type_name(&self) -> &'static str {
        match self.kind {
            Kind::Number { .. } | Kind::Angle { .. } => "a number",
            Kind::Integer { .. } => "a whole number",
            Kind::PowerOfTwo { .. } => "a power of two",
            Kind::Triple { .. } => "three numbers",
            Kind::Pair { .. } | Kind::Band { .. } => "two numbers",
            Kind::Word { .. } => "a word",
            Kind::Path { .. } => "a path",
        }
    }

    /// The range without its unit: "0 to 60", or the words allowed.
    pub fn bare_range(&self) -> String {
        match self.kind {
            Kind::Number { range: [min, max], .. }
            | Kind::Angle { range: [min, max], .. }
            | Kind::Pair { range: [min, max], .. }
            | Kind::Triple { range: [min, max], .. } => format!("{min} to {max}"),
            Kind::Integer { range: [min, max], .. } | Kind::PowerOfTwo { range: [min, max], .. } => {
                format!("{min} to {max}")
            }
            Kind::Band { .. } => "0 <= low < high, high may be inf".to_owned(),
            Kind::Word { words, .. } => quoted(words.iter().map(|(word, _)| *word)),
            Kind::Path { .. } => "a file that exists".to_owned(),
        }
    }

    /// The range with its unit: "0 to 60 m/s".
    pub fn range(&self) -> String {
        match self.unit {
            "" => self.bare_range(),
            unit => format!("{} {unit}", self.bare_range()),
        }
    }

    /// The default as it would be written in a scene file, or in words.
    pub fn default_text(&self) -> String {
        fn text<V>(absent: Absent<V>, write: impl Fn(V) -> String) -> String {
            match absent {
                Absent::Is(value) => write(value),
                Absent::Means(words) => words.to_owned(),
            }
        }
        match self.kind {
            Kind::Number { absent, .. } | Kind::Angle { absent, .. } => text(absent, |v| v.to_string()),
            Kind::Integer { absent, .. } | Kind::PowerOfTwo { absent, .. } => text(absent, |v| v.to_string()),
            Kind::Pair { absent, .. } => text(absent, |[a, b]| format!("[{a}, {b}]")),
            Kind::Triple { absent, .. } => text(absent, |[a, b, c]| format!("[{a}, {b}, {c}]")),
            Kind::Word { absent, .. } => format!("\"{absent}\""),
            Kind::Band { absent, .. } | Kind::Path { absent, .. } => absent.to_owned(),
        }
    }
}

/// A number that is always there.
pub(super) const fn number<T>(
    name: &'static str,
    unit: &'static str,
    range: [f64; 2],
    default: f64,
    set: fn(&mut T, f64),
    meaning: &'static str,
) -> Key<T> {
    Key { name, unit, kind: Kind::Number { range, absent: Absent::Is(default), set }, meaning }
}

/// A number whose absence means something of its own.
pub(super) const fn optional<T>(
    name: &'static str,
    unit: &'static str,
    range: [f64; 2],
    absent: &'static str,
    set: fn(&mut T, f64),
    meaning: &'static str,
) -> Key<T> {
    Key { name, unit, kind: Kind::Number { range, absent: Absent::Means(absent), set }, meaning }
}

/// An angle in degrees.
pub(super) const fn angle<T>(
    name: &'static str,
    range: [f64; 2],
    default: f64,
    set: fn(&mut T, f64),
    meaning: &'static str,
) -> Key<T> {
    Key { name, unit: "degrees", kind: Kind::Angle { range, absent: Absent::Is(default), set }, meaning }
}

/// A power of two.
pub(super) const fn power_of_two<T>(
    name: &'static str,
    range: [u64; 2],
    default: u64,
    set: fn(&mut T, u64),
    meaning: &'static str,
) -> Key<T> {
    Key { name, unit: "", kind: Kind::PowerOfTwo { range, absent: Absent::Is(default), set }, meaning }
}

/// One of a few words.
pub(super) const fn word<T>(
    name: &'static str,
    default: &'static str,
    words: &'static [Word<T>],
    meaning: &'static str,
) -> Key<T> {
    Key { name, unit: "", kind: Kind::Word { words, absent: default }, meaning }
}

/// A linear Rec. 709 colour.
pub(super) const fn color<T>(
    name: &'static str,
    default: [f64; 3],
    set: fn(&mut T, [f64; 3]),
    meaning: &'static str,
) -> Key<T> {
    Key {
        name,
        unit: "",
        kind: Kind::Triple { range: [0.0, 1.0], absent: Absent::Is(default), set },
        meaning,
    }
}

/// A position in the world.
pub(super) const fn position<T>(
    name: &'static str,
    default: [f64; 3],
    set: fn(&mut T, [f64; 3]),
    meaning: &'static str,
) -> Key<T> {
    Key {
        name,
        unit: "m",
        kind: Kind::Triple { range: [-1e9, 1e9], absent: Absent::Is(default), set },
        meaning,
    }
}

/// `"a", "b", "c"`.
pub(super) fn quoted(words: impl Iterator<Item = &'static str>) -> String {
    words.map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(", ")
}
