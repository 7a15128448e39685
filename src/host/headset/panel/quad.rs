//! The panel's images in a session: egui runs, and what it shows is drawn into a swapchain that both eyes see.

use super::board::{self, Board};
use crate::draw::{self, Painting};
use crate::gpu::{Device, FRAMES_IN_FLIGHT, Overlay, Recorder};
use crate::host::HostError;
use crate::xr::{self, Session, Swapchain, SwapchainInfo, Usage, XrError};
use ash::vk;
use egui::{Context, Event, Pos2, RawInput, Rect, Ui};
use std::sync::Arc;
use std::time::Duration;

/// Width and height, points: as fine as a finger at arm's length points, on [`board::SIZE`].
pub const POINTS: [f32; 2] = [420.0, 560.0];
/// Pixels a point: some 28 a degree at the panel's distance, more than headsets have.
const SCALE: f32 = 2.0;
/// Formats it is kept in: what egui's colours are encoded as.
const FORMATS: [vk::Format; 2] = [vk::Format::R8G8B8A8_SRGB, vk::Format::B8G8R8A8_SRGB];

/// In the order they are dropped: views of images before the images.
pub struct Quad {
    drawer: draw::Panel,
    /// One for each image.
    overlays: Vec<Overlay>,
    swapchain: Swapchain,
    context: Context,
    /// What is to be drawn next. egui tells of each change to its textures once, so this is kept until it is drawn.
    painting: Option<Painting>,
    /// Whether an image was given back, for the compositor to show.
    drawn: bool,
}

impl Quad {
    /// Images in `session`.
    ///
    /// # Errors
    /// The runtime has gone, refuses, or has no format that egui's colours can be drawn in.
    pub fn new(session: &Session) -> Result<Self, HostError> {
        let offered = session.formats()?;
        let format = FORMATS.into_iter().find(|format| offered.contains(format));
        let format = format.ok_or_else(|| XrError::Missing {
            runtime: session.runtime.name.clone(),
            what: "images of 8-bit sRGB colours".to_owned(),
        })?;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "constants")]
        let size = POINTS.map(|side| (side * SCALE) as u32);
        let info = SwapchainInfo { size, format, usage: Usage::Panel, foveated: false, subsampled: false };
        let swapchain = Swapchain::new(session, info)?;
        let device: &Arc<Device> = session.device();
        let overlays: Vec<_> = swapchain
            .images()
            .iter()
            .map(|&image| Overlay::lent(device, image, size, format))
            .collect::<Result<_, _>>()?;
        let Some(first) = overlays.first() else {
            let what = "a swapchain with images in it".to_owned();
            return Err(XrError::Missing { runtime: session.runtime.name.clone(), what }.into());
        };
        let drawer = draw::Panel::new(device, first)?;
        let context = Context::default();
        context.set_visuals(egui::Visuals::dark());
        Ok(Self { drawer, overlays, swapchain, context, painting: None, drawn: false })
    }

    /// Whether what egui showed last is drawn, so that it may run again.
    pub const fn is_free(&self) -> bool {
        self.painting.is_none()
    }

    /// Runs `show` with `events`, of which none is left, at `time`, seconds.
    pub fn run(&mut self, time: f64, events: &mut Vec<Event>, mut show: impl FnMut(&mut Ui)) {
        let mut input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, POINTS.into())),
            time: Some(time),
            focused: true,
            ..RawInput::default()
        };
        input.events.append(events);
        if let Some(root) = input.viewports.get_mut(&egui::ViewportId::ROOT) {
            root.native_pixels_per_point = Some(SCALE);
        }
        let output = self.context.run_ui(input, &mut show);
        self.painting = Some(Painting::of(&self.context, output));
    }

    /// The image to draw into, where there is something to draw and the compositor has one free. Does not wait.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn acquire(&mut self) -> Result<Option<usize>, XrError> {
        if self.painting.is_none() {
            return Ok(None);
        }
        self.swapchain.acquire(Duration::ZERO)
    }

    /// Records it into image `turn`, in the frame of number `index`.
    ///
    /// # Errors
    /// Out of memory.
    pub fn record(&mut self, commands: Recorder<'_>, turn: usize, index: usize) -> Result<(), HostError> {
        if let (Some(painting), Some(overlay)) = (self.painting.take(), self.overlays.get(turn)) {
            self.drawer.record(commands, overlay, index % FRAMES_IN_FLIGHT, &painting)?;
        }
        Ok(())
    }

    /// Gives the image back, drawn.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn release(&mut self) -> Result<(), XrError> {
        if self.painting.is_none() {
            self.swapchain.release()?;
            self.drawn = true;
        }
        Ok(())
    }

    /// What the compositor shows at `board`, once something is drawn.
    pub fn layer(&self, board: &Board) -> Option<xr::Quad<'_>> {
        self.drawn.then(|| xr::Quad { color: &self.swapchain, pose: board.pose(), size: board::SIZE })
    }
}
