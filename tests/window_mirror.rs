//! A headset's pictures in a window: which views, where, and that nobody waits.
//!
//! A window wants its program's main thread, so this test has no harness: it starts itself again as the window's program.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic")]
mod support;

use ash::vk;
use std::process::Stdio;
use std::sync::Arc;
use std::time::{Duration, Instant};
use support::picture::Picture;
use support::program::on_vulkan;
use support::xvfb::Xvfb;
use swell::gpu::{
    Commands, Device, DeviceNeeds, Directly, Image, ImageInfo, Instance, Layers, Outcome, Pace,
    PhysicalDevice, Picture as Shown, Presenter, Transition, Validation, upload_image,
};
use swell::host::{DesktopWindow, Key, Mirror};

/// Pixels of one view.
const VIEW: [u32; 2] = [64, 48];
const LEFT: [u8; 3] = [200, 40, 10];
const RIGHT: [u8; 3] = [20, 90, 230];
/// Wider than the views: bars at the sides. Higher than two of them: bars above and below.
const WINDOW: [u32; 2] = [300, 150];
const PATIENCE: Duration = Duration::from_secs(60);

fn main() {
    let mut words = std::env::args().skip(1);
    if words.next().as_deref() == Some("mirror") {
        return program();
    }
    let screen = Xvfb::start([400, 300]);
    // Not `current_exe`, which is the dynamic loader under the runner.
    let mut command = on_vulkan(std::env::args_os().next().unwrap());
    command.arg("mirror").stdin(Stdio::null());
    let mut child = screen.show(&mut command).spawn().unwrap();
    let window = screen.window("a mirror");
    // One view, 200 pixels wide, in the middle; then both, 100 pixels high.
    let press = |key: u8| {
        window.focus();
        for down in [true, false] {
            screen.key(u32::from(key), down);
        }
    };
    let shows = |places: &[([u32; 2], [u8; 3])]| {
        let right =
            |picture: &Picture| places.iter().all(|(at, colour)| picture.pixel(at[0], at[1]) == *colour);
        screen.screenshot_when(|_| window.frame().1 == WINDOW && right(&window.picture()));
    };
    let middle = |colour| [([49, 75], [0; 3]), ([51, 1], colour), ([248, 148], colour), ([251, 75], [0; 3])];
    shows(&middle(LEFT));
    press(b'r');
    shows(&middle(RIGHT));
    press(b'r');
    // 150 x 112 each, 19 rows above and below.
    shows(&[
        ([75, 17], [0; 3]),
        ([1, 21], LEFT),
        ([148, 129], LEFT),
        ([151, 21], RIGHT),
        ([298, 129], RIGHT),
        ([225, 132], [0; 3]),
    ]);
    window.picture().save(&std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("mirror.png"));
    window.close();
    let started = Instant::now();
    while child.try_wait().unwrap().is_none() {
        assert!(started.elapsed() < PATIENCE, "it does not end");
        std::thread::sleep(Duration::from_millis(10));
    }
    assert!(child.wait().unwrap().success());
    println!("a headset's views are mirrored: ok");
}

/// Views of two colours, shown as a headset's would be: in the layout a headset's are in, without waiting.
fn program() {
    let mut window = DesktopWindow::open("a mirror", WINDOW).unwrap();
    let instance = Instance::new(Validation::On, &window.extensions().unwrap(), &Directly).unwrap();
    let heard = instance.heard();
    let physical = PhysicalDevice::choose(&instance, None).unwrap();
    let needs = DeviceNeeds { extensions: Presenter::DEVICE_EXTENSIONS, ..DeviceNeeds::default() };
    let device = Device::new(instance, physical, &needs).unwrap();
    window.attach(&device, Pace::Mirror).unwrap();
    let views = views(&device);
    let layout = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;
    let picture = Shown { image: views.raw, extent: VIEW, layout };
    let mut ways = [Mirror::Left, Mirror::Right, Mirror::Both].into_iter().filter_map(Mirror::layers);
    let mut layers = ways.next().unwrap();
    let (mut shown, started) = (0, Instant::now());
    while !window.is_closed() {
        assert!(started.elapsed() < PATIENCE, "nobody closes it");
        window.pump(false).unwrap();
        for _ in window.pressed().iter().filter(|key| **key == Key::Reset) {
            layers = ways.next().unwrap();
        }
        if window.show(&picture, layers, Duration::ZERO).unwrap() == Outcome::Shown {
            shown += 1;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(shown > 0 && layers == Layers::Both);
    window.wait().unwrap();
    drop((window, views, device));
    assert_eq!(heard.all(), [""; 0]);
}

fn views(device: &Arc<Device>) -> Image {
    let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC;
    let mut info = ImageInfo::texture(VIEW[0], 1, vk::Format::R8G8B8A8_SRGB);
    (info.extent, info.layers, info.usage) = (VIEW, 2, info.usage | usage);
    info.view = vk::ImageViewType::TYPE_2D_ARRAY;
    let image = Image::new(device, "views", info).unwrap();
    let pixels = (VIEW[0] * VIEW[1]) as usize;
    let data: Vec<u8> = [LEFT, RIGHT].iter().flat_map(|[r, g, b]| [*r, *g, *b, 255].repeat(pixels)).collect();
    upload_image(device, &image, &data, 4).unwrap();
    let commands = Commands::new(device, "views").unwrap();
    let drawn = Transition {
        from: vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL,
        to: vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL,
        after: (vk::PipelineStageFlags::FRAGMENT_SHADER, vk::AccessFlags::empty()),
        before: (vk::PipelineStageFlags::COLOR_ATTACHMENT_OUTPUT, vk::AccessFlags::COLOR_ATTACHMENT_WRITE),
    };
    drawn.record(commands.begin().unwrap(), std::iter::once(&image), &mut Vec::new());
    commands.submit().unwrap();
    commands.wait().unwrap();
    image
}
