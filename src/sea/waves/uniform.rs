//! What shaders see of a sea's models: the Rust twin of `shaders/models.wgsl`.
use super::{Front, Kind, Lean, MAX_MODELS, MAX_OCTAVES, MAX_WAVES, Model, Wave, turns};
use bytemuck::{Pod, Zeroable};
use std::f64::consts::TAU;

/// [`ModelUniform::lean`] of a model without foam.
pub const NO_FOAM: u32 = 2;
/// Added to the number of a wave's kind where its crests are rings.
const RING: u32 = 4;

/// One wave near the anchor. Its phase at a point p relative to the anchor is `k (d . p) + phase`; of a ring it is
/// `k (r - R) + phase`, where R = |w|, r = |w + p| and, without loss far out, r - R = (2 w + p) . p / (r + R).
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct WaveUniform {
    /// d, the unit direction (x, z); for rings w, from the centre to the anchor, metres.
    pub along: [f32; 2],
    /// rad/m.
    pub k: f32,
    /// At the anchor, now; -pi..=pi.
    pub phase: f32,
    /// A, metres.
    pub amplitude: f32,
    /// Q A, metres; 0 but for Gerstner waves.
    pub horizontal: f32,
    /// K; 1 but for peaked waves.
    pub sharpness: f32,
    /// 0 sine, 1 peaked, 2 exp-sine, 3 Gerstner; 4 and 5 are rings of 0 and 1.
    pub kind: u32,
}

/// One model: which waves are its own, and its foam. Fields as in [`super::FbmFoam`].
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct ModelUniform {
    /// Index of its first wave.
    pub first: u32,
    /// How many it has.
    pub count: u32,
    /// 0 foam on upright normals, 1 on leaning ones, [`NO_FOAM`].
    pub lean: u32,
    /// 1 over its greatest height, 1/m.
    pub per_max_height: f32,
    /// Shares of the greatest height.
    pub range: [f32; 2],
    /// Share of that range.
    pub height_amount: f32,
    /// Exponent.
    pub height_falloff: f32,
    /// Below 1, of the normal's upward part.
    pub angle_amount: f32,
    /// Exponent.
    pub angle_falloff: f32,
    /// Least and greatest share of reflections that foam takes.
    pub reflection: [f32; 2],
}

/// All models of a sea at one time, around one anchor.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct ModelsUniform {
    /// How many models there are.
    pub count: u32,
    /// How many waves they have.
    pub waves_count: u32,
    /// Up to 16 bytes.
    pub unused: [u32; 2],
    /// The models.
    pub models: [ModelUniform; MAX_MODELS],
    /// Their waves, those of a model side by side.
    pub waves: [WaveUniform; MAX_WAVES + MAX_OCTAVES],
}

const _: () = assert!(size_of::<WaveUniform>() == 32 && size_of::<ModelUniform>() == 48);
const _: () = assert!(size_of::<ModelsUniform>().is_multiple_of(16));

impl Default for ModelsUniform {
    fn default() -> Self {
        Self::zeroed()
    }
}

impl ModelsUniform {
    /// Describes `models` at `time`, seconds, for positions relative to `anchor`, world (x, z) in metres. Models beyond what
    /// [`super::validate`] allows are left out. Allocates nothing.
    pub fn describe(&mut self, models: &[Model], time: f64, anchor: [f64; 2]) {
        let mut used = 0;
        self.count = 0;
        for (slot, model) in self.models.iter_mut().zip(models) {
            let own = &mut self.waves[used..];
            let count = model.waves().len().min(own.len());
            for (slot, wave) in own.iter_mut().zip(model.waves()) {
                *slot = WaveUniform::new(wave, time, anchor);
            }
            *slot = ModelUniform::new(model, used as u32, count as u32);
            used += count;
            self.count += 1;
        }
        self.waves_count = used as u32;
    }
}

impl WaveUniform {
    /// Describes `wave` at `time`, seconds, around `anchor`, world (x, z) in metres. Phases are reduced in `f64`.
    #[expect(clippy::cast_possible_truncation, reason = "reduced in f64 first")]
    pub fn new(wave: &Wave, time: f64, anchor: [f64; 2]) -> Self {
        let rate = wave.k / TAU;
        let (along, here, ring) = match wave.front {
            Front::Plane { direction: [x, z] } => {
                ([x, z], turns(rate * x, anchor[0]) + turns(rate * z, anchor[1]), 0)
            }
            Front::Ring { centre } => {
                let from = [anchor[0] - centre[0], anchor[1] - centre[1]];
                (from, turns(rate, libm::hypot(from[0], from[1])), RING)
            }
        };
        let kind = match wave.kind {
            Kind::Sine => 0,
            Kind::Peaked => 1,
            Kind::ExpSine => 2,
            Kind::Gerstner => 3,
        };
        Self {
            along: along.map(|part| part as f32),
            k: wave.k as f32,
            phase: (TAU * turns(1.0, here + wave.turned(time))) as f32,
            amplitude: wave.amplitude as f32,
            horizontal: wave.horizontal as f32,
            sharpness: wave.sharpness as f32,
            kind: kind + ring,
        }
    }
}

impl ModelUniform {
    #[expect(clippy::cast_possible_truncation, reason = "authored numbers, far inside f32")]
    fn new(model: &Model, first: u32, count: u32) -> Self {
        let own = Self { first, count, lean: NO_FOAM, ..Self::default() };
        let Model::Fbm(fbm) = model else { return own };
        let foam = &fbm.foam;
        let most = fbm.max_height();
        Self {
            lean: match foam.lean {
                Lean::Upright => 0,
                Lean::Leaning => 1,
            },
            per_max_height: if most > 0.0 { (1.0 / most) as f32 } else { 0.0 },
            range: foam.range.map(|share| share as f32),
            height_amount: foam.height_amount as f32,
            height_falloff: foam.height_falloff as f32,
            angle_amount: foam.angle_amount as f32,
            angle_falloff: foam.angle_falloff as f32,
            reflection: foam.reflection.map(|share| share as f32),
            ..own
        }
    }
}
