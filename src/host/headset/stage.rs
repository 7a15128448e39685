//! A session and the images that are drawn in it.

use super::HeadsetSettings;
use super::panel::{Board, Quad};
use super::views::Views;
use super::warp::Warp;
use crate::draw::{HiddenMesh, NEAR};
use crate::gpu::{Device, Image, Target, Turn};
use crate::host::HostError;
use crate::host::painter::Painter;
use crate::jobs::kernel_id;
use crate::xr::vendor::{self, HandJoints, Joints, ThreadRole};
use crate::xr::{
    DepthRange, FrameTime, HANDS, Hand, Input, Layer, Runtime, Session, SpaceStep, Time, XrError, extensions,
};
use std::sync::Arc;
use std::time::Duration;

/// How long an image is waited for before a frame goes without: far longer than a compositor that lives keeps one.
pub(super) const IMAGE_PATIENCE: Duration = Duration::from_millis(500);

/// In the order they are dropped: views of images before the images, all before the session.
pub struct Stage {
    /// The panel's images, once it was shown.
    pub quad: Option<Quad>,
    pub views: Views,
    pub warp: Option<Warp>,
    pub input: Input,
    joints: Option<HandJoints>,
    refresh_rate: Option<f32>,
    sustained: bool,
    /// When the runtime moves play space's origin, if it is about to.
    pub moves_at: Option<Time>,
    pub session: Session,
}

/// Images whose turn it is in a frame.
#[derive(Clone, Copy)]
pub struct Turns {
    /// Of the views.
    pub views: Turn,
    /// Of their motion, where that is drawn.
    pub motion: Option<Turn>,
}

impl AsRef<Target> for Stage {
    fn as_ref(&self) -> &Target {
        &self.views.target
    }
}

impl Stage {
    /// Begins a session; its frames are copied where somebody `looks`. Views are `scale` times as large as `settings` say.
    ///
    /// # Errors
    /// The runtime has gone, refuses, or has no format that can be drawn.
    pub fn new(
        runtime: &Arc<Runtime>,
        device: &Arc<Device>,
        settings: &HeadsetSettings,
        looks: bool,
        scale: f32,
    ) -> Result<Self, HostError> {
        let session = Session::new(runtime, device)?;
        let formats = session.formats()?;
        let views = Views::new(&session, device, &formats, settings, looks, scale)?;
        let warp = if settings.space_warp { Warp::new(&session, device, &formats)? } else { None };
        let input = Input::new(&session)?;
        let joints = optional("hands without controllers", HandJoints::new(&session), None)?;
        let refresh_rate = vendor::choose_refresh_rate(&session, settings.refresh_rate);
        let refresh_rate = optional("a chosen refresh rate", refresh_rate, None)?;
        let sustained = settings.sustained && optional("sustained clocks", vendor::sustain(&session), false)?;
        Ok(Self { quad: None, views, warp, input, joints, refresh_rate, sustained, moves_at: None, session })
    }

    /// Pixels of a view.
    pub const fn size(&self) -> [u32; 2] {
        self.views.color.info.size
    }

    /// Makes the views' images anew, `scale` times as large as `settings` say. Every frame is finished.
    ///
    /// # Errors
    /// As [`Views::new`].
    pub fn resize(&mut self, settings: &HeadsetSettings, looks: bool, scale: f32) -> Result<(), HostError> {
        let formats = self.session.formats()?;
        let device = Arc::clone(self.session.device());
        self.views = Views::new(&self.session, &device, &formats, settings, looks, scale)?;
        Ok(())
    }

    /// Whether play space's origin has moved since the frame before the one of `time`.
    pub fn has_moved(&mut self, time: FrameTime) -> bool {
        self.moves_at.take_if(|at| time.is_from(*at)).is_some()
    }

