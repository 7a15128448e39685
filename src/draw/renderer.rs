//! One frame: the maps uploaded, the sea and the sky drawn in one pass. Hosts decide when, from where and into what.

use super::camera;
use super::counts::DrawCounts;
use super::debug_view::Look;
use super::descriptors::Shared;
use super::error::DrawError;
use super::hidden_area::{HiddenArea, HiddenMesh};
use super::moment::Moment;
use super::motion::Motion;
use super::ocean::Ocean;
use super::sea_stages::SeaStages;
use super::sea_textures::SeaTextures;
use super::shaders::BINDINGS;
use super::shadow::Shadow;
use super::sky::Sky;
use super::sky_map::SkyMap;
use super::solids::{Solids, Uploaded};
use super::uniforms::{Constant, Frame, Spacing};
use super::vignette::Vignette;
use super::waves::Waves;
use crate::gpu::{Bindings, Device, FRAMES_IN_FLIGHT, Pass, Recorder, Target, Turn, UploadRing};
use crate::lod::{Frustum, LodSettings, Quadtree, Quality, vertex_spacing};
use crate::scene::{Scene, Shadows};
use glam::DVec3;
use std::sync::Arc;

/// Room for instances: some ten times what the largest tree draws.
const MOST_PATCHES: usize = 4096;

/// Where the frame recorded last has put things in the ring.
struct Latest {
    slot: usize,
    /// Of each uniform block.
    uniforms: [u32; 2],
    instances: u64,
    solids: Uploaded,
    solids_before: Option<u64>,
    /// The frame before is known, so that things can have moved.
    looks_back: bool,
}

/// Everything a scene needs to be drawn into targets of one kind.
pub struct Renderer {
    hidden_area: HiddenArea,
    solids: Option<Solids>,
    ocean: Ocean,
    sky: Option<Sky>,
    vignette: Option<Vignette>,
    motion: Option<Motion>,
    shadow: Option<Shadow>,
    latest: Option<Latest>,
    stages: SeaStages,
    /// Where the stages look at them.
    waves: Option<Waves>,
    look: Look,
    tree: Quadtree,
    frusta: Vec<Frustum>,
    still: Frame,
    constant: Constant,
    ring: UploadRing,
    uniform_align: u64,
    textures: Vec<SeaTextures>,
    bindings: Bindings,
    /// Kept for the descriptor sets, which refer to them.
    _shared: Shared,
}

impl Renderer {
    /// Makes textures, meshes and pipelines for `scene`, seen as `look`, in targets of `pass`.
    ///
    /// # Errors
    /// Out of device memory, or the device cannot draw this look.
    pub fn new(
        device: &Arc<Device>,
        pass: &Pass,
        scene: &Scene,
        sky_map: &SkyMap,
        look: Look,
    ) -> Result<Self, DrawError> {
        let stages = SeaStages::of(scene);
        let cascades = &scene.sea.cascades[..stages.cascades];
        let tree = Quadtree::new(&scene.lod)?;
        let spacing = spacing(&tree);
        let still = Frame::still(scene, sky_map, scene.sea.expected_rms_height(), spacing);
        let limits = &device.physical.limits;
        let uniform_align = limits.min_uniform_buffer_offset_alignment.max(16);
        let waves = stages.use_waves().then(|| Waves::new(scene));
        // Patches that are seen, and where there are shadows those that cast them.
        let surfaces = if scene.water.shadows.shadows == Shadows::Off { 1 } else { 2 };
        let share = SeaTextures::bytes(cascades)
            + surfaces * Ocean::instance_bytes(MOST_PATCHES)
            + 2 * Solids::BYTES
            + (size_of::<Frame>() + size_of::<Waves>()) as u64
            + 2 * uniform_align
            + 1024;
        let ring = UploadRing::new(device, FRAMES_IN_FLIGHT as u64, share)?;
        let bindings = Bindings::new(device, BINDINGS, FRAMES_IN_FLIGHT)?;
        let hidden_area = HiddenArea::new(device, pass, &bindings)?;
        let solids = if look.has_solids() { Some(Solids::new(device, pass, &bindings)?) } else { None };
        let shadow = Shadow::new(device, pass, &bindings, scene, sky_map, look)?;
        let layers = if shadow.is_some() { Vec::new() } else { look.layers(stages) };
        let ocean = Ocean::new(device, pass, &bindings, &scene.lod, stages, &layers)?;
        let sky = if look.has_sky() { Some(Sky::new(device, pass, &bindings)?) } else { None };
        let vignette = if look.has_vignette() { Some(Vignette::new(device, pass, &bindings)?) } else { None };
        let shared = Shared::new(device, sky_map)?;
        let textures = (0..FRAMES_IN_FLIGHT)
            .map(|_| SeaTextures::new(device, cascades))
            .collect::<Result<Vec<_>, _>>()?;
        shared.bind(&bindings, &ring, &textures, shadow.as_ref());
        Ok(Self {
            hidden_area,
            solids,
            ocean,
            sky,
            vignette,
            motion: None,
            shadow,
            latest: None,
            stages,
            waves,
            look,
            tree,
            frusta: Vec::with_capacity(2),
            still,
            constant: Constant { growth: spacing.per_metre, detail: scene.water.detail },
            ring,
            uniform_align,
            textures,
            bindings,
            _shared: shared,
        })
    }

