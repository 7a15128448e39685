//! `docs/scene.md`, written from the schema.
use super::section::{self, Section};
use std::fmt::Write;

const HEAD: &str = "\
# Scene files

<!-- Written from src/scene/schema/; after a change there run SWELL_WRITE_DOCS=1 cargo test --test scene_reference -->

A scene is a TOML file of at most 1 MiB. Every key may be left out, and an empty file is a scene. Lengths are metres,
times seconds; only keys ending in `_deg` are degrees. Numbers are finite (`band` alone may end in `inf`). A relative path
starts from the scene file's folder. A key that is not listed here, a value of another type or out of its range is an
error that names file, line, column, key, value and range:

    scenes/x.toml:4:14: sea.wind_speed = -3 is out of range: 0 to 60 m/s

Directions in the sea's plane run from +X counter-clockwise seen from above, so 90 is -Z; see `conventions.md`.
";

const CASCADES: &str = "
At most four cascades, each a periodic patch of its own size that carries its own band of wave numbers; the sea is their
sum. They are sorted by descending patch size. Patch sizes without a common multiple hide the repetition. A key that a
cascade leaves out has the value of `[sea]`. With no `[[sea.cascade]]` there is one cascade with the values of `[sea]`
that carries all wave numbers.
";

const WAVES: &str = "
Waves one by one, at most 32, layers included: `waves.md` has their equations. A key that a kind has no use for is an error.
";

const FBM: &str = "
A fractal sum of octaves: `waves.md` has the equations.
";

const LAYERS: &str = "
What is added to the sea of `[sea]`, whatever its model: displacements add up, and the normal is that of the sum. At most four
models in all, that of `[sea]` included where it is none of \"fft\".
";

const SIGNAL: &str = "
Where `lod.tessellation` is \"signal\"; see `tessellation.md`.
";

const RAFT: &str = "
What a rider in a headset stands on; see `raft.md`. It begins under the camera and looks where the camera looks.
";

const BUOYS: &str = "
At most 64 balls with masts that float on the waves.
";

/// The text of `docs/scene.md`: every key of a scene file with its type, unit, range, default and meaning.
pub fn reference() -> String {
    let mut text = HEAD.to_owned();
    for section in section::all() {
        write_section(&mut text, &section);
    }
    text
}

fn write_section(text: &mut String, section: &Section) {
    // Writing to a string cannot fail.
    let (inherited, own): (Vec<_>, Vec<_>) = section.rows.iter().partition(|row| row.inherited);
    if section.rows.is_empty() {
        return;
    }
    let _ = writeln!(text, "\n## {}", section.title());
    text.push_str(match (section.path, section.model) {
        ("sea.cascade", _) => CASCADES,
        ("sea.wave", _) => WAVES,
        ("sea", Some("fbm")) => FBM,
        ("layer", None) => LAYERS,
        ("lod.signal", _) => SIGNAL,
        ("raft", _) => RAFT,
        ("buoy", _) => BUOYS,
        _ => "",
    });
    if !own.is_empty() {
        text.push_str("\n| key | type | unit | range | default | meaning |\n|---|---|---|---|---|---|\n");
    }
    for row in own {
        let _ = writeln!(
            text,
            "| `{}` | {} | {} | {} | {} | {} |",
            row.name, row.type_name, row.unit, row.range, row.default, row.meaning
        );
    }
    if !inherited.is_empty() {
        let names: Vec<_> = inherited.iter().map(|row| format!("`{}`", row.name)).collect();
        let _ = writeln!(text, "\nFrom `{}`: {}.", section.source, names.join(", "));
    }
}
