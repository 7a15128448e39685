//! What keyboard and mouse have done since the frame before.

use crate::host::view::Controls;
use crate::panel::{Knob, Quick};
use glam::DVec3;
use winit::event::{ElementState, MouseButton, MouseScrollDelta, WindowEvent};
use winit::keyboard::{KeyCode, PhysicalKey};

/// A key that does something once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Key {
    /// Esc: the end.
    End,
    /// R: back to the scene's camera.
    Reset,
    /// O: circle about a point, or fly.
    Orbit,
    /// P, F12: keep the picture.
    Screenshot,
    /// F11: all of the screen, or a window.
    Fullscreen,
    /// T: what frames cost, in the title.
    Readout,
    /// F1 to F7: another look, counted from 0.
    Look(usize),
    /// F10: the panel, or none.
    Panel,
    /// What keys mean while the panel is shown.
    Quick(Quick),
}

/// Keys that mean something else while the panel is shown.
fn quick(code: KeyCode) -> Option<Quick> {
    use Knob::{Amplitude, Speed, Steepness, Wavelength};
    Some(match code {
        KeyCode::Digit8 => Quick::Preset('8'),
        KeyCode::Digit9 => Quick::Preset('9'),
        KeyCode::Digit0 => Quick::Preset('0'),
        KeyCode::Digit5 => Quick::Readout(0),
        KeyCode::Digit6 => Quick::Readout(1),
        KeyCode::KeyU => Quick::Turn(Steepness, true),
        KeyCode::KeyJ => Quick::Turn(Steepness, false),
        KeyCode::KeyI => Quick::Turn(Wavelength, true),
        KeyCode::KeyK => Quick::Turn(Wavelength, false),
        KeyCode::KeyO => Quick::Turn(Amplitude, true),
        KeyCode::KeyL => Quick::Turn(Amplitude, false),
        KeyCode::KeyM => Quick::Turn(Speed, true),
        KeyCode::KeyN => Quick::Turn(Speed, false),
        _ => return None,
    })
}

/// Keys by where they are on the keyboard, whatever is printed on them.
fn key(code: KeyCode) -> Option<Key> {
    Some(match code {
        KeyCode::Escape => Key::End,
        KeyCode::KeyR => Key::Reset,
        KeyCode::KeyO => Key::Orbit,
        KeyCode::KeyP | KeyCode::F12 => Key::Screenshot,
        KeyCode::F11 => Key::Fullscreen,
        KeyCode::KeyT => Key::Readout,
        KeyCode::F1 => Key::Look(0),
        KeyCode::F2 => Key::Look(1),
        KeyCode::F3 => Key::Look(2),
        KeyCode::F4 => Key::Look(3),
        KeyCode::F5 => Key::Look(4),
        KeyCode::F6 => Key::Look(5),
        KeyCode::F7 => Key::Look(6),
        KeyCode::F10 => Key::Panel,
        _ => return None,
    })
}

/// What a held key moves: the axis (right, up, forward) and the sign. The last two stand for faster.
const HELD: [(KeyCode, usize, f64); 14] = [
    (KeyCode::KeyD, 0, 1.0),
    (KeyCode::KeyA, 0, -1.0),
    (KeyCode::ArrowRight, 0, 1.0),
    (KeyCode::ArrowLeft, 0, -1.0),
    (KeyCode::KeyE, 1, 1.0),
    (KeyCode::Space, 1, 1.0),
    (KeyCode::KeyQ, 1, -1.0),
    (KeyCode::ControlLeft, 1, -1.0),
    (KeyCode::KeyW, 2, 1.0),
    (KeyCode::KeyS, 2, -1.0),
    (KeyCode::ArrowUp, 2, 1.0),
    (KeyCode::ArrowDown, 2, -1.0),
    (KeyCode::ShiftLeft, FASTER, 1.0),
    (KeyCode::ShiftRight, FASTER, 1.0),
];
const FASTER: usize = 3;

/// Touch pads scroll by pixels: as many as make a notch.
const PIXELS_A_NOTCH: f64 = 50.0;

/// Keys and buttons that are down, and what moved.
#[derive(Debug, Default)]
pub struct Input {
    held: [bool; HELD.len()],
    buttons: [bool; 2],
    cursor: Option<[f64; 2]>,
    drag: [f64; 2],
    wheel: f64,
    pressed: Vec<Key>,
    /// Ctrl is down.
    control: bool,
}

