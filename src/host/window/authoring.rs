//! A scene authored while it is shown: the panel, what becomes of its changes, and files that change.
//!
//! Nothing here keeps a frame waiting for what is being made: the old scene is shown until the new one is ready. A new sea begins
//! its step while the old one is drawn for the last time.

use super::shader_watch::ShaderWatch;
use super::watch::Watch;
use super::workshop::{Made, Order, Outcome, Shown, Workshop};
use super::{WindowHost, WindowSettings};
use crate::draw::{self, Painting};
use crate::gpu::{FRAMES_IN_FLIGHT, Overlay, Recorder, Target};
use crate::host::HostError;
use crate::host::view::Viewer;
use crate::panel::{Measured, Panel, SECTION_POINTS, SECTION_STEP};
use crate::sea::{SeaMaps, query::Query};
use std::sync::Arc;
use std::time::Instant;

/// Where a scene's text comes from, and what is watched.
pub struct Authoring {
    /// The panel.
    pub panel: Panel,
    workshop: Workshop,
    /// A scene with another sea, which a frame has to begin.
    incoming: Option<Box<Made>>,
    watch: Option<Watch>,
    shaders: Option<ShaderWatch>,
    /// The renderer is to be made anew though the text is the same.
    anew: bool,
    drawer: Option<draw::Panel>,
    overlay: Option<Overlay>,
    /// What this frame shows over the picture.
    painting: Option<Painting>,
    /// What the panel took in the frame before, milliseconds.
    took: f64,
}

impl Authoring {
    /// For the text that the shown scene was read from.
    ///
    /// # Errors
    /// None for a text that a scene was read from.
    pub fn new(settings: &WindowSettings) -> Result<Self, HostError> {
        let file = settings.scene_file.as_deref();
        Ok(Self {
            panel: Panel::new(settings.scene_text.clone(), file)?,
            workshop: Workshop::new(),
            incoming: None,
            watch: file.map(Watch::new),
            shaders: settings.shaders.as_deref().map(ShaderWatch::new),
            anew: false,
            drawer: None,
            overlay: None,
            painting: None,
            took: 0.0,
        })
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
        self.look_at_files();
        let own = &mut self.authoring;
        if let Some(outcome) = own.workshop.finished() {
            match outcome {
                // Somebody has chosen another look meanwhile.
                Outcome::Facts(facts) => own.panel.accepted(facts, &self.scene.warnings),
                Outcome::Made(made) if made.painter.is_some() && made.look != self.look => own.anew = true,
                Outcome::Made(made) if made.sea.is_some() => own.incoming = Some(made),
                Outcome::Made(made) => self.adopt(made)?,
                Outcome::Refused(reason) => {
                    if !self.opened.window.interface().is_some_and(|interface| interface.is_shown()) {
                        eprintln!("{reason}");
                    }
                    own.panel.refused(reason);
                }
            }
        }
        let own = &mut self.authoring;
        if own.workshop.is_busy() || own.incoming.is_some() {
            return Ok(());
        }
        let changed = own.panel.changed();
        if changed.is_some() || own.anew {
            own.workshop.order(Order::Scene {
                text: changed.unwrap_or_else(|| own.panel.text().to_owned()),
                origin: own.panel.origin().to_owned(),
                shown: Shown {
                    scene: Arc::clone(&self.scene),
                    sky: Arc::clone(&self.sky),
                    look: self.look,
                    target: self.opened.target.info,
                    device: Arc::clone(self.painter.device()),
                },
                quality: self.settings.quality,
                threads: self.settings.threads,
                time,
                anew: std::mem::take(&mut own.anew),
            });
        }
        Ok(())
    }

