//! Daylight after Preetham, Shirley and Smits, "A Practical Analytic Model for Daylight" (SIGGRAPH 1999).
//!
//! Luminance is in kcd/m^2 and illuminance in klx, as linear Rec. 709 whose luminance is the stated quantity.

use glam::Vec3;
use std::f32::consts::PI;

/// A clear or hazy sky for one position of the sun.
pub struct Daylight {
    sun: Vec3,
    zenith: Vec3,
    perez: [Perez; 3],
    at_zenith: Vec3,
    sun_light: Vec3,
}

/// The five coefficients of Perez's sky luminance distribution.
struct Perez([f32; 5]);

impl Perez {
    /// F of the paper's equation (3), for the cosine of the angle from the zenith and the angle from the sun.
    fn value(&self, cos_theta: f32, gamma: f32) -> f32 {
        let [a, b, c, d, e] = self.0;
        let cos_gamma = gamma.cos();
        (1.0 + a * (b / cos_theta).exp()) * (1.0 + c * (d * gamma).exp() + e * cos_gamma * cos_gamma)
    }
}

/// The model is made for suns above the horizon; lower ones light the sky as this one does, dimmed.
const LOWEST_SUN: f32 = 0.035;
/// Luminance of the sky falls to 1/e for each so many radians that the sun is below [`LOWEST_SUN`].
const DUSK: f32 = 0.05;
/// Where rays are taken to meet the horizon: the formula has no value at and below 90 degrees.
const LOWEST_RAY: f32 = 0.01;

impl Daylight {
    /// The sky with the sun towards the unit vector `sun`, at `turbidity` 1.7 (very clear) ..= 10 (hazy).
    pub fn new(sun: Vec3, turbidity: f32) -> Self {
        let t = turbidity;
        let elevation = sun.y.clamp(-1.0, 1.0).asin();
        let dusk = ((elevation - LOWEST_SUN).min(0.0) / DUSK).exp();
        let theta = PI / 2.0 - elevation.max(LOWEST_SUN);
        // Appendix A.2 of the paper: luminance Y and the chromaticities x and y.
        let perez = [
            Perez([
                0.1787 * t - 1.4630,
                -0.3554 * t + 0.4275,
                -0.0227 * t + 5.3251,
                0.1206 * t - 2.5771,
                -0.0670 * t + 0.3703,
            ]),
            Perez([
                -0.0193 * t - 0.2592,
                -0.0665 * t + 0.0008,
                -0.0004 * t + 0.2125,
                -0.0641 * t - 0.8989,
                -0.0033 * t + 0.0452,
            ]),
            Perez([
                -0.0167 * t - 0.2608,
                -0.0950 * t + 0.0092,
                -0.0079 * t + 0.2102,
                -0.0441 * t - 1.6537,
                -0.0109 * t + 0.0529,
            ]),
        ];
        let chi = (4.0 / 9.0 - t / 120.0) * (PI - 2.0 * theta);
        let luminance = ((4.0453 * t - 4.9710) * chi.tan() - 0.2155 * t + 2.4192).max(0.0);
        let cubic = |c: [f32; 4]| ((c[0] * theta + c[1]) * theta + c[2]) * theta + c[3];
        let square = |rows: [[f32; 4]; 3]| (cubic(rows[0]) * t + cubic(rows[1])) * t + cubic(rows[2]);
        let x = square([
            [0.001_66, -0.003_75, 0.002_09, 0.0],
            [-0.029_03, 0.063_77, -0.032_02, 0.003_94],
            [0.116_93, -0.211_96, 0.060_52, 0.258_86],
        ]);
        let y = square([
            [0.002_75, -0.006_10, 0.003_17, 0.0],
            [-0.042_14, 0.089_70, -0.041_53, 0.005_16],
            [0.153_46, -0.267_56, 0.066_70, 0.266_88],
        ]);
        let at_zenith = Vec3::from_array([0, 1, 2].map(|i| perez[i].value(1.0, theta)));
        let zenith = Vec3::new(luminance * dusk, x, y);
        let sun_light = sun_light(elevation, turbidity);
        Self { sun: Vec3::new(sun.x, theta.cos(), sun.z).normalize(), zenith, perez, at_zenith, sun_light }
    }