impl Input {
    /// Takes in an event that is about keyboard or mouse; with a panel, some keys are about that, and those with Ctrl are its own.
    pub fn take(&mut self, event: &WindowEvent, panel: bool) {
        match event {
            WindowEvent::KeyboardInput { event, is_synthetic, .. } => {
                let PhysicalKey::Code(code) = event.physical_key else { return };
                let down = event.state == ElementState::Pressed;
                if matches!(code, KeyCode::ControlLeft | KeyCode::ControlRight) {
                    self.control = down;
                }
                if panel && down && self.control {
                    return;
                }
                for (held, _) in self.held.iter_mut().zip(HELD).filter(|(_, (own, ..))| *own == code) {
                    *held = down;
                }
                // Keys that were down when the window got the keyboard were not meant for it.
                if down && !event.repeat && !is_synthetic {
                    let quick = panel.then(|| quick(code)).flatten().map(Key::Quick);
                    self.pressed.extend(quick.or_else(|| key(code)));
                }
            }
            WindowEvent::MouseInput { state, button, .. } => {
                let down = *state == ElementState::Pressed;
                match button {
                    MouseButton::Left => self.buttons[0] = down,
                    MouseButton::Right => self.buttons[1] = down,
                    _ => {}
                }
            }
            WindowEvent::CursorMoved { position, .. } => {
                let at = [position.x, position.y];
                if let Some(before) = self.cursor.replace(at).filter(|_| self.buttons.contains(&true)) {
                    self.drag = [0, 1].map(|axis| self.drag[axis] + at[axis] - before[axis]);
                }
            }
            WindowEvent::CursorLeft { .. } => self.cursor = None,
            WindowEvent::MouseWheel { delta, .. } => {
                self.wheel += match delta {
                    MouseScrollDelta::LineDelta(_, lines) => f64::from(*lines),
                    MouseScrollDelta::PixelDelta(pixels) => pixels.y / PIXELS_A_NOTCH,
                };
            }
            WindowEvent::Focused(false) => self.release(),
            _ => {}
        }
    }

    /// Whoever has the keyboard now gets the events of keys and buttons that go up.
    fn release(&mut self) {
        (self.held, self.buttons, self.cursor, self.control) = Default::default();
    }

    /// Keys pressed since the last call, in order.
    pub fn pressed(&mut self) -> impl Iterator<Item = Key> {
        self.pressed.drain(..)
    }

    /// What hands ask for since the last call, in a window `height` pixels high.
    pub fn controls(&mut self, height: u32) -> Controls {
        let mut axes = [0.0_f64; 4];
        for (_, (_, axis, sign)) in self.held.iter().zip(HELD).filter(|(held, _)| **held) {
            axes[axis] += sign;
        }
        let drag = std::mem::take(&mut self.drag).map(|pixels| pixels / f64::from(height.max(1)));
        Controls {
            motion: DVec3::new(axes[0], axes[1], axes[2]).clamp(DVec3::NEG_ONE, DVec3::ONE),
            fast: axes[FASTER] > 0.0,
            drag,
            wheel: std::mem::take(&mut self.wheel),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use winit::dpi::PhysicalPosition;
    use winit::event::DeviceId;

    fn moved(x: f64, y: f64) -> WindowEvent {
        WindowEvent::CursorMoved { device_id: DeviceId::dummy(), position: PhysicalPosition::new(x, y) }
    }

    fn button(state: ElementState) -> WindowEvent {
        WindowEvent::MouseInput { device_id: DeviceId::dummy(), state, button: MouseButton::Left }
    }

    #[test]
    fn only_a_held_button_drags() {
        let mut input = Input::default();
        input.take(&moved(10.0, 10.0), false);
        input.take(&moved(30.0, 10.0), false);
        assert_eq!(input.controls(100).drag, [0.0; 2]);
        input.take(&button(ElementState::Pressed), false);
        input.take(&moved(40.0, 5.0), false);
        assert_eq!(input.controls(100).drag, [0.1, -0.05]);
        assert_eq!(input.controls(100).drag, [0.0; 2], "told once");
    }

    #[test]
    fn a_lost_keyboard_lets_everything_go() {
        let mut input = Input { held: [true; HELD.len()], ..Input::default() };
        input.take(&button(ElementState::Pressed), false);
        assert!(input.controls(100).fast);
        input.take(&WindowEvent::Focused(false), false);
        input.take(&moved(0.0, 0.0), false);
        input.take(&moved(50.0, 0.0), false);
        assert_eq!(input.controls(100), Controls::default());
    }

    #[test]
    fn opposite_keys_cancel() {
        let mut input = Input::default();
        for (held, (code, ..)) in input.held.iter_mut().zip(HELD) {
            *held = matches!(code, KeyCode::KeyW | KeyCode::ArrowUp | KeyCode::KeyA | KeyCode::KeyD);
        }
        assert_eq!(input.controls(100).motion, DVec3::Z);
    }
}
