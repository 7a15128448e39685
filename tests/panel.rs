//! The panel, used as a person uses it, without a screen: widgets found by name, changed, undone, saved.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic")]
mod panel_support;

use egui::{Event, Key, Modifiers, pos2, vec2};
use egui_kittest::kittest::Queryable;
use panel_support::{Desk, shipped};
use std::collections::BTreeSet;
use swell::panel::{Edit, Facts, Knob, Panel, Quick, presets};
use swell::scene::{Part, Scene, parts};

const SCENES: [&str; 3] = ["open_ocean", "calm", "storm"];

fn wind(text: &str) -> f64 {
    Scene::parse(text, "panel").unwrap().sea.cascades[0].wind_speed
}

#[test]
fn change_undo_redo_save_reload_gives_the_same_bytes() {
    for name in SCENES {
        let before = shipped(name);
        let mut desk = Desk::new(&before);
        let slider = desk.find("sea.wind_speed");
        let from = slider.left_center() + vec2(20.0, 0.0);
        desk.drag(from, from + vec2(35.0, 0.0));
        let dragged = desk.text().to_owned();
        assert_ne!(wind(&dragged), wind(&before), "{name}: the slider was dragged");
        desk.panel().edit(Edit::Undo);
        assert_eq!(desk.text(), before, "{name}: a drag is one step");
        desk.panel().edit(Edit::Redo);
        assert_eq!(desk.text(), dragged);
        desk.harness.key_press_modifiers(Modifiers::COMMAND, Key::S);
        desk.harness.run_steps(3);
        assert_eq!(desk.on_disk(), dragged, "{name}: saved");
        let reloaded = Panel::new(desk.on_disk(), None).unwrap();
        assert_eq!(reloaded.text(), dragged);
        desk.harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        desk.harness.run_steps(3);
        desk.harness.get_by_label("Save").click();
        desk.harness.run_steps(3);
        assert_eq!(desk.on_disk(), before, "{name}: the file's own bytes again");
        assert_eq!(Scene::parse(&desk.on_disk(), "a").unwrap(), Scene::parse(&before, "a").unwrap());
    }
}

/// A text with a table of each section, so that each key of `part` may stand in it, and where that is.
fn with(part: &Part) -> (String, String) {
    let (around, name) = part.path.rsplit_once('.').unwrap_or(("", part.path));
    let all = parts();
    let chooses = |path: &str| all.iter().any(|p| p.path == path && p.model.is_some());
    let by_parent = all.iter().find(|p| p.path == around && p.children.contains(&name)).and_then(|p| p.model);
    let model = part.model.or(by_parent).unwrap_or("fft");
    let mut text = String::new();
    let mut place = String::new();
    let mut path = String::new();
    for step in part.path.split('.') {
        path = if path.is_empty() { step.to_owned() } else { format!("{path}.{step}") };
        let several = all.iter().any(|p| p.path == path && p.several);
        text += &if several { format!("[[{path}]]\n") } else { format!("[{path}]\n") };
        if chooses(&path) && (path != "layer" || model != "fft") {
            text += &format!("model = \"{model}\"\n");
        }
        place = if place.is_empty() { step.to_owned() } else { format!("{place}.{step}") };
        if several {
            place += "[0]";
        }
    }
    (text, place)
}

#[test]
fn every_key_of_the_schema_has_a_widget() {
    for part in parts() {
        let (text, place) = with(&part);
        // Some kinds of wave have keys that others have not.
        let kinds: BTreeSet<_> = part.fields.iter().map(|field| field.kinds.first()).collect();
        for kind in kinds {
            let text = kind.map_or_else(|| text.clone(), |kind| format!("{text}kind = \"{kind}\"\n"));
            let mut desk = Desk::new(&text);
            for field in part.fields.iter().filter(|field| field.kinds.first() == kind) {
                let path = format!("{place}.{}", field.name);
                let widget = desk.find(&path);
                assert!(widget.width() > 10.0, "{path}: {widget:?}\n{text}");
            }
        }
    }
}

#[test]
fn another_model_takes_the_keys_of_the_first_with_it() {
    for scene in SCENES {
        let before = shipped(scene);
        let mut desk = Desk::new(&before);
        for model in ["waves", "fbm", "fft", "waves"] {
            desk.choose("sea.model", model);
            assert!(desk.text().contains(&format!("model = \"{model}\"")), "{}", desk.text());
            if let Err(error) = Scene::parse(desk.text(), scene) {
                panic!("{model}: {error}\n{}", desk.text());
            }
        }
        for _ in 0..4 {
            desk.panel().edit(Edit::Undo);
        }
        assert_eq!(desk.text(), before);
    }
}

