//! Motion vectors are where points are seen now less where the same points were seen before.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
mod support;

use ash::vk;
use glam::{DVec3, Mat3, Vec3, Vec4};
use half::f16;
use std::sync::Arc;
use support::stage::{eye, ray, seen_at};
use swell::draw::{Eye, Fov, Look, Moment, Renderer, Shape, SkyMap, Solid};
use swell::gpu::{
    Buffer, Commands, Device, DeviceNeeds, Directly, FRAMES_IN_FLIGHT, Instance, MemoryLocation,
    PhysicalDevice, Target, TargetInfo, Turn, Validation,
};
use swell::scene::Scene;
use swell::sea::{Sea, SeaMaps, Surface};

const SIZE: [u32; 2] = [200, 150];

/// A renderer that draws into a picture, and motion into another one.
struct Stage {
    commands: Vec<Commands>,
    renderer: Renderer,
    readback: Buffer,
    target: Target,
    motion: Target,
    device: Arc<Device>,
    frames: usize,
}

impl Stage {
    fn new(scene: &Scene) -> Self {
        let instance = Instance::new(Validation::On, &[], &Directly).unwrap();
        let physical = PhysicalDevice::choose(&instance, None).unwrap();
        let device = Device::new(instance, physical, &DeviceNeeds::default()).unwrap();
        let info = TargetInfo {
            extent: vk::Extent2D { width: SIZE[0], height: SIZE[1] },
            views: 2,
            format: vk::Format::R8G8B8A8_SRGB,
            samples: vk::SampleCountFlags::TYPE_4,
        };
        let target = Target::new(&device, info).unwrap();
        let info = TargetInfo {
            format: vk::Format::R16G16B16A16_SFLOAT,
            samples: vk::SampleCountFlags::TYPE_1,
            ..info
        };
        let motion = Target::new(&device, info).unwrap();
        let sky = SkyMap::new(&scene.sky).unwrap();
        let renderer = Renderer::new(&device, target.pass(), scene, &sky, Look::Water).unwrap();
        let commands = (0..FRAMES_IN_FLIGHT).map(|i| Commands::new(&device, &format!("frame {i}")).unwrap());
        let (usage, bytes) = (vk::BufferUsageFlags::TRANSFER_DST, u64::from(SIZE[0] * SIZE[1]) * 2 * 8);
        let readback = Buffer::new(&device, "readback", bytes, usage, MemoryLocation::GpuToCpu).unwrap();
        Self { commands: commands.collect(), renderer, readback, target, motion, device, frames: 0 }
    }

    fn prepared(scene: &Scene) -> Self {
        let mut stage = Self::new(scene);
        stage.renderer.prepare_motion(&stage.device, stage.motion.pass()).unwrap();
        stage
    }

    /// Draws the next frame and returns its motion.
    fn frame(&mut self, maps: &SeaMaps, eyes: &[Eye; 2], solids: &[Solid]) -> Motion {
        let slot = self.frames % FRAMES_IN_FLIGHT;
        self.frames += 1;
        let recording = self.commands[slot].begin().unwrap();
        let moment = Moment { eyes, maps, solids, vignette: 0.0 };
        self.renderer.record(recording, &self.target, Turn::default(), slot, moment).unwrap();
        self.renderer.record_motion(recording, &self.motion, Turn::default()).unwrap();
        self.motion.copy_to(recording, &self.readback);
        self.commands[slot].submit().unwrap();
        self.commands[slot].wait().unwrap();
        let said = self.device.instance().messages();
        assert!(said.is_empty(), "the validation layers said: {said:#?}");
        let halves: &[f16] = bytemuck::cast_slice(self.readback.bytes());
        let texels = halves.chunks_exact(4).map(|t| [t[0], t[1], t[2], t[3]].map(f64::from));
        Motion(texels.take((2 * SIZE[0] * SIZE[1]) as usize).collect())
    }
}

/// Texels of both views.
struct Motion(Vec<[f64; 4]>);

impl Motion {
    fn texel(&self, view: usize, x: u32, y: u32) -> DVec3 {
        let [x, y, z, _] = self.0[((view as u32 * SIZE[1] + y) * SIZE[0] + x) as usize];
        DVec3::new(x, y, z)
    }

