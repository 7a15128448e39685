//! Opaque, lit things that float on the sea.

use glam::{DVec3, Mat3, Vec3};

/// The most solids that one frame shows.
pub const MOST_SOLIDS: usize = 256;

/// A unit mesh: one metre across, centred on its origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A cube.
    Box,
    /// A ball.
    Sphere,
    /// A cylinder along y, with flat ends.
    Cylinder,
}

/// One thing of one colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// Its mesh.
    pub shape: Shape,
    /// Of its centre, world metres.
    pub position: DVec3,
    /// Columns: its own x, y and z in the world, orthonormal.
    pub axes: Mat3,
    /// Along its own axes, metres.
    pub size: Vec3,
    /// Albedo, linear Rec. 709, 0..=1.
    pub color: [f32; 3],
}
