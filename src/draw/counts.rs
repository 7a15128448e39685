//! What a frame took to draw.

use std::ops::AddAssign;

/// Counted while recording, over everything that a frame draws.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DrawCounts {
    /// Draw calls.
    pub draws: u32,
    /// The sea's patches.
    pub patches: u32,
    /// Triangles, for each view.
    pub triangles: u32,
    /// Vertices for each view, each mesh's counted once an instance; a device that forgets some shades them again.
    pub vertices: u32,
}

impl DrawCounts {
    /// One draw call of `instances` meshes.
    pub(super) const fn draw(triangles: u32, vertices: u32, instances: u32) -> Self {
        Self { draws: 1, patches: 0, triangles: triangles * instances, vertices: vertices * instances }
    }
}

impl AddAssign for DrawCounts {
    fn add_assign(&mut self, other: Self) {
        self.draws += other.draws;
        self.patches += other.patches;
        self.triangles += other.triangles;
        self.vertices += other.vertices;
    }
}
