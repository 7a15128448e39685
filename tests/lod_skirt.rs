//! The skirt covers the plane outside the quadtree once, to the horizon.
mod lod_support;
use glam::{DMat3, DVec3, dvec3};
use lod_support::Random;
use swell::lod::skirt::{FADE_END, SKIRT_INNER};
use swell::lod::{border_fade, skirt};

/// Triangles of the skirt as homogeneous points (x, z, w) of the sea's plane.
fn triangles(size: f64, extent: f64) -> Vec<[DVec3; 3]> {
    let (vertices, indices) = skirt(size, extent);
    let point = |index: &u16| {
        let [x, _, z, w] = vertices[usize::from(*index)].position.map(f64::from);
        dvec3(x, z, w)
    };
    indices.chunks_exact(3).map(|t| [point(&t[0]), point(&t[1]), point(&t[2])]).collect()
}

fn side(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    DMat3::from_cols(a, b, c).determinant()
}

/// Inside a triangle with corners at infinity too: on the same side of its three lines as its own third corner.
fn holds([a, b, c]: [DVec3; 3], p: DVec3) -> bool {
    let whole = side(a, b, c);
    [side(a, b, p), side(b, c, p), side(c, a, p)].into_iter().all(|s| s * whole > 0.0)
}

#[test]
fn the_plane_outside_is_covered_exactly_once() {
    let mut random = Random(31);
    for (size, extent) in [(256.0, 1.0), (4096.0, 10.0), (8192.0, 3.0)] {
        let triangles = triangles(size, extent);
        let inner = 0.5 * SKIRT_INNER * size;
        for _ in 0..20_000 {
            let far = inner * 10.0_f64.powf(random.between(-0.5, 6.0));
            let p = dvec3(random.between(-far, far), random.between(-far, far), 1.0);
            let covers = triangles.iter().filter(|&&t| holds(t, p)).count();
            let outside = p.x.abs().max(p.y.abs()) > inner * (1.0 + 1e-6);
            assert_eq!(covers, usize::from(outside), "{p} of {size}");
        }
        // The horizon itself: every direction but the four mitres lies on one outer side.
        for _ in 0..1_000 {
            let angle = random.between(0.0, std::f64::consts::TAU);
            let p = dvec3(angle.cos() * 1.0e9, angle.sin() * 1.0e9, 1.0);
            assert_eq!(triangles.iter().filter(|&&t| holds(t, p)).count(), 1);
        }
    }
}

/// With x = i and z = j on the plane, counter-clockwise from above is a negative turn in (x, z).
#[test]
fn triangles_face_up() {
    assert!(triangles(4096.0, 10.0).into_iter().all(|[a, b, c]| side(a, b, c) < 0.0));
}

#[test]
fn it_lies_below_rest_and_starts_under_the_quadtree() {
    let (vertices, _) = skirt(4096.0, 10.0);
    for vertex in vertices {
        let [x, y, z, w] = vertex.position;
        let far = x.abs().max(z.abs());
        if w == 0.0 {
            assert_eq!((far, y), (1.0, 0.0), "a direction along the plane");
        } else {
            assert!(y < 0.0 && y > -0.1);
            assert!(far == 40_960.0 || (far < 2048.0 && far > 0.95 * 2048.0), "{far}");
        }
    }
}

#[test]
fn waves_end_before_the_border() {
    let size = 4096.0;
    assert_eq!(border_fade(0.0, 0.0, size), 1.0);
    assert_eq!(border_fade(-0.69 * 2048.0, 300.0, size), 1.0);
    assert_eq!(border_fade(10.0, FADE_END * 2048.0, size), 0.0);
    assert_eq!(border_fade(2048.0, -2048.0, size), 0.0);
    assert!((border_fade(0.84 * 2048.0, 0.0, size) - 0.5).abs() < 1e-5);
    // Almost flat already where the skirt begins below it.
    assert!(border_fade(SKIRT_INNER as f32 * 2048.0, 0.0, size) < 0.005);
    let along: Vec<f32> = (0..=2048).map(|x| border_fade(x as f32, 0.0, size)).collect();
    assert!(along.is_sorted_by(|a, b| a >= b));
}
