//! Sessions that play themselves, and pictures of every frame.

use super::{WindowHost, script::Asked};
use crate::gpu::Picture;
use crate::host::{HostError, read_back};
use crate::panel::Panel;

/// Pictures that may be on their way to the disk at once.
const AT_ONCE: u64 = 8;

impl WindowHost {
    /// Does what the script says for this frame; whether it is over.
    pub(super) fn play(&mut self) -> Result<bool, HostError> {
        let Some(mut script) = self.settings.play.take() else { return Ok(false) };
        let context = self.opened.window.interface().map(|interface| interface.context().clone());
        let choice = |word: &str| Panel::choice(context.as_ref()?, word);
        let asked = script.go_on(&mut self.authoring.panel, choice);
        let over = script.is_over();
        self.settings.play = Some(script);
        let Asked { events, toggle } = asked?;
        if toggle {
            self.toggle_panel();
        }
        if let Some(interface) = self.opened.window.interface() {
            for event in events {
                interface.put_in(event);
            }
        }
        Ok(over)
    }

    /// Writes the frame drawn last, where a recording was asked for.
    pub(super) fn record_frame(&mut self) -> Result<(), HostError> {
        let Some(folder) = &self.settings.record else { return Ok(()) };
        let Some(picture) = self.opened.target.finished() else { return Ok(()) };
        let pixels = read_back(self.painter.device(), picture)?;
        let path = folder.join(format!("frame_{:04}.png", self.drawn));
        self.screenshots.write(path, Picture::finished(picture).extent, picture.info.layers, pixels);
        if self.drawn % AT_ONCE == AT_ONCE - 1 {
            self.screenshots.finish()?;
        }
        Ok(())
    }
}
