//! Parameters of the quadtree ("VR Ocean" section 5 and table 2).
use super::error::check_range;
use super::{LodError, Tessellation};

/// Named quality levels, table 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quality {
    /// V 16, tau 2.0, beta 1.2
    Low,
    /// V 32, tau 1.5, beta 1.5
    Medium,
    /// V 64, tau 1.2, beta 1.8
    High,
    /// V 64, tau 1.0, beta 2.0
    Ultra,
    /// V 128, tau 3.0, beta 2.0: what pictures of the others are measured against. No scene file can ask for it.
    Reference,
}

/// What a [`Quality`] stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// Grid cells along a patch's side, V.
    pub cells: u32,
    /// A node of size s is divided while its centre is nearer than s tau (57).
    pub lod_scale: f64,
    /// A patch's box is this much wider than the patch when culled (61).
    pub cull_scale: f64,
}

impl Quality {
    /// The row of table 2.
    pub const fn preset(self) -> Preset {
        let (cells, lod_scale, cull_scale) = match self {
            Self::Low => (16, 2.0, 1.2),
            Self::Medium => (32, 1.5, 1.5),
            Self::High => (64, 1.2, 1.8),
            Self::Ultra => (64, 1.0, 2.0),
            Self::Reference => (128, 3.0, 2.0),
        };
        Preset { cells, lod_scale, cull_scale }
    }
}

/// Everything the quadtree needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LodSettings {
    /// Side of the quadtree's square, S, metres, 256..=8192.
    pub size: f64,
    /// Preset.
    pub quality: Quality,
    /// Levels below the root; `None` takes L_max of eq (56).
    pub levels: Option<u32>,
    /// Largest height of a patch's box, h_max, metres; `None` takes the paper's 0.03 S.
    pub max_height: Option<f64>,
    /// Largest horizontal displacement to allow for when culling, metres.
    pub reach: f64,
    /// Distance to which the skirt continues the sea, as a multiple of `size`.
    pub skirt_extent: f64,
    /// How many of a patch's cells are drawn.
    pub tessellation: Tessellation,
}

impl LodSettings {
    /// Levels below the root: `levels`, or L_max of eq (56), clamp(floor(log2(S / 64) + 0.5), 2, 8).
    pub fn level_count(&self) -> u32 {
        self.levels.unwrap_or_else(|| (libm::log2(self.size / 64.0) + 0.5).floor().clamp(2.0, 8.0) as u32)
    }

    /// Largest height above and below rest that culling allows for, metres: `max_height`, or the paper's 0.03 S.
    pub fn height_bound(&self) -> f64 {
        self.max_height.unwrap_or(0.03 * self.size)
    }

    /// Every value in its range.
    ///
    /// # Errors
    /// [`LodError::OutOfRange`] for the first one that is not.
    pub fn check(&self) -> Result<(), LodError> {
        check_range("size", self.size, 256.0, 8192.0)?;
        // One patch alone is coarse where its density cannot follow the distance.
        let (fewest, tessellation) = match self.tessellation {
            Tessellation::Grid => (1.0, Ok(())),
            Tessellation::Signal(signal) => (0.0, signal.check()),
        };
        tessellation?;
        check_range("levels", f64::from(self.level_count()), fewest, 10.0)?;
        check_range("max_height", self.height_bound(), 0.0, 1.0e4)?;
        check_range("reach", self.reach, 0.0, 1.0e4)?;
        check_range("skirt_extent", self.skirt_extent, 1.0, 1.0e4)
    }
}
