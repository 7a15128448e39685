//! Density by the wave signal: vertices where waves move the surface, and none where they do not.
//!
//! ```text
//! Signal -> highest frequency that displaces enough -> Density: a real factor for an edge -> Factor: 2^l segments, weight
//!                                                      Leaf, its four edges and its inside -> pieces of the Mesh
//! ```
//! What a hardware tessellator would do, on the CPU: headsets and naga have no such stages. An edge's factor is a function
//! of the edge alone, so the patches on both sides agree. `docs/tessellation.md` gives the reasons.
mod factor;
mod mesh;
mod plan;
mod signal;

pub use factor::{Density, Factor, Side};
pub use mesh::{Mesh, Pieces, SCALE, Vertex, Weight, vertex_position};
pub use signal::{Component, Signal};

pub(super) use plan::{MOST_PIECES, Plan};

use super::LodError;
use super::error::check_range;

/// How the density of a patch's grid is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Tessellation {
    /// The same grid for every patch.
    #[default]
    Grid,
    /// By the wave signal.
    Signal(SignalSettings),
}

/// What an edge's factor is made of: max(1, 2 f |p1 - p2| S_F S_D S).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignalSettings {
    /// f, the highest frequency that displaces enough, 1/m: [`Signal::highest_frequency`]. 0 is a flat sea.
    pub frequency: f64,
    /// S, a factor on every density: 1 samples the highest frequency twice a wave.
    pub density: f64,
    /// Least and largest S_F, 0..=1: what (1 - cos)^5 of the angle between view and vertical is held to.
    pub fresnel: [f64; 2],
    /// Distances, metres, between which S_D falls from 1 to 0.
    pub distance: [f64; 2],
}

impl SignalSettings {
    /// Distance between vertices, metres, where nothing lessens the density; infinite for a flat sea.
    pub fn finest_spacing(&self) -> f64 {
        1.0 / (2.0 * self.frequency * self.density * self.fresnel[1])
    }

    /// Every value in its range.
    ///
    /// # Errors
    /// [`LodError::OutOfRange`] for the first one that is not.
    pub fn check(&self) -> Result<(), LodError> {
        let ([least, most], [near, far]) = (self.fresnel, self.distance);
        check_range("frequency", self.frequency, 0.0, 1.0e4)?;
        check_range("density", self.density, 0.0, 1.0e3)?;
        check_range("least fresnel", least, 0.0, 1.0)?;
        check_range("largest fresnel", most, least, 1.0)?;
        check_range("near distance", near, 0.0, 1.0e6)?;
        check_range("far distance", far, near.next_up(), 1.0e6)
    }
}
