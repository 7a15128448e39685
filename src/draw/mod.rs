//! What a frame shows and how it is recorded: one file for each thing drawn, one for each shader.
//!
//! Nothing here knows what it draws to or when: a host (`host::headless` so far) brings a target, the eyes and the maps.

pub mod camera;
mod clouds;
mod daylight;
mod debug_view;
mod foam_pattern;
mod moment;
mod ocean;
mod renderer;
mod sea_textures;
mod sky;
mod sky_map;
mod sky_picture;
mod solids;
mod uniforms;

pub use camera::{Eye, Fov, eyes};
pub use debug_view::Look;
pub use moment::Moment;
pub use ocean::DrawCounts;
pub use renderer::{DrawError, Renderer};
pub use sky_map::SkyMap;
pub use sky_picture::SkyError;
pub use solids::{MOST_SOLIDS, Shape, Solid};

/// SPIR-V and reflection, written by build.rs.
pub mod shaders {
    use crate::gpu::BindingKind;
    include!(concat!(env!("OUT_DIR"), "/shaders.rs"));
}
