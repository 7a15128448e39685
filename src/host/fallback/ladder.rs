//! What is given up, step by step.

use crate::lod::Quality;

/// Sizes of the first levels, as factors on what was asked for: 0.7 draws half the pixels.
const SCALES: [f32; 4] = [1.0, 0.9, 0.8, 0.7];

/// How finely frames are made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Factor on each side of a view, beside the one asked for.
    pub scale: f32,
    /// The quadtree's preset.
    pub quality: Quality,
    /// Whether cascades beyond the first are stepped every second frame only, in turns.
    pub in_turns: bool,
}

/// Levels, the best first; never empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Ladder(Vec<Level>);

impl Ladder {
    /// From what was asked for down to the least.
    pub fn new(quality: Quality) -> Self {
        let mut levels: Vec<_> =
            SCALES.iter().map(|&scale| Level { scale, quality, in_turns: false }).collect();
        let scale = SCALES[SCALES.len() - 1];
        let coarser = [Quality::High, Quality::Medium, Quality::Low].into_iter();
        levels.extend(coarser.filter(|&coarser| coarser < quality).map(|quality| Level {
            scale,
            quality,
            in_turns: false,
        }));
        let least = levels.last().map_or(quality, |level| level.quality);
        levels.push(Level { scale, quality: least, in_turns: true });
        Self(levels)
    }

    /// The level of this number; the last one beyond it.
    pub fn level(&self, number: usize) -> Level {
        self.0[number.min(self.last())]
    }

    /// Number of the last level.
    pub const fn last(&self) -> usize {
        self.0.len() - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn size_goes_first_then_the_preset_then_the_small_waves() {
        let ladder = Ladder::new(Quality::High);
        let levels: Vec<_> = (0..=ladder.last()).map(|number| ladder.level(number)).collect();
        let told: Vec<_> = levels.iter().map(|level| (level.scale, level.quality, level.in_turns)).collect();
        use Quality::{High, Low, Medium};
        let wanted = [
            (1.0, High, false),
            (0.9, High, false),
            (0.8, High, false),
            (0.7, High, false),
            (0.7, Medium, false),
            (0.7, Low, false),
            (0.7, Low, true),
        ];
        assert_eq!(told, wanted);
        assert_eq!(Ladder::new(Low).last(), 4);
    }
}
