//! A scene file that is changed value by value, undone, saved and read again.
use proptest::prelude::*;
use swell::scene::{Address, Document, Field, FieldKind, History, Part, Scene, SceneError, Value, parts};

const SCENES: [(&str, &str); 3] = [
    ("open_ocean", include_str!("../scenes/open_ocean.toml")),
    ("calm", include_str!("../scenes/calm.toml")),
    ("storm", include_str!("../scenes/storm.toml")),
];

fn sea() -> Address {
    Address::root().table("sea")
}

/// A value of this kind that is not the default, between its bounds at `at`, 0 to 1.
fn some_value(field: &Field, at: f64) -> Option<Value> {
    let between = |[low, high]: [f64; 2]| low + at * (high - low);
    Some(match &field.kind {
        FieldKind::Number(range) => Value::Number(between(*range)),
        FieldKind::Integer([low, high]) => Value::Integer(low + (at * (high - low) as f64) as u64),
        FieldKind::PowerOfTwo([low, _]) => Value::Integer(low * 2),
        FieldKind::Numbers(range, count) => {
            Value::Numbers((0..*count).map(|i| between(*range) / (1.0 + i as f64)).collect())
        }
        FieldKind::Color => Value::Numbers(vec![at, 0.5 * at, 0.25]),
        FieldKind::Word(words) => Value::Text((*words.last()?).to_owned()),
        FieldKind::Band => Value::Numbers(vec![0.01 + at, f64::INFINITY]),
        FieldKind::Path => return None,
    })
}

/// Where a part's keys are, in a document with one table of each array and the model that the part wants.
fn address(document: &mut Document, part: &Part) -> Address {
    let parts = parts();
    let (around, name) = part.path.rsplit_once('.').unwrap_or(("", part.path));
    let own = parts.iter().any(|p| {
        p.path == part.path && p.fields.iter().any(|field| field.name == "model") && p.model.is_none()
    });
    let around_it = parts.iter().find(|p| {
        p.path == around && p.children.contains(&name) && (part.model.is_none() || p.model == part.model)
    });
    let wanted = part.model.or_else(|| around_it.and_then(|p| p.model));
    let mut address = Address::root();
    let mut so_far = String::new();
    for name in part.path.split('.') {
        so_far = if so_far.is_empty() { name.to_owned() } else { format!("{so_far}.{name}") };
        if parts.iter().any(|part| part.several && part.path == so_far) {
            if document.count(&address, name) == 0 {
                document.add(&address, name);
            }
            address = address.element(name, 0);
        } else {
            address = address.table(name);
        }
        let holds = if own { so_far == part.path } else { so_far == around };
        if let (true, Some(model)) = (holds, wanted) {
            document.set(&address, "model", &Value::Text(model.to_owned()));
        }
    }
    address
}

#[test]
fn every_key_can_be_set_to_values_of_its_range_and_is_read_back() {
    for part in parts() {
        for field in &part.fields {
            let Some(value) = some_value(field, 0.3) else { continue };
            let mut document = Document::parse("", "new").unwrap();
            let address = address(&mut document, &part);
            document.set(&address, field.name, &value);
            let text = document.text();
            let fit = field.kind.fit(&value).unwrap();
            let read = Document::parse(&text, "new").unwrap().get(&address, field.name).unwrap();
            match (&read, &fit) {
                (Value::Number(a), Value::Number(b)) => assert!((a - b).abs() <= 1e-6 * b.abs(), "{text}"),
                (Value::Numbers(a), Value::Numbers(b)) => {
                    assert!(
                        a.iter().zip(b).all(|(a, b)| a == b || (a - b).abs() <= 1e-6 * b.abs()),
                        "{text}"
                    );
                }
                _ => assert_eq!(read, fit, "{text}"),
            }
            // Alone, a key may lack another; it is never unknown, of the wrong type or out of range.
            let scene = document.scene("new");
            assert!(
                matches!(scene, Ok(_) | Err(SceneError::Contradiction { .. })),
                "{}.{}: {scene:?}",
                part.path,
                field.name
            );
        }
    }
}

#[test]
fn a_change_leaves_everything_else_as_it_is() {
    for (name, text) in SCENES {
        let mut document = Document::parse(text, name).unwrap();
        assert_eq!(document.text(), text, "{name}: opened and not changed");
        document.set(&sea(), "choppiness", &Value::Number(0.4321));
        let changed = document.text();
        let differing: Vec<_> = text.lines().zip(changed.lines()).filter(|(a, b)| a != b).collect();
        assert_eq!(changed.lines().count(), text.lines().count(), "{name}");
        let [(before, after)] = differing[..] else { panic!("{name}: {differing:?}") };
        let comment = |line: &str| line.split_once('#').map(|(_, comment)| comment.to_owned());
        assert_eq!(comment(before), comment(after), "{name}: the comment stays");
        assert!(after.starts_with("choppiness = 0.4321"), "{after}");
        assert!(document.scene(name).unwrap().sea.cascades.iter().all(|c| c.choppiness == 0.4321));
    }
}

#[test]
fn tables_are_added_and_removed() {
    let mut document =
        Document::parse("[sea]\nwind_speed = 7.0\n\n[camera]\nfov_deg = 40.0\n", "new").unwrap();
    let before = document.text();
    for (index, size) in [400.0, 50.0, 9.0].into_iter().enumerate() {
        document.add(&sea(), "cascade");
        document.set(&sea().element("cascade", index), "patch_size", &Value::Number(size));
    }
    let scene = document.scene("new").unwrap();
    let sizes: Vec<f64> = scene.sea.cascades.iter().map(|cascade| cascade.patch_size).collect();
    assert_eq!(sizes, [400.0, 50.0, 9.0]);
    document.remove(&sea(), "cascade", 1);
    assert_eq!(document.count(&sea(), "cascade"), 2);
    assert_eq!(document.scene("new").unwrap().sea.cascades[1].patch_size, 9.0);
    document.remove(&sea(), "cascade", 0);
    document.remove(&sea(), "cascade", 0);
    document.remove(&sea(), "cascade", 0);
    assert_eq!(document.text(), before, "nothing is left of them");
}

