//! The comfort vignette: darkness that closes in while the viewer is moved, against sickness.
//!
//! It is a circle about each view's axis, not about the picture's middle: with two eyes that look the same way the two
//! circles are one. Only the rim has triangles, so that a tiled GPU blends nothing in the middle.

use super::camera::{Eye, Fov};
use super::counts::DrawCounts;
use super::shaders;
use crate::gpu::{
    Bindings, Blend, DepthUse, Device, GpuError, Pass, Pipeline, PipelineInfo, Recorder, VertexInput,
};
use glam::Vec4;
use std::sync::Arc;

/// Twin: `shaders/vignette.wgsl`. Quads around each of the two rings.
const SEGMENTS: u32 = 64;
/// Half the angle that stays clear when it is fully closed, radians.
const CLOSED: f32 = 0.35;
/// From clear to black, radians.
const WIDTH: f32 = 0.24;
/// No ring is wider, radians: tangents end at a right angle.
const WIDEST: f32 = 1.45;

/// The ring's pipeline; its vertices come from their number.
pub struct Vignette(Pipeline);

impl Vignette {
    /// Compiles it for `pass`, whose format can be blended.
    ///
    /// # Errors
    /// The driver refuses.
    pub fn new(device: &Arc<Device>, pass: &Pass, bindings: &Bindings) -> Result<Self, GpuError> {
        let info = PipelineInfo {
            name: "vignette",
            vertex: (shaders::VIGNETTE_VERTEX_MAIN, c"vertex_main"),
            fragment: (shaders::VIGNETTE_FRAGMENT_MAIN, c"fragment_main"),
            input: VertexInput::default(),
            depth: DepthUse::Ignored,
            blend: Blend::Over,
            cull: false,
            lines: false,
        };
        Ok(Self(Pipeline::new(device, pass, bindings.pipeline_layout, &info)?))
    }

    /// Draws it, after everything else, inside the pass.
    pub fn draw(&self, commands: Recorder<'_>) -> DrawCounts {
        commands.begin_label(c"vignette");
        self.0.bind(commands);
        let vertices = SEGMENTS * 2 * 6;
        commands.draw(vertices);
        commands.end_label();
        DrawCounts::draw(vertices / 3, vertices, 1)
    }
}

/// Angles (radians) where darkness begins and where it is complete, for `strength` 0..=1: it comes in from the widest
/// corner that any eye sees.
pub fn angles(eyes: &[Eye], strength: f32) -> Vec4 {
    let corner = |fov: Fov| {
        let (x, y) = (fov.left.abs().max(fov.right.abs()), fov.up.abs().max(fov.down.abs()));
        x.hypot(y).atan()
    };
    let widest = eyes.iter().map(|eye| corner(eye.fov)).fold(CLOSED, f32::max);
    let begin = (widest + (CLOSED - widest) * strength.clamp(0.0, 1.0)).min(WIDEST - WIDTH);
    Vec4::new(begin, begin + WIDTH, 0.0, 0.0)
}
