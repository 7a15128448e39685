//! How far apart drawn vertices are at a distance: which waves the mesh can carry there.
use super::Preset;
use std::f64::consts::FRAC_1_SQRT_2;

/// Largest value of (1 + m) / (1 + t) while a slide of weight m = smoothstep(t) stretches every second cell.
const STRETCH: f64 = 1.06;

/// Distance between neighbouring drawn vertices, metres, at rest points `distance` metres from the viewer: a close
/// estimate, to choose the mip of the displacement by.
///
/// distance / (V max(tau - 1/2, 1)), within `finest..=coarsest` (see [`super::Quadtree::finest_spacing`]): tau - 1/2 is
/// where an undivided node seen across its side begins, in sides; balance keeps the mesh of the presets below
/// tau = 1.5 as fine as that of 1.5. Measured over random viewers, at most 3 % of the drawn edges extend further. It
/// depends on nothing but the distance, so patches agree at the vertices they share; it never falls with distance.
pub fn vertex_spacing(distance: f64, preset: Preset, finest: f64, coarsest: f64) -> f64 {
    let slope = 1.0 / (f64::from(preset.cells) * (preset.lod_scale - 0.5).max(1.0));
    (distance * slope).max(finest).min(coarsest)
}

/// The same, exceeded by no drawn edge's extent along the grid's axis: for a mesh that must nowhere be coarser than its
/// waves. (Beside a border whose vertices slide by another weight edges are skewed, and somewhat longer than that.)
///
/// A point of an undivided node of side s lies within s / sqrt(2) of its centre, hence s <= distance / (tau -
/// 1/sqrt(2)). A node whose vertices have slid by m has cells up to 1 + m times as long; its parent's q then grows with
/// the distance so that the product stays below 1.06 times the same. At tau = 1 it is 3.6 times [`vertex_spacing`]: few
/// nodes are seen corner on.
pub fn vertex_spacing_bound(distance: f64, preset: Preset, finest: f64, coarsest: f64) -> f64 {
    let nearest = preset.lod_scale - FRAC_1_SQRT_2;
    if nearest <= 0.0 {
        return coarsest;
    }
    (distance * STRETCH / (f64::from(preset.cells) * nearest)).max(finest).min(coarsest)
}