#[test]
fn tables_written_inline_are_changed_too() {
    let text = "sea = { wind_speed = 3, cascade = [{ patch_size = 90.0 }, { patch_size = 7.0 }] } # short\n";
    let mut document = Document::parse(text, "inline").unwrap();
    document.set(&sea().element("cascade", 1), "patch_size", &Value::Number(8.0));
    document.set(&sea(), "wind_speed", &Value::Number(4.5));
    document.add(&sea(), "cascade");
    document.remove(&sea(), "cascade", 2);
    assert_eq!(
        document.text(),
        "sea = { wind_speed = 4.5, cascade = [{ patch_size = 90.0 }, { patch_size = 8.0 }] } # short\n"
    );
    assert!(document.scene("inline").is_ok());
}

#[test]
fn what_does_not_fit_is_brought_within_its_bounds_or_refused() {
    let number = FieldKind::Number([0.0, 60.0]);
    assert_eq!(number.fit(&Value::Number(61.0)), Some(Value::Number(60.0)));
    assert_eq!(number.fit(&Value::Number(f64::NAN)), None);
    assert_eq!(number.fit(&Value::Integer(7)), Some(Value::Number(7.0)));
    assert_eq!(number.fit(&Value::Text("7".to_owned())), None);
    assert_eq!(FieldKind::PowerOfTwo([16, 512]).fit(&Value::Integer(100)), Some(Value::Integer(128)));
    assert_eq!(FieldKind::PowerOfTwo([16, 512]).fit(&Value::Integer(u64::MAX)), None);
    assert_eq!(FieldKind::Band.fit(&Value::Numbers(vec![2.0, 1.0])), None);
    assert_eq!(
        FieldKind::Color.fit(&Value::Numbers(vec![2.0, 0.5, -1.0])),
        Some(Value::Numbers(vec![1.0, 0.5, 0.0]))
    );
    assert_eq!(FieldKind::Word(vec!["a"]).fit(&Value::Text("b".to_owned())), None);
}

#[test]
fn a_drag_is_one_step_and_undoing_it_gives_the_bytes_back() {
    let (name, text) = SCENES[0];
    let mut history = History::new(text.to_owned());
    let mut document = Document::parse(text, name).unwrap();
    for step in 1..=20 {
        document.set(&sea(), "wind_speed", &Value::Number(f64::from(step)));
        history.change("sea.wind_speed", document.text());
    }
    history.settle();
    document.set(&sea(), "wind_speed", &Value::Number(3.0));
    history.change("sea.wind_speed", document.text());
    assert!(history.is_changed() && history.can_undo() && !history.can_redo());
    assert!(history.undo());
    assert!(history.text().contains("wind_speed = 20.0"));
    assert!(history.undo());
    assert_eq!(history.text(), text);
    assert!(!history.undo() && !history.is_changed());
    assert!(history.redo() && history.redo() && !history.redo());
    assert!(history.text().contains("wind_speed = 3.0"));
    history.mark_saved();
    assert!(!history.is_changed());
    history.undo();
    assert!(history.is_changed(), "the file says otherwise");
    history.change("other", "# new\n".to_owned());
    assert!(!history.can_redo(), "another way was taken");
}

#[test]
fn a_file_changed_by_somebody_else_is_a_step_and_ones_own_is_none() {
    let mut history = History::new("a = 1\n".to_owned());
    history.change("a", "a = 2\n".to_owned());
    history.mark_saved();
    assert!(!history.reload("a = 2\n".to_owned()), "written from here");
    assert!(history.reload("a = 3\n".to_owned()));
    assert_eq!((history.text(), history.is_changed()), ("a = 3\n", false));
    assert!(history.undo());
    assert_eq!(history.text(), "a = 2\n");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    /// Whatever is changed and in what order: undoing all of it gives the file's own bytes, redoing all of it the last.
    #[test]
    fn undo_and_redo_return_every_byte(
        which in 0..SCENES.len(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), 0.0..1.0_f64), 1..12),
    ) {
        let (name, text) = SCENES[which];
        let mut history = History::new(text.to_owned());
        // A layer of waves has tables and no keys.
        let parts: Vec<_> = parts().into_iter().filter(|part| !part.fields.is_empty()).collect();
        let mut texts = vec![text.to_owned()];
        for (part, field, at) in changes {
            let part = part.get(&parts);
            let field = field.get(&part.fields);
            let Some(value) = some_value(field, at) else { continue };
            let mut document = Document::parse(history.text(), name).unwrap();
            let address = address(&mut document, part);
            document.set(&address, field.name, &value);
            history.change("x", document.text());
            history.settle();
            if texts.last().map(String::as_str) != Some(history.text()) {
                texts.push(history.text().to_owned());
            }
        }
        // Saved and loaded, it is the same scene, or is refused in the same words.
        let told = |scene: Result<Scene, swell::scene::SceneError>| scene.map_err(|error| error.to_string());
        let document = Document::parse(history.text(), name).unwrap();
        prop_assert_eq!(told(document.scene(name)), told(Scene::parse(history.text(), name)));
        for before in texts.iter().rev().skip(1) {
            prop_assert!(history.undo());
            prop_assert_eq!(history.text(), before.as_str());
        }
        for after in texts.iter().skip(1) {
            prop_assert!(history.redo());
            prop_assert_eq!(history.text(), after.as_str());
        }
    }
}
