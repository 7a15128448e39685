//! Shadows: the pass that draws the sun's map, and the pipelines that look at it: docs/shadows.md. A scene without shadows
//! has neither, and no map.

use super::counts::DrawCounts;
use super::debug_view::Look;
use super::error::DrawError;
use super::moment::Moment;
use super::ocean::{self, Layer, Ocean};
use super::sea_stages::SeaStages;
use super::shaders as s;
use super::sky_map::SkyMap;
use super::solids::{self, Solids, Uploaded};
use super::sun_map::Fit;
use crate::gpu::{
    Bindings, Blend, DepthInfo, DepthMap, DepthUse, Device, GpuError, Pass, Pipeline, PipelineInfo, Recorder,
    Sampler, UploadRing,
};
use crate::lod::{LodError, LodSettings, Quadtree};
use crate::scene::{Scene, ShadowSettings, Shadows};
use glam::{DVec3, Vec3};
use std::sync::Arc;

/// Constant in steps of the map's depth, and by slope. Three texels by three are looked at: a plane is higher there by at most
/// what it rises over a texel and a half along either side, so 3 times the larger slope.
const LOWERED: [f32; 2] = [2.0, 3.0];

/// The sun's map, who draws it and who looks at it.
pub struct Shadow {
    /// Patches and skirt where shadows fall. The skirt begins beyond any shadow.
    pub surface: [Pipeline; 2],
    /// Solids where shadows fall.
    pub solids: Pipeline,
    /// What is looked into.
    pub map: DepthMap,
    /// What looks.
    pub sampler: Sampler,
    cast_patches: Pipeline,
    cast_solids: Pipeline,
    /// Chooses the patches that cast, from the same levels as the ones that are seen: both are one surface.
    tree: Quadtree,
    settings: ShadowSettings,
    sun: Vec3,
    max_height: f64,
}

impl Shadow {
    /// What shadows need in `pass`; nothing where `scene` has none, or `look` shows none.
    ///
    /// # Errors
    /// Out of memory, or the driver refuses.
    pub fn new(
        device: &Arc<Device>,
        pass: &Pass,
        bindings: &Bindings,
        scene: &Scene,
        sky: &SkyMap,
        look: Look,
    ) -> Result<Option<Self>, DrawError> {
        let settings = scene.water.shadows;
        if settings.shadows == Shadows::Off || !look.has_solids() || sky.sun_light == Vec3::ZERO {
            return Ok(None);
        }
        let stages = SeaStages::of(scene);
        let map = DepthMap::new(device, "sun's map", settings.resolution)?;
        let cast = |name, vertex, input| {
            let info = DepthInfo { name, vertex, input, lowered: LOWERED };
            Pipeline::depth_only(device, &map, bindings.pipeline_layout, &info)
        };
        let lit = Layer { fragment: stages.shadowed_water(), entry: c"water_main", lines: false };
        let beyond = Layer { fragment: stages.water(), entry: c"fragment_main", lines: false };
        let patches = (stages.shadowed_patch(), c"patch_main");
        let skirt = (stages.skirt(), c"vertex_main");
        let solids = PipelineInfo {
            name: "solids in shadow",
            vertex: (s::SHADOWED_SOLID_MAIN, c"solid_main"),
            fragment: (s::SHADOWED_MATT_MAIN, c"matt_main"),
            input: solids::INPUT,
            depth: DepthUse::Solid,
            blend: Blend::Opaque,
            cull: true,
            lines: false,
        };
        Ok(Some(Self {
            surface: [
                ocean::patches(device, pass, bindings, patches, &lit)?,
                ocean::skirt(device, pass, bindings, skirt, &beyond)?,
            ],
            solids: Pipeline::new(device, pass, bindings.pipeline_layout, &solids)?,
            sampler: Sampler::comparing(device, "sun's map")?,
            cast_patches: cast(
                "patches' shadows",
                (stages.sun_map_patch(), c"patch_main"),
                ocean::PATCH_INPUT,
            )?,
            cast_solids: cast("solids' shadows", (s::SUN_MAP_SOLID_MAIN, c"solid_main"), solids::INPUT)?,
            map,
            tree: Quadtree::new(&scene.lod)?,
            settings,
            sun: sky.sun,
            max_height: scene.lod.height_bound(),
        }))
    }

    /// The map for `moment`, and the patches that cast into it chosen for `head`.
    pub fn fit(&mut self, moment: Moment<'_>, head: DVec3) -> Fit {
        let fit = Fit::new(&self.settings, self.sun, self.max_height, moment.eyes, moment.solids);
        self.tree.select(head, &[fit.frustum(head)]);
        fit
    }

    /// Copies the chosen patches to the ring and returns their offset.
    ///
    /// # Errors
    /// The ring is full.
    pub fn upload(&self, ring: &mut UploadRing) -> Result<u64, GpuError> {
        Ocean::upload(ring, self.tree.selection())
    }

    /// Draws the map in its own pass: the patches at `instances` in the ring, and the solids uploaded there. Uniforms are bound.
    pub fn draw(
        &self,
        commands: Recorder<'_>,
        ring: &UploadRing,
        (ocean, instances): (&Ocean, u64),
        (solids, uploaded): (Option<&Solids>, &Uploaded),
    ) -> DrawCounts {
        commands.begin_label(c"shadows");
        self.map.begin(commands);
        let patches = (ring, instances);
        let mut counts = ocean.draw_patches(&self.cast_patches, commands, patches, self.tree.selection());
        if let Some(solids) = solids {
            counts += solids.draw_with(&self.cast_solids, commands, ring, uploaded);
        }
        self.map.end(commands);
        commands.end_label();
        counts
    }

    /// Another preset of the quadtree.
    ///
    /// # Errors
    /// A setting out of its range.
    pub fn set_lod(&mut self, settings: &LodSettings) -> Result<(), LodError> {
        self.tree = Quadtree::new(settings)?;
        Ok(())
    }
}
