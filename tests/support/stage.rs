//! Frames drawn by the library, with validation listening.
use super::picture::Picture;
use glam::{DVec3, Mat3};
use swell::draw::{DrawCounts, Eye, Fov, Look};
use swell::gpu::Validation;
use swell::host::{Headless, HeadlessSettings};
use swell::scene::Scene;

pub const SCENES: [&str; 3] = ["open_ocean", "calm", "storm"];

/// A scene that comes with Swell.
pub fn shipped(name: &str) -> Scene {
    Scene::load(format!("{}/scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// A renderer and the size of its views. A message of the validation layers, synchronization included, is a failure.
pub struct Stage {
    pub host: Headless,
    /// What the latest frame took to draw.
    pub counts: DrawCounts,
    pub size: [u32; 2],
    views: u32,
}

impl Stage {
    /// Ready to draw `scene` at `time`, from one eye or two.
    pub fn new(scene: &Scene, size: [u32; 2], views: u32, look: Look, time: f64) -> Self {
        let settings = HeadlessSettings {
            size,
            stereo: views == 2,
            look,
            device: None,
            validation: Validation::On,
            threads: 0,
            cache: None,
        };
        let host = Headless::new(scene, &settings, time).unwrap_or_else(|error| panic!("{error}"));
        Self { host, counts: DrawCounts::default(), size, views }
    }

    /// The frame's bytes, view after view, seen from `eyes`; from the eyes before where there are none.
    pub fn frame(&mut self, time: f64, eyes: &[Eye]) -> Vec<u8> {
        self.host.set_eyes(eyes);
        let (mut bytes, mut counts) = (Vec::new(), self.counts);
        self.host
            .run([time], |frame| {
                bytes.extend_from_slice(frame.pixels);
                counts = frame.counts;
                Ok(())
            })
            .unwrap_or_else(|error| panic!("{error}"));
        self.counts = counts;
        let said = self.host.device().instance().messages();
        assert!(said.is_empty(), "the validation layers said: {said:#?}");
        bytes
    }

    /// The same as a picture, views side by side.
    pub fn picture(&mut self, time: f64, eyes: &[Eye]) -> Picture {
        let bytes = self.frame(time, eyes);
        Picture::from_frame(self.size, self.views, &bytes)
    }

    pub fn aspect(&self) -> f32 {
        self.size[0] as f32 / self.size[1] as f32
    }
}

/// An eye that looks along (`yaw`, `pitch`), rolled; yaw 0 is -Z, positive to the left; radians.
pub fn eye(position: DVec3, [yaw, pitch, roll]: [f64; 3], fov: Fov) -> Eye {
    let turn = Mat3::from_rotation_y(yaw as f32) * Mat3::from_rotation_x(pitch as f32);
    Eye { position, axes: turn * Mat3::from_rotation_z(roll as f32), fov }
}

/// The direction through (x, y) in pixels from the picture's upper left corner; not of unit length.
pub fn ray(eye: &Eye, size: [u32; 2], [x, y]: [f64; 2]) -> DVec3 {
    let Fov { left, right, up, down } = eye.fov;
    let across = |from: f32, to: f32, share: f64| f64::from(from) + f64::from(to - from) * share;
    let tangents = [across(left, right, x / f64::from(size[0])), across(up, down, y / f64::from(size[1]))];
    let [right, up, back] = [0, 1, 2].map(|axis| eye.axes.col(axis).as_dvec3());
    right * tangents[0] + up * tangents[1] - back
}

/// Where `point` is seen, in pixels from the picture's upper left corner, and how far along the view's axis, metres.
pub fn seen_at(eye: &Eye, size: [u32; 2], point: DVec3) -> ([f64; 2], f64) {
    let Fov { left, right, up, down } = eye.fov;
    let [x, y, back] = [0, 1, 2].map(|axis| eye.axes.col(axis).as_dvec3().dot(point - eye.position));
    let share = |from: f32, to: f32, tangent: f64| (tangent - f64::from(from)) / f64::from(to - from);
    let place = [share(left, right, x / -back), share(up, down, y / -back)];
    ([place[0] * f64::from(size[0]), place[1] * f64::from(size[1])], -back)
}
