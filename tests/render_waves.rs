//! Formulas drawn: the shaders' waves are Rust's, point by point; and far pixels show the mean of what is in them.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use ash::vk;
use glam::DVec3;
use std::sync::Arc;
use support::picture::Picture;
use support::random::Random;
use support::stage::{Stage, shipped};
use swell::draw::{Look, Waves, shaders};
use swell::gpu::{
    BindingKind, Bindings, Blend, Buffer, Commands, DepthUse, Device, DeviceNeeds, Directly, Instance,
    MemoryLocation, PhysicalDevice, Pipeline, PipelineInfo, Resource, Target, TargetInfo, Turn, UploadRing,
    Validation, VertexInput,
};
use swell::scene::Scene;
use swell::sea::Sea;
use swell::sea::waves::{Model, Sample, evaluate};

/// Texels: a column for each point of a time, a row for each time.
const SIDE: u32 = 100;
/// Metres from the frame's origin within which points are.
const REACH: f64 = 100.0;

/// The shaders of the sea on points of our choice: they include the files that ocean.wgsl includes.
struct Probe {
    commands: Commands,
    pipelines: [Pipeline; 2],
    bindings: Bindings,
    ring: UploadRing,
    readback: Buffer,
    target: Target,
    device: Arc<Device>,
}

/// Binding of the waves in shaders/models.wgsl.
static WAVES: [(u32, BindingKind); 1] = [(18, BindingKind::Uniform)];

const INPUT: VertexInput<'static> = VertexInput {
    bindings: &[vk::VertexInputBindingDescription {
        binding: 0,
        stride: 16,
        input_rate: vk::VertexInputRate::VERTEX,
    }],
    attributes: &[vk::VertexInputAttributeDescription {
        location: 0,
        binding: 0,
        format: vk::Format::R32G32B32A32_SFLOAT,
        offset: 0,
    }],
};

impl Probe {
    fn new() -> Self {
        let instance = Instance::new(Validation::On, &[], &Directly).unwrap();
        let physical = PhysicalDevice::choose(&instance, None).unwrap();
        let device = Device::new(instance, physical, &DeviceNeeds::default()).unwrap();
        let info = TargetInfo {
            extent: vk::Extent2D { width: SIDE, height: SIDE },
            views: 1,
            format: vk::Format::R32G32B32A32_SFLOAT,
            samples: vk::SampleCountFlags::TYPE_1,
        };
        let target = Target::new(&device, info).unwrap();
        let bindings = Bindings::new(&device, &WAVES, 1).unwrap();
        let row = (size_of::<Waves>() + 256 + SIDE as usize * 48) as u64;
        let ring = UploadRing::new(&device, 1, u64::from(SIDE) * row).unwrap();
        bindings.write(0, |_| Resource::Uniform(ring.buffer(), size_of::<Waves>() as u64));
        let pipeline = |fragment| {
            let info = PipelineInfo {
                name: "probe",
                vertex: (shaders::PROBE_VERTEX_MAIN, c"vertex_main"),
                fragment,
                input: INPUT,
                depth: DepthUse::Ignored,
                blend: Blend::Opaque,
                cull: false,
                lines: false,
            };
            Pipeline::new(&device, target.pass(), bindings.pipeline_layout, &info).unwrap()
        };
        let pipelines = [
            pipeline((shaders::PROBE_DISPLACEMENT_MAIN, c"displacement_main")),
            pipeline((shaders::PROBE_NORMAL_MAIN, c"normal_main")),
        ];
        let (usage, bytes) = (vk::BufferUsageFlags::TRANSFER_DST, 16 * u64::from(SIDE * SIDE));
        let readback = Buffer::new(&device, "readback", bytes, usage, MemoryLocation::GpuToCpu).unwrap();
        let commands = Commands::new(&device, "probe").unwrap();
        Self { commands, pipelines, bindings, ring, readback, target, device }
    }

