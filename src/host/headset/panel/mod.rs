//! The panel in a headset: it stands before the person, hands point at it, and the scene changes around it. See `docs/panel.md`.

mod board;
mod pointer;
mod quad;

pub use board::Board;
pub use pointer::Pointed;
pub use quad::Quad;

use super::eyes;
use super::stage::{Stage, optional};
use super::world::World;
use super::{Guest, Show};
use crate::host::HostError;
use crate::host::authoring::{Authoring, AuthoringSettings, Onto, Shown, cut};
use crate::panel::draw_pointer;
use crate::sea::SeaMaps;
use crate::xr::{HANDS, Hand, VIEWS, View};
use egui::Event;
use pointer::Pointer;
use std::time::Instant;

/// Seconds between two runs of a panel that nobody points at: for its plots, and for what has been made.
const IDLE: f64 = 0.1;

/// What of the panel outlives a session.
pub struct HeadsetPanel {
    authoring: Authoring,
    /// Where it stands; nothing while it is hidden.
    board: Option<Board>,
    pointer: Pointer,
    events: Vec<Event>,
    /// When egui ran last, and the frame before, seconds of the sea.
    ran: f64,
    before: f64,
    /// What running it took last, milliseconds.
    took: f64,
}

impl HeadsetPanel {
    /// Hidden.
    ///
    /// # Errors
    /// As [`Authoring::new`].
    pub fn new(settings: &AuthoringSettings) -> Result<Self, HostError> {
        let authoring = Authoring::new(settings)?;
        let (board, pointer, events) = (None, Pointer::default(), Vec::new());
        Ok(Self { authoring, board, pointer, events, ran: f64::NEG_INFINITY, before: 0.0, took: 0.0 })
    }

    /// Where it stands, if it is shown.
    pub const fn board(&self) -> Option<&Board> {
        self.board.as_ref()
    }

    /// Drops whatever is of the device, which is about to go.
    pub fn forget(&mut self) {
        self.authoring.forget();
    }
}

impl Show<'_> {
    /// Takes over what was made of a changed text, and has changes made, for a frame at `seconds`.
    pub(super) fn author(
        &mut self,
        world: &mut World,
        stage: &mut Stage,
        seconds: f64,
        guest: &mut dyn Guest,
    ) -> Result<(), HostError> {
        let Some(panel) = &mut self.panel else { return Ok(()) };
        let shown = Shown {
            scene: &self.scene,
            sky: &self.sky,
            look: self.settings.look,
            pass: stage.views.target.pass(),
            device: world.painter.device(),
            threads: self.settings.threads,
        };
        let made = panel.authoring.turn(&shown, seconds).or_else(|| panel.authoring.incoming());
        let Some(made) = made else { return Ok(()) };
        let onto = Onto {
            scene: &mut self.scene,
            sky: &mut self.sky,
            sea: &mut self.sea,
            painter: &mut world.painter,
        };
        let adopted = panel.authoring.adopt(made, onto)?;
        if adopted.painter {
            stage.show_hidden_area(&mut world.painter)?;
            if let Some(warp) = &stage.warp {
                world.painter.prepare_motion(warp.target())?;
            }
        }
        if adopted.sea && self.settings.thread_hints {
            stage.hint_threads(&self.sea.kernel_ids())?;
        }
        if adopted.before.lod.quality != self.scene.lod.quality {
            self.adapt.refit(&self.scene);
            guest.level(self.adapt.number());
        }
        // Colours alone leave what is on a coarser level there.
        if adopted.painter || adopted.sea {
            self.use_level(world)?;
        }
        if adopted.before.camera != self.scene.camera {
            self.ride.begin(&self.scene)?;
        } else if adopted.before.raft != self.scene.raft {
            self.ride.refit(&self.scene)?;
        }
        Ok(())
    }

    /// Shows or hides the panel as hands or `guest` ask, lets it see what they do, and returns what of that is left for the raft.
    pub(super) fn point(
        &mut self,
        stage: &mut Stage,
        views: &[View; VIEWS],
        hands: &[Hand; HANDS],
        seconds: f64,
        guest: &mut dyn Guest,
    ) -> Result<Pointed, HostError> {
        let all = Pointed { hands: *hands, rays: [None; HANDS] };
        let asked = guest.asks_for_panel() ^ hands.iter().any(|hand| hand.panel);
        let Some(panel) = &mut self.panel else { return Ok(all) };
        #[expect(clippy::cast_possible_truncation, reason = "a frame's length")]
        let step = (seconds - panel.before).clamp(0.0, 0.1) as f32;
        let frame = 1e3 * (seconds - panel.before);
        panel.before = seconds;
        if asked {
            panel.board = match panel.board {
                None => Some(Board::before(eyes::head(views))),
                Some(_) => None,
            };
            panel.authoring.show(panel.board.is_some(), &self.scene);
            panel.ran = f64::NEG_INFINITY;
            panel.pointer.leave(&mut panel.events);
        }
        let Some(board) = panel.board else { return Ok(all) };
        if stage.quad.is_none() {
            stage.quad = match Quad::new(&stage.session) {
                Ok(quad) => Some(quad),
                Err(HostError::Xr(error)) => optional("the panel", Err(error), None)?,
                Err(error) => return Err(error),
            };
        }
        let Some(quad) = &mut stage.quad else {
            self.panel = None;
            return Ok(all);
        };
        let pointed = panel.pointer.step(hands, &board, quad::POINTS, step, &mut panel.events);
        panel.authoring.measured(frame, &self.sea, panel.took);
        let due = panel.pointer.is_busy() || !panel.events.is_empty() || seconds >= panel.ran + IDLE;
        // Time may also go backwards, with another clock.
        if quad.is_free() && (due || seconds < panel.ran) {
            let began = Instant::now();
            let (own, pointer) = (&mut panel.authoring.panel, panel.pointer.shown());
            quad.run(seconds, &mut panel.events, |ui| {
                own.fill(ui);
                if let Some((at, pressed)) = pointer {
                    draw_pointer(ui, at, pressed);
                }
            });
            panel.ran = seconds;
            panel.took = 1e3 * began.elapsed().as_secs_f64();
        }
        Ok(pointed)
    }
}

/// Heights ahead of the eyes, for the panel's plot where it is shown.
pub fn cut_ahead(panel: Option<&mut HeadsetPanel>, maps: &SeaMaps, eye: &crate::draw::Eye) {
    if let Some(panel) = panel.filter(|panel| panel.board.is_some()) {
        cut(&mut panel.authoring.panel, maps, eye);
    }
}
