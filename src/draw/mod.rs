//! What a frame shows and how it is recorded: one file for each thing drawn, one for each shader.
//!
//! Nothing here knows what it draws to or when: a host (`host::headless` so far) brings a target, the eyes and the maps.

mod buoy;
pub mod camera;
mod clouds;
mod counts;
mod daylight;
mod debug_view;
mod descriptors;
mod error;
mod foam_pattern;
mod hands;
mod hidden_area;
mod moment;
mod motion;
mod ocean;
mod overlay;
mod patch_grid;
mod raft;
mod renderer;
mod sea_stages;
mod sea_textures;
#[cfg(not(target_os = "android"))]
mod shader_reload;
mod shadow;
mod sky;
mod sky_map;
mod sky_picture;
mod solid_meshes;
mod solids;
mod sun_map;
mod uniforms;
mod vertex_input;
mod vignette;
mod waves;
#[cfg(not(target_os = "android"))]
mod wgsl;

pub use buoy::{BUOY_SOLIDS, Buoy};
pub use camera::{Eye, Fov, NEAR, eyes};
pub use counts::DrawCounts;
pub use debug_view::Look;
pub use error::DrawError;
pub use hands::{HAND_SOLIDS, Hand, hand, joint, ray};
pub use hidden_area::HiddenMesh;
pub use moment::Moment;
pub use overlay::{Painting, Panel};
pub use raft::{RAFT_SOLIDS, Raft};
pub use renderer::Renderer;
pub use sea_textures::SeaTextures;
#[cfg(not(target_os = "android"))]
pub use shader_reload::compile_shaders;
pub use sky_map::SkyMap;
pub use sky_picture::SkyError;
pub use solids::{MOST_SOLIDS, Pose, Shape, Solid};
pub use waves::Waves;

/// SPIR-V and reflection, written by build.rs.
pub mod shaders {
    use crate::gpu::BindingKind;
    include!(concat!(env!("OUT_DIR"), "/shaders.rs"));
}
