//! What a step of the sea leaves behind: the maps that are uploaded, baked and asked for heights.
use super::{
    mips::{mip_levels, mip_offset},
    settings::{CascadeSettings, FoamSettings},
    simd::Aligned,
    waves::Model,
};
use half::f16;
use std::sync::Arc;

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
    pub displacement: Aligned<[f16; 4]>,
    /// (n_u, n_v, J, smoothness), eqs (50)(51): the whole mip chain.
    pub gradient: Aligned<[u8; 4]>,
    /// The displacement at full precision, where it is wanted: frames do without.
    pub planes: Option<Planes>,
}

/// Displacement at full precision, each plane N x N, metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Planes {
    /// Along u.
    pub du: Vec<f32>,
    /// Height.
    pub height: Vec<f32>,
    /// Along v.
    pub dv: Vec<f32>,
}

impl CascadeMaps {
    /// Flat maps for a cascade, with planes or without.
    pub fn new(cascade: &CascadeSettings, planes: bool) -> Self {
        let n = cascade.resolution;
        let chain = mip_offset(n, mip_levels(n));
        let plane = vec![0.0; if planes { n * n } else { 0 }];
        Self {
            resolution: n,
            patch_size: cascade.patch_size,
            rotation: cascade.rotation,
            displacement: Aligned::zeros(chain),
            gradient: Aligned::zeros(chain),
            planes: planes.then(|| Planes { du: plane.clone(), height: plane.clone(), dv: plane }),
        }
    }

    /// Whether they are those of a grid of `n` x `n`.
    pub(super) fn fits(&self, n: usize) -> bool {
        let chain = mip_offset(n, mip_levels(n));
        let whole = |planes: &Planes| {
            [&planes.du, &planes.height, &planes.dv].iter().all(|plane| plane.len() == n * n)
        };
        self.resolution == n
            && self.displacement.len() == chain
            && self.gradient.len() == chain
            && self.planes.as_ref().is_none_or(whole)
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
    /// Formulas that are in no map; their displacements at `time` are added to those of the cascades.
    pub models: Arc<[Model]>,
}
