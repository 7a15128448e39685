//! Depth is true: a marker that floats nearby stands apart in the two views as far as geometry says.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use glam::{DVec3, Vec3};
use support::headset::{Watcher, settings};
use support::monado::{Service, Settings};
use support::picture::Picture;
use support::program::run;
use support::stage::shipped;
use swell::draw::{Buoy, Eye};
use swell::host::marker;
use swell::raft::BuoySettings;
use swell::scene::Scene;
use swell::sea::Sea;

/// Pixels a side are this much more than the headset asks for, so that half a pixel means something.
const SCALE: f32 = 3.0;

#[test]
fn a_markers_disparity_is_what_geometry_predicts() {
    let service = Service::start(Settings::default());
    let said = run(&mut service.reexec("disparity_of_a_marker"));
    print!("{}", said.out);
    assert!(said.status == Some(0) && said.out.contains("1 passed"), "{said:?}");
}

#[test]
#[ignore = "runs in a process of its own"]
fn disparity_of_a_marker() {
    let mut scene = shipped("open_ocean");
    let color = [0.9, 0.0, 0.9];
    scene.buoys = vec![BuoySettings { at: [0.3, -2.6], radius: 0.25, color, height: 1.5 }];
    let mut watcher = Watcher::new(5);
    let mut settings = settings(20);
    settings.scale = SCALE;
    let report = watcher.try_watch(&scene, &settings).unwrap();
    assert_eq!(report.said, Vec::<String>::new());
    let mut compared = 0;
    for (index, seen) in watcher.seen.iter().enumerate() {
        let Some(views) = &seen.pictures else { continue };
        let buoy = floating(&scene, seen.time);
        let wanted = seen.eyes.map(|eye| project(&eye, views[0].size, buoy.top()));
        let found = [0, 1].map(|i| centroid(&views[i], &seen.eyes[i], &buoy));
        let disparity = |places: [[f64; 2]; 2]| [places[0][0] - places[1][0], places[0][1] - places[1][1]];
        let (predicted, measured) = (disparity(wanted), disparity(found));
        println!("frame {index}: disparity {measured:.2?} px, predicted {predicted:.2?} px");
        assert!(predicted[0] > 4.0, "the marker is too far to tell anything: {predicted:?}");
        for axis in 0..2 {
            let error = (measured[axis] - predicted[axis]).abs();
            assert!(error < 0.5, "frame {index}, axis {axis}: {measured:?} instead of {predicted:?}");
        }
        compared += 1;
    }
    assert!(compared >= 3);
}

fn floating(scene: &Scene, time: f64) -> Buoy {
    let mut sea = Sea::new(&scene.sea).unwrap();
    let mut maps = sea.new_maps();
    sea.step(time, &mut maps).unwrap();
    marker(&scene.buoys[0], &maps)
}

/// Pixels from the upper left corner.
fn project(eye: &Eye, size: [u32; 2], point: DVec3) -> [f64; 2] {
    let clip = eye.view_projection(point) * Vec3::ZERO.extend(1.0);
    assert!(clip.w > 0.0);
    [0, 1].map(|axis| f64::from(clip[axis] / clip.w * 0.5 + 0.5) * f64::from(size[axis]))
}

/// The middle of the marker's colour around where it should be, weighted by how much of it a pixel has.
fn centroid(picture: &Picture, eye: &Eye, buoy: &Buoy) -> [f64; 2] {
    let [x, y] = project(eye, picture.size, buoy.top());
    let distance = (buoy.top() - eye.position).length();
    let pixels = f64::from(picture.size[0]) / f64::from(eye.fov.right - eye.fov.left);
    let reach = (0.75 * f64::from(Buoy::TOP_SIZE * buoy.diameter) / distance * pixels).ceil();
    let (mut sum, mut weights) = ([0.0; 2], 0.0);
    for row in (y - reach) as u32..=(y + reach) as u32 {
        for column in (x - reach) as u32..=(x + reach) as u32 {
            let [red, green, blue] = picture.pixel(column, row).map(f64::from);
            let weight = (red.min(blue) - green - 25.0).clamp(0.0, 50.0);
            sum[0] += weight * (f64::from(column) + 0.5);
            sum[1] += weight * (f64::from(row) + 0.5);
            weights += weight;
        }
    }
    assert!(weights > 50.0 * 20.0, "the marker is not where it should be, {x:.1} {y:.1}");
    sum.map(|sum| sum / weights)
}