    /// Light from the unit vector `direction`, without the sun's disc; below the horizon, the horizon's.
    pub fn radiance(&self, direction: Vec3) -> Vec3 {
        let gamma = direction.dot(self.sun).clamp(-1.0, 1.0).acos();
        let cos_theta = direction.y.max(LOWEST_RAY);
        let value = |i: usize| self.zenith[i] * self.perez[i].value(cos_theta, gamma) / self.at_zenith[i];
        from_xyy(value(0), value(1), value(2))
    }

    /// Illuminance by the sun alone on a plane at right angles to it.
    pub const fn sun_light(&self) -> Vec3 {
        self.sun_light
    }
}

/// Appendix A.1: attenuation of the sun's light by molecules (Rayleigh) and haze (Angstrom), at the wavelengths that
/// stand for red, green and blue; ozone and water vapour are left out, being a few per cent.
fn sun_light(elevation: f32, turbidity: f32) -> Vec3 {
    /// Illuminance of the sun outside the air, klx.
    const OUTSIDE: f32 = 128.0;
    const WAVELENGTHS: [f32; 3] = [0.61, 0.55, 0.465];
    let degrees = elevation.to_degrees();
    if degrees < -1.0 {
        return Vec3::ZERO;
    }
    let mass = 1.0 / (elevation.max(0.0).sin() + 0.15 * (degrees.max(0.0) + 3.885).powf(-1.253));
    let beta = 0.046_08 * turbidity - 0.045_86;
    let setting = ((degrees + 1.0) / 1.5).clamp(0.0, 1.0);
    Vec3::from_array(WAVELENGTHS.map(|micrometres| {
        let air = (-0.008_735 * micrometres.powf(-4.08) * mass).exp();
        let haze = (-beta * micrometres.powf(-1.3) * mass).exp();
        OUTSIDE * air * haze * setting
    }))
}

/// CIE xyY to linear Rec. 709.
fn from_xyy(luminance: f32, x: f32, y: f32) -> Vec3 {
    let scale = luminance / y.max(1e-3);
    let (cx, cy, cz) = (x * scale, luminance, (1.0 - x - y) * scale);
    Vec3::new(
        3.2406 * cx - 1.5372 * cy - 0.4986 * cz,
        -0.9689 * cx + 1.8758 * cy + 0.0415 * cz,
        0.0557 * cx - 0.2040 * cy + 1.0570 * cz,
    )
    .max(Vec3::ZERO)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sun(elevation_deg: f32) -> Vec3 {
        let e = elevation_deg.to_radians();
        Vec3::new(e.cos(), e.sin(), 0.0)
    }

    fn luminance(c: Vec3) -> f32 {
        c.dot(Vec3::new(0.2126, 0.7152, 0.0722))
    }

    #[test]
    fn a_clear_noon_sky_is_blue_and_a_few_kilocandela() {
        let sky = Daylight::new(sun(60.0), 2.5);
        let zenith = sky.radiance(Vec3::Y);
        assert!(zenith.z > zenith.x, "{zenith}");
        assert!((1.0..15.0).contains(&luminance(zenith)), "{zenith}");
    }

    #[test]
    fn the_sky_brightens_towards_the_sun_and_the_horizon() {
        let sky = Daylight::new(sun(30.0), 3.0);
        let near = luminance(sky.radiance(sun(28.0)));
        let away = luminance(sky.radiance(Vec3::new(-0.8, 0.6, 0.0)));
        assert!(near > 2.0 * away, "{near} {away}");
        let horizon = luminance(sky.radiance(Vec3::new(0.0, 0.01, -1.0).normalize()));
        assert!(horizon > luminance(sky.radiance(Vec3::Y)));
    }

    #[test]
    fn a_low_sun_is_red_and_weak() {
        let high = Daylight::new(sun(60.0), 3.0).sun_light();
        let low = Daylight::new(sun(3.0), 3.0).sun_light();
        assert!(luminance(high) > 70.0 && luminance(high) < 128.0, "{high}");
        assert!(low.x / low.z > 3.0 * high.x / high.z, "{low} {high}");
        assert_eq!(Daylight::new(sun(-5.0), 3.0).sun_light(), Vec3::ZERO);
    }
}
