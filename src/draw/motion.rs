//! Motion vectors for space warp (`XR_FB_space_warp`), which shows every other frame from the one before.
//!
//! A second, small pass draws the same meshes with both frames' maps, poses and views. A cascade lies still in the world,
//! so its earlier map is addressed from this frame's origin too; nothing has to know of the earlier origin. Cost: none
//! until it is asked for, as pipelines and pass are made then.

use super::camera::Eye;
use super::counts::DrawCounts;
use super::moment::Moment;
use super::ocean::{self, Layer};
use super::sea_stages::SeaStages;
use super::shaders as s;
use super::solids::{MOST_SOLIDS, MOTION_INPUT, Solid};
use crate::gpu::{
    Bindings, Blend, DepthUse, Device, FRAMES_IN_FLIGHT, GpuError, Pass, Pipeline, PipelineInfo, Recorder,
    VertexInput,
};
use std::sync::Arc;

/// Pipelines of the motion pass, and what the frame before was seen from.
pub struct Motion {
    /// Of patches and skirt.
    pub surface: [Pipeline; 2],
    /// Of solids.
    pub solids: Pipeline,
    sky: Pipeline,
    /// The slot of the frame before.
    slot: Option<usize>,
    time: f64,
    eyes: Vec<Eye>,
    bodies: Vec<Solid>,
}

/// What the frame before was.
#[derive(Clone, Copy)]
pub struct Before<'a> {
    /// Its sea's time, seconds.
    pub time: f64,
    /// Where it was seen from.
    pub eyes: &'a [Eye],
    /// What floated.
    pub solids: &'a [Solid],
}

/// The slot whose maps are those of the frame before the one in `slot`.
pub const fn slot_before(slot: usize) -> usize {
    (slot + FRAMES_IN_FLIGHT - 1) % FRAMES_IN_FLIGHT
}

impl Motion {
    /// Pipelines for `pass` and a sea drawn by `stages`; there is no frame before.
    ///
    /// # Errors
    /// The driver refuses.
    pub fn new(
        device: &Arc<Device>,
        pass: &Pass,
        bindings: &Bindings,
        stages: SeaStages,
    ) -> Result<Self, GpuError> {
        let fragment = s::MOTION_FRAGMENT_MAIN;
        let layer = Layer { fragment, entry: c"fragment_main", lines: false };
        let vertex = [(stages.patch_motion(), c"patch_main"), (s::MOTION_SKIRT_MAIN, c"skirt_main")];
        let solids = PipelineInfo {
            name: "solids' motion",
            vertex: (s::MOTION_SOLID_MAIN, c"solid_main"),
            fragment: (fragment, c"fragment_main"),
            input: MOTION_INPUT,
            depth: DepthUse::Solid,
            blend: Blend::Opaque,
            cull: true,
            lines: false,
        };
        let sky = PipelineInfo {
            name: "sky's motion",
            vertex: (s::MOTION_SKY_MAIN, c"sky_main"),
            input: VertexInput::default(),
            depth: DepthUse::Background,
            cull: false,
            ..solids
        };
        Ok(Self {
            surface: ocean::surface(device, pass, bindings, vertex, &layer)?,
            solids: Pipeline::new(device, pass, bindings.pipeline_layout, &solids)?,
            sky: Pipeline::new(device, pass, bindings.pipeline_layout, &sky)?,
            slot: None,
            time: 0.0,
            eyes: Vec::with_capacity(2),
            bodies: Vec::with_capacity(MOST_SOLIDS),
        })
    }

    /// The frame before the one in `slot`, where its maps are still there: frames take the slots in turns.
    pub fn before(&self, slot: usize) -> Option<Before<'_>> {
        let before = Before { time: self.time, eyes: &self.eyes, solids: &self.bodies };
        (self.slot == Some(slot_before(slot))).then_some(before)
    }

    /// Keeps what the next frame has to know of this one.
    pub fn remember(&mut self, slot: usize, moment: Moment<'_>) {
        (self.slot, self.time) = (Some(slot), moment.maps.time);
        self.eyes.clear();
        self.eyes.extend_from_slice(moment.eyes);
        self.bodies.clear();
        self.bodies.extend_from_slice(moment.solids);
    }

    /// Draws the sky's motion, last, inside the pass.
    pub fn draw_sky(&self, commands: Recorder<'_>) -> DrawCounts {
        self.sky.bind(commands);
        commands.draw(3);
        DrawCounts::draw(1, 3, 1)
    }
}
