//! A scene authored while it is shown: its text, what becomes of changes to it, and a file that somebody else changes.
//!
//! Nothing here keeps a frame waiting for what is being made: the old scene is shown until the new one is ready. A new sea begins
//! its step while the old one is drawn for the last time. Windows and headsets author alike.

mod cut;
mod fit;
mod watch;
mod workshop;

pub use cut::cut;
pub use fit::Fit;
pub use watch::Watch;
pub use workshop::{Made, Shown};

use super::HostError;
use super::painter::Painter;
use crate::draw::SkyMap;
use crate::panel::{Measured, Panel};
use crate::scene::Scene;
use crate::sea::SeaAhead;
use std::path::PathBuf;
use std::sync::Arc;
use workshop::{Order, Outcome, Workshop};

/// What is authored.
#[derive(Clone, Debug)]
pub struct AuthoringSettings {
    /// The text that the shown scene was read from.
    pub text: String,
    /// The file it was read from, where it was one: watched, and saved to.
    pub file: Option<PathBuf>,
    /// What is done to every scene that is read.
    pub fit: Fit,
}

/// A text, the panel that changes it, and the thread that makes scenes of it.
pub struct Authoring {
    /// The panel.
    pub panel: Panel,
    fit: Fit,
    watch: Option<Watch>,
    /// Its thread begins with the first order.
    workshop: Option<Workshop>,
    /// A scene with another sea, which a frame has to begin.
    incoming: Option<Box<Made>>,
    /// The renderer is to be made anew though the text is the same.
    anew: bool,
    /// Whether somebody sees what the panel tells.
    shown: bool,
}

/// What is shown, to be changed.
pub struct Onto<'a> {
    /// The scene.
    pub scene: &'a mut Arc<Scene>,
    /// Its sky.
    pub sky: &'a mut Arc<SkyMap>,
    /// Its sea.
    pub sea: &'a mut SeaAhead,
    /// What draws it.
    pub painter: &'a mut Painter,
}

/// What a scene has been taken over from.
pub struct Adopted {
    /// The scene before.
    pub before: Arc<Scene>,
    /// Whether the renderer is another, which knows nothing that the one before it was told.
    pub painter: bool,
    /// Whether the sea is another.
    pub sea: bool,
}

impl Authoring {
    /// For the text that the shown scene was read from.
    ///
    /// # Errors
    /// None for a text that a scene was read from.
    pub fn new(settings: &AuthoringSettings) -> Result<Self, HostError> {
        let file = settings.file.as_deref();
        Ok(Self {
            panel: Panel::new(settings.text.clone(), file)?,
            fit: settings.fit.clone(),
            watch: file.map(Watch::new),
            workshop: None,
            incoming: None,
            anew: false,
            shown: false,
        })
    }

    /// The panel is seen from now on, or not any more. `scene` is what is drawn.
    pub fn show(&mut self, shown: bool, scene: &Arc<Scene>) {
        self.shown = shown;
        if shown && self.panel.wants_facts() {
            self.order(Order::Facts(Arc::clone(scene)));
        }
    }

    /// The renderer is made anew, though the text is the same: shaders have changed.
    #[cfg(not(target_os = "android"))]
    pub const fn make_anew(&mut self) {
        self.anew = true;
    }

    /// Once a frame: looks whether the file has changed, and has what has changed made, for a frame at about `time`. What is
    /// returned is to be taken over by [`Self::adopt`] before the frame.
    pub fn turn(&mut self, shown: &Shown<'_>, time: f64) -> Option<Box<Made>> {
        self.look_at_file();
        if let Some(outcome) = self.workshop.as_mut().and_then(Workshop::finished)
            && let Some(made) = self.take(outcome, shown)
        {
            return Some(made);
        }
        let busy = self.workshop.as_ref().is_some_and(Workshop::is_busy) || self.incoming.is_some();
        if busy {
            return None;
        }
        let changed = self.panel.changed();
        if changed.is_some() || self.anew {
            let text = changed.unwrap_or_else(|| self.panel.text().to_owned());
            let order = Order::Scene {
                text,
                origin: self.panel.origin().to_owned(),
                shown: shown.kept(),
                fit: self.fit.clone(),
                time,
                anew: std::mem::take(&mut self.anew),
            };
            self.order(order);
        }
        None
    }

