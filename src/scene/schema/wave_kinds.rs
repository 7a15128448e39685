//! Which keys of a wave go with which `kind`, and which stand in place of others. The reader refuses the rest, and the panel
//! does not show it.
use crate::scene::draft::Shape;
use crate::scene::field::Alternative;

/// Keys that only these kinds of wave have; the other keys of a wave every kind has.
pub(in crate::scene) static KEYS_OF_KINDS: &[(&str, &[Shape])] = &[
    ("direction_deg", &[Shape::Sine, Shape::Peaked, Shape::Gerstner]),
    ("sharpness", &[Shape::Peaked, Shape::Circular]),
    ("steepness", &[Shape::Gerstner]),
    ("q", &[Shape::Gerstner]),
    ("centre", &[Shape::Circular]),
];

/// The two ways to say how steep a Gerstner wave is.
pub(in crate::scene) static GERSTNER_FORMS: Alternative = Alternative {
    kind: Shape::Gerstner.word(),
    alone: "steepness",
    together: [("amplitude", 0.1), ("q", 0.5)],
};

impl Shape {
    /// The word of the key `kind`.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Sine => "sine",
            Self::Peaked => "peaked",
            Self::Gerstner => "gerstner",
            Self::Circular => "circular",
        }
    }
}

/// The kinds that have the key `name` of a wave, as words; none where every kind has it.
pub(in crate::scene) fn kinds_with(name: &str) -> Vec<&'static str> {
    let row = KEYS_OF_KINDS.iter().find(|(key, _)| *key == name);
    row.map_or_else(Vec::new, |(_, shapes)| shapes.iter().map(|shape| shape.word()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::assemble::{defaults, names};
    use crate::scene::key::Kind;
    use crate::scene::schema::WAVE;

    #[test]
    fn the_words_of_kinds_are_those_of_the_key() {
        let kind = WAVE.iter().find(|key| key.name == "kind").map(|key| &key.kind);
        let Some(Kind::Word { words, .. }) = kind else { panic!("kind is a word") };
        for (word, set) in *words {
            let mut wave = defaults(WAVE);
            set(&mut wave);
            assert_eq!(wave.shape.word(), *word);
        }
    }

    #[test]
    fn the_tables_name_keys_that_a_wave_has() {
        let [a, b] = GERSTNER_FORMS.together.map(|(key, _)| key);
        let of_kinds = KEYS_OF_KINDS.iter().map(|(key, _)| *key);
        for name in of_kinds.chain([GERSTNER_FORMS.alone, a, b]) {
            assert!(names(WAVE).contains(&name), "{name}");
        }
    }
}