    /// What each pipeline says of `points` (x, z), relative to the origin that the waves of their row are told of.
    fn ask(&mut self, rows: &[(Waves, Vec<[f32; 2]>)]) -> [Vec<[f32; 4]>; 2] {
        let mut said = [Vec::new(), Vec::new()];
        for (pipeline, said) in self.pipelines.iter().zip(&mut said) {
            self.ring.begin(0);
            let recording = self.commands.begin().unwrap();
            self.target.begin(recording, Turn::default(), [f32::NAN; 4]);
            pipeline.bind(recording);
            for (row, (waves, points)) in rows.iter().enumerate() {
                let offset = self.ring.push(bytemuck::bytes_of(waves), 256).unwrap();
                let middle = |texel: usize| (2.0 * texel as f32 + 1.0) / SIDE as f32 - 1.0;
                let corners: Vec<[f32; 4]> = points
                    .iter()
                    .enumerate()
                    .flat_map(|(column, &[x, z])| {
                        // A triangle around the texel's middle, half as wide as the texel.
                        [[-0.5, -0.5], [0.5, -0.5], [0.0, 0.5]].map(|[right, down]| {
                            let place = |texel, by: f32| middle(texel) + by / SIDE as f32;
                            [x, z, place(column, right), place(row, down)]
                        })
                    })
                    .collect();
                let vertices = self.ring.push(bytemuck::cast_slice(&corners), 16).unwrap();
                self.bindings.bind(recording, 0, &[u32::try_from(offset).unwrap()]);
                recording.vertex_buffer(0, self.ring.buffer(), vertices);
                recording.draw(corners.len() as u32);
            }
            self.target.end(recording);
            self.target.copy_to(recording, &self.readback);
            self.commands.submit().unwrap();
            self.commands.wait().unwrap();
            let heard = self.device.instance().messages();
            assert!(heard.is_empty(), "the validation layers said: {heard:#?}");
            said.extend_from_slice(bytemuck::cast_slice(
                &self.readback.bytes()[..16 * (SIDE * SIDE) as usize],
            ));
        }
        said
    }
}

/// One of each kind, and all of them together. Waves are no finer than what their distance from the origin leaves of
/// single precision: 2 pi / 0.5 m over 100 m is a phase of 1 257 rad, whose last bit is 1.2e-4, of an amplitude of 2 cm.
const MODELS: [(&str, &str); 10] = [
    ("sine", "[sea]\nmodel = 'waves'\n[[sea.wave]]\nwavelength = 7\namplitude = 0.8\ndirection_deg = 33"),
    (
        "sum of sines",
        "[sea]\nmodel = 'waves'\n[[sea.wave]]\nwavelength = 41\namplitude = 1.5\ndirection_deg = -20\n\
         [[sea.wave]]\nwavelength = 12\namplitude = 0.4\ndirection_deg = 40\nspeed = 3\n\
         [[sea.wave]]\nwavelength = 0.5\namplitude = 0.02\ndirection_deg = 170\nphase = 1.3",
    ),
    (
        "peaked",
        "[sea]\nmodel = 'waves'\n[[sea.wave]]\nkind = 'peaked'\nwavelength = 9\namplitude = 0.5\nsharpness = 4.5\n\
         direction_deg = 200\n[[sea.wave]]\nkind = 'peaked'\nwavelength = 5\namplitude = 0.2\nsharpness = 1",
    ),
    (
        "gerstner",
        "[sea]\nmodel = 'waves'\n[[sea.wave]]\nkind = 'gerstner'\nwavelength = 60\nsteepness = 0.3\ndirection_deg = 315\n\
         [[sea.wave]]\nkind = 'gerstner'\nwavelength = 31\nsteepness = 0.3\ndirection_deg = 301\n\
         [[sea.wave]]\nkind = 'gerstner'\nwavelength = 18\nsteepness = 0.3\ndirection_deg = 70",
    ),
    (
        "GPU Gems' gerstner",
        "[sea]\nmodel = 'waves'\n[[sea.wave]]\nkind = 'gerstner'\nwavelength = 20\namplitude = 0.7\nq = 0.8\n\
         [[sea.wave]]\nkind = 'gerstner'\nwavelength = 11\namplitude = 0.3\nq = 0.8\ndirection_deg = 100",
    ),
    (
        "circular",
        "[sea]\nmodel = 'waves'\n[[sea.wave]]\nkind = 'circular'\nwavelength = 6\namplitude = 0.4\ncentre = [20, -30]\n\
         [[sea.wave]]\nkind = 'circular'\nwavelength = 8\namplitude = 0.3\nsharpness = 3\ncentre = [-2000, 1500]",
    ),
    ("fbm", "[sea]\nmodel = 'fbm'\nseed = 3"),
    (
        "fbm of sines",
        "[sea]\nmodel = 'fbm'\nkernel = 'sine'\n[sea.foam]\nangle = 'leaning'\nrange = [0.1, 0.6]",
    ),
    (
        "fbm of gerstner",
        "[sea]\nmodel = 'fbm'\nkernel = 'gerstner'\noctaves = 64\nchoppiness = 0.4\nfrequency_ramp = 1.05",
    ),
    (
        "layers",
        "[sea]\nmodel = 'waves'\n[[sea.wave]]\nkind = 'gerstner'\nwavelength = 80\nsteepness = 0.4\n\
         [[sea.wave]]\nkind = 'circular'\nwavelength = 6\namplitude = 0.1\n\
         [[layer]]\nmodel = 'fbm'\noctaves = 20\n[layer.foam]\nreflection = [0.2, 0.7]\n\
         [[layer]]\nmodel = 'waves'\n[[layer.wave]]\nkind = 'peaked'\nwavelength = 13\nsharpness = 7\n\
         [[layer]]\nmodel = 'fbm'\noctaves = 10\nkernel = 'sine'\namplitude = 0.1",
    ),
];

