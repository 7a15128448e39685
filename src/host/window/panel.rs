//! The panel in a window: over the picture, with shaders that are compiled anew when they change.

use super::WindowHost;
use super::shader_watch::ShaderWatch;
use crate::draw::{self, Painting};
use crate::gpu::{FRAMES_IN_FLIGHT, Overlay, Recorder, Target};
use crate::host::HostError;
use crate::host::authoring::{Made, Onto, Shown};
use crate::host::view::Viewer;
use std::path::Path;
use std::time::Instant;

/// What the panel is drawn with.
pub struct PanelOver {
    shaders: Option<ShaderWatch>,
    drawer: Option<draw::Panel>,
    overlay: Option<Overlay>,
    /// What this frame shows over the picture.
    painting: Option<Painting>,
    /// What the panel took in the frame before, milliseconds.
    took: f64,
}

impl PanelOver {
    /// Nothing yet; shaders in the folder `shaders` are watched.
    pub fn new(shaders: Option<&Path>) -> Self {
        let shaders = shaders.map(ShaderWatch::new);
        Self { shaders, drawer: None, overlay: None, painting: None, took: 0.0 }
    }

    /// The picture that the panel was drawn on goes, after all frames have ended.
    pub fn drop_overlay(&mut self) {
        self.overlay = None;
    }

    /// Draws the panel over the picture of `target`, where there is something to draw; `index` counts frames.
    pub fn record(&mut self, recorder: Recorder<'_>, target: &Target, index: usize) -> Result<(), HostError> {
        let (Some(painting), Some(picture)) = (&self.painting, target.finished()) else { return Ok(()) };
        if self.overlay.is_none() {
            self.overlay = Some(Overlay::new(target.device(), picture)?);
        }
        let Some(overlay) = &self.overlay else { return Ok(()) };
        if self.drawer.is_none() {
            self.drawer = Some(draw::Panel::new(target.device(), overlay)?);
        }
        if let Some(drawer) = &mut self.drawer {
            drawer.record(recorder, overlay, index % FRAMES_IN_FLIGHT, painting)?;
        }
        Ok(())
    }
}

impl WindowHost {
    /// Looks whether files have changed, has changed scenes made and takes over what was made. `time` is the next to be shown.
    pub(super) fn author(&mut self, time: f64) -> Result<(), HostError> {
        self.look_at_shaders();
        let shown = Shown {
            scene: &self.scene,
            sky: &self.sky,
            look: self.look,
            pass: self.opened.target.pass(),
            device: self.painter.device(),
            threads: self.settings.threads,
        };
        match self.authoring.turn(&shown, time) {
            Some(made) => self.adopt(made),
            None => Ok(()),
        }
    }

    fn look_at_shaders(&mut self) {
        match self.panel.shaders.as_mut().and_then(ShaderWatch::compiled) {
            Some(Ok(replacements)) => {
                self.painter.device().replace_shaders(replacements);
                self.authoring.make_anew();
                self.authoring.panel.shaders(None);
            }
            Some(Err(error)) => {
                eprintln!("{error}");
                self.authoring.panel.shaders(Some(error));
            }
            None => {}
        }
    }

    /// Shows what was begun from the next frame on.
    pub(super) fn adopt_incoming(&mut self) -> Result<(), HostError> {
        match self.authoring.incoming() {
            Some(made) => self.adopt(made),
            None => Ok(()),
        }
    }

    fn adopt(&mut self, made: Box<Made>) -> Result<(), HostError> {
        let Self { scene, sky, sea, painter, .. } = self;
        let adopted = self.authoring.adopt(made, Onto { scene, sky, sea, painter })?;
        if self.scene.camera != adopted.before.camera {
            self.viewer = Viewer::new(&self.scene.camera);
        }
        Ok(())
    }

    /// Shows the panel, or hides it.
    pub(super) fn toggle_panel(&mut self) {
        let step = self.settings.play.as_ref().map(|play| play.step());
        if let Some(interface) = self.opened.window.interface_or_new(step) {
            interface.toggle();
            self.authoring.show(interface.is_shown(), &self.scene);
        }
    }

    /// Lets the panel see this frame's events; what it shows is drawn with the frame.
    pub(super) fn run_panel(&mut self, frame_milliseconds: f64) {
        self.authoring.measured(frame_milliseconds, &self.sea, self.panel.took);
        let began = Instant::now();
        let panel = &mut self.authoring.panel;
        self.panel.painting = self.opened.window.run_interface(|ui| panel.show(ui));
        self.panel.took =
            if self.panel.painting.is_some() { 1e3 * began.elapsed().as_secs_f64() } else { 0.0 };
    }
}