    fn look_at_file(&mut self) {
        if self.watch.as_mut().is_some_and(Watch::has_changed) {
            match std::fs::read_to_string(self.panel.file()) {
                Ok(text) => self.panel.reload(text),
                Err(error) => self.panel.refused(format!("{}: {error}", self.panel.origin())),
            }
        }
    }

    /// What can be shown at once is returned; another sea has to be begun first.
    fn take(&mut self, outcome: Outcome, shown: &Shown<'_>) -> Option<Box<Made>> {
        match outcome {
            Outcome::Facts(facts) => self.panel.accepted(facts, &shown.scene.warnings),
            // Somebody has chosen another look meanwhile.
            Outcome::Made(made) if made.painter.is_some() && made.look != shown.look => self.anew = true,
            Outcome::Made(made) if made.sea.is_some() => self.incoming = Some(made),
            Outcome::Made(made) => return Some(made),
            Outcome::Refused(reason) => {
                if !self.shown {
                    eprintln!("{reason}");
                }
                self.panel.refused(reason);
            }
        }
        None
    }

    /// Whether a sea waits for its first step here, which is then begun for the frame at `following`. A headset, which learns late
    /// when a frame is, begins it with the first frame that shows it.
    ///
    /// # Errors
    /// A worker failed.
    #[cfg(not(target_os = "android"))]
    pub fn begin_incoming(&mut self, following: Option<f64>) -> Result<bool, HostError> {
        let sea = self.incoming.as_mut().and_then(|made| made.sea.as_mut());
        let (Some(sea), Some(following)) = (sea, following) else { return Ok(false) };
        sea.begin(following)?;
        Ok(true)
    }

    /// The scene whose sea was begun.
    pub const fn incoming(&mut self) -> Option<Box<Made>> {
        self.incoming.take()
    }

    /// Shows `made` from the next frame on. Frames that were submitted are waited for, two at most; what is old is dropped elsewhere.
    ///
    /// # Errors
    /// The device was lost.
    pub fn adopt(&mut self, made: Box<Made>, onto: Onto<'_>) -> Result<Adopted, HostError> {
        let Made { scene, facts, sky, sea, painter, look: _ } = *made;
        onto.painter.wait_all()?;
        if let Some(sky) = sky {
            *onto.sky = sky;
        }
        let adopted = (painter.is_some(), sea.is_some());
        match painter {
            Some(painter) => {
                let old = std::mem::replace(onto.painter, painter);
                self.order(Order::Waste(Box::new(old)));
            }
            None => onto.painter.repaint(&scene, onto.sky, facts.height()),
        }
        if let Some(sea) = sea {
            let old = std::mem::replace(onto.sea, sea);
            self.order(Order::Waste(Box::new(old)));
        }
        let before = std::mem::replace(onto.scene, Arc::new(scene));
        self.panel.accepted(facts, &onto.scene.warnings);
        Ok(Adopted { before, painter: adopted.0, sea: adopted.1 })
    }

    /// Waits for the thread and drops what it made: the device is about to go.
    pub fn forget(&mut self) {
        // What was on its way is wanted still, of another device.
        self.anew |= self.incoming.take().is_some() || self.workshop.as_ref().is_some_and(Workshop::is_busy);
        self.workshop = None;
    }

    /// What the frame before took, milliseconds: from one to the next, the sea's step, and the panel.
    pub fn measured(&mut self, frame: f64, sea: &SeaAhead, panel: f64) {
        let sea = 1e3 * sea.last_step().as_secs_f64();
        self.panel.plots().add(Measured { frame, sea, panel });
    }

    fn order(&mut self, order: Order) {
        self.workshop.get_or_insert_with(Workshop::new).order(order);
    }
}