/// Share of reflections that a model's foam leaves.
fn gloss(model: &Model, rest: [f64; 2], time: f64) -> f64 {
    let Model::Fbm(fbm) = model else { return 1.0 };
    let [least, greatest] = fbm.foam.reflection;
    1.0 - model.sample(rest, time).foam.clamp(least, greatest)
}

/// 10 000 random points and times a model, near and far from the world's origin.
#[test]
fn shaders_and_rust_agree() {
    let mut probe = Probe::new();
    let mut random = Random(6);
    println!("| model | displacement, m | normal | foam | reflection |\n|---|---:|---:|---:|---:|");
    for (name, text) in MODELS {
        let scene = Scene::parse(text, name).unwrap();
        let sea = Sea::new(&scene.sea).unwrap();
        let mut maps = sea.new_maps();
        let (mut rows, mut wanted) = (Vec::new(), Vec::new());
        let mut block = Waves::new(&scene);
        for row in 0..SIDE {
            let far = [0.0, 300.0, 1.0e6][row as usize % 3];
            let [x, z] = [0, 1].map(|_| random.between(-far, far));
            maps.time = random.between(-1e5, 1e5);
            block.turn(&maps, None, DVec3::new(x, 0.0, z), 1.0);
            let points: Vec<[f32; 2]> =
                (0..SIDE).map(|_| [0, 1].map(|_| random.between(-REACH, REACH) as f32)).collect();
            let answers = points.iter().map(|&[right, back]| {
                let rest = [x + f64::from(right), z + f64::from(back)];
                let gloss: f64 = scene.sea.models.iter().map(|model| gloss(model, rest, maps.time)).product();
                (evaluate(&scene.sea.models, rest, maps.time), gloss)
            });
            wanted.extend(answers);
            rows.push((block, points));
        }
        let [displacements, normals] = probe.ask(&rows);
        let mut worst = [0.0_f64; 4];
        for (index, (wanted, gloss)) in wanted.iter().enumerate() {
            let differ = |drawn: &[f32], wanted: &[f64]| {
                let squares = drawn.iter().zip(wanted).map(|(&a, b)| (f64::from(a) - b).powi(2));
                squares.sum::<f64>().sqrt()
            };
            let Sample { displacement, foam, .. } = wanted;
            let (drawn, normal) = (displacements[index], normals[index]);
            let differences = [
                differ(&drawn[..3], displacement),
                differ(&normal[..3], &wanted.normal()),
                differ(&drawn[3..], &[*foam]),
                differ(&normal[3..], &[*gloss]),
            ];
            for (worst, difference) in worst.iter_mut().zip(differences) {
                assert!(
                    !difference.is_nan(),
                    "{name}, point {index}: {drawn:?} {normal:?}, {wanted:?} is wanted"
                );
                *worst = worst.max(difference);
            }
        }
        println!("| {name} | {:.1e} | {:.1e} | {:.1e} | {:.1e} |", worst[0], worst[1], worst[2], worst[3]);
        let moves = wanted.iter().map(|(sample, _)| sample.displacement[1].abs()).fold(0.0, f64::max);
        assert!(moves > 0.1, "{name}: waves are wanted, {moves} m is the most");
        assert!(worst[0] < 1e-4 && worst[1] < 1e-3, "{name}: displacement, normal: {worst:?}");
        assert!(worst[2] < 1e-3 && worst[3] < 1e-3, "{name}: foam, reflection: {worst:?}");
    }
}