    /// Records one frame of `moment` into the images whose `turn` it is. `slot` is the frame in flight whose last use has
    /// ended.
    ///
    /// # Errors
    /// The upload ring is too small, which means that the maps are not the scene's.
    pub fn record(
        &mut self,
        commands: Recorder<'_>,
        target: &Target,
        turn: Turn,
        slot: usize,
        moment: Moment<'_>,
    ) -> Result<DrawCounts, DrawError> {
        let eyes = moment.eyes;
        let head = camera::head(eyes);
        self.frusta.clear();
        self.frusta.extend(eyes.iter().map(|eye| eye.frustum(head)));
        let selection = self.tree.select(head, &self.frusta);
        self.ring.begin(slot as u64);
        let origin = DVec3::new(selection.origin().x, 0.0, selection.origin().y);
        self.still.turn(moment, origin, self.constant);
        if let Some(shadow) = &mut self.shadow {
            self.still.cast(shadow.fit(moment, head).uniforms(origin));
        }
        self.latest = None;
        let before = self.motion.as_ref().and_then(|motion| motion.before(slot));
        self.still.look_back(before.map_or(eyes, |before| before.eyes), origin);
        let mut uniforms = [self.ring.push(bytemuck::bytes_of(&self.still), self.uniform_align)?, 0];
        if let Some(waves) = &mut self.waves {
            waves.turn(moment.maps, before.map(|before| before.time), origin, self.constant.growth);
            uniforms[1] = self.ring.push(bytemuck::bytes_of(waves), self.uniform_align)?;
        }
        self.textures[slot].upload(commands, &mut self.ring, moment.maps)?;
        let instances = Ocean::upload(&mut self.ring, selection)?;
        let casters = self.shadow.as_ref().map(|own| own.upload(&mut self.ring)).transpose()?;
        let (mut solids, mut solids_before) = (Uploaded::default(), None);
        if let Some(own) = &mut self.solids {
            solids = own.upload(&mut self.ring, moment.solids, origin)?;
            if let Some(before) = before {
                let offset = own.upload_before(&mut self.ring, moment.solids, before.solids, origin)?;
                solids_before = Some(offset);
            }
        }
        let uniforms = uniforms.map(|offset| u32::try_from(offset).unwrap_or(u32::MAX));
        let looks_back = before.is_some();
        let mut counts = DrawCounts::default();
        if let (Some(shadow), Some(casters)) = (&self.shadow, casters) {
            // A pass of several views forgets what was bound before it: both passes bind.
            self.bindings.bind(commands, slot, &uniforms);
            let floating = (self.solids.as_ref(), &solids);
            counts += shadow.draw(commands, &self.ring, (&self.ocean, casters), floating);
        }
        target.begin(commands, turn, self.look.clear());
        self.bindings.bind(commands, slot, &uniforms);
        counts += self.hidden_area.draw(commands);
        if let Some(own) = &self.solids {
            let lit = self.shadow.as_ref().map_or(own.pipeline(), |shadow| &shadow.solids);
            counts += own.draw_with(lit, commands, &self.ring, &solids);
        }
        counts += match &self.shadow {
            Some(shadow) => {
                self.ocean.draw_with(&shadow.surface, commands, (&self.ring, instances), selection)
            }
            None => self.ocean.draw(commands, &self.ring, instances, selection),
        };
        if let Some(sky) = &self.sky {
            counts += sky.draw(commands);
        }
        if let Some(vignette) = self.vignette.as_ref().filter(|_| moment.vignette > 0.0) {
            counts += vignette.draw(commands);
        }
        target.end(commands);
        if let Some(motion) = &mut self.motion {
            motion.remember(slot, moment);
        }
        self.latest = Some(Latest { slot, uniforms, instances, solids, solids_before, looks_back });
        Ok(counts)
    }

