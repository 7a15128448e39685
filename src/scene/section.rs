//! The sections of a scene file and the names of their keys: for telling what an unknown key may have meant, and for
//! `docs/scene.md`.
use super::field::{self, FieldKind, Value};
use super::key::Key;
use super::schema;

/// A key as text.
pub(super) struct Row {
    pub name: &'static str,
    pub type_name: &'static str,
    pub unit: &'static str,
    pub range: String,
    pub default: String,
    pub meaning: &'static str,
    /// A key of `[sea]` that a cascade may override.
    pub inherited: bool,
    pub kind: FieldKind,
    /// The default, where it is a value.
    pub value: Option<Value>,
}

/// A section as text.
pub(super) struct Section {
    /// Path as in an error message: `sea.cascade`; empty for the top of the file.
    pub path: &'static str,
    /// How it is written in a file: `[[sea.cascade]]`.
    pub header: &'static str,
    pub rows: Vec<Row>,
}

fn rows<T>(keys: &[Key<T>]) -> impl Iterator<Item = Row> {
    keys.iter().map(|key| Row {
        name: key.name,
        type_name: key.type_name(),
        unit: key.unit,
        range: key.bare_range(),
        default: key.default_text(),
        meaning: key.meaning,
        inherited: false,
        kind: field::kind(key),
        value: field::default(key),
    })
}

/// All sections, in the order in which they are documented.
pub(super) fn all() -> Vec<Section> {
    let section = |path, header, rows| Section { path, header, rows };
    vec![
        section("sea", "[sea]", rows(schema::SEA).chain(rows(schema::SEA_AND_CASCADE)).collect()),
        section(
            "sea.cascade",
            "[[sea.cascade]]",
            rows(schema::CASCADE_ONLY)
                .chain(rows(schema::SEA_AND_CASCADE).map(|row| Row { inherited: true, ..row }))
                .collect(),
        ),
        section("sea.foam", "[sea.foam]", rows(schema::FOAM).collect()),
        section("lod", "[lod]", rows(schema::LOD).collect()),
        section("sky", "[sky]", rows(schema::SKY).collect()),
        section("water", "[water]", rows(schema::WATER).collect()),
        section("camera", "[camera]", rows(schema::CAMERA).collect()),
        section("raft", "[raft]", rows(schema::RAFT).collect()),
        section("buoy", "[[buoy]]", rows(schema::BUOY).collect()),
    ]
}

/// What to tell whoever wrote `name` in the section `path`, which has no such key: the section it does belong to, the
/// nearest name there is, or all names there are.
pub(super) fn hint(path: &str, name: &str, children: &[&'static str]) -> String {
    let sections = all();
    let here: Vec<&str> = sections
        .iter()
        .filter(|section| section.path == path)
        .flat_map(|section| section.rows.iter().map(|row| row.name))
        .chain(children.iter().copied())
        .collect();
    if let Some(nearest) = nearest(name, &here) {
        return format!("did you mean {nearest}?");
    }
    if let Some(other) = sections.iter().find(|section| section.rows.iter().any(|row| row.name == name)) {
        return format!("{name} belongs under {}", other.header);
    }
    format!("here may stand: {}", here.join(", "))
}

/// The name at most a third of its letters away from `name`, if there is one.
fn nearest<'n>(name: &str, names: &[&'n str]) -> Option<&'n str> {
    if name.len() > 64 {
        return None;
    }
    names
        .iter()
        .map(|&candidate| (edits(name, candidate), candidate))
        .filter(|(edits, candidate)| *edits <= 1 + candidate.len() / 3 && *edits < candidate.len())
        .min_by_key(|(edits, _)| *edits)
        .map(|(_, candidate)| candidate)
}

/// Letters to insert, remove or replace to turn `a` into `b` (Levenshtein distance).
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, letter) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for j in 0..b.len() {
            let replaced = diagonal + usize::from(letter != b[j]);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(row[j + 1] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_of_known_pairs() {
        assert_eq!(edits("kitten", "sitting"), 3);
        assert_eq!(edits("", "abc"), 3);
        assert_eq!(edits("wind", "wind"), 0);
    }

    #[test]
    fn every_default_lies_in_its_own_range() {
        for section in all() {
            let body: String = section
                .rows
                .iter()
                .filter(|row| row.default.parse::<f64>().is_ok() || row.default.starts_with(['"', '[']))
                .map(|row| format!("{} = {}\n", row.name, row.default))
                .collect();
            crate::scene::Scene::parse(&format!("{}\n{body}", section.header), "defaults").unwrap();
        }
    }
}
