//! Unit meshes: one metre across, centred, closed, counter-clockwise seen from outside.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use std::f32::consts::{PI, TAU};
use std::ops::Range;

/// A corner and the direction out of the surface there.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SolidVertex {
    pub position: [f32; 3],
    pub normal: [f32; 3],
}

/// Where a mesh is in the common buffers.
#[derive(Clone, Debug)]
pub struct Part {
    pub indices: Range<u32>,
    pub vertices: u32,
}

/// Several meshes in one pair of buffers.
#[derive(Default)]
pub struct Meshes {
    pub vertices: Vec<SolidVertex>,
    pub indices: Vec<u16>,
}

/// Sides of a cylinder, and meridians of a ball.
const AROUND: u16 = 24;
/// Rows of a ball from pole to pole.
const ROWS: u16 = 14;

impl Meshes {
    /// Adds what `add` adds, and says where it is.
    pub fn part(&mut self, add: impl Fn(&mut Self)) -> Part {
        let start = (self.indices.len() as u32, self.vertices.len() as u32);
        add(self);
        Part { indices: start.0..self.indices.len() as u32, vertices: self.vertices.len() as u32 - start.1 }
    }

    fn vertex(&mut self, position: Vec3, normal: Vec3) -> u16 {
        self.vertices.push(SolidVertex { position: position.into(), normal: normal.into() });
        (self.vertices.len() - 1) as u16
    }

    /// A cube of side 1.
    pub fn cube(&mut self) {
        for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
            for normal in [axis, -axis] {
                // Any vector across; the third completes a right-handed triad, so that the corners go round.
                let across = Vec3::new(axis.y, axis.z, axis.x);
                let along = normal.cross(across);
                let corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
                    .map(|(a, b)| self.vertex(0.5 * normal + a * across + b * along, normal));
                let [a, b, c, d] = corners;
                self.indices.extend([a, b, c, c, d, a]);
            }
        }
    }

    /// A ball of diameter 1.
    pub fn ball(&mut self) {
        let first = self.vertices.len() as u16;
        for row in 0..=ROWS {
            let (up_sin, up_cos) = (PI * f32::from(row) / f32::from(ROWS)).sin_cos();
            for column in 0..=AROUND {
                let (sin, cos) = (TAU * f32::from(column) / f32::from(AROUND)).sin_cos();
                let normal = Vec3::new(up_sin * cos, up_cos, -up_sin * sin);
                self.vertex(0.5 * normal, normal);
            }
        }
        for row in 0..ROWS {
            for column in 0..AROUND {
                let above = first + row * (AROUND + 1) + column;
                let below = above + AROUND + 1;
                // At the poles one of the two triangles has no area.
                if row > 0 {
                    self.indices.extend([above, below + 1, above + 1]);
                }
                if row + 1 < ROWS {
                    self.indices.extend([above, below, below + 1]);
                }
            }
        }
    }

    /// A cylinder along y, 1 high and 1 across.
    pub fn cylinder(&mut self) {
        let around = |column: u16| {
            let (sin, cos) = (TAU * f32::from(column) / f32::from(AROUND)).sin_cos();
            Vec3::new(cos, 0.0, -sin)
        };
        for column in 0..AROUND {
            let [here, next] = [around(column), around(column + 1)];
            let half = 0.5 * Vec3::Y;
            let [a, b, c, d] = [(here, -half), (next, -half), (next, half), (here, half)]
                .map(|(out, up)| self.vertex(0.5 * out + up, out));
            self.indices.extend([a, b, c, c, d, a]);
        }
        for (up, turn) in [(Vec3::Y, 1), (-Vec3::Y, -1)] {
            let middle = self.vertex(0.5 * up, up);
            for column in 0..AROUND {
                self.vertex(0.5 * around(column) + 0.5 * up, up);
            }
            for column in 0..AROUND {
                let [a, b] = [middle + 1 + column, middle + 1 + (column + 1) % AROUND];
                self.indices.extend(if turn > 0 { [middle, a, b] } else { [middle, b, a] });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;

    fn meshes() -> [(&'static str, Meshes, f32); 3] {
        let mut meshes = [Meshes::default(), Meshes::default(), Meshes::default()];
        meshes[0].cube();
        meshes[1].ball();
        meshes[2].cylinder();
        let [cube, ball, cylinder] = meshes;
        [("cube", cube, 1.0), ("ball", ball, PI / 6.0), ("cylinder", cylinder, PI / 4.0)]
    }

    #[test]
    fn meshes_are_closed_and_face_outwards() {
        for (name, mesh, volume) in meshes() {
            let place = |i: u16| Vec3::from(mesh.vertices[usize::from(i)].position);
            let (mut edges, mut enclosed) = (HashMap::<_, i32>::new(), 0.0);
            let key = |v: Vec3| (v * 4096.0).round().as_ivec3();
            for triangle in mesh.indices.chunks_exact(3) {
                let corners = [place(triangle[0]), place(triangle[1]), place(triangle[2])];
                let [a, b, c] = corners;
                let out = (b - a).cross(c - a);
                assert!(out.length() > 1e-5, "{name}: a triangle without area");
                let normal: Vec3 =
                    triangle.iter().map(|&i| Vec3::from(mesh.vertices[usize::from(i)].normal)).sum();
                assert!(out.dot(normal) > 0.0, "{name}: {corners:?} faces inwards");
                enclosed += a.dot(b.cross(c)) / 6.0;
                for [from, to] in [[a, b], [b, c], [c, a]] {
                    *edges.entry((key(from), key(to))).or_default() += 1;
                    *edges.entry((key(to), key(from))).or_default() -= 1;
                }
            }
            assert!(edges.values().all(|&count| count == 0), "{name} is open");
            // Flat facets enclose a little less than the round thing.
            assert!(enclosed > 0.96 * volume && enclosed < 1.0001 * volume, "{name}: {enclosed} m3");
        }
    }
}