    /// Makes what [`Self::record_motion`] needs to draw into targets of `pass`: one sample, four signed 16-bit floats,
    /// as many views as the frames have.
    ///
    /// # Errors
    /// Out of memory, or the driver refuses.
    pub fn prepare_motion(&mut self, device: &Arc<Device>, pass: &Pass) -> Result<(), DrawError> {
        self.motion = Some(Motion::new(device, pass, &self.bindings, self.stages)?);
        self.latest = None;
        Ok(())
    }

    /// Records the motion vectors of the frame recorded last, after it and in the same commands, into the images of a
    /// `target` of any size whose `turn` it is: normalised device coordinates (y down, depth reversed) now less those in the frame before, in x, y and z;
    /// 1 in w. All zero where no frame was recorded before, or not in the other slot.
    ///
    /// # Errors
    /// No frame was recorded since [`Self::prepare_motion`].
    pub fn record_motion(
        &self,
        commands: Recorder<'_>,
        target: &Target,
        turn: Turn,
    ) -> Result<DrawCounts, DrawError> {
        let (Some(motion), Some(latest)) = (&self.motion, &self.latest) else {
            return Err(DrawError::NoMotion);
        };
        let mut counts = DrawCounts::default();
        target.begin(commands, turn, [0.0; 4]);
        if latest.looks_back {
            self.bindings.bind(commands, latest.slot, &latest.uniforms);
            if let (Some(solids), Some(before)) = (&self.solids, latest.solids_before) {
                commands.vertex_buffer(2, self.ring.buffer(), before);
                counts += solids.draw_with(&motion.solids, commands, &self.ring, &latest.solids);
            }
            let instances = (&self.ring, latest.instances);
            let selection = self.tree.selection();
            counts += self.ocean.draw_with(&motion.surface, commands, instances, selection);
            counts += motion.draw_sky(commands);
        }
        target.end(commands);
        Ok(counts)
    }

    /// Hides each view's `meshes` from the next frame on; empty ones hide nothing. Call it between frames: it waits for
    /// those that were submitted.
    ///
    /// # Errors
    /// Indices that are no triangles of the vertices, or out of memory.
    pub fn set_hidden_area(
        &mut self,
        device: &Arc<Device>,
        meshes: [HiddenMesh<'_>; 2],
    ) -> Result<(), DrawError> {
        self.hidden_area.set(device, meshes)
    }

    /// Draws `scene`, which is the one it was made for, with another preset of the quadtree from the next frame on. Call it
    /// between frames that have ended.
    ///
    /// # Errors
    /// Out of memory.
    pub fn set_quality(
        &mut self,
        device: &Arc<Device>,
        scene: &Scene,
        quality: Quality,
    ) -> Result<(), DrawError> {
        let settings = LodSettings { quality, ..scene.lod };
        let tree = Quadtree::new(&settings)?;
        self.ocean.set_meshes(device, &settings)?;
        if let Some(shadow) = &mut self.shadow {
            shadow.set_lod(&settings)?;
        }
        let spacing = spacing(&tree);
        self.still.set_lod(scene, spacing);
        self.constant.growth = spacing.per_metre;
        (self.tree, self.latest) = (tree, None);
        Ok(())
    }

    /// Draws `scene`, which differs from the one it was made for in colours and exposure alone, from the next frame on.
    /// `rms_height` is its sea's, metres.
    pub fn repaint(&mut self, scene: &Scene, sky_map: &SkyMap, rms_height: f64) {
        self.still = Frame::still(scene, sky_map, rms_height, spacing(&self.tree));
        self.constant.detail = scene.water.detail;
    }

    /// Bytes uploaded by the latest frame.
    pub const fn uploaded(&self) -> u64 {
        self.ring.used()
    }
}

/// How far apart the vertices of `tree` are.
fn spacing(tree: &Quadtree) -> Spacing {
    Spacing {
        per_metre: vertex_spacing(1.0, tree.preset(), 0.0, f64::INFINITY),
        finest: tree.finest_spacing(),
        coarsest: tree.coarsest_spacing(),
    }
}
