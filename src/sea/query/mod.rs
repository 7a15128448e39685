//! The surface at a point, from the very maps that are drawn. See `docs/query.md`.
mod approach;
mod formulas;
mod grid;
mod guess;
mod newton;
mod sample;
mod search;

use super::{
    foam::foam,
    maps::SeaMaps,
    settings::{FoamSettings, MAX_CASCADES},
    simd::{Isa, MAX_LANES},
    waves::Model,
};
use grid::Grid;
use newton::{Block, Solve};
use sample::{Sample, norm, normal};
use search::search;

/// Most steps of one inversion.
pub const MAX_ITERATIONS: u32 = 64;
/// Horizontal error, metres, at which an inversion is content.
pub const TOLERANCE: f64 = 1e-7;

/// Points that are looked for together.
const TOGETHER: usize = 64;
/// Points of which only one is asked for: the longest vector.
const ALONE: usize = MAX_LANES;

/// A point of the sea's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Where the point rests, world (x, z), metres.
    pub rest: [f64; 2],
    /// Where it is, world (x, y, z), metres.
    pub position: [f64; 3],
    /// Unit normal of the displaced surface, world (x, y, z).
    pub normal: [f64; 3],
    /// `position` less the rest position, metres.
    pub displacement: [f64; 3],
    /// Foam cover, 0..=1.
    pub foam: f64,
    /// Horizontal distance between `position` and the point asked for, metres; 0 for [`Surface::at_rest`].
    pub residual: f64,
    /// Steps that it took.
    pub iterations: u32,
}

impl Surface {
    /// Height above the sea at rest, metres.
    pub fn height(&self) -> f64 {
        self.position[1]
    }

    /// [`Query::at_rest`] of one point.
    pub fn at_rest(maps: &SeaMaps, x: f64, z: f64) -> Self {
        Query::new(maps).at_rest(x, z)
    }

    /// [`Query::above`] of one point.
    pub fn above(maps: &SeaMaps, x: f64, z: f64) -> Self {
        Query::new(maps).above(x, z)
    }
}

/// A step's maps, ready to be asked about many points. Making one costs about as much as asking about one.
///
/// Positions are world (x, z), metres, finite and within 1e9; one that is not a number is answered with none. Maps are
/// those of a [`super::Sea`]: at most [`MAX_CASCADES`], of 2^m x 2^m points.
#[derive(Clone, Copy, Debug)]
pub struct Query<'a> {
    grids: [Grid<'a>; MAX_CASCADES],
    /// How each cascade lies to the first.
    frames: [Frame; MAX_CASCADES],
    /// How many there are.
    count: usize,
    foam: &'a FoamSettings,
    /// Formulas that are added to the maps, at this time, seconds.
    models: &'a [Model],
    time: f64,
    isa: Isa,
}

/// How a cascade lies to the first one.
#[derive(Clone, Copy, Debug, Default)]
struct Frame {
    /// (cos, sin) of its own rotation less the first's.
    turn: [f64; 2],
    /// `turn` times its texels for each texel of the first.
    follow: [f64; 2],
}

impl<'a> Query<'a> {
    /// Works out what all queries share.
    pub fn new(maps: &'a SeaMaps) -> Self {
        Self::with_isa(maps, Isa::best())
    }

    /// The same on another instruction set, with the same answers to the bit.
    pub fn with_isa(maps: &'a SeaMaps, isa: Isa) -> Self {
        let mut grids = [Grid::FLAT; MAX_CASCADES];
        for (grid, maps) in grids.iter_mut().zip(&maps.cascades) {
            *grid = Grid::new(maps);
        }
        let [cos, sin] = grids[0].turn;
        let mut frames = grids.each_ref().map(|grid| {
            let [own_cos, own_sin] = grid.turn;
            let turn = [own_cos * cos + own_sin * sin, own_sin * cos - own_cos * sin];
            Frame { turn, follow: turn.map(|part| part * grid.per_metre / grids[0].per_metre) }
        });
        frames[0] = Frame { turn: [1.0, 0.0], follow: [1.0, 0.0] };
        // No cascade at all is one that is flat.
        let count = maps.cascades.len().clamp(1, MAX_CASCADES);
        Self { grids, frames, count, foam: &maps.foam, models: &maps.models, time: maps.time, isa }
    }

    /// The point of the surface whose rest position is (`x`, `z`).
    pub fn at_rest(&self, x: f64, z: f64) -> Surface {
        self.surface([x, z], [x, z], 1)
    }

