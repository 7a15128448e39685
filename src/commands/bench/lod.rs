//! `quadtree`: what a frame does to choose patches.
use super::harness::{Body, Case, Label, Work};
use super::{BenchError, selection::Selection};
use crate::draw::{Eye, eyes};
use crate::lod::{Frustum, LodSettings, Quadtree, Quality, Tessellation};
use crate::scene::CameraSettings;
use glam::DVec3;
use std::f64::consts::TAU;
use std::hint::black_box;

/// The largest tree of the finest quality.
const SETTINGS: LodSettings = LodSettings {
    size: 8192.0,
    quality: Quality::Ultra,
    levels: None,
    max_height: Some(6.0),
    reach: 6.0,
    skirt_extent: 8.0,
    tessellation: Tessellation::Grid,
};
/// Where the head looks in turn: once around.
const DIRECTIONS: usize = 64;

/// A head that turns and drifts, with two eyes.
struct Choice {
    tree: Quadtree,
    looks: Vec<Vec<Eye>>,
    frusta: Vec<Frustum>,
    frame: usize,
    drawn: u32,
}

impl Body for Choice {
    fn prepare(&mut self) {
        self.frame += 1;
        let drift = DVec3::new(0.03, 0.0, 0.02);
        for eye in &mut self.looks[self.frame % DIRECTIONS] {
            eye.position += drift * DIRECTIONS as f64;
        }
    }

    fn run(&mut self) -> Result<(), BenchError> {
        let eyes = &self.looks[self.frame % DIRECTIONS];
        let head = 0.5 * (eyes[0].position + eyes[1].position);
        self.frusta.clear();
        self.frusta.extend(eyes.iter().map(|eye| eye.frustum(head)));
        let selection = self.tree.select(head, &self.frusta);
        self.drawn = selection.batches().map(|batch| batch.instances.len() as u32).sum();
        black_box(self.drawn);
        Ok(())
    }
}

/// The case, if it is wanted.
///
/// # Errors
/// None that these settings give.
pub fn cases(selection: &Selection) -> Result<Option<Case>, BenchError> {
    if !selection.wants("quadtree") {
        return Ok(None);
    }
    let look = |direction: usize| {
        let (sin, cos) = (TAU * direction as f64 / DIRECTIONS as f64).sin_cos();
        let eye = [100.0, 1.7, -40.0];
        let look = [eye[0] + sin, eye[1] - 0.1, eye[2] + cos];
        eyes(&CameraSettings { eye, look, fov_y: 1.75, eye_separation: 0.064 }, 1.0, true)
    };
    let mut tree = Quadtree::new(&SETTINGS)?;
    let head = DVec3::new(100.0, 1.7, -40.0);
    let leaves = tree.select(head, &[Frustum::everywhere()]).leaves().len();
    let label = Label { name: "quadtree".to_owned(), n: 0, cascades: 0, threads: 1, isa: "" };
    let work = Work { points: leaves as f64, ..Work::default() };
    let looks = (0..DIRECTIONS).map(look).collect();
    let body = Choice { tree, looks, frusta: Vec::with_capacity(2), frame: 0, drawn: 0 };
    Ok(Some(Case::new(label, work, body)))
}
