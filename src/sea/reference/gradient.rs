//! Normals, the Jacobian and packing, as printed.
use crate::sea::{CascadeSettings, NormalKind};

/// `[n_u, n_y, n_v, J]` at every grid point of a field of (Du, h, Dv), eqs (45)-(49), normals of the length of (49).
pub fn gradient(field: &[[f64; 3]], cascade: &CascadeSettings, normals: NormalKind) -> Vec<[f64; 4]> {
    let n = cascade.resolution as i64;
    let at = |c: i64, r: i64| field[(r.rem_euclid(n) * n + c.rem_euclid(n)) as usize];
    let scale = 0.5 * n as f64 / cascade.patch_size;
    let derivative = |ahead: [f64; 3], back: [f64; 3]| [0, 1, 2].map(|i: usize| (ahead[i] - back[i]) * scale);
    let r = cascade.roughness;
    let length = 1.0 - r * (0.306 + r * (0.113 + r * 0.081));
    let mut out = Vec::new();
    for row in 0..n {
        for column in 0..n {
            let along_u = derivative(at(column + 1, row), at(column - 1, row));
            let along_v = derivative(at(column, row + 1), at(column, row - 1));
            let tangent_u = [1.0 + along_u[0], along_u[1], along_u[2]];
            let tangent_v = [along_v[0], along_v[1], 1.0 + along_v[2]];
            let jacobian = tangent_u[0] * tangent_v[2] - tangent_u[2] * tangent_v[0];
            let normal = match normals {
                NormalKind::Exact => {
                    let [x, y, z] = cross(tangent_v, tangent_u);
                    [x, y.abs(), z]
                }
                NormalKind::Sheet => [-along_u[1], 1.0, -along_v[1]],
            };
            let norm = normal.iter().map(|part| part * part).sum::<f64>().sqrt();
            let [x, y, z] = normal.map(|part| part / norm * length);
            out.push([x, y, z, jacobian]);
        }
    }
    out
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Eq (53).
pub fn smoothness(length: f64) -> f64 {
    let t = ((length - 2.0 / 3.0) / (1.0 / 3.0)).clamp(0.0, 1.0);
    let r = 1.0 - t * (0.85 + 0.15 * t);
    1.0 - r.max(0.0).sqrt()
}

/// The four values of eq (50) before rounding to bytes, 0..=255.
pub fn unrounded([x, y, z, jacobian]: [f64; 4]) -> [f64; 4] {
    let length = (x * x + y * y + z * z).sqrt();
    [
        (x / length * 0.5 + 0.5) * 255.0,
        (z / length * 0.5 + 0.5) * 255.0,
        (jacobian * 0.5 + 0.5).clamp(0.0, 1.0) * 255.0,
        smoothness(length) * 255.0,
    ]
}