    /// The point of the surface above or below (`x`, `z`): the q with q + D(q) = (x, z).
    ///
    /// Newton's method on the piecewise bilinear field that is drawn, and on formulas; where the sea is so steep that it fails, with
    /// damped steps and from several places. At most [`MAX_ITERATIONS`] steps in all; `residual` says how well they
    /// went. Where the sea has folded over (J < 0) there are several such points and one of them is returned.
    pub fn above(&self, x: f64, z: f64) -> Surface {
        if !self.models.is_empty() {
            let (q, iterations) = formulas::solve(self, [x, z]);
            return self.surface(q, [x, z], iterations);
        }
        let mut block = Block::<ALONE>::new(self);
        self.isa.run(Solve { block: &mut block, targets: &[[x; ALONE], [z; ALONE]] });
        self.found(&block, 0, [x, z])
    }

    /// [`Self::above`] for each of `points`, with the same answers to the bit, sooner: several at a time.
    ///
    /// # Panics
    /// When `points` and `surfaces` differ in length.
    pub fn above_many(&self, points: &[[f64; 2]], surfaces: &mut [Surface]) {
        if !self.models.is_empty() {
            return each(points, surfaces, |[x, z]| self.above(x, z));
        }
        assert_eq!(points.len(), surfaces.len(), "one surface for each point");
        let mut block = Block::<TOGETHER>::new(self);
        for (points, surfaces) in points.chunks(TOGETHER).zip(surfaces.chunks_mut(TOGETHER)) {
            self.isa.run(Solve { block: &mut block, targets: &targets(points) });
            for (i, (surface, &target)) in surfaces.iter_mut().zip(points).enumerate() {
                *surface = self.found(&block, i, target);
            }
        }
    }

    /// Heights alone of [`Self::above`] for each of `points`, metres, to the last few bits of a double: the least that
    /// buoyancy wants, and the cheapest.
    ///
    /// # Panics
    /// When `points` and `heights` differ in length.
    pub fn heights(&self, points: &[[f64; 2]], heights: &mut [f64]) {
        if !self.models.is_empty() {
            return each(points, heights, |point| {
                Sample::at(self, formulas::solve(self, point).0).value.displacement[1]
            });
        }
        assert_eq!(points.len(), heights.len(), "one height for each point");
        let mut block = Block::<TOGETHER>::new(self);
        for (points, heights) in points.chunks(TOGETHER).zip(heights.chunks_mut(TOGETHER)) {
            self.isa.run(Solve { block: &mut block, targets: &targets(points) });
            heights.copy_from_slice(&block.heights()[..heights.len()]);
            for (i, (height, &target)) in heights.iter_mut().zip(points).enumerate() {
                if !block.found(i) {
                    let (q, _) = search(self, target, block.looks(i));
                    *height = Sample::at(self, q).value.displacement[1];
                }
            }
        }
    }

    /// The surface at what a block has come to, or what a search finds.
    fn found<const P: usize>(&self, block: &Block<'_, 'a, P>, i: usize, target: [f64; 2]) -> Surface {
        let (q, looks) = if block.found(i) {
            let [x, z] = block.offset(i);
            ([target[0] + x, target[1] + z], block.looks(i))
        } else {
            search(self, target, block.looks(i))
        };
        self.surface(q, target, looks)
    }

    fn surface(&self, q: [f64; 2], target: [f64; 2], iterations: u32) -> Surface {
        let sample = Sample::at(self, q);
        let [x, height, z] = sample.value.displacement;
        Surface {
            rest: q,
            position: [q[0] + x, height, q[1] + z],
            normal: normal(self, q),
            displacement: [x, height, z],
            foam: (foam(self.foam, sample.value.compression) + sample.foam).min(1.0),
            residual: if target == q { 0.0 } else { norm(sample.miss(q, target)) },
            iterations,
        }
    }

    fn grids(&self) -> &[Grid<'a>] {
        &self.grids[..self.count]
    }

    fn first(&self) -> &Grid<'a> {
        &self.grids[0]
    }

    /// The cascades after the first, and how they lie to it.
    fn others(&self) -> impl Iterator<Item = (&Grid<'a>, &Frame)> {
        self.grids().iter().zip(&self.frames).skip(1)
    }
}

/// World x of all and world z of all; idle places ask what the last point does.
#[inline(always)]
fn targets(points: &[[f64; 2]]) -> [[f64; TOGETHER]; 2] {
    let mut targets = [[0.0; TOGETHER]; 2];
    for i in 0..TOGETHER {
        [targets[0][i], targets[1][i]] = points[i.min(points.len() - 1)];
    }
    targets
}

/// One answer for each of `points`.
fn each<T>(points: &[[f64; 2]], answers: &mut [T], answer: impl Fn([f64; 2]) -> T) {
    assert_eq!(points.len(), answers.len(), "one answer for each point");
    for (to, &point) in answers.iter_mut().zip(points) {
        *to = answer(point);
    }
}
