//! Swell: an ocean simulated on the CPU and drawn with Vulkan, made for standalone VR headsets.
//!
//! # Data flow
//! ```text
//! scene file -> Scene -> sea: spectrum (once) -> every frame: evolve -> FFT -> displacement -> gradient -> mips
//!                                                                                            |
//!                        lod: quadtree -> stitched patches, culled                           v
//!                                               \-> draw: one pass on gpu <- double-buffered maps
//!                                                                                            |
//!                        eyes in the world <- raft: rider <- heave, pitch, roll <- height query
//! ```
//! The sea of frame n + 1 is simulated on worker threads while frame n is drawn.
//!
//! # Conventions
//! Right-handed, Y up, -Z forward; metres, seconds, radians. See `docs/conventions.md`.
//!
//! # Layers
//! Imports run downwards only: `host` -> `draw` -> `gpu`; `draw` -> `lod`, `sea`, `scene`, `raft`; `scene` -> `raft` -> `sea`.
//! `host` -> `panel` -> `scene`, `sea`, `output`.
//! `sea`, `lod`, `raft` and `scene` know nothing of Vulkan or windows.
#![warn(missing_docs)]

#[cfg(not(target_os = "android"))]
pub mod commands;
pub mod draw;
pub mod gpu;
pub mod host;
pub mod jobs;
pub mod lod;
pub mod output;
pub mod panel;
pub mod raft;
pub mod scene;
pub mod sea;
pub mod xr;
