//! Density by the wave signal: seams stay closed, slides end where the coarser mesh begins, and vertices are where waves are.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod lod_support;
use glam::{DVec3, Vec2};
use lod_support::{QUALITIES, Random, settings};
use std::collections::{BTreeSet, HashMap};
use swell::lod::tessellation::{Component, Density, Mesh, Pieces, Side, Signal, Vertex, vertex_position};
use swell::lod::{
    Edge, Frustum, Instance, LodSettings, Node, Pattern, Quadtree, Quality, SignalSettings, Tessellation,
    grid,
};

const ALL: [Frustum; 1] = [Frustum::everywhere()];

/// Waves of some length, from none at all to more than any patch can carry, and ranges of every kind.
fn signal(random: &mut Random) -> SignalSettings {
    let least = random.between(0.0, 1.0);
    let near = random.between(0.0, 800.0);
    let frequency = if random.below(16) == 0 { 0.0 } else { 10.0_f64.powf(random.between(-3.5, 1.0)) };
    SignalSettings {
        frequency,
        density: random.between(0.3, 3.0),
        fresnel: [least, random.between(least, 1.0)],
        distance: [near, near + random.between(1.0, 6000.0)],
    }
}

fn tree(size: f64, quality: Quality, levels: Option<u32>, signal: SignalSettings) -> Quadtree {
    let tessellation = Tessellation::Signal(signal);
    Quadtree::new(&LodSettings { tessellation, ..settings(size, quality, levels) }).unwrap()
}

type Corners = [[u32; 2]; 3];

fn bits(place: Vec2) -> [u32; 2] {
    // Adding 0 makes -0 the same as 0.
    (place + 0.0).to_array().map(f32::to_bits)
}

/// Every triangle that is drawn, by the bits of its corners, and how many draws that takes.
fn triangles(tree: &Quadtree, mesh: &Mesh) -> (Vec<Corners>, usize) {
    let selection = tree.selection();
    let (mut triangles, mut draws) = (Vec::new(), 0);
    for batch in selection.batches() {
        draws += 1;
        let range = mesh.pieces[batch.mesh].clone();
        let indices = &mesh.indices[range.start as usize..range.end as usize];
        assert!(!indices.is_empty(), "mesh {} is drawn and is nothing", batch.mesh);
        for instance in &selection.instances()[batch.instances.start as usize..batch.instances.end as usize] {
            let corner = |&index: &u16| bits(vertex_position(instance, mesh.vertices[usize::from(index)]));
            triangles.extend(indices.chunks_exact(3).map(|t| [corner(&t[0]), corner(&t[1]), corner(&t[2])]));
        }
    }
    (triangles, draws)
}

/// Sides cancel against sides run the other way round, but for the border's; nothing is turned over; the area is the root's.
fn check_sheet(triangles: &[Corners], size: f64) {
    let mut sides: HashMap<[[u32; 2]; 2], i32> = HashMap::new();
    let mut area = 0.0;
    for corners in triangles {
        let [a, b, c] = corners.map(|p| Vec2::from(p.map(f32::from_bits)).as_dvec2());
        let doubled = -(b - a).perp_dot(c - a);
        assert!(doubled >= 0.0, "turned over: {a} {b} {c}");
        area += doubled / 2.0;
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            if corners[from] != corners[to] {
                *sides.entry([corners[from], corners[to]]).or_default() += 1;
            }
        }
    }
    assert!((area - size * size).abs() < 1e-6 * area, "{area}");
    let half = (size / 2.0) as f32;
    for (&[from, to], &count) in &sides {
        let back = sides.get(&[to, from]).copied().unwrap_or(0);
        let ends = [from, to].map(|p| p.map(f32::from_bits));
        let on_border =
            [0, 1].into_iter().any(|axis| ends[0][axis].abs() == half && ends[0][axis] == ends[1][axis]);
        assert!(on_border || count == back, "a crack or a T-junction: {ends:?}, {count} and {back}");
    }
}

