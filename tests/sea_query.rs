//! The height query against the maps that are drawn.
mod sea_common;
use sea_common::{cascades, maps, settings};
use swell::sea::simd::Isa;
use swell::sea::{Query, SeaMaps, Spectrum, Surface};

#[test]
fn at_rest_on_a_grid_point_is_the_texel() {
    let sea = settings(Spectrum::Jonswap);
    let maps = maps(&sea, 5.0);
    let map = &maps.cascades[0];
    let spacing = map.patch_size / map.resolution as f64;
    for (i, j) in [(0, 0), (3, 7), (63, 63), (20, 0)] {
        let texel = map.displacement[j * map.resolution + i].map(f64::from);
        for laps in [0.0, -3.0, 12_500.0] {
            let [x, z] = [i, j].map(|at| at as f64 * spacing + laps * map.patch_size);
            let surface = Surface::at_rest(&maps, x, z);
            for (got, truth) in surface.displacement.iter().zip(texel) {
                assert!((got - truth).abs() < 1e-6, "{i} {j}, {laps} patches away");
            }
            assert_eq!((surface.rest, surface.residual), ([x, z], 0.0));
        }
    }
}

#[test]
fn above_is_the_inverse_of_at_rest() {
    for sea in [settings(Spectrum::Phillips), settings(Spectrum::Tma), cascades()] {
        let maps = maps(&sea, 31.0);
        let mut displaced = 0.0_f64;
        for step in 0..1000 {
            let (x, z) = (f64::from(step) * 1.37 - 500.0, f64::from(step * step % 997) * 0.71);
            let above = Surface::above(&maps, x, z);
            assert!(above.residual < 1e-6, "({x}, {z}): {above:?}");
            assert!((above.position[0] - x).hypot(above.position[2] - z) < 1e-6);
            assert!(above.iterations <= swell::sea::query::MAX_ITERATIONS);
            let [qx, qz] = above.rest;
            let rest = Surface::at_rest(&maps, qx, qz);
            assert!((rest.height() - above.height()).abs() < 1e-12);
            assert_eq!((rest.position, rest.normal, rest.foam), (above.position, above.normal, above.foam));
            displaced = displaced.max((x - qx).hypot(z - qz));
        }
        assert!(displaced > 0.05, "the sea hardly moves sideways: {displaced} m");
    }
}

#[test]
fn a_sea_turned_with_its_wind_is_the_sea_seen_turned() {
    let straight = settings(Spectrum::Jonswap);
    let (mut turned, angle) = (straight.clone(), 0.9_f64);
    turned.cascades[0].rotation = angle;
    turned.cascades[0].wind_direction += angle;
    let (straight, turned) = (maps(&straight, 7.0), maps(&turned, 7.0));
    // Counter-clockwise seen from above takes +X towards -Z.
    let (sin, cos) = angle.sin_cos();
    let turn = |x: f64, z: f64| [x * cos + z * sin, z * cos - x * sin];
    for step in 0..100 {
        let (x, z) = (f64::from(step) * 2.3, f64::from(step) * -1.1);
        let [tx, tz] = turn(x, z);
        let (a, b) = (Surface::at_rest(&straight, x, z), Surface::at_rest(&turned, tx, tz));
        for (a, b) in [(a.displacement, b.displacement), (a.normal, b.normal), (a.position, b.position)] {
            let [ax, az] = turn(a[0], a[2]);
            let error = (ax - b[0]).abs() + (a[1] - b[1]).abs() + (az - b[2]).abs();
            assert!(error < 1e-3, "({x}, {z}): {a:?} {b:?}");
        }
        let above = Surface::above(&turned, b.position[0], b.position[2]);
        assert!((above.height() - b.height()).abs() < 1e-5);
    }
}

#[test]
fn a_folded_sea_is_answered_honestly() {
    let mut sea = settings(Spectrum::Jonswap);
    sea.cascades[0].choppiness = 4.0;
    let maps = maps(&sea, 2.0);
    let mut folded = 0;
    for step in 0..2000 {
        let (x, z) = (f64::from(step) * 0.53, f64::from(step * step % 613) * 0.19);
        let above = Surface::above(&maps, x, z);
        let miss = (above.position[0] - x).hypot(above.position[2] - z);
        assert!((miss - above.residual).abs() < 1e-9 && above.iterations <= 64);
        folded += u32::from(above.residual > 1e-3);
    }
    assert!(folded < 100, "{folded} of 2000 points not found");
}

/// Points all over, some of them whole texels, their number no multiple of any number of lanes.
fn points() -> Vec<[f64; 2]> {
    (0..1003)
        .map(f64::from)
        .map(|step| [step * 1.37 - 500.0, if step % 10.0 == 0.0 { step } else { step * step % 997.0 * 0.71 }])
        .collect()
}

