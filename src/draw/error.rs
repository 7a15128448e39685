//! What can be wrong with a frame.

use super::solids::MOST_SOLIDS;
use crate::gpu::GpuError;
use crate::lod::LodError;

/// A frame that cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum DrawError {
    /// Vulkan or memory.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The scene's level of detail.
    #[error(transparent)]
    Lod(#[from] LodError),
    /// More than there is room for.
    #[error("{count} solids in a frame, at most {MOST_SOLIDS} are drawn")]
    TooManySolids {
        /// How many.
        count: usize,
    },
    /// A hidden area that ends in the middle of a triangle.
    #[error("a hidden area of {count} indices, a multiple of 3 is needed")]
    HiddenIndices {
        /// How many.
        count: usize,
    },
    /// A hidden area whose triangle has no such corner.
    #[error("index {index} of a hidden area is not below {vertices}, the number of its vertices")]
    HiddenIndex {
        /// The index.
        index: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A motion pass that nothing was made for.
    #[error("no motion vectors without a frame recorded since Renderer::prepare_motion")]
    NoMotion,
}
