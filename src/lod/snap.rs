//! The quadtree follows the viewer in whole steps, so that its vertices stay where they are in the world.
use glam::{DVec2, DVec3};

/// Step of the quadtree's origin, metres: delta = S / (2 V), eq (69), the spacing of level 1's vertices.
///
/// Vertices of every level >= 1 stay in place when the origin moves by it.
pub fn snap_step(size: f64, cells: u32) -> f64 {
    size / (2.0 * f64::from(cells))
}

/// World (x, z) of the quadtree's centre for a viewer at `eye`, eq (69): at most one step to the west and south of it.
pub fn snap_origin(eye: DVec3, size: f64, cells: u32) -> DVec2 {
    let step = snap_step(size, cells);
    (DVec2::new(eye.x, eye.z) / step).floor() * step
}