    /// The largest component of any texel.
    fn largest(&self) -> f64 {
        self.0.iter().flat_map(|t| &t[..3]).fold(0.0, |most, value| most.max(value.abs()))
    }
}

fn pair(middle: DVec3, angles: [f64; 3]) -> [Eye; 2] {
    let both = eye(middle, angles, Fov::symmetric(1.0, 1.0));
    let right = both.axes.x_axis.as_dvec3();
    let fov = |left, right| Fov { left, right, up: 0.6, down: -0.7 };
    [(-0.0315, fov(-0.9, 0.75)), (0.0315, fov(-0.75, 0.9))].map(|(shift, fov)| Eye {
        position: middle + right * shift,
        fov,
        ..both
    })
}

/// A point (w = 1, relative to `origin`) or direction (w = 0) in normalised device coordinates.
fn ndc(eye: &Eye, origin: DVec3, point: Vec4) -> DVec3 {
    let clip = eye.view_projection(origin) * point;
    (clip.truncate() / clip.w).as_dvec3()
}

fn maps_at(sea: &mut Sea, time: f64) -> SeaMaps {
    let mut maps = sea.new_maps();
    sea.step(time, &mut maps).unwrap();
    maps
}

/// Long waves over a fine mesh whose vertices lie on the texels' borders, as in `render_heights`, where it is argued why the
/// drawn displacement is the query's to 1e-3. Two cascades, the second one turned.
const WAVES: &str = "
[sea]
resolution = 64
wind_speed = 15
choppiness = 0.8
seed = 5
[[sea.cascade]]
patch_size = 1024
[[sea.cascade]]
patch_size = 512
rotation_deg = 90
[lod]
size = 2048
quality = 'high'
levels = 7
";
const CALM: &str = "[sea]\nwind_speed = 0\nresolution = 64\n[lod]\nsize = 2048\n";

/// The point of the surface that `eye` sees along `direction`, by the secant method from the plane at rest.
fn surface_along(maps: &SeaMaps, eye: &Eye, direction: DVec3) -> Option<Surface> {
    let above = |along: f64| {
        let point = eye.position + along * direction;
        let surface = Surface::above(maps, point.x, point.z);
        (point.y - surface.height(), surface)
    };
    let mut near = -eye.position.y / direction.y;
    let mut gap = above(near).0;
    let mut far = near + gap / -direction.y;
    for _ in 0..20 {
        let (next_gap, surface) = above(far);
        if next_gap.abs() < 1e-6 {
            return Some(surface);
        }
        let step = next_gap * (far - near) / (next_gap - gap);
        (near, gap, far) = (far, next_gap, far - step);
    }
    None
}

/// The motion of a rest point follows the maps. The mesh is off by 1e-3 of the displacement at most, and as it is linear in
/// the displacement, its motion is off by 1e-3 of the difference of two displacements; halves round to 5e-4; and 2e-5
/// (1/500 of a pixel) is for the point that is seen, which is off by as much as the mesh.
#[test]
fn waves_move_as_the_query_says() {
    moves_as_the_query_says(WAVES);
}

/// As in `render_heights`, formulas so long that the mesh is off by 2e-4 of what is displaced, and as much of its motion.
#[test]
fn formulas_move_as_the_query_says() {
    moves_as_the_query_says(
        "[sea]\nmodel = 'waves'\n[[sea.wave]]\nkind = 'gerstner'\nwavelength = 120\nsteepness = 0.25\n\
         [[sea.wave]]\nkind = 'gerstner'\nwavelength = 90\nsteepness = 0.2\ndirection_deg = 70\n\
         [lod]\nsize = 2048\nquality = 'high'\nlevels = 7",
    );
}