/// Pixels of a picture, and how many times as many the one has that says what ought to be in them.
const FAR: [u32; 2] = [320, 180];
const FINER: u32 = 6;
/// Of two frames, seconds.
const TIMES: [f64; 2] = [12.5, 12.5 + 1.0 / 36.0];

/// Luminance of each pixel, linear, averaged over squares of `side`.
fn luminance(picture: &Picture, side: u32) -> Vec<f64> {
    let linear = |byte: u8| {
        let share = f64::from(byte) / 255.0;
        if share <= 0.040_45 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
    };
    let width = picture.size[0] / side;
    let mut sums = vec![0.0; (width * picture.size[1] / side) as usize];
    for (x, y) in (0..picture.size[1]).flat_map(|y| (0..picture.size[0]).map(move |x| (x, y))) {
        let [r, g, b] = picture.pixel(x, y).map(linear);
        let light = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        sums[(y / side * width + x / side) as usize] += light / f64::from(side * side);
    }
    sums
}

/// Far water is as bright as it ought to be, and changes from a frame to the next as much as it ought to: what is not
/// filtered sparkles: without the filter fbm_sea changes by 0.039.
#[test]
fn far_pixels_show_the_mean_of_what_is_in_them() {
    for (name, rows) in [("fbm_sea", 56..66), ("sum_of_sines", 59..66)] {
        let scene = shipped(name);
        let frames = |finer: u32| {
            let mut stage = Stage::new(&scene, FAR.map(|side| side * finer), 1, Look::Water, TIMES[0]);
            let mut band = |time| {
                let all = luminance(&stage.picture(time, &[]), finer);
                all[(rows.start * FAR[0]) as usize..(rows.end * FAR[0]) as usize].to_vec()
            };
            TIMES.map(&mut band)
        };
        let [coarse, fine] = [frames(1), frames(FINER)];
        let root = |a: &[f64], b: &[f64]| {
            (a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / a.len() as f64).sqrt()
        };
        let mean = |band: &[f64]| band.iter().sum::<f64>() / band.len() as f64;
        let brighter = mean(&coarse[0]) - mean(&fine[0]);
        let (changes, ought) = (root(&coarse[0], &coarse[1]), root(&fine[0], &fine[1]));
        println!("{name}: brighter by {brighter:.4}, changes by {changes:.4}, {ought:.4} is wanted");
        assert!(brighter.abs() < 0.04, "{name}: brighter by {brighter}");
        assert!(changes < 2.0 * ought, "{name}: changes by {changes}, {ought} is wanted");
    }
}
