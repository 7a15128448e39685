//! Where something points that no mouse shows.

use egui::{Color32, Id, LayerId, Order, Pos2, Stroke, Ui};

/// Draws a ring at `at`, points, over everything: smaller and brighter while it presses.
pub fn draw_pointer(ui: &Ui, at: Pos2, pressed: bool) {
    let painter = ui.ctx().layer_painter(LayerId::new(Order::Debug, Id::new("pointer")));
    let (radius, fill) = if pressed { (5.0, 200) } else { (7.0, 60) };
    painter.circle(at, radius, Color32::from_white_alpha(fill), Stroke::new(2.0, Color32::WHITE));
}
