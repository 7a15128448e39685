//! What a step of the sea leaves behind: the maps that are uploaded, baked and asked for heights.
use super::{
    mips::{mip_levels, mip_offset},
    settings::{CascadeSettings, FoamSettings},
};
use half::f16;

/// The maps of one cascade. Grid point (i, j) is at index j N + i, at u = i L/N, v = j L/N.
#[derive(Clone, Debug, PartialEq)]
pub struct CascadeMaps {
    /// N.
    pub resolution: usize,
    /// L, metres.
    pub patch_size: f64,
    /// Angle of the axes u and v, radians, see `docs/conventions.md`.
    pub rotation: f64,
    /// (Du, h, Dv, compression), metres and a ratio 0..=2: the whole mip chain.
    pub displacement: Vec<[f16; 4]>,
    /// (n_u, n_v, J, smoothness), eqs (50)(51): the whole mip chain.
    pub gradient: Vec<[u8; 4]>,
    /// Displacement along u at full precision, metres, N x N.
    pub du: Vec<f32>,
    /// Height at full precision, metres, N x N.
    pub height: Vec<f32>,
    /// Displacement along v at full precision, metres, N x N.
    pub dv: Vec<f32>,
}

impl CascadeMaps {
    /// Flat maps for a cascade.
    pub fn new(cascade: &CascadeSettings) -> Self {
        let n = cascade.resolution;
        let chain = mip_offset(n, mip_levels(n));
        Self {
            resolution: n,
            patch_size: cascade.patch_size,
            rotation: cascade.rotation,
            displacement: vec![[f16::ZERO; 4]; chain],
            gradient: vec![[0; 4]; chain],
            du: vec![0.0; n * n],
            height: vec![0.0; n * n],
            dv: vec![0.0; n * n],
        }
    }
}

/// The maps of a whole sea at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct SeaMaps {
    /// Time of the step that filled them, seconds.
    pub time: f64,
    /// How compression becomes foam.
    pub foam: FoamSettings,
    /// One per cascade; their displacements add up.
    pub cascades: Vec<CascadeMaps>,
}
