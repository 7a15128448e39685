//! How many triangles the wave signal saves against the fixed grid at equal image error: the table of docs/tessellation.md.
//!
//! `./x test --test render_tessellation -- --ignored --nocapture` looks for the settings anew and prints [`ROWS`].
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use support::picture::{Difference, Picture};
use support::stage::{Stage, shipped};
use swell::draw::{DrawCounts, Look, eyes};
use swell::lod::{LodSettings, Quality, SignalSettings, Tessellation};
use swell::scene::Scene;

const SIZE: [u32; 2] = [480, 270];
const TIME: f64 = 12.5;
/// The fixed grid to beat.
const GRID: Quality = Quality::Medium;
/// Image errors up to this many times the grid's count as equal.
const EQUAL: f32 = 1.01;

/// A view and the settings that take the fewest triangles found there.
struct Row {
    scene: &'static str,
    /// Metres to the point looked at.
    away: f64,
    quality: Quality,
    fresnel: f64,
    far: f64,
    /// Metres between vertices where nothing lessens the density: 1 / (2 f S).
    spacing: f64,
}

const ROWS: [Row; 6] = [
    Row { scene: "open_ocean", away: 20.0, quality: Quality::Medium, fresnel: 1.0, far: 400.0, spacing: 0.5 },
    Row { scene: "open_ocean", away: 100.0, quality: Quality::High, fresnel: 1.0, far: 200.0, spacing: 0.7 },
    Row { scene: "open_ocean", away: 500.0, quality: Quality::High, fresnel: 1.0, far: 400.0, spacing: 1.4 },
    Row { scene: "calm", away: 20.0, quality: Quality::Medium, fresnel: 1.0, far: 200.0, spacing: 0.5 },
    Row { scene: "calm", away: 100.0, quality: Quality::High, fresnel: 0.25, far: 200.0, spacing: 0.35 },
    Row { scene: "calm", away: 500.0, quality: Quality::High, fresnel: 0.25, far: 200.0, spacing: 0.25 },
];

/// A shipped scene seen from a height that grows with the distance of what is looked at, foam without a memory.
fn view(name: &str, away: f64) -> Scene {
    let mut scene = shipped(name);
    scene.sea.foam.fade_time = 0.0;
    scene.camera.eye = [0.0, 2.5 + 0.15 * away, 0.0];
    scene.camera.look = [0.0, 0.0, -away];
    scene
}

fn draw(scene: &Scene, quality: Quality, tessellation: Tessellation) -> (Picture, DrawCounts) {
    let lod = LodSettings { quality, tessellation, ..scene.lod };
    let scene = Scene { lod, ..scene.clone() };
    let mut stage = Stage::new(&scene, SIZE, 1, Look::Water, TIME);
    let eyes = eyes(&scene.camera, stage.aspect(), false);
    let picture = stage.picture(TIME, &eyes);
    (picture, stage.counts)
}

/// One view's reference, and what the fixed grid makes of it.
struct Bar {
    scene: Scene,
    reference: Picture,
    grid: (Difference, DrawCounts),
}

impl Bar {
    fn new(name: &str, away: f64) -> Self {
        let scene = view(name, away);
        let (reference, _) = draw(&scene, Quality::Reference, Tessellation::Grid);
        let (picture, counts) = draw(&scene, GRID, Tessellation::Grid);
        Self { grid: (reference.difference(&picture), counts), scene, reference }
    }

    fn signal(&self, row: &Row) -> (Difference, DrawCounts) {
        let (picture, counts) = draw(&self.scene, row.quality, row.tessellation());
        (self.reference.difference(&picture), counts)
    }
}

impl Row {
    fn tessellation(&self) -> Tessellation {
        Tessellation::Signal(SignalSettings {
            frequency: 0.5 / self.spacing,
            density: 1.0,
            fresnel: [self.fresnel, 1.0],
            distance: [0.0, self.far],
        })
    }
}

fn saved(less: u32, more: u32) -> f64 {
    100.0 * (1.0 - f64::from(less) / f64::from(more))
}

#[test]
fn triangles_saved_are_documented() {
    let mut table = String::from(
        "| scene | away | grid: triangles | vertices | FLIP | signal: quality, spacing, S_F from, S_D to | triangles | vertices | FLIP | fewer triangles | fewer vertices |\n\
         |---|---:|---:|---:|---:|---|---:|---:|---:|---:|---:|\n",
    );
    for row in &ROWS {
        let bar = Bar::new(row.scene, row.away);
        let ((grid, before), (signal, after)) = (&bar.grid, &bar.signal(row));
        table.push_str(&format!(
            "| `{}` | {} m | {} | {} | {:.4} | {:?}, {} m, {}, {} m | {} | {} | {:.4} | {:.0} % | {:.0} % |\n",
            row.scene,
            row.away,
            before.triangles,
            before.vertices,
            grid.mean,
            row.quality,
            row.spacing,
            row.fresnel,
            row.far,
            after.triangles,
            after.vertices,
            signal.mean,
            saved(after.triangles, before.triangles),
            saved(after.vertices, before.vertices)
        ));
        assert!(signal.mean <= EQUAL * grid.mean, "{table}: the image error is not equal");
        assert!(after.triangles < before.triangles && after.vertices < before.vertices, "{table}");
    }
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/tessellation.md");
    let text = std::fs::read_to_string(page).unwrap();
    assert!(text.contains(&table), "docs/tessellation.md ought to have:\n{table}");
}

/// For each view and each range of the factors, spacings from coarse to fine until the image error is that of the grid.
#[test]
#[ignore = "minutes: looks for the settings of the table"]
fn look_for_the_fewest_triangles() {
    for &Row { scene, away, .. } in &ROWS {
        let bar = Bar::new(scene, away);
        let (grid, before) = &bar.grid;
        println!("// {} triangles, {} vertices, FLIP {:.4}", before.triangles, before.vertices, grid.mean);
        let mut best: Option<(u32, String)> = None;
        for quality in [Quality::Medium, Quality::High] {
            for (fresnel, far) in [0.25, 1.0].into_iter().flat_map(|f| [200.0, 400.0, 1000.0].map(|d| (f, d)))
            {
                for spacing in [1.4, 1.0, 0.7, 0.5, 0.35, 0.25] {
                    let row = Row { scene, away, quality, fresnel, far, spacing };
                    let (signal, after) = bar.signal(&row);
                    if best.as_ref().is_some_and(|(fewest, _)| after.triangles >= *fewest) {
                        break;
                    }
                    if signal.mean <= EQUAL * grid.mean {
                        let found = format!(
                            "    Row {{ scene: \"{scene}\", away: {away:?}, quality: Quality::{quality:?}, fresnel: {fresnel:?}, \
                             far: {far:?}, spacing: {spacing:?} }}, // {} triangles, FLIP {:.4}",
                            after.triangles, signal.mean
                        );
                        best = Some((after.triangles, found));
                        break;
                    }
                }
            }
        }
        println!("{}", best.map_or_else(|| "    // nothing found".to_owned(), |(_, found)| found));
    }
}