fn moves_as_the_query_says(scene: &str) {
    let scene = Scene::parse(scene, "waves.toml").unwrap();
    let mut sea = Sea::new(&scene.sea).unwrap();
    let mut stage = Stage::prepared(&scene);
    let (mut compared, mut worst, mut most) = (0, 0.0_f64, 0.0_f64);
    for (x, z, yaw, time) in
        [(3.0, 8.0, 0.3, 40.0), (-207.0, 330.0, 2.0, 90.0), (1.0e6 + 90.0, 55.0, 5.5, 7.0)]
    {
        let (before, now) = (maps_at(&mut sea, time), maps_at(&mut sea, time + 0.1));
        let above = Surface::above(&now, x, z).height() + 9.0;
        let eyes = pair(DVec3::new(x, above, z), [yaw, -0.75, 0.0]);
        stage.frame(&before, &eyes, &[]);
        let motion = stage.frame(&now, &eyes, &[]);
        for (view, eye) in eyes.iter().enumerate() {
            for (px, py) in (0..SIZE[1]).step_by(3).flat_map(|y| (0..SIZE[0]).step_by(3).map(move |x| (x, y)))
            {
                let direction = ray(eye, SIZE, [f64::from(px) + 0.5, f64::from(py) + 0.5]).normalize();
                let Some(seen) = (direction.y < -0.2).then(|| surface_along(&now, eye, direction)).flatten()
                else {
                    continue;
                };
                let is = DVec3::from(seen.position);
                let was = DVec3::from(Surface::at_rest(&before, seen.rest[0], seen.rest[1]).position);
                let place =
                    |point: DVec3| ndc(eye, eye.position, (point - eye.position).as_vec3().extend(1.0));
                let wanted = place(is) - place(was);
                let drawn = motion.texel(view, px, py);
                // A metre across at a metre's distance is 2 / 1.3 of the picture's height of 2.
                let mesh = 1e-3 * (is - was).length() * 1.6 / (is - eye.position).length();
                let allowed = 2e-5 + 5e-4 * wanted.length() + mesh;
                let error = (drawn - wanted).length();
                assert!(error < allowed, "{px} {py} in view {view}: {drawn}, {wanted} is wanted");
                (compared, worst) = (compared + 1, worst.max(error / allowed));
                most = most.max(wanted.length());
            }
        }
    }
    println!("{compared} pixels, worst {worst:.3} of what is allowed, motion up to {most:.4}");
    assert!(compared > 15_000 && most > 0.015, "{compared} pixels, motion up to {most}");
}

/// The eye walks and turns over a plane, across steps of the frame's origin: every pixel of the sea moves by the parallax of
/// the plane, every pixel of the sky by the turn alone. Halves round to 5e-4, and 3e-5 is 1/300 of a pixel.
#[test]
fn a_moving_eye_sees_parallax() {
    let scene = Scene::parse(CALM, "calm.toml").unwrap();
    let mut sea = Sea::new(&scene.sea).unwrap();
    let maps = maps_at(&mut sea, 5.0);
    let mut stage = Stage::prepared(&scene);
    for away in [0.0, 1.0e6] {
        let (mut sea_pixels, mut sky_pixels, mut worst) = (0, 0, 0.0_f64);
        for (step, yaw) in [(0.15, 0.02), (0.2, -0.01), (-0.3, 0.0)] {
            let from = pair(DVec3::new(away - 0.1, 3.0, 0.05 - away), [0.6, -0.2, 0.05]);
            let to = pair(DVec3::new(away - 0.1 + step, 3.02, 0.05 - away - 0.1), [0.6 + yaw, -0.21, 0.05]);
            stage.frame(&maps, &from, &[]);
            let motion = stage.frame(&maps, &to, &[]);
            for view in 0..2 {
                let (was, is) = (&from[view], &to[view]);
                for y in 0..SIZE[1] {
                    for x in 0..SIZE[0] {
                        let direction = ray(is, SIZE, [f64::from(x) + 0.5, f64::from(y) + 0.5]).normalize();
                        let drawn = motion.texel(view, x, y);
                        let point = if direction.y > 0.01 {
                            sky_pixels += 1;
                            direction.as_vec3().extend(0.0)
                        } else if direction.y < -0.01 {
                            sea_pixels += 1;
                            (direction * (-is.position.y / direction.y)).as_vec3().extend(1.0)
                        } else {
                            continue;
                        };
                        let wanted = ndc(is, is.position, point) - ndc(was, is.position, point);
                        let allowed = 3e-5 + 1e-3 * wanted.length();
                        let error = (drawn - wanted).length();
                        assert!(error < allowed, "view {view}, {x} {y}: {drawn}, {wanted} is wanted");
                        worst = worst.max(error / allowed);
                    }
                }
            }
        }
        println!("{sea_pixels} pixels of sea, {sky_pixels} of sky, worst {worst:.3}");
        assert!(sea_pixels > 50_000 && sky_pixels > 20_000);
    }
}

