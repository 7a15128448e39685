//! The sections of a scene file and the names of their keys: for telling what an unknown key may have meant, and for
//! `docs/scene.md`.
use super::field::{self, Alternative, FieldKind, Value};
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
    /// Explained in another section.
    pub inherited: bool,
    pub kind: FieldKind,
    /// The default, where it is a value.
    pub value: Option<Value>,
    /// The words of `kind` with which it may stand; empty where any will do.
    pub kinds: Vec<&'static str>,
}

/// A section as text.
pub(super) struct Section {
    /// Path as in an error message: `sea.cascade`; empty for the top of the file.
    pub path: &'static str,
    /// How it is written in a file: `[[sea.cascade]]`.
    pub header: &'static str,
    /// The `model` that it belongs to, where that makes a difference.
    pub model: Option<&'static str>,
    pub rows: Vec<Row>,
    /// Where inherited rows are explained.
    pub source: &'static str,
    /// Tables that may stand in it.
    pub children: &'static [&'static str],
    /// Rows that stand in place of each other.
    pub alternative: Option<Alternative>,
}

impl Section {
    /// The header, and for which model.
    pub fn title(&self) -> String {
        match self.model {
            Some(model) => format!("{} with model = \"{model}\"", self.header),
            None => self.header.to_owned(),
        }
    }
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
        kinds: Vec::new(),
    })
}

fn wave_rows() -> impl Iterator<Item = Row> {
    rows(schema::WAVE).map(|row| Row { kinds: schema::kinds_with(row.name), ..row })
}

/// All sections, in the order in which they are documented.
pub(super) fn all() -> Vec<Section> {
    let section = |path, header, rows| Section {
        path,
        header,
        model: None,
        rows,
        source: "",
        children: &[],
        alternative: None,
    };
    let wave = |section: Section| Section { alternative: Some(schema::GERSTNER_FORMS), ..section };
    let of_model = |model, children, section: Section| Section { model: Some(model), children, ..section };
    let from = |source, section: Section| Section { source, ..section };
    let inherited = |row| Row { inherited: true, ..row };
    vec![
        section("sea", "[sea]", rows(schema::ANY_SEA).collect()),
        of_model(
            "fft",
            &["cascade", "foam"],
            section("sea", "[sea]", rows(schema::SEA).chain(rows(schema::SEA_AND_CASCADE)).collect()),
        ),
        from(
            "[sea]",
            section(
                "sea.cascade",
                "[[sea.cascade]]",
                rows(schema::CASCADE_ONLY).chain(rows(schema::SEA_AND_CASCADE).map(inherited)).collect(),
            ),
        ),
        of_model("fft", &[], section("sea.foam", "[sea.foam]", rows(schema::FOAM).collect())),
        of_model("waves", &["wave"], section("sea", "[sea]", rows(schema::STILL_WATER).collect())),
        wave(section("sea.wave", "[[sea.wave]]", wave_rows().collect())),
        of_model(
            "fbm",
            &["foam"],
            section("sea", "[sea]", rows(schema::STILL_WATER).chain(rows(schema::FBM)).collect()),
        ),
        of_model("fbm", &[], section("sea.foam", "[sea.foam]", rows(schema::FBM_FOAM).collect())),
        section("layer", "[[layer]]", rows(schema::LAYER).collect()),
        of_model("waves", &["wave"], section("layer", "[[layer]]", Vec::new())),
        from(
            "[[sea.wave]]",
            wave(section("layer.wave", "[[layer.wave]]", wave_rows().map(inherited).collect())),
        ),
        of_model(
            "fbm",
            &["foam"],
            from("[sea]", section("layer", "[[layer]]", rows(schema::FBM).map(inherited).collect())),
        ),
        of_model(
            "fbm",
            &[],
            from(
                "[sea.foam]",
                section("layer.foam", "[layer.foam]", rows(schema::FBM_FOAM).map(inherited).collect()),
            ),
        ),
        section("lod", "[lod]", rows(schema::LOD).collect()),
        section("lod.signal", "[lod.signal]", rows(schema::LOD_SIGNAL).collect()),
        section("sky", "[sky]", rows(schema::SKY).collect()),
        section("water", "[water]", rows(schema::WATER).collect()),
        section("camera", "[camera]", rows(schema::CAMERA).collect()),
        section("raft", "[raft]", rows(schema::RAFT).collect()),
        section("buoy", "[[buoy]]", rows(schema::BUOY).collect()),
    ]
}

/// What to tell whoever wrote `name` in the section `path`, where only the names `here` may stand: the section it does belong
/// to, the nearest name there is, or all names there are.
pub(super) fn hint(path: &str, name: &str, here: &[&'static str]) -> String {
    let has = |section: &Section| {
        section.rows.iter().any(|row| row.name == name) || section.children.contains(&name)
    };
    let sections = all();
    // The right name for another model is no slip of the fingers.
    if let Some(other) = sections.iter().find(|section| section.path == path && has(section)) {
        return format!("{name} belongs under {}", other.title());
    }
    if let Some(nearest) = nearest(name, here) {
        return format!("did you mean {nearest}?");
    }
    if let Some(other) = sections.iter().find(|section| has(section)) {
        return format!("{name} belongs under {}", other.title());
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
            let model = match section.path {
                "sea.wave" => Some("waves"),
                _ => section.model,
            };
            let model = model.map_or(String::new(), |model| format!("model = \"{model}\"\n"));
            let text = match section.header {
                header @ ("[sea]" | "[[layer]]") => format!("{header}\n{model}{body}"),
                header if header.contains("sea.") => format!("[sea]\n{model}{header}\n{body}"),
                header if header.contains("layer.") => format!("[[layer]]\n{model}{header}\n{body}"),
                header => format!("{header}\n{body}"),
            };
            if let Err(error) = crate::scene::Scene::parse(&text, "defaults") {
                panic!("{error}\n{text}");
            }
        }
    }
}
