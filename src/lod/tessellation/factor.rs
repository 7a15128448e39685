//! The factor of an edge: how many segments it is cut into, and how far its vertices have slid towards half as many.
use super::SignalSettings;
use crate::lod::weight::WEIGHT_STEPS;
use crate::lod::{Edge, Node};
use glam::{DVec2, DVec3};

/// Real factors from a power of two up to this many times it are drawn with vertices on their way: at the power of two
/// itself they lie on the grid of that many segments.
const SLIDE: f64 = 1.5;

/// A side of a square of the quadtree, by whole numbers: the same value whichever patch asks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Side {
    /// Level of the squares it is a side of.
    pub level: u8,
    /// Column of its western end, in sides.
    pub x: u16,
    /// Row of its southern end, in sides.
    pub y: u16,
    /// True when it runs along z.
    pub along_z: bool,
}

impl Side {
    /// An edge of a node.
    pub fn of(node: Node, edge: Edge) -> Self {
        let Node { level, x, y } = node;
        let (x, y, along_z) = match edge {
            Edge::East => (x + 1, y, true),
            Edge::West => (x, y, true),
            Edge::North => (x, y + 1, false),
            Edge::South => (x, y, false),
        };
        Self { level, x, y, along_z }
    }

    /// Its middle (x, z) at rest, metres relative to the root's centre, and its length.
    fn middle(self, root_size: f64) -> (DVec2, f64) {
        let length = Node { level: self.level, x: 0, y: 0 }.size(root_size);
        let half = if self.along_z { DVec2::new(0.0, 0.5) } else { DVec2::new(0.5, 0.0) };
        let start = DVec2::new(f64::from(self.x), f64::from(self.y));
        ((start + half) * length - 0.5 * root_size, length)
    }
}

/// How densely one viewer wants edges to be cut.
#[derive(Clone, Copy, Debug)]
pub struct Density {
    settings: SignalSettings,
    /// The viewer relative to the root's centre, metres.
    viewer: DVec3,
    root_size: f64,
}

impl Density {
    /// For a viewer at `viewer` metres from the centre of a root of side `root_size`.
    pub fn new(settings: SignalSettings, viewer: DVec3, root_size: f64) -> Self {
        Self { settings, viewer, root_size }
    }

    /// max(1, 2 f |p1 - p2| S_F S_D S) of a side, with the sea's normal at rest at its middle.
    pub fn factor(&self, side: Side) -> f64 {
        let (middle, length) = side.middle(self.root_size);
        let away = DVec3::new(middle.x - self.viewer.x, self.viewer.y, middle.y - self.viewer.z);
        let distance = away.length();
        let SignalSettings { frequency, density, .. } = self.settings;
        let factor = 2.0 * frequency * length * self.fresnel(distance) * self.nearness(distance) * density;
        factor.max(1.0)
    }

    /// S_F: Schlick's term (1 - n . v)^5 within its range; n is up.
    fn fresnel(&self, distance: f64) -> f64 {
        let [least, most] = self.settings.fresnel;
        let cosine = if distance > 0.0 { (self.viewer.y.abs() / distance).min(1.0) } else { 1.0 };
        let grazing = 1.0 - cosine;
        let squared = grazing * grazing;
        (squared * squared * grazing).clamp(least, most)
    }

    /// S_D: 1 up to the near distance, 0 from the far one on.
    fn nearness(&self, distance: f64) -> f64 {
        let [near, far] = self.settings.distance;
        1.0 - ((distance - near) / (far - near)).clamp(0.0, 1.0)
    }
}

/// A factor as it is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factor {
    /// Binary logarithm of the number of segments.
    pub level: u8,
    /// How far odd vertices have slid onto the grid of half as many, 0..=1, in steps of 1/256.
    pub weight: f32,
}

impl Factor {
    /// The power of two at or above `real`, at most 2^`most`. (A number that is none counts as 1.)
    pub fn new(real: f64, most: u8) -> Self {
        let (mut level, mut segments) = (0, 1.0);
        while segments < real && level < most {
            level += 1;
            segments *= 2.0;
        }
        if level == 0 {
            return Self { level, weight: 0.0 };
        }
        let t = ((SLIDE - real / (0.5 * segments)) / (SLIDE - 1.0)).clamp(0.0, 1.0);
        let weight = t * t * (3.0 - 2.0 * t);
        Self { level, weight: ((weight * WEIGHT_STEPS).round() / WEIGHT_STEPS) as f32 }
    }

    /// With the quadtree's own slide where the factor can grow no more: there a patch's density follows its size.
    #[must_use]
    pub fn or_slid(self, most: u8, weight: f32) -> Self {
        if self.level == most { Self { weight: self.weight.max(weight), ..self } } else { self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_are_the_next_power_of_two() {
        for (real, level) in
            [(0.0, 0), (1.0, 0), (1.01, 1), (2.0, 1), (2.1, 2), (33.0, 6), (64.0, 6), (1e9, 6)]
        {
            assert_eq!(Factor::new(real, 6).level, level, "{real}");
        }
        assert_eq!(Factor::new(f64::NAN, 6), Factor { level: 0, weight: 0.0 });
    }

    /// Just above a power of two the vertices lie where that many segments have them.
    #[test]
    fn slides_begin_where_the_coarser_grid_ends() {
        for level in 0..6_u8 {
            let power = f64::from(1_u32 << level);
            assert_eq!(Factor::new(power, 6).weight, 0.0);
            assert_eq!(Factor::new(power.next_up(), 6), Factor { level: level + 1, weight: 1.0 });
            assert_eq!(Factor::new(1.5 * power, 6).weight, 0.0);
        }
    }
}
