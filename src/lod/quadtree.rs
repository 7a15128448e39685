//! The quadtree: from a viewer and its views to the patches to draw.
use super::balance::{balance, divided_per_level};
use super::select::{Bounds, View};
use super::tessellation::{Density, Pieces};
use super::{
    Frustum, LodError, LodSettings, Node, Preset, Ranges, Selection, SignalSettings, SubdivisionMap,
    Tessellation, snap_origin,
};
use glam::DVec3;

/// A quadtree over the sea around the viewer, chosen anew for every frame without allocation.
#[derive(Clone, Debug)]
pub struct Quadtree {
    size: f64,
    preset: Preset,
    bounds: Bounds,
    /// Where the wave signal chooses the density.
    signal: Option<(Pieces, SignalSettings)>,
    map: SubdivisionMap,
    selection: Selection,
    stack: Vec<Node>,
    /// The latest eye that was a number.
    eye: DVec3,
}

impl Quadtree {
    /// A tree with these settings, its memory reserved.
    ///
    /// # Errors
    /// [`LodError::OutOfRange`] for a setting outside its range.
    pub fn new(settings: &LodSettings) -> Result<Self, LodError> {
        settings.check()?;
        let preset = settings.quality.preset();
        let levels = settings.level_count();
        let widest = divided_per_level(preset.lod_scale);
        let signal = match settings.tessellation {
            Tessellation::Grid => None,
            Tessellation::Signal(signal) => Some((Pieces::new(preset.cells), signal)),
        };
        let divided: usize = (0..levels).map(|level| widest.min(1 << (2 * level))).sum();
        Ok(Self {
            size: settings.size,
            preset,
            bounds: Bounds {
                cull_scale: preset.cull_scale,
                max_height: settings.height_bound(),
                reach: settings.reach,
            },
            signal,
            map: SubdivisionMap::new(levels, divided),
            selection: Selection::with_capacity(3 * divided + 1, levels, signal.map(|(pieces, _)| pieces)),
            stack: Vec::with_capacity(3 * levels as usize + 1),
            eye: DVec3::ZERO,
        })
    }

    /// Chooses the patches for a viewer whose head is at `eye` (world metres), seen in any of `frusta`.
    ///
    /// Levels depend on `eye` alone, so both eyes of a headset see the same mesh; the frusta are relative to `eye`, and
    /// a patch is drawn when any of them keeps it. An `eye` that is not finite is replaced by the latest one that was.
    pub fn select(&mut self, eye: DVec3, frusta: &[Frustum]) -> &Selection {
        if eye.is_finite() {
            self.eye = eye;
        }
        let origin = snap_origin(self.eye, self.size, self.preset.cells);
        let eye = self.eye - DVec3::new(origin.x, 0.0, origin.y);
        let ranges = Ranges::new(eye, self.size, self.preset.lod_scale);
        self.subdivide(&ranges);
        balance(&mut self.map);
        let density = self.signal.map(|(pieces, signal)| (pieces, Density::new(signal, eye, self.size)));
        let view = View { origin, eye, frusta, ranges, root_size: self.size, bounds: self.bounds, density };
        self.selection.fill(&self.map, &view);
        &self.selection
    }

    /// Divides every node that eq (57) divides, from the root down (section 5.2).
    fn subdivide(&mut self, ranges: &Ranges) {
        self.map.clear();
        self.stack.clear();
        self.stack.push(Node::ROOT);
        while let Some(node) = self.stack.pop() {
            if u32::from(node.level) < self.map.levels() && ranges.divides(node) {
                self.map.divide(node);
                self.stack.extend(node.children().into_iter().rev());
            }
        }
    }

    /// The latest selection.
    pub fn selection(&self) -> &Selection {
        &self.selection
    }

    /// The tree the latest selection was made from.
    pub fn map(&self) -> &SubdivisionMap {
        &self.map
    }

    /// Side of the root, S, metres.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// What the quality level stands for.
    pub fn preset(&self) -> Preset {
        self.preset
    }

    /// Levels below the root, L_max.
    pub fn levels(&self) -> u32 {
        self.map.levels()
    }

    /// Distance between vertices of the finest patches, metres; where the wave signal wants no more, the distance it wants.
    pub fn finest_spacing(&self) -> f64 {
        let finest = self.coarsest_spacing() / f64::from(1_u32 << self.levels());
        let wanted = self.signal.map_or(0.0, |(_, signal)| signal.finest_spacing());
        finest.max(wanted).min(self.coarsest_spacing())
    }

    /// Distance between vertices of the undivided root, metres.
    pub fn coarsest_spacing(&self) -> f64 {
        self.size / f64::from(self.preset.cells)
    }
}