#[test]
fn what_is_typed_stays_within_the_range() {
    let mut desk = Desk::new("[sea]\nwind_speed = 10.0\n\n[camera]\nfov_deg = 50.0\n");
    for (path, typed, wanted) in
        [("sea.wind_speed", "7000", 60.0), ("sea.wind_speed", "-3", 0.0), ("sea.wind_speed", "12.5", 12.5)]
    {
        let slider = desk.find(path);
        // The number is at the right of the slider.
        desk.click(slider.right_center() - vec2(20.0, 0.0));
        desk.harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
        desk.harness.event(Event::Text(typed.to_owned()));
        desk.harness.step();
        desk.harness.key_press(Key::Enter);
        desk.harness.run_steps(4);
        assert_eq!(wind(desk.text()), wanted, "{typed} was typed");
    }
    let before = desk.text().to_owned();
    let slider = desk.find("sea.wind_speed");
    desk.click(slider.right_center() - vec2(20.0, 0.0));
    desk.harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    desk.harness.event(Event::Text("nan".to_owned()));
    desk.harness.key_press(Key::Enter);
    desk.harness.run_steps(4);
    assert!(wind(desk.text()).is_finite());
    assert_eq!(desk.text(), before, "what is no number changes nothing");
}

#[test]
fn words_are_chosen_from_a_list() {
    let mut desk = Desk::new(&shipped("calm"));
    desk.choose("sea.spectrum", "tma");
    assert!(desk.text().contains("spectrum = \"tma\""), "{}", desk.text());
}

#[test]
fn cascades_are_added_and_removed() {
    let before = shipped("open_ocean");
    let cascades = |text: &str| Scene::parse(text, "panel").unwrap().sea.cascades.len();
    let mut desk = Desk::new(&before);
    desk.find("sea.model");
    let button = desk.harness.state().place("sea.cascade add").unwrap();
    let had = cascades(&before);
    desk.click(button.center());
    assert_eq!(desk.text().matches("[[sea.cascade]]").count(), had + 1);
    desk.find(&format!("sea.cascade[{had}].patch_size"));
    let button = desk.harness.state().place(&format!("sea.cascade[{had}] remove")).unwrap();
    desk.click(button.center());
    assert_eq!(cascades(desk.text()), had);
    desk.panel().edit(Edit::Undo);
    desk.panel().edit(Edit::Undo);
    assert_eq!(desk.text(), before);
}

#[test]
fn every_preset_is_a_scene_and_one_step() {
    for name in SCENES {
        let before = shipped(name);
        let mut desk = Desk::new(&before);
        for preset in presets() {
            desk.panel().take_preset(&preset);
            let taken = Scene::parse(desk.text(), preset.name).unwrap();
            let alone = Scene::parse(preset.text, preset.name).unwrap();
            assert_eq!(taken.sea, alone.sea, "{name}: {}", preset.name);
            assert_eq!(taken.camera, Scene::parse(&before, name).unwrap().camera, "the rest stays");
            desk.panel().edit(Edit::Undo);
            assert_eq!(desk.text(), before);
        }
    }
    let keys: Vec<char> = presets().iter().filter_map(|preset| preset.key).collect();
    assert_eq!(keys, ['8', '9', '0'], "three have keys");
}

#[test]
fn a_preset_leaves_the_comment_at_the_head_of_the_file() {
    let is_head = |line: &&str| line.is_empty() || line.starts_with('#');
    for name in SCENES {
        let before = shipped(name);
        let head: Vec<_> = before.lines().take_while(is_head).collect();
        assert!(head.len() > 2, "{name} has one");
        for preset in presets() {
            let mut panel = Panel::new(before.clone(), None).unwrap();
            panel.take_preset(&preset);
            let after: Vec<_> = panel.text().lines().take_while(is_head).collect();
            assert_eq!(after, head, "{name}: {}", preset.name);
        }
    }
    let layered =
        "# Mine.\n[[layer]]\n\n# Where from.\n[camera]\nfov_deg = 40.0\n\n# The water.\n[sea]\n\n[sky]\n";
    let mut panel = Panel::new(layered.to_owned(), None).unwrap();
    let lines = |text: &str, kept: &[char]| -> Vec<String> {
        text.lines().filter(|line| line.starts_with(kept)).map(str::to_owned).collect()
    };
    for preset in presets() {
        panel.take_preset(&preset);
        let mut wanted: Vec<_> =
            ["# Mine.", "# Where from.", "[camera]", "# The water."].map(str::to_owned).into();
        wanted.extend(lines(preset.text, &['[']));
        wanted.push("[sky]".to_owned());
        assert_eq!(lines(panel.text(), &['#', '[']), wanted, "{}:\n{}", preset.name, panel.text());
    }
}

