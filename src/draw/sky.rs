//! The sky behind everything.

use super::counts::DrawCounts;
use super::shaders;
use crate::gpu::{
    Bindings, Blend, DepthUse, Device, GpuError, Pass, Pipeline, PipelineInfo, Recorder, VertexInput,
};
use std::sync::Arc;

/// The sky's pipeline; its light is in the cube texture.
pub struct Sky(Pipeline);

impl Sky {
    /// Compiles it for `pass`.
    ///
    /// # Errors
    /// The driver refuses.
    pub fn new(device: &Arc<Device>, pass: &Pass, bindings: &Bindings) -> Result<Self, GpuError> {
        let info = PipelineInfo {
            name: "sky",
            vertex: (shaders::SKY_VERTEX_MAIN, c"vertex_main"),
            fragment: (shaders::SKY_FRAGMENT_MAIN, c"fragment_main"),
            input: VertexInput::default(),
            depth: DepthUse::Background,
            blend: Blend::Opaque,
            cull: false,
            lines: false,
        };
        Ok(Self(Pipeline::new(device, pass, bindings.pipeline_layout, &info)?))
    }

    /// Draws it, last, inside the pass.
    pub fn draw(&self, commands: Recorder<'_>) -> DrawCounts {
        commands.begin_label(c"sky");
        self.0.bind(commands);
        commands.draw(3);
        commands.end_label();
        DrawCounts::draw(1, 3, 1)
    }
}
