//! Which stages draw the sea of a scene: build.rs compiles them for each kind of sea and number of cascades.

use super::shaders as s;
use crate::scene::{Scene, Shading};

/// SPIR-V of a stage for 1 to 4 cascades, and with formulas for 0 to 4.
type Variants = (&'static [&'static [u8]; 4], &'static [&'static [u8]; 5]);

/// A kind of sea.
#[derive(Clone, Copy, Debug)]
pub struct SeaStages {
    /// Some of its waves are formulas.
    pub analytic: bool,
    /// Cascades that are drawn: none where formulas are all there is.
    pub cascades: usize,
    /// How water looks.
    pub shading: Shading,
}

impl SeaStages {
    /// What `scene` needs, and no more.
    pub fn of(scene: &Scene) -> Self {
        let sea = &scene.sea;
        let cascades = if sea.spectral { sea.cascades.len() } else { 0 };
        let analytic = cascades == 0 || !sea.models.is_empty();
        Self { analytic, cascades, shading: scene.water.shading }
    }

    const fn choose(self, (plain, analytic): Variants) -> &'static [u8] {
        if self.analytic { analytic[self.cascades] } else { plain[self.cascades - 1] }
    }

    /// Vertices of patches.
    pub const fn patch(self) -> &'static [u8] {
        self.choose((&s::OCEAN_VERTEX_MAIN, &s::ANALYTIC_OCEAN_VERTEX_MAIN))
    }

    /// Vertices of the skirt.
    pub const fn skirt(self) -> &'static [u8] {
        self.choose((&s::SKIRT_VERTEX_MAIN, &s::ANALYTIC_SKIRT_VERTEX_MAIN))
    }

    /// Vertices of patches in the motion pass.
    pub const fn patch_motion(self) -> &'static [u8] {
        self.choose((&s::MOTION_PATCH_MAIN, &s::ANALYTIC_MOTION_PATCH_MAIN))
    }

    /// Pixels of water.
    pub const fn water(self) -> &'static [u8] {
        self.choose(match self.shading {
            Shading::Physical => (&s::OCEAN_FRAGMENT_MAIN, &s::ANALYTIC_OCEAN_FRAGMENT_MAIN),
            Shading::BlinnPhong => (&s::PHONG_OCEAN_FRAGMENT_MAIN, &s::ANALYTIC_PHONG_OCEAN_FRAGMENT_MAIN),
        })
    }

    /// Vertices of patches where shadows fall.
    pub const fn shadowed_patch(self) -> &'static [u8] {
        self.choose((&s::SHADOWED_PATCH_MAIN, &s::ANALYTIC_SHADOWED_PATCH_MAIN))
    }

    /// Pixels of water where shadows fall.
    pub const fn shadowed_water(self) -> &'static [u8] {
        self.choose(match self.shading {
            Shading::Physical => (&s::SHADOWED_WATER_MAIN, &s::ANALYTIC_SHADOWED_WATER_MAIN),
            Shading::BlinnPhong => (&s::PHONG_SHADOWED_WATER_MAIN, &s::ANALYTIC_PHONG_SHADOWED_WATER_MAIN),
        })
    }

    /// Vertices of patches that cast shadows.
    pub const fn sun_map_patch(self) -> &'static [u8] {
        self.choose((&s::SUN_MAP_PATCH_MAIN, &s::ANALYTIC_SUN_MAP_PATCH_MAIN))
    }

    /// Whether the block of [`super::waves`] is looked at.
    pub fn use_waves(self) -> bool {
        self.analytic || self.shading == Shading::BlinnPhong
    }

    /// Pixels coloured by level.
    pub const fn lod(self) -> &'static [u8] {
        self.choose((&s::DEBUG_LOD_MAIN, &s::ANALYTIC_DEBUG_LOD_MAIN))
    }

    /// Normals as colours.
    pub const fn normal(self) -> &'static [u8] {
        self.choose((&s::DEBUG_NORMAL_MAIN, &s::ANALYTIC_DEBUG_NORMAL_MAIN))
    }

    /// Compression as a colour.
    pub const fn jacobian(self) -> &'static [u8] {
        self.choose((&s::DEBUG_JACOBIAN_MAIN, &s::ANALYTIC_DEBUG_JACOBIAN_MAIN))
    }
}
