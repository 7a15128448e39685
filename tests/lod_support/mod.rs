//! Random viewers and settings for the tests of the quadtree.
#![allow(dead_code, reason = "each test uses a part")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]
use glam::DVec3;
use swell::lod::{LodSettings, Quadtree, Quality};

pub const QUALITIES: [Quality; 4] = [Quality::Low, Quality::Medium, Quality::High, Quality::Ultra];

/// SplitMix64 (Steele, Lea and Flood 2014).
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in low..high.
    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn below(&mut self, end: u64) -> u64 {
        self.bits() % end
    }

    /// Low over the water mostly, at times a kilometre up.
    pub fn viewer(&mut self) -> DVec3 {
        let height = 10.0_f64.powf(self.range(-1.0, 3.3));
        let spread = if self.below(8) == 0 { 1.0e6 } else { 2.0e4 };
        DVec3::new(self.range(-spread, spread), height, self.range(-spread, spread))
    }
}

/// Settings with nothing special but these.
pub fn settings(size: f64, quality: Quality, levels: Option<u32>) -> LodSettings {
    LodSettings { size, quality, levels, max_height: Some(8.0), reach: 6.0, skirt_extent: 10.0 }
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