    /// Tells the runtime which threads make the frame: this one, and the sea's `workers` by the kernel's numbers.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn hint_threads(&self, workers: &[u32]) -> Result<(), XrError> {
        if let Some(renderer) = kernel_id() {
            let told = vendor::hint(&self.session, ThreadRole::Renderer, renderer);
            optional("a scheduled frame thread", told, false)?;
        }
        for &worker in workers {
            let told = vendor::hint(&self.session, ThreadRole::Worker, worker);
            optional("scheduled workers", told, false)?;
        }
        Ok(())
    }

    /// Says once what was found.
    pub fn tell(&self, settings: &HeadsetSettings) {
        let runtime = &self.session.runtime;
        let [width, height] = self.size();
        eprintln!(
            "headset: {} on {}, {width}x{height} an eye, standing in {:?}",
            runtime.headset, runtime.name, self.session.space
        );
        if !runtime.is_opaque() {
            eprintln!("headset: its display adds the sea to the room; nothing hides what is behind");
        }
        let list = |found: bool| {
            let names: Vec<_> = extensions::KNOWN
                .iter()
                .filter(|known| known.is_in(&runtime.extensions) == found)
                .map(|known| known.name)
                .collect();
            if names.is_empty() { "none".to_owned() } else { names.join(" ") }
        };
        eprintln!("extensions found: {}", list(true));
        eprintln!("extensions missing: {}", list(false));
        let mut extras: Vec<String> = Vec::new();
        extras.extend(self.refresh_rate.map(|rate| format!("{rate} Hz")));
        extras.extend(self.views.depth.is_some().then(|| "depth submitted".to_owned()));
        extras.extend(self.views.foveation.is_some().then(|| format!("foveation {:?}", settings.foveation)));
        extras.extend(self.warp.as_ref().map(|warp| {
            let [width, height] = warp.size();
            format!("space warp from {width}x{height}")
        }));
        extras.extend(self.sustained.then(|| "sustained clocks".to_owned()));
        extras.extend(self.joints.is_some().then(|| "hands tracked".to_owned()));
        eprintln!(
            "in use: {}",
            if extras.is_empty() { "nothing extra".to_owned() } else { extras.join(", ") }
        );
    }

    /// Joints of those `hands` at `time` that have no grip, where they are seen.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn joints(&self, time: FrameTime, hands: &[Hand; HANDS]) -> Result<[Option<Joints>; HANDS], XrError> {
        let mut found = [None; HANDS];
        if let Some(joints) = &self.joints {
            for side in (0..HANDS).filter(|&side| hands[side].grip.is_none()) {
                found[side] = joints.locate(&self.session, time, side)?;
            }
        }
        Ok(found)
    }

    /// Says what the hands hold.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn tell_hands(&self) -> Result<(), HostError> {
        for (side, path) in ["left", "right"].into_iter().zip(self.input.profiles(&self.session)?) {
            if !path.is_empty() {
                eprintln!("{side} hand: {path}");
            }
        }
        Ok(())
    }

    /// Has `painter` draw nothing where lenses hide it.
    ///
    /// # Errors
    /// The runtime has gone, or out of memory.
    pub fn show_hidden_area(&self, painter: &mut Painter) -> Result<(), HostError> {
        let [left, right] = [self.session.hidden_area(0)?, self.session.hidden_area(1)?];
        painter.set_hidden_area(
            [&left, &right].map(|mask| HiddenMesh { vertices: &mask.vertices, indices: &mask.indices }),
        )
    }

    /// The images whose turn it is, or nothing where those of the views did not come in time.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn acquire(&mut self) -> Result<Option<Turns>, XrError> {
        let Some(views) = self.views.acquire()? else { return Ok(None) };
        let motion = self.warp.as_mut().map_or(Ok(None), Warp::acquire)?;
        Ok(Some(Turns { views, motion }))
    }

    /// Gives the images back, drawn.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn release(&mut self) -> Result<(), XrError> {
        self.views.release()?;
        self.quad.as_mut().map_or(Ok(()), Quad::release)?;
        self.warp.as_mut().map_or(Ok(()), Warp::release)
    }

    /// Ends the frame with what was drawn, the panel where it stands on `board`, and where its motion was drawn, with that and the
    /// `step` of play space.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn end(&mut self, time: FrameTime, step: SpaceStep, board: Option<&Board>) -> Result<(), XrError> {
        let range = DepthRange { near: NEAR };
        let layer = Layer {
            color: &self.views.color,
            depth: self.views.depth.as_ref().map(|depth| (depth, range)),
            motion: self.warp.as_mut().and_then(|warp| warp.shown(range, step)),
            quad: self.quad.as_ref().zip(board).and_then(|(quad, board)| quad.layer(board)),
        };
        self.session.end(time, Some(&layer))
    }

    /// Ends the frame with nothing to see.
    ///
    /// # Errors
    /// The session or the runtime has gone.
    pub fn end_empty(&mut self, time: FrameTime) -> Result<(), XrError> {
        if let Some(warp) = &mut self.warp {
            warp.interrupt();
        }
        self.session.end(time, None)
    }

    /// The copy.
    pub const fn picture(&self) -> Option<&Image> {
        self.views.picture.as_ref()
    }
}

/// What is merely good to have: where a runtime offers it and then refuses, one line says so and it is gone `without`.
pub(super) fn optional<T>(what: &str, asked: Result<T, XrError>, without: T) -> Result<T, XrError> {
    match asked {
        Err(XrError::Call { result, .. }) => {
            eprintln!("headset: without {what}, as OpenXR says {result}");
            Ok(without)
        }
        other => other,
    }
}