/// Over random views and signals: from one flat square to every patch as dense as can be, and most in between.
#[test]
fn the_mesh_is_a_sheet_without_holes() {
    let mut random = Random(71);
    let (mut most_draws, mut in_pieces, mut whole) = (0, 0, 0);
    for quality in QUALITIES {
        let mesh = Mesh::new(quality.preset().cells);
        for (size, levels, views) in
            [(2048.0, None, 12), (8192.0, Some(8), 4), (256.0, Some(0), 3), (1536.0, Some(2), 4)]
        {
            for _ in 0..views {
                let mut tree = tree(size, quality, levels, signal(&mut random));
                tree.select(random.viewer(), &ALL);
                let (triangles, draws) = triangles(&tree, &mesh);
                check_sheet(&triangles, size);
                let selection = tree.selection();
                let pieces = selection.instances().len();
                in_pieces += (pieces - selection.patches()) / 4;
                whole += selection.patches();
                most_draws = most_draws.max(draws);
            }
        }
    }
    println!("{whole} patches, {in_pieces} of them in pieces; at most {most_draws} draws");
    assert!(in_pieces > 20, "{in_pieces} patches in pieces are too few to tell");
}

/// Vertices along an edge of a leaf, from low to high, that its pieces use.
fn along(tree: &Quadtree, mesh: &Mesh, node: Node, edge: Edge) -> BTreeSet<[u32; 2]> {
    let selection = tree.selection();
    let centre = node.centre(tree.size());
    let size = node.size(tree.size()) as f32;
    let is_own = |i: &Instance| (i.centre_x, i.centre_z, i.size) == (centre.x as f32, centre.y as f32, size);
    let mut found = BTreeSet::new();
    for batch in selection.batches() {
        let instances = &selection.instances()[batch.instances.start as usize..batch.instances.end as usize];
        let Some(instance) = instances.iter().find(|instance| is_own(instance)) else { continue };
        let range = mesh.pieces[batch.mesh].clone();
        for &index in &mesh.indices[range.start as usize..range.end as usize] {
            let vertex: Vertex = mesh.vertices[usize::from(index)];
            let on_edge = match edge {
                Edge::East => vertex.place[0] == 64,
                Edge::West => vertex.place[0] == 0,
                Edge::North => vertex.place[1] == 64,
                Edge::South => vertex.place[1] == 0,
            };
            if on_edge {
                found.insert(bits(vertex_position(instance, vertex)));
            }
        }
    }
    found
}

/// Both sides of an edge compute the same factor and use the same vertices, whether the patches are of one size or not.
#[test]
fn both_sides_of_an_edge_agree() {
    let mut random = Random(72);
    let (mut equal, mut halves) = (0, 0);
    for quality in QUALITIES {
        let mesh = Mesh::new(quality.preset().cells);
        for _ in 0..3 {
            let signal = signal(&mut random);
            let mut tree = tree(4096.0, quality, None, signal);
            let viewer = random.viewer();
            tree.select(viewer, &ALL);
            let origin = tree.selection().origin();
            let density = Density::new(signal, viewer - DVec3::new(origin.x, 0.0, origin.y), tree.size());
            let leaves: BTreeSet<Node> = tree.selection().leaves().iter().map(|leaf| leaf.node).collect();
            for &node in &leaves {
                for edge in Edge::ALL {
                    let Some(across) = node.neighbour(edge) else { continue };
                    let opposite = edge.opposite();
                    assert_eq!(Side::of(node, edge), Side::of(across, opposite));
                    assert_eq!(
                        density.factor(Side::of(node, edge)),
                        density.factor(Side::of(across, opposite))
                    );
                    let mine = along(&tree, &mesh, node, edge);
                    if leaves.contains(&across) {
                        assert_eq!(mine, along(&tree, &mesh, across, opposite), "{node:?} {edge:?}");
                        equal += 1;
                    } else if tree.map().is_divided(across) {
                        let small = across
                            .children()
                            .into_iter()
                            .filter(|c| c.neighbour(opposite).and_then(Node::parent) == Some(node));
                        let theirs: BTreeSet<_> =
                            small.flat_map(|child| along(&tree, &mesh, child, opposite)).collect();
                        assert_eq!(mine, theirs, "{node:?} {edge:?} and two smaller ones");
                        halves += 1;
                    }
                }
            }
        }
    }
    assert!(equal > 1000 && halves > 200, "{equal} {halves}");
}

