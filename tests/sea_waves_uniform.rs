//! What shaders see of waves is enough for single precision to give the same water, wherever and whenever.
#![allow(
    clippy::unwrap_used,
    clippy::cast_possible_truncation,
    reason = "a test may panic, and rounds on purpose"
)]
#[path = "support/random.rs"]
mod random;

use random::Random;
use swell::scene::Scene;
use swell::sea::waves::{ModelsUniform, NO_FOAM, WaveUniform, evaluate};

const SCENE: &str = "[sea]\nmodel = 'waves'\nloops = 'allow'\n\
     [[sea.wave]]\nwavelength = 9\namplitude = 0.5\ndirection_deg = 25\n\
     [[sea.wave]]\nkind = 'peaked'\nwavelength = 6\namplitude = 0.3\nsharpness = 4\ndirection_deg = 200\n\
     [[sea.wave]]\nkind = 'gerstner'\nwavelength = 12\nsteepness = 0.4\ndirection_deg = -70\nphase = 1\n\
     [[sea.wave]]\nkind = 'circular'\nwavelength = 5\namplitude = 0.2\ncentre = [30, -8]\n\
     [[sea.wave]]\nkind = 'circular'\nwavelength = 7\namplitude = 0.2\nsharpness = 3\ncentre = [1000040, 25]\n\
     [[layer]]\nmodel = 'fbm'\nkernel = 'exp-sine'\noctaves = 16\nseed = 3\n\
     [[layer]]\nmodel = 'fbm'\nkernel = 'gerstner'\noctaves = 16\nchoppiness = 0.2\n[layer.foam]\nangle = 'leaning'\n";

/// Displacement and its derivatives, in singles.
#[derive(Clone, Copy, Default)]
struct Single {
    offset: [f32; 3],
    along_x: [f32; 3],
    along_z: [f32; 3],
}

/// A wave at a point relative to the anchor: what a shader does.
fn add(sum: &mut Single, wave: &WaveUniform, [x, z]: [f32; 2]) {
    let [mut dx, mut dz] = wave.along;
    let (mut travelled, mut bound, mut growth) = (dx * x + dz * z, 1.0, 0.0);
    if wave.kind >= 4 {
        let [wx, wz] = wave.along;
        let (before, now) = ((wx * wx + wz * wz).sqrt(), ((wx + x).powi(2) + (wz + z).powi(2)).sqrt());
        travelled = ((2.0 * wx + x) * x + (2.0 * wz + z) * z) / (before + now);
        [dx, dz] = [(wx + x) / now, (wz + z) / now];
        let s = (wave.k / std::f32::consts::PI * now).min(1.0);
        (bound, growth) = (s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s) * wave.k / std::f32::consts::PI);
    }
    let (sin, cos) = (wave.k * travelled + wave.phase).sin_cos();
    let (height, by_f) = match wave.kind % 4 {
        1 => {
            let base = (0.5 * (sin + 1.0)).max(1e-30);
            let power = base.powf(wave.sharpness - 1.0);
            (2.0 * base * power, wave.sharpness * power * cos)
        }
        2 => ((sin - 1.0).exp(), (sin - 1.0).exp() * cos),
        _ => (sin, cos),
    };
    let slope = wave.amplitude * (bound * wave.k * by_f + growth * height);
    let (aside, squeeze) = (wave.horizontal * cos, -wave.k * wave.horizontal * sin);
    let parts = [
        (&mut sum.offset, [dx * aside, wave.amplitude * bound * height, dz * aside]),
        (&mut sum.along_x, [dx * dx * squeeze, dx * slope, dx * dz * squeeze]),
        (&mut sum.along_z, [dx * dz * squeeze, dz * slope, dz * dz * squeeze]),
    ];
    for (to, from) in parts {
        to.iter_mut().zip(from).for_each(|(to, from)| *to += from);
    }
}

fn normal(single: &Single) -> [f32; 3] {
    let t = [1.0 + single.along_x[0], single.along_x[1], single.along_x[2]];
    let b = [single.along_z[0], single.along_z[1], 1.0 + single.along_z[2]];
    let n = [b[1] * t[2] - b[2] * t[1], b[2] * t[0] - b[0] * t[2], b[0] * t[1] - b[1] * t[0]];
    let length = n.iter().map(|part| part * part).sum::<f32>().sqrt();
    n.map(|part| part / length)
}

#[test]
fn single_precision_gives_the_same_sea_near_any_anchor_at_any_time() {
    let models = Scene::parse(SCENE, "x.toml").unwrap().sea.models;
    let mut random = Random(21);
    let mut uniform = ModelsUniform::default();
    for (anchor, time) in
        [([0.0, 0.0], 0.0), ([1e6, 16.0], 604_800.0), ([-3.2e8, 5e5], 1e9), ([28.0, -8.0], 7.5)]
    {
        uniform.describe(&models, time, anchor);
        assert_eq!((uniform.count, uniform.waves_count), (3, 37));
        let (mut offset, mut turned) = (0.0_f64, 0.0_f64);
        for i in 0..3000 {
            let reach = if i < 500 { 5.0 } else { 150.0 };
            let near = [random.between(-reach, reach) as f32, random.between(-reach, reach) as f32];
            let mut single = Single::default();
            let waves = &uniform.waves[..uniform.waves_count as usize];
            waves.iter().for_each(|wave| add(&mut single, wave, near));
            let truth =
                evaluate(&models, [anchor[0] + f64::from(near[0]), anchor[1] + f64::from(near[1])], time);
            let (got, wanted) = (normal(&single), truth.normal());
            for i in 0..3 {
                offset = offset.max((f64::from(single.offset[i]) - truth.displacement[i]).abs());
                turned = turned.max((f64::from(got[i]) - wanted[i]).abs());
            }
        }
        println!("{anchor:?} m, {time} s: {offset:.1e} m, normals {turned:.1e}");
        assert!(offset < 1e-4 && turned < 1e-3, "{anchor:?} {time}: {offset} m, {turned}");
    }
}

#[test]
fn models_lie_side_by_side_and_say_what_foam_they_make() {
    let models = Scene::parse(SCENE, "x.toml").unwrap().sea.models;
    let mut uniform = ModelsUniform::default();
    uniform.describe(&models, 1.0, [0.0; 2]);
    let ranges: Vec<_> =
        uniform.models[..3].iter().map(|model| (model.first, model.count, model.lean)).collect();
    assert_eq!(ranges, [(0, 5, NO_FOAM), (5, 16, 0), (21, 16, 1)]);
    let most: f32 = uniform.waves[5..21].iter().map(|wave| wave.amplitude).sum();
    assert!((uniform.models[1].per_max_height * most - 1.0).abs() < 1e-5);
    let kinds: Vec<_> = uniform.waves[..6].iter().map(|wave| wave.kind).collect();
    assert_eq!(kinds, [0, 1, 3, 4, 5, 2]);
    // Fewer models leave nothing of those before.
    uniform.describe(&models[..1], 1.0, [0.0; 2]);
    assert_eq!((uniform.count, uniform.waves_count), (1, 5));
}
