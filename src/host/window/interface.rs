//! egui in a window: events in, triangles out.

use crate::draw::Painting;
use crate::panel::draw_pointer;
use egui::{Context, Order, Pos2, Rect, Ui, ViewportId};
use winit::event::{ElementState, WindowEvent};
use winit::window::Window;

/// Seconds that a frame of a recording counts as.
type Step = Option<f64>;

/// A context of egui's on a window, shown or not.
pub struct Interface {
    context: Context,
    input: egui_winit::State,
    shown: bool,
    /// Events that a script has put in, before the window's own.
    scripted: Vec<egui::Event>,
    /// Where a script's pointer is: drawn, since nobody else draws it.
    pointer: Option<Pos2>,
    /// Where the mouse is now, of which egui learns with the next frame.
    mouse: Option<Pos2>,
    /// What the panel left of the picture in the frame before.
    free: Rect,
    time: f64,
    step: Step,
}

impl Interface {
    /// Not shown at first. With `step`, its clock goes by so many seconds a frame, for recordings.
    pub fn new(window: &Window, step: Step) -> Self {
        let context = Context::default();
        context.set_visuals(egui::Visuals::dark());
        let scale = window.scale_factor() as f32;
        let input =
            egui_winit::State::new(context.clone(), ViewportId::ROOT, window, Some(scale), None, None);
        Self {
            context,
            input,
            shown: false,
            scripted: Vec::new(),
            pointer: None,
            mouse: None,
            free: Rect::EVERYTHING,
            time: 0.0,
            step,
        }
    }

    /// egui's own.
    pub const fn context(&self) -> &Context {
        &self.context
    }

    /// Whether it is shown.
    pub const fn is_shown(&self) -> bool {
        self.shown
    }

    /// Shows it, or hides it.
    pub fn toggle(&mut self) {
        self.shown = !self.shown;
        if let (true, Some(at)) = (self.shown, self.mouse) {
            self.scripted.push(egui::Event::PointerMoved(at));
        }
    }

    /// Takes in an event; whether nobody else is to have it. What is let go of is everybody's business.
    pub fn take(&mut self, window: &Window, event: &WindowEvent) -> bool {
        let moved = if let WindowEvent::CursorMoved { position, .. } = event {
            let scale = egui_winit::pixels_per_point(&self.context, window);
            self.mouse = Some(Pos2::new(position.x as f32 / scale, position.y as f32 / scale));
            true
        } else {
            false
        };
        if !self.shown {
            // Clicks are where egui knows the mouse to be, also those right after it is shown.
            if moved {
                let _unused = self.input.on_window_event(window, event);
                self.input.egui_input_mut().events.clear();
            }
            return false;
        }
        let consumed = self.input.on_window_event(window, event).consumed;
        match event {
            // A widget that was clicked keeps egui's focus; keys are its own while it is typed into.
            WindowEvent::KeyboardInput { event, .. } => {
                self.context.text_edit_focused() && event.state == ElementState::Pressed
            }
            // Not what egui says: that is about where the mouse was in the frame before.
            WindowEvent::MouseInput { state, .. } => {
                let is_own = self.is_under_mouse() || self.context.egui_is_using_pointer();
                is_own && *state == ElementState::Pressed
            }
            _ => consumed,
        }
    }

    /// Whether the mouse is over something of egui's, also where it came there, or left it, since the last frame.
    fn is_under_mouse(&self) -> bool {
        let above = |at| self.context.layer_id_at(at).is_some_and(|layer| layer.order != Order::Background);
        self.mouse.is_some_and(|at| !self.free.contains(at) || above(at))
    }

    /// Puts in an event that no hand made.
    pub fn put_in(&mut self, event: egui::Event) {
        if let egui::Event::PointerMoved(at) = event {
            self.pointer = Some(at);
        }
        self.scripted.push(event);
    }

    /// Runs `show` for a frame; nothing where it is not shown.
    pub fn run(&mut self, window: &Window, mut show: impl FnMut(&mut Ui)) -> Option<Painting> {
        if !self.shown {
            return None;
        }
        let mut input = self.input.take_egui_input(window);
        if let Some(step) = self.step {
            self.time += step;
            (input.time, input.focused) = (Some(self.time), true);
        }
        input.events.append(&mut self.scripted);
        let (pointer, free) = (self.pointer, &mut self.free);
        let mut output = self.context.run_ui(input, |ui| {
            show(ui);
            *free = ui.available_rect_before_wrap();
            if let Some(at) = pointer {
                draw_pointer(ui, at, ui.input(|input| input.pointer.any_down()));
            }
        });
        self.input.handle_platform_output(window, std::mem::take(&mut output.platform_output));
        Some(Painting::of(&self.context, output))
    }
}