/// Triangles with an area of one patch, each from its lowest corner on.
fn shapes(mesh: &Mesh, inside: u8, edges: [u8; 4], weights: [f32; 5]) -> BTreeSet<Corners> {
    let [morph, edge_morph @ ..] = weights;
    let instance = Instance { centre_x: 0.0, centre_z: 0.0, size: 64.0, morph, edge_morph };
    let pieces = Pieces::new(64);
    let numbers: Vec<usize> = if inside == 0 {
        vec![Pieces::QUAD]
    } else {
        let strips =
            Edge::ALL.into_iter().zip(edges).map(|(edge, segments)| pieces.strip(edge, inside, segments));
        pieces.inside(inside).into_iter().chain(strips).collect()
    };
    let of = |numbers: &[usize]| {
        let mut shapes = BTreeSet::new();
        for &number in numbers {
            let range = mesh.pieces[number].clone();
            for triangle in mesh.indices[range.start as usize..range.end as usize].chunks_exact(3) {
                let places =
                    [0, 1, 2].map(|k| vertex_position(&instance, mesh.vertices[usize::from(triangle[k])]));
                if (places[1] - places[0]).perp_dot(places[2] - places[0]) != 0.0 {
                    let mut corners = places.map(bits);
                    let lowest = (0..3).min_by_key(|&k| corners[k]).unwrap();
                    corners.rotate_left(lowest);
                    shapes.insert(corners);
                }
            }
        }
        shapes
    };
    let shapes = of(&numbers);
    if let Some(whole) = (inside > 0).then(|| pieces.whole(inside, edges)).flatten() {
        assert_eq!(of(&[whole]), shapes, "the whole patch {inside} {edges:?} is not its pieces");
    }
    shapes
}

/// A factor that grows past a power of two changes no triangle: the denser mesh begins as the coarser one.
#[test]
fn growing_past_a_power_of_two_changes_no_triangle() {
    let mesh = Mesh::new(64);
    let mut random = Random(73);
    let zero = [0.0; 5];
    for inside in 1..=6_u8 {
        for _ in 0..60 {
            let edges = [0; 4].map(|_| random.below(7) as u8);
            let plain = shapes(&mesh, inside, edges, zero);
            if inside < 6 {
                let mut weights = zero;
                weights[0] = 1.0;
                assert_eq!(shapes(&mesh, inside + 1, edges, weights), plain, "inside {inside} {edges:?}");
            }
            for edge in 0..4 {
                if edges[edge] < 6 {
                    let (mut finer, mut weights) = (edges, zero);
                    finer[edge] += 1;
                    weights[1 + edge] = 1.0;
                    assert_eq!(
                        shapes(&mesh, inside, finer, weights),
                        plain,
                        "{inside} {edges:?}, edge {edge}"
                    );
                }
            }
        }
    }
    assert_eq!(shapes(&mesh, 1, [0; 4], [1.0; 5]), shapes(&mesh, 0, [0; 4], zero));
}

/// Where waves are shorter than any patch can carry, the mesh is the plain grid's.
#[test]
fn short_waves_give_the_plain_grid() {
    let mut random = Random(74);
    let short = SignalSettings { frequency: 100.0, density: 1.0, fresnel: [1.0, 1.0], distance: [1e5, 2e5] };
    for quality in QUALITIES {
        let cells = quality.preset().cells;
        let mesh = Mesh::new(cells);
        let patterns: Vec<Vec<u16>> = Pattern::all().map(|pattern| grid::indices(cells, pattern)).collect();
        let mut tree = tree(2048.0, quality, None, short);
        let mut plain = lod_support::tree(2048.0, quality, None);
        for _ in 0..2 {
            let viewer = random.viewer();
            tree.select(viewer, &ALL);
            let mut wanted = BTreeSet::new();
            let selection = plain.select(viewer, &ALL);
            for leaf in selection.leaves() {
                let instance = &selection.instances()[leaf.instance.unwrap() as usize];
                for t in patterns[leaf.pattern.index()].chunks_exact(3) {
                    let mut corners = [0, 1, 2].map(|k| {
                        let v = u32::from(t[k]);
                        let (i, j) = (v % (cells + 1), v / (cells + 1));
                        bits(swell::lod::vertex_position(instance, leaf.pattern, cells, i, j))
                    });
                    corners.sort_unstable();
                    wanted.insert(corners);
                }
            }
            let (mut found, _) = triangles(&tree, &mesh);
            found.iter_mut().for_each(|corners| corners.sort_unstable());
            assert_eq!(found.into_iter().collect::<BTreeSet<_>>(), wanted, "{quality:?}");
        }
    }
}

