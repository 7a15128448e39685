//! The quadtree against the plainest one: recursion, sets, and the paper's map of levels.
mod lod_support;
use glam::{DVec3, dvec3};
use lod_support::{Random, trees};
use std::collections::{BTreeMap, BTreeSet};
use swell::lod::{Frustum, Quadtree, snap_origin};

/// (level, x, y)
type Square = (u32, u32, u32);

struct Reference {
    size: f64,
    tau: f64,
    levels: u32,
    viewer: DVec3,
    leaves: BTreeSet<Square>,
}

impl Reference {
    fn new(tree: &Quadtree, eye: DVec3) -> Self {
        let (size, preset) = (tree.size(), tree.preset());
        let origin = snap_origin(eye, size, preset.cells);
        let viewer = dvec3(eye.x - origin.x, eye.y, eye.z - origin.y);
        let mut reference =
            Self { size, tau: preset.lod_scale, levels: tree.levels(), viewer, leaves: BTreeSet::new() };
        reference.divide((0, 0, 0));
        while reference.split_one_too_coarse() {}
        reference
    }

    fn divide(&mut self, (level, x, y): Square) {
        let side = self.size / 2_f64.powi(level as i32);
        let centre = |cell: u32| (f64::from(cell) + 0.5) * side - self.size / 2.0;
        let distance = dvec3(centre(x), 0.0, centre(y)).distance_squared(self.viewer);
        if level < self.levels && distance < (side * self.tau).powi(2) {
            children((level, x, y)).into_iter().for_each(|child| self.divide(child));
        } else {
            self.leaves.insert((level, x, y));
        }
    }

    /// The paper's map, a level for every finest cell.
    fn map(&self) -> Vec<Vec<u32>> {
        let width = 1 << self.levels;
        let mut map = vec![vec![0; width]; width];
        for &(level, x, y) in &self.leaves {
            let stride = 1 << (self.levels - level);
            for row in &mut map[(y * stride) as usize..((y + 1) * stride) as usize] {
                row[(x * stride) as usize..((x + 1) * stride) as usize].fill(level);
            }
        }
        map
    }

    /// Divides the first leaf with a cell beside it two levels finer; false when there is none.
    fn split_one_too_coarse(&mut self) -> bool {
        let map = self.map();
        let width = map.len();
        for y in 0..width {
            for x in 0..width {
                for (u, v) in [(x + 1, y), (x, y + 1), (x.wrapping_sub(1), y), (x, y.wrapping_sub(1))] {
                    if u < width && v < width && map[v][u] > map[y][x] + 1 {
                        let level = map[y][x];
                        let shift = self.levels - level;
                        let coarse = (level, x as u32 >> shift, y as u32 >> shift);
                        self.leaves.remove(&coarse);
                        self.leaves.extend(children(coarse));
                        return true;
                    }
                }
            }
        }
        false
    }

    /// Eqs (62)-(64) to the letter.
    fn flags(&self) -> BTreeMap<Square, u8> {
        let map = self.map();
        let width = 1_i64 << self.levels;
        let level_at = |x: i64, y: i64| {
            let inside = (0..width).contains(&x) && (0..width).contains(&y);
            inside.then(|| map[y as usize][x as usize])
        };
        let of_leaf = |&(level, x, y): &Square| {
            let stride = 1_i64 << (self.levels - level);
            let (gx, gy) = (i64::from(x) * stride, i64::from(y) * stride);
            let around = [(gx + stride, gy), (gx, gy + stride), (gx - 1, gy), (gx, gy - 1)];
            let flags = around
                .into_iter()
                .enumerate()
                .map(|(bit, (x, y))| u8::from(level_at(x, y).is_some_and(|other| other < level)) << bit);
            ((level, x, y), flags.sum())
        };
        self.leaves.iter().map(of_leaf).collect()
    }
}

fn children((level, x, y): Square) -> [Square; 4] {
    [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| (level + 1, 2 * x + dx, 2 * y + dy))
}

#[test]
fn leaves_and_flags_equal_the_reference() {
    let mut random = Random(11);
    let mut forced_views = 0;
    for mut tree in trees() {
        // The reference walks the whole map for each forced split.
        let views = if tree.levels() > 6 { 15 } else { 120 };
        for _ in 0..views {
            let eye = random.viewer();
            let reference = Reference::new(&tree, eye);
            let selection = tree.select(eye, &[Frustum::everywhere()]);
            let flags: BTreeMap<Square, u8> = selection
                .leaves()
                .iter()
                .map(|leaf| {
                    let node = leaf.node;
                    ((u32::from(node.level), u32::from(node.x), u32::from(node.y)), leaf.pattern.bits())
                })
                .collect();
            assert_eq!(flags.len(), selection.leaves().len());
            assert_eq!(flags, reference.flags(), "viewer {eye}");

            let mut plain = Reference { leaves: BTreeSet::new(), ..reference };
            plain.divide((0, 0, 0));
            forced_views += usize::from(plain.leaves.len() < flags.len());

            let map = plain_map(&tree);
            for (y, row) in map.iter().enumerate() {
                for (x, &level) in row.iter().enumerate() {
                    assert_eq!(tree.map().level_at(x as u16, y as u16), level);
                }
            }
        }
    }
    assert!(forced_views > 100, "balancing must have had work: {forced_views}");
}

/// The map from the leaves themselves.
fn plain_map(tree: &Quadtree) -> Vec<Vec<u8>> {
    let width = 1 << tree.levels();
    let mut map = vec![vec![u8::MAX; width]; width];
    for leaf in tree.selection().leaves() {
        let stride = 1_usize << (tree.levels() - u32::from(leaf.node.level));
        let (x, y) = (usize::from(leaf.node.x) * stride, usize::from(leaf.node.y) * stride);
        map[y..y + stride].iter_mut().for_each(|row| row[x..x + stride].fill(leaf.node.level));
    }
    map
}