#[test]
fn nothing_moves_when_nothing_does_and_where_no_frame_was() {
    let scene = Scene::parse(WAVES, "waves.toml").unwrap();
    let mut sea = Sea::new(&scene.sea).unwrap();
    let (first, second) = (maps_at(&mut sea, 5.0), maps_at(&mut sea, 6.0));
    let eyes = pair(DVec3::new(1.0, 9.0, 2.0), [0.3, -0.5, 0.1]);
    let mut stage = Stage::prepared(&scene);
    assert_eq!(stage.frame(&first, &eyes, &[]).largest(), 0.0, "there is no frame before the first");
    let same = stage.frame(&first, &eyes, &[]).largest();
    assert!(same < 1e-6, "sea and eyes are the same, and something moves by {same}");
    assert!(stage.frame(&second, &eyes, &[]).largest() > 0.01);
    // The slot is used again: the maps of the frame before are gone.
    stage.frames -= 1;
    assert_eq!(stage.frame(&first, &eyes, &[]).largest(), 0.0, "the frame before has been overwritten");
    assert!(stage.frame(&second, &eyes, &[]).largest() > 0.01);
}

#[test]
fn solids_move_as_they_are_moved() {
    let scene = Scene::parse(CALM, "calm.toml").unwrap();
    let mut sea = Sea::new(&scene.sea).unwrap();
    let maps = maps_at(&mut sea, 5.0);
    let eyes = pair(DVec3::new(40.0, 5.0, 2.0), [0.0; 3]);
    let mut stage = Stage::prepared(&scene);
    let ball = |x: f64, y: f64| Solid {
        shape: Shape::Sphere,
        position: eyes[0].position + DVec3::new(x, y, -6.0),
        axes: Mat3::IDENTITY,
        size: Vec3::ONE,
        color: [0.5; 3],
        lead: 0.0,
    };
    let cube = Solid { shape: Shape::Box, ..ball(2.0, 1.0) };
    // Shapes change places on their way to the device; one ball stays, one moves, one has just come.
    let before = [ball(-2.0, 1.0), cube, ball(0.0, 1.0)];
    let moved = [
        before[0],
        Solid { position: cube.position - 0.3 * DVec3::Y, ..cube },
        ball(0.2, 1.1),
        ball(0.0, -0.5),
    ];
    stage.frame(&maps, &eyes, &before);
    let motion = stage.frame(&maps, &eyes, &moved);
    for (view, eye) in eyes.iter().enumerate() {
        for (i, now) in moved.iter().enumerate() {
            let was = before.get(i).unwrap_or(now);
            // Of the point that is nearest to the eye's plane: the middle of what is seen, a little off for perspective.
            let front = |solid: &Solid| solid.position + 0.5 * DVec3::Z;
            let place = |point: DVec3| ndc(eye, eye.position, (point - eye.position).as_vec3().extend(1.0));
            let wanted = place(front(now)) - place(front(was));
            let (pixel, _) = seen_at(eye, SIZE, front(now));
            let drawn = motion.texel(view, pixel[0] as u32, pixel[1] as u32);
            let error = (drawn - wanted).length();
            assert!(error < 1e-5 + 0.01 * wanted.length(), "solid {i}: {drawn}, {wanted} is wanted");
        }
    }
}

#[test]
fn motion_has_to_be_prepared() {
    let scene = Scene::parse(CALM, "calm.toml").unwrap();
    let mut stage = Stage::new(&scene);
    let said = "no motion vectors without a frame recorded since Renderer::prepare_motion";
    let recording = stage.commands[0].begin().unwrap();
    assert_eq!(
        stage.renderer.record_motion(recording, &stage.motion, Turn::default()).unwrap_err().to_string(),
        said
    );
    stage.renderer.prepare_motion(&stage.device, stage.motion.pass()).unwrap();
    assert_eq!(
        stage.renderer.record_motion(recording, &stage.motion, Turn::default()).unwrap_err().to_string(),
        said
    );
}
