//! What a model says about a rest point.
use std::ops::Add;

/// Displacement of a rest point, its derivatives along the rest plane, and foam. Axes are the world's (x, y, z).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// Metres.
    pub displacement: [f64; 3],
    /// Derivative of the displacement along x.
    pub along_x: [f64; 3],
    /// Derivative of the displacement along z.
    pub along_z: [f64; 3],
    /// Foam cover, 0..=1.
    pub foam: f64,
}

impl Sample {
    /// Tangent of the displaced surface along x.
    pub fn tangent(&self) -> [f64; 3] {
        let [x, y, z] = self.along_x;
        [1.0 + x, y, z]
    }

    /// Tangent of the displaced surface along z.
    pub fn binormal(&self) -> [f64; 3] {
        let [x, y, z] = self.along_z;
        [x, y, 1.0 + z]
    }

    /// Unit normal: binormal x tangent. Straight up where both vanish.
    pub fn normal(&self) -> [f64; 3] {
        let ([tx, ty, tz], [bx, by, bz]) = (self.tangent(), self.binormal());
        let cross = [by * tz - bz * ty, bz * tx - bx * tz, bx * ty - by * tx];
        let length = cross.iter().map(|part| part * part).sum::<f64>().sqrt();
        if length > 0.0 { cross.map(|part| part / length) } else { [0.0, 1.0, 0.0] }
    }

    /// Determinant of the horizontal map from rest to displaced points; below 0 the surface has folded over.
    pub fn jacobian(&self) -> f64 {
        (1.0 + self.along_x[0]) * (1.0 + self.along_z[2]) - self.along_x[2] * self.along_z[0]
    }
}

impl Add for Sample {
    type Output = Self;

    /// Displacements and derivatives are summed; foam is too, up to 1.
    fn add(self, other: Self) -> Self {
        let sum = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|i| a[i] + b[i]);
        Self {
            displacement: sum(self.displacement, other.displacement),
            along_x: sum(self.along_x, other.along_x),
            along_z: sum(self.along_z, other.along_z),
            foam: (self.foam + other.foam).min(1.0),
        }
    }
}