    fn look_at_files(&mut self) {
        let own = &mut self.authoring;
        if own.watch.as_mut().is_some_and(Watch::has_changed) {
            match std::fs::read_to_string(own.panel.file()) {
                Ok(text) => own.panel.reload(text),
                Err(error) => own.panel.refused(format!("{}: {error}", own.panel.origin())),
            }
        }
        if let Some(compiled) = own.shaders.as_mut().and_then(ShaderWatch::compiled) {
            match compiled {
                Ok(replacements) => {
                    self.painter.device().replace_shaders(replacements);
                    own.anew = true;
                    own.panel.shaders(None);
                }
                Err(error) => {
                    eprintln!("{error}");
                    own.panel.shaders(Some(error));
                }
            }
        }
    }

    /// Whether a sea waits for its first step here, which is then begun for the frame at `following`.
    pub(super) fn begin_incoming(&mut self, following: Option<f64>) -> Result<bool, HostError> {
        let sea = self.authoring.incoming.as_mut().and_then(|made| made.sea.as_mut());
        let (Some(sea), Some(following)) = (sea, following) else { return Ok(false) };
        sea.begin(following)?;
        Ok(true)
    }

    /// Shows what was begun from the next frame on.
    pub(super) fn adopt_incoming(&mut self) -> Result<(), HostError> {
        match self.authoring.incoming.take() {
            Some(made) => self.adopt(made),
            None => Ok(()),
        }
    }

    /// Shows `made` from the next frame on. Frames that were submitted are waited for, two at most; what is old is dropped elsewhere.
    fn adopt(&mut self, made: Box<Made>) -> Result<(), HostError> {
        let Made { scene, facts, sky, sea, painter, look: _ } = *made;
        self.painter.wait_all()?;
        if let Some(sky) = sky {
            self.sky = sky;
        }
        match painter {
            Some(painter) => {
                let old = std::mem::replace(&mut self.painter, painter);
                self.authoring.workshop.order(Order::Waste(Box::new(old)));
            }
            None => self.painter.repaint(&scene, &self.sky, facts.height()),
        }
        if let Some(sea) = sea {
            let old = std::mem::replace(&mut self.sea, sea);
            self.authoring.workshop.order(Order::Waste(Box::new(old)));
        }
        if scene.camera != self.scene.camera {
            self.viewer = Viewer::new(&scene.camera);
        }
        self.scene = Arc::new(scene);
        self.authoring.panel.accepted(facts, &self.scene.warnings);
        Ok(())
    }

    /// Shows the panel, or hides it.
    pub(super) fn toggle_panel(&mut self) {
        let step = self.settings.play.as_ref().map(|play| play.step());
        if let Some(interface) = self.opened.window.interface_or_new(step) {
            interface.toggle();
        }
        if self.authoring.panel.wants_facts() {
            self.authoring.workshop.order(Order::Facts(Arc::clone(&self.scene)));
        }
    }

    /// Lets the panel see this frame's events; what it shows is drawn with the frame.
    pub(super) fn run_panel(&mut self, frame_milliseconds: f64) {
        let own = &mut self.authoring;
        let sea = 1e3 * self.sea.last_step().as_secs_f64();
        own.panel.plots().add(Measured { frame: frame_milliseconds, sea, panel: own.took });
        let began = Instant::now();
        own.painting = self.opened.window.run_interface(|ui| own.panel.show(ui));
        own.took = if own.painting.is_some() { 1e3 * began.elapsed().as_secs_f64() } else { 0.0 };
    }
}

/// Heights straight ahead of `viewer`, for the plot of the cut, where somebody looks at it.
pub(super) fn cut(panel: &mut Panel, maps: &SeaMaps, viewer: &Viewer) {
    if !panel.plots().wants_section() {
        return;
    }
    let eye = viewer.eye(1.0);
    let back = eye.axes.z_axis;
    let length = f64::from(back.x).hypot(f64::from(back.z)).max(1e-6);
    let ahead = [-f64::from(back.x) / length, -f64::from(back.z) / length];
    let query = Query::new(maps);
    let heights = (0..SECTION_POINTS).map(|point| {
        let distance = point as f64 * SECTION_STEP;
        query.above(eye.position.x + ahead[0] * distance, eye.position.z + ahead[1] * distance).height()
    });
    panel.plots().set_section(heights);
}
