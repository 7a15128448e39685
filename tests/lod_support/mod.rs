//! Random viewers and settings for the tests of the quadtree.
#![allow(dead_code, reason = "each test uses a part")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]
#[path = "../support/random.rs"]
mod random;

use glam::DVec3;
pub use random::Random;
use swell::lod::{LodSettings, Quadtree, Quality, Tessellation};

pub const QUALITIES: [Quality; 4] = [Quality::Low, Quality::Medium, Quality::High, Quality::Ultra];

impl Random {
    pub fn below(&mut self, end: u64) -> u64 {
        self.bits() % end
    }

    /// Low over the water mostly, at times a kilometre up.
    pub fn viewer(&mut self) -> DVec3 {
        let height = 10.0_f64.powf(self.between(-1.0, 3.3));
        let spread = if self.below(8) == 0 { 1.0e6 } else { 2.0e4 };
        DVec3::new(self.between(-spread, spread), height, self.between(-spread, spread))
    }
}

/// Settings with nothing special but these.
pub fn settings(size: f64, quality: Quality, levels: Option<u32>) -> LodSettings {
    LodSettings {
        size,
        quality,
        levels,
        max_height: Some(8.0),
        reach: 6.0,
        skirt_extent: 10.0,
        tessellation: Tessellation::Grid,
    }
}

pub fn tree(size: f64, quality: Quality, levels: Option<u32>) -> Quadtree {
    Quadtree::new(&settings(size, quality, levels)).unwrap()
}

/// Every preset with sizes over the whole range and several overridden depths.
pub fn trees() -> Vec<Quadtree> {
    let sizes = [(256.0, None), (384.0, Some(5)), (1024.0, None), (1536.0, Some(1)), (4096.0, None)];
    let deep = [(2048.0, Some(8)), (8192.0, Some(10)), (8192.0, None), (8192.0, Some(3))];
    let cases = sizes.into_iter().chain(deep);
    cases.flat_map(|(size, levels)| QUALITIES.map(|quality| tree(size, quality, levels))).collect()
}