#[test]
fn many_at_a_time_are_answered_as_one_alone() {
    let mut folded = settings(Spectrum::Jonswap);
    folded.cascades[0].choppiness = 4.0;
    for sea in [settings(Spectrum::Jonswap), cascades(), folded] {
        let maps = maps(&sea, 31.0);
        let (query, points) = (Query::new(&maps), points());
        let alone: Vec<_> = points.iter().map(|&[x, z]| Surface::above(&maps, x, z)).collect();
        let mut together = vec![Surface::at_rest(&maps, 0.0, 0.0); points.len()];
        query.above_many(&points, &mut together);
        assert_eq!(alone, together);
        // In another company.
        let mut later = vec![0.0; points.len() - 3];
        query.heights(&points[3..], &mut later);
        for (alone, height) in alone[3..].iter().zip(later) {
            assert!((alone.height() - height).abs() < 1e-9, "{alone:?} {height}");
        }
    }
}

#[test]
fn all_instruction_sets_answer_alike() {
    for sea in [settings(Spectrum::Jonswap), cascades()] {
        let maps = maps(&sea, 31.0);
        let points = points();
        let ask = |isa| {
            let query = Query::with_isa(&maps, isa);
            let mut surfaces = vec![Surface::at_rest(&maps, 0.0, 0.0); points.len()];
            query.above_many(&points, &mut surfaces);
            let mut heights = vec![0.0; points.len()];
            query.heights(&points, &mut heights);
            (surfaces, heights)
        };
        let best = ask(Isa::best());
        for isa in Isa::available() {
            assert!(ask(isa) == best, "{isa} answers differently");
        }
    }
}

/// A long search costs a hundred times what most points do.
#[test]
fn nearly_all_points_are_found_without_a_search() {
    for sea in [settings(Spectrum::Jonswap), cascades()] {
        let maps = maps(&sea, 31.0);
        let points = points();
        let mut surfaces = vec![Surface::at_rest(&maps, 0.0, 0.0); points.len()];
        Query::new(&maps).above_many(&points, &mut surfaces);
        let searched = surfaces.iter().filter(|surface| surface.iterations > 6).count();
        assert!(searched * 100 < points.len(), "{searched} of {} points were searched for", points.len());
    }
}

#[test]
fn no_point_is_answered_with_no_number_and_harms_no_other() {
    let maps = maps(&cascades(), 3.0);
    let mut heights = [0.0; 3];
    Query::new(&maps).heights(&[[1.0, 2.0], [f64::NAN, 0.0], [3.0, f64::INFINITY]], &mut heights);
    assert!((heights[0] - Surface::above(&maps, 1.0, 2.0).height()).abs() < 1e-9);
    assert!(heights[1].is_nan() && heights[2].is_nan());
}

#[test]
fn without_cascades_the_sea_is_flat() {
    let flat = SeaMaps { cascades: Vec::new(), ..maps(&settings(Spectrum::Jonswap), 0.0) };
    let surface = Surface::above(&flat, 12.5, -7.0);
    assert_eq!((surface.position, surface.normal), ([12.5, 0.0, -7.0], [0.0, 1.0, 0.0]));
}

#[test]
fn normals_are_those_of_the_surface() {
    let maps = maps(&cascades(), 8.0);
    let d = 1e-3;
    let mut worst = 0.0_f64;
    for step in 0..200 {
        let (x, z) = (f64::from(step) * 3.1, f64::from(step) * -1.7);
        let normal = Surface::at_rest(&maps, x, z).normal;
        assert!((normal.iter().map(|n| n * n).sum::<f64>() - 1.0).abs() < 1e-12);
        let along = |dx: f64, dz: f64| {
            let (a, b) = (Surface::at_rest(&maps, x + dx, z + dz), Surface::at_rest(&maps, x - dx, z - dz));
            [0, 1, 2].map(|i| a.position[i] - b.position[i])
        };
        // The drawn facets' own tangents lie across the smooth normal, up to the facets' size.
        for tangent in [along(d, 0.0), along(0.0, d)] {
            let length = tangent.iter().map(|t| t * t).sum::<f64>().sqrt();
            worst = worst.max(normal.iter().zip(tangent).map(|(n, t)| n * t).sum::<f64>().abs() / length);
        }
    }
    assert!(worst < 0.15, "{worst}");
}

#[test]
fn a_thousand_kilometres_out_nothing_is_lost() {
    let maps = maps(&settings(Spectrum::Jonswap), 14.0);
    // 80 m divide 1 000 000 m.
    let (near, far) = (Surface::above(&maps, 3.3, 4.4), Surface::above(&maps, 1_000_003.3, -999_995.6));
    assert!((near.height() - far.height()).abs() < 1e-7, "{near:?} {far:?}");
}
