//! The panel on a desk, with hands, for its tests.
#![allow(dead_code, reason = "each test uses a part")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]
use egui::{Event, Modifiers, PointerButton, Rect};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::path::Path;
use swell::panel::Panel;

pub fn shipped(name: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("scenes/{name}.toml")))
        .unwrap()
}

/// A panel on a copy of a shipped scene.
pub struct Desk {
    folder: tempfile::TempDir,
    pub harness: Harness<'static, Panel>,
}

impl Desk {
    pub fn new(text: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("scene.toml");
        std::fs::write(&file, text).unwrap();
        let panel = Panel::new(text.to_owned(), Some(&file)).unwrap();
        let build = Harness::builder().with_size([1000.0, 2600.0]);
        let harness = build.build_ui_state(|ui, panel: &mut Panel| panel.show(ui), panel);
        Self { folder, harness }
    }

    pub fn panel(&mut self) -> &mut Panel {
        self.harness.state_mut()
    }

    pub fn text(&self) -> &str {
        self.harness.state().text()
    }

    pub fn on_disk(&self) -> String {
        std::fs::read_to_string(self.folder.path().join("scene.toml")).unwrap()
    }

    /// Shows the widget of the key at `path`, and says where it is.
    pub fn find(&mut self, path: &str) -> Rect {
        self.panel().seek(path);
        self.harness.run_steps(20);
        self.harness.state().place(path).unwrap_or_else(|| panic!("no widget for {path}"))
    }

    pub fn click(&mut self, at: egui::Pos2) {
        self.harness.event(Event::PointerMoved(at));
        for pressed in [true, false] {
            let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
            self.harness.event(Event::PointerButton { pos: at, button, pressed, modifiers });
            self.harness.step();
        }
        self.harness.run_steps(8);
    }

    /// Chooses `word` from the list of the key at `path`.
    pub fn choose(&mut self, path: &str, word: &str) {
        let list = self.find(path);
        self.click(list.center());
        self.harness.get_by_label(word).click();
        self.harness.run_steps(4);
    }

    /// Drags from one place to another, in several steps as a hand does.
    pub fn drag(&mut self, from: egui::Pos2, to: egui::Pos2) {
        self.harness.drag_at(from);
        self.harness.step();
        for step in 1..=6_u8 {
            self.harness.event(Event::PointerMoved(from.lerp(to, f32::from(step) / 6.0)));
            self.harness.step();
        }
        self.harness.drop_at(to);
        self.harness.run_steps(4);
    }
}