#[test]
fn keys_turn_the_waves_up_and_down() {
    let mut desk = Desk::new(&shipped("open_ocean"));
    for knob in [Knob::Steepness, Knob::Wavelength, Knob::Amplitude, Knob::Speed] {
        let before = desk.text().to_owned();
        desk.panel().quick(Quick::Turn(knob, true));
        assert_ne!(desk.text(), before, "{knob:?}");
        assert!(Scene::parse(desk.text(), "turned").is_ok());
        desk.panel().quick(Quick::Turn(knob, false));
        desk.panel().edit(Edit::Undo);
        desk.panel().edit(Edit::Undo);
        assert_eq!(desk.text(), before, "each press is a step");
    }
    for _ in 0..100 {
        desk.panel().quick(Quick::Turn(Knob::Speed, true));
    }
    assert_eq!(wind(desk.text()), 60.0, "no further than the range");
}

#[test]
fn readouts_are_shown_by_key() {
    let mut desk = Desk::new(&shipped("open_ocean"));
    let scene = Scene::parse(desk.text(), "a").unwrap();
    desk.panel().accepted(Facts::of(&scene.sea), &[]);
    for which in [0, 1] {
        desk.panel().quick(Quick::Readout(which));
    }
    desk.harness.run_steps(20);
    assert!(desk.harness.query_by_label_contains("sea.cascade[1]").is_some());
    let height = format!("significant wave height: {:.3} m", 4.0 * scene.sea.expected_rms_height());
    assert!(desk.harness.query_by_label(&height).is_some(), "{height}");
    desk.panel().quick(Quick::Readout(1));
    desk.harness.run_steps(20);
    assert!(desk.harness.query_by_label(&height).is_none());
}

#[test]
fn a_text_that_is_no_scene_is_told_and_not_saved() {
    let before = shipped("calm");
    let mut desk = Desk::new(&before);
    assert_eq!(desk.panel().changed(), None, "what it began with is drawn already");
    desk.choose("sky.model", "cubemap");
    let text = desk.panel().changed().unwrap();
    let error = Scene::parse(&text, "panel").unwrap_err().to_string();
    desk.panel().refused(error.clone());
    desk.panel().save();
    desk.harness.run_steps(3);
    assert_eq!(desk.on_disk(), before, "not saved");
    assert!(desk.harness.query_by_label(&error).is_some(), "{error}");
    desk.panel().edit(Edit::Undo);
    assert_eq!(desk.panel().changed().as_deref(), Some(before.as_str()));
}

#[test]
fn a_file_that_somebody_else_writes_is_taken_over() {
    let mut desk = Desk::new(&shipped("calm"));
    let other = shipped("storm");
    desk.panel().reload(other.clone());
    assert_eq!(desk.panel().changed().as_deref(), Some(other.as_str()));
    desk.panel().reload("[sea\n".to_owned());
    assert!(desk.panel().trouble().unwrap().contains(":1:"), "{:?}", desk.panel().trouble());
    assert_eq!(desk.text(), other, "half a file is told of and left");
    desk.panel().edit(Edit::Undo);
    assert_eq!(desk.text(), shipped("calm"));
}

#[test]
fn bands_never_cross() {
    let mut desk = Desk::new("[[sea.cascade]]\nband = [0.5, 2.0]\n");
    let widget = desk.find("sea.cascade[0].band");
    desk.drag(pos2(widget.left() + 15.0, widget.center().y), pos2(widget.left() + 900.0, widget.center().y));
    let text = desk.text().to_owned();
    let band = Scene::parse(&text, "a").unwrap().sea.cascades[0].band;
    assert!(band[0] > 0.5 && band[0] < band[1], "{text}");
}
