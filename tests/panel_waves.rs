//! Waves in the panel: of which keys a kind has, and of the two forms of a Gerstner wave, only those are in the file that belong
//! together.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod panel_support;

use panel_support::Desk;
use swell::panel::Edit;
use swell::scene::{Field, Part, Scene, parts};

const KINDS: [&str; 4] = ["sine", "peaked", "gerstner", "circular"];

/// Every key of a wave but `kind`, with some value.
const KEYS: [(&str, &str); 9] = [
    ("wavelength", "20.0"),
    ("amplitude", "0.4            # seen from a boat"),
    ("direction_deg", "30.0"),
    ("speed", "3.0"),
    ("phase", "0.5"),
    ("sharpness", "3.0"),
    ("steepness", "0.3"),
    ("q", "0.4"),
    ("centre", "[1.0, 2.0]"),
];

/// Keys of one of the two forms of a Gerstner wave each.
const FORMS: [&[&str]; 2] = [&["steepness"], &["amplitude", "q"]];

fn wave_part(path: &str) -> Part {
    parts().into_iter().find(|part| part.path == path).unwrap()
}

fn has<'f>(part: &'f Part, kind: &str) -> impl Iterator<Item = &'f Field> {
    part.fields.iter().filter(move |field| field.is_for(Some(kind)))
}

/// A scene with one wave of this kind at `path`, "sea.wave" or "layer.wave", that has all keys but those of `without`.
fn scene(path: &str, kind: &str, without: &[&str]) -> String {
    let part = wave_part(path);
    let around = if path == "sea.wave" { "[sea]\nmodel = \"waves\"\n" } else { "[[layer]]\n" };
    let mut text = format!("# A wave.\n\n{around}\n[[{path}]]\nkind = \"{kind}\"\n");
    for (key, value) in KEYS {
        if has(&part, kind).any(|field| field.name == key) && !without.contains(&key) {
            text += &format!("{key} = {value}\n");
        }
    }
    text + "\n[camera]\nfov_deg = 40.0\n"
}

/// The keys that the one wave in `text` has, in the order of the file.
fn keys(text: &str) -> Vec<String> {
    let wave = text.split("wave]]\n").nth(1).unwrap().split("\n\n").next().unwrap();
    wave.lines().map(|line| line.split(' ').next().unwrap().to_owned()).collect()
}

#[track_caller]
fn is_scene(text: &str) {
    if let Err(error) = Scene::parse(text, "panel") {
        panic!("{error}\n{text}");
    }
}

#[test]
fn another_kind_takes_the_keys_of_the_first_with_it() {
    assert!(
        wave_part("sea.wave")
            .fields
            .iter()
            .all(|field| { field.name == "kind" || KEYS.iter().any(|(key, _)| *key == field.name) })
    );
    for (path, place) in [("sea.wave", "sea.wave[0]"), ("layer.wave", "layer[0].wave[0]")] {
        let part = wave_part(path);
        for from in KINDS {
            let forms: &[&[&str]] = if from == "gerstner" { &FORMS } else { &[&[]] };
            for without in forms {
                let before = scene(path, from, without);
                is_scene(&before);
                let mut desk = Desk::new(&before);
                for to in KINDS.into_iter().filter(|to| *to != from) {
                    desk.choose(&format!("{place}.kind"), to);
                    is_scene(desk.text());
                    let own = |key: &String| has(&part, to).any(|field| field.name == key);
                    let mut wanted: Vec<_> = keys(&before).into_iter().filter(own).collect();
                    if to == "gerstner" {
                        // An amplitude stays, and gets what it needs beside it.
                        wanted.push("q".to_owned());
                    }
                    assert_eq!(keys(desk.text()), wanted, "{from} to {to}:\n{}", desk.text());
                    desk.find(&format!("{place}.kind"));
                    for field in &part.fields {
                        let shown = desk.harness.state().place(&format!("{place}.{}", field.name)).is_some();
                        assert_eq!(shown, field.is_for(Some(to)), "{to}: {}", field.name);
                    }
                    desk.panel().edit(Edit::Undo);
                    assert_eq!(desk.text(), before, "one step");
                }
            }
        }
    }
}

#[test]
fn without_its_kind_a_wave_is_a_sine() {
    let before = scene("sea.wave", "circular", &[]);
    let mut desk = Desk::new(&before);
    let unset = desk.find("sea.wave[0].kind unset");
    desk.click(unset.center());
    is_scene(desk.text());
    assert_eq!(keys(desk.text()), ["wavelength", "amplitude", "speed", "phase"]);
    desk.panel().edit(Edit::Undo);
    assert_eq!(desk.text(), before);
}

#[test]
fn a_gerstner_wave_has_one_form() {
    let amplitude_and_q = ["kind", "wavelength", "amplitude", "direction_deg", "speed", "phase", "q"];
    let bare = ["kind", "wavelength", "direction_deg", "speed", "phase"];
    let form = |more: &[&'static str]| [&bare[..], more].concat();
    for (without, pressed, wanted) in [
        (FORMS[1], "q", form(&["q", "amplitude"])),
        (FORMS[1], "amplitude", form(&["amplitude", "q"])),
        (FORMS[1], "steepness unset", form(&[])),
        (FORMS[0], "steepness", form(&["steepness"])),
        (FORMS[0], "q unset", form(&[])),
        (FORMS[0], "amplitude unset", form(&[])),
    ] {
        let before = scene("sea.wave", "gerstner", without);
        is_scene(&before);
        assert_eq!(keys(&before) == amplitude_and_q, without == FORMS[0]);
        let mut desk = Desk::new(&before);
        let button = desk.find(&format!("sea.wave[0].{pressed}"));
        desk.click(button.center());
        is_scene(desk.text());
        assert_eq!(keys(desk.text()), wanted, "{pressed}:\n{}", desk.text());
        desk.panel().edit(Edit::Undo);
        assert_eq!(desk.text(), before, "one step");
    }
    // What is dragged stays in its form.
    let before = scene("sea.wave", "gerstner", FORMS[0]);
    let mut desk = Desk::new(&before);
    let slider = desk.find("sea.wave[0].q");
    let from = slider.left_center() + egui::vec2(20.0, 0.0);
    desk.drag(from, from + egui::vec2(30.0, 0.0));
    assert_ne!(desk.text(), before);
    assert_eq!(keys(desk.text()), amplitude_and_q);
    desk.panel().edit(Edit::Undo);
    assert_eq!(desk.text(), before, "one step");
}

#[test]
fn a_key_that_should_not_be_there_can_be_taken_out() {
    let good = scene("sea.wave", "sine", &[]);
    let mut desk = Desk::new(&good.replace("phase = 0.5\n", "phase = 0.5\nq = 0.4\n"));
    assert!(Scene::parse(desk.text(), "panel").is_err());
    let unset = desk.find("sea.wave[0].q unset");
    desk.click(unset.center());
    assert_eq!(desk.text(), good);
}