/// A flat sea is two triangles a patch, but for the corners of smaller ones; one patch alone is two triangles.
#[test]
fn a_flat_sea_has_no_vertices_to_spare() {
    let flat =
        SignalSettings { frequency: 0.0, density: 1.0, fresnel: [0.0, 1.0], distance: [100.0, 4000.0] };
    let mesh = Mesh::new(32);
    let mut random = Random(75);
    let mut flat_tree = tree(4096.0, Quality::Medium, None, flat);
    for _ in 0..20 {
        flat_tree.select(random.viewer(), &ALL);
        let (triangles, _) = triangles(&flat_tree, &mesh);
        let patches = flat_tree.selection().patches();
        assert!(triangles.len() <= 8 * patches, "{} triangles for {patches} patches", triangles.len());
    }
    let mut quad = tree(256.0, Quality::Medium, Some(0), flat);
    quad.select(DVec3::new(3.0, 2.0, 5.0), &ALL);
    assert_eq!(triangles(&quad, &mesh).0.len(), 2);
    // The same patch over waves of 16 m: 2 f |p1 - p2| = 32.
    let waves = SignalSettings { frequency: 1.0 / 16.0, fresnel: [1.0, 1.0], distance: [1e4, 2e4], ..flat };
    let mut quad = tree(256.0, Quality::Medium, Some(0), waves);
    quad.select(DVec3::new(3.0, 2.0, 5.0), &ALL);
    assert_eq!(triangles(&quad, &mesh).0.len(), 2 * 32 * 32);
}

/// The factor's formula, term by term.
#[test]
fn an_edges_factor_is_the_formula() {
    let settings =
        SignalSettings { frequency: 0.25, density: 1.5, fresnel: [0.2, 0.9], distance: [50.0, 450.0] };
    let side = Side::of(Node { level: 2, x: 1, y: 2 }, Edge::East);
    // Of a root of 1024 m: from (0, 0) to (0, 256).
    let at = |x: f64, y: f64, z: f64| Density::new(settings, DVec3::new(x, y, z), 1024.0).factor(side);
    let full = 2.0 * 0.25 * 256.0 * 1.5;
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-9 * b, "{a} {b}");
    // From straight above; from far away, level; from between.
    close(at(0.0, 20.0, 128.0), full * 0.2);
    close(at(250.0, 0.0, 128.0), full * 0.9 * 0.5);
    let between = (1.0 - 0.1_f64).powi(5);
    close(at(99.0_f64.sqrt() * 10.0, 10.0, 128.0), full * between * (1.0 - 50.0 / 400.0));
    close(at(500.0, 0.0, 128.0), 1.0);
}

#[test]
fn the_highest_frequency_is_that_of_waves_that_displace() {
    let waves = [(0.01, 1.0), (0.1, 0.3), (1.0, 0.02), (0.5, 0.0)];
    let signal = Signal(waves.map(|(frequency, amplitude)| Component { frequency, amplitude }).to_vec());
    for (threshold, frequency) in [(0.0, 1.0), (0.02, 1.0), (0.021, 0.1), (0.5, 0.01), (2.0, 0.0)] {
        assert_eq!(signal.highest_frequency(threshold), frequency);
    }
}

#[test]
fn settings_out_of_range_are_named() {
    let good = SignalSettings { frequency: 0.1, density: 1.0, fresnel: [0.5, 1.0], distance: [0.0, 1.0] };
    assert!(good.check().is_ok());
    let cases = [
        ("frequency", SignalSettings { frequency: -1.0, ..good }),
        ("density", SignalSettings { density: f64::NAN, ..good }),
        ("least fresnel", SignalSettings { fresnel: [-0.1, 1.0], ..good }),
        ("largest fresnel", SignalSettings { fresnel: [0.5, 0.4], ..good }),
        ("near distance", SignalSettings { distance: [f64::INFINITY, 1.0], ..good }),
        ("far distance", SignalSettings { distance: [5.0, 5.0], ..good }),
    ];
    for (key, bad) in cases {
        let error = bad.check().unwrap_err().to_string();
        assert!(error.contains(&format!("`{key}`")), "{key}: {error}");
    }
}

/// What is reserved at first is enough for any viewer.
#[test]
fn memory_is_reserved_once() {
    let mut random = Random(76);
    for quality in QUALITIES {
        for (size, levels) in [(8192.0, Some(10)), (4096.0, None)] {
            let mut tree = tree(size, quality, levels, signal(&mut random));
            tree.select(DVec3::ZERO, &ALL);
            let places = |tree: &Quadtree| {
                let selection = tree.selection();
                (selection.instances().as_ptr(), selection.leaves().as_ptr())
            };
            let first = places(&tree);
            for _ in 0..300 {
                tree.select(random.viewer(), &ALL);
                assert_eq!(places(&tree), first);
                assert!(tree.selection().instances().len() <= 4096, "more than the ring has room for");
            }
        }
    }
}
