//! `docs/scene.md` says what the schema says.

#[test]
fn documentation_is_up_to_date() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/scene.md");
    let reference = swell::scene::reference();
    if std::env::var_os("SWELL_WRITE_DOCS").is_some() {
        std::fs::write(path, &reference).unwrap();
    }
    let written = std::fs::read_to_string(path).unwrap_or_default();
    assert!(
        written == reference,
        "docs/scene.md is out of date; run: SWELL_WRITE_DOCS=1 cargo test --test scene_reference"
    );
}
