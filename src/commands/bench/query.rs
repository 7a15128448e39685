//! `query`: a thousand questions for the height above a point.
use super::harness::{Body, Case, Label, Work};
use super::{BenchError, sea, selection::Selection};
use crate::sea::{Query, Sea, SeaMaps, philox};
use std::hint::black_box;

/// Questions in one call.
const QUESTIONS: usize = 1000;
/// They lie within this many metres of the origin, along each axis.
const AROUND: f64 = 400.0;
/// Metres by which they move on from call to call.
const DRIFT: f64 = 0.37;

struct Questions {
    maps: SeaMaps,
    points: Vec<[f64; 2]>,
    heights: Vec<f64>,
}

impl Body for Questions {
    fn prepare(&mut self) {
        for [x, _] in &mut self.points {
            *x += DRIFT;
        }
    }

    fn run(&mut self) -> Result<(), BenchError> {
        Query::new(&self.maps).heights(&self.points, &mut self.heights);
        black_box(&self.heights);
        Ok(())
    }
}

/// The case, if it is wanted: on the maps of one cascade of the size of detail.
///
/// # Errors
/// Making the sea.
pub fn cases(selection: &Selection) -> Result<Option<Case>, BenchError> {
    if !selection.wants("query") {
        return Ok(None);
    }
    let n = selection.detail;
    let mut sea = Sea::new(&sea::settings(n, 1, sea::NO_MEMORY))?;
    let mut maps = sea.new_maps();
    sea.step(10.0, &mut maps)?;
    let points = (0..QUESTIONS as i32).map(|i| philox::gaussian(1, i, 0, 0).map(|x| (x * AROUND) % AROUND));
    let label = Label { name: "query".to_owned(), n, cascades: 1, threads: 1, isa: "" };
    let work = Work { points: QUESTIONS as f64, ..Work::default() };
    let body = Questions { maps, points: points.collect(), heights: vec![0.0; QUESTIONS] };
    Ok(Some(Case::new(label, work, body)))
}
