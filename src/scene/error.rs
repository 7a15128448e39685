//! What can be wrong with a scene file, and where.
use std::{fmt, io, path::PathBuf};

/// A place in a scene file, as editors understand it: `file:line:column`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file, as it was named by whoever asked for it.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

impl Place {
    /// The place of the byte at `offset` of `text`; offsets past the end or inside a character are moved back.
    pub(super) fn of(file: &str, text: &str, offset: usize) -> Box<Self> {
        let end = (0..=offset.min(text.len())).rev().find(|&end| text.is_char_boundary(end)).unwrap_or(0);
        let before = &text[..end];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        Box::new(Self {
            file: file.to_owned(),
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
        })
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.file, self.line, self.column)
    }
}

/// Why a scene file was refused. Every message is one line that begins with the file and, where there is one, the place.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// The file is not there or cannot be read.
    #[error("{}: cannot read the scene file: {source}; check the path given to --scene", path.display())]
    Read {
        /// The scene file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// Longer than any scene written by a person.
    #[error("{}: the scene file is larger than {limit} bytes; is it a scene?", path.display())]
    TooLarge {
        /// The scene file.
        path: PathBuf,
        /// Most bytes accepted.
        limit: u64,
    },
    /// Bytes that are not UTF-8.
    #[error("{place}: byte {byte:#04x} is not UTF-8 text; save the scene file as UTF-8")]
    NotText {
        /// The first such byte.
        place: Box<Place>,
        /// Its value.
        byte: u8,
    },
    /// Not TOML: syntax errors and keys given twice.
    #[error("{place}: {message}, at `{near}`")]
    Syntax {
        /// Where the parser stopped.
        place: Box<Place>,
        /// The parser's own words.
        message: String,
        /// The text at that place.
        near: String,
    },
    /// A key no section has.
    #[error("{place}: {key} is not a key of a scene; {hint}")]
    UnknownKey {
        /// Of the key.
        place: Box<Place>,
        /// Its whole path.
        key: String,
        /// The nearest key, the section it belongs to, or the keys there are.
        hint: String,
    },
    /// A value of the wrong TOML type.
    #[error("{place}: {key} = {value} is {found}; give {wanted}")]
    WrongType {
        /// Of the value.
        place: Box<Place>,
        /// The key's whole path.
        key: String,
        /// The value as written.
        value: String,
        /// Its type.
        found: &'static str,
        /// The type and range of the key.
        wanted: String,
    },
    /// A number outside its range, NaN or infinite.
    #[error("{place}: {key} = {value} is {problem}: {range}")]
    OutOfRange {
        /// Of the value.
        place: Box<Place>,
        /// The key's whole path.
        key: String,
        /// The value as written.
        value: String,
        /// "out of range", "not a finite number" or "not a power of two".
        problem: &'static str,
        /// The range, with its unit.
        range: String,
    },
    /// A word that is none of the words allowed.
    #[error("{place}: {key} = {value} is not one of: {words}")]
    UnknownWord {
        /// Of the value.
        place: Box<Place>,
        /// The key's whole path.
        key: String,
        /// The value as written.
        value: String,
        /// The words allowed.
        words: String,
    },
    /// Values that are each allowed but contradict one another.
    #[error("{place}: {key} = {value} {problem}")]
    Contradiction {
        /// Of the value.
        place: Box<Place>,
        /// The key's whole path.
        key: String,
        /// The value as written.
        value: String,
        /// What it contradicts and what to do.
        problem: String,
    },
}
