//! Somebody who looks on while the library's headset host draws: states, eyes, and pictures of chosen frames.
use super::picture::Picture;
use super::stage::Stage;
use std::sync::Arc;
use swell::draw::{DrawCounts, Eye, Look, Solid};
use swell::gpu::{Buffer, Commands, Device, MemoryLocation, Validation};
use swell::host::{Guest, HeadsetFrame, HeadsetReport, HeadsetSettings, HostError, headset};
use swell::scene::Scene;
use swell::xr::{HANDS, Hand, VIEWS, vendor::FoveationLevel};

/// One frame that was shown.
pub struct Seen {
    pub time: f64,
    pub state: &'static str,
    pub eyes: [Eye; VIEWS],
    pub hands: [Hand; HANDS],
    pub solids: Vec<Solid>,
    pub vignette: f32,
    pub counts: DrawCounts,
    pub uploaded: u64,
    /// Left, right.
    pub pictures: Option<[Picture; VIEWS]>,
}

/// Looks at every `every`-th frame; 0 looks at none.
pub struct Watcher {
    pub every: usize,
    pub states: Vec<&'static str>,
    pub seen: Vec<Seen>,
    /// States of frames that were left empty.
    pub empty: Vec<&'static str>,
    reader: Option<(Arc<Device>, Commands)>,
}

impl Watcher {
    pub fn new(every: usize) -> Self {
        Self { every, states: Vec::new(), seen: Vec::new(), empty: Vec::new(), reader: None }
    }

    /// Shows `frames` frames of `scene`; validation listens, and must be silent.
    pub fn watch(&mut self, scene: &Scene, frames: u64) -> HeadsetReport {
        let report = self.try_watch(scene, &settings(frames)).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(report.said, Vec::<String>::new());
        report
    }

    pub fn try_watch(
        &mut self,
        scene: &Scene,
        settings: &HeadsetSettings,
    ) -> Result<HeadsetReport, HostError> {
        headset(scene, settings, self)
    }

    /// Each picture is what a camera of one eye sees there and then, but for what lenses hide.
    pub fn sees_what_a_lone_camera_sees(&self, scene: &Scene) {
        let mut alone: Option<Stage> = None;
        for (index, seen) in self.seen.iter().enumerate() {
            let Some(views) = &seen.pictures else { continue };
            let apart = views[0].difference(&views[1]).mean;
            assert!(apart > 0.02, "frame {index}: the eyes see the same: {apart}");
            let mono =
                alone.get_or_insert_with(|| Stage::new(scene, views[0].size, 1, Look::Water, seen.time));
            mono.host.set_scenery(&seen.solids, seen.vignette);
            for (view, eye) in views.iter().zip(seen.eyes) {
                // Some drivers leave layer 1 with its clear colour.
                assert!(view.colours() > 1000, "frame {index}: {} colours", view.colours());
                let [view, lone] = lenses_over(view, &mono.picture(seen.time, &[eye]));
                let difference = view.difference(&lone);
                println!("frame {index}: mean {}, 99th percentile {}", difference.mean, difference.high);
                // The foam remembers what came before, and the lone camera chooses detail for one eye, not for the head.
                assert!(
                    difference.mean < 0.004 && difference.high < 0.05,
                    "{} {}",
                    difference.mean,
                    difference.high
                );
            }
        }
    }
}

/// Both with black wherever `seen` is black, and a pixel around: what the lenses hide, and its softened edge.
fn lenses_over(seen: &Picture, lone: &Picture) -> [Picture; 2] {
    let [width, height] = seen.size;
    let black = |x: u32, y: u32| seen.pixel(x, y) == [0, 0, 0];
    let around = |at: u32, most: u32| at.saturating_sub(1)..=(at + 1).min(most - 1);
    let mut both = [seen.clone(), lone.clone()];
    let mut hidden = 0;
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        if around(x, width).any(|x| around(y, height).any(|y| black(x, y))) {
            let at = 3 * (y * width + x) as usize;
            both.iter_mut().for_each(|picture| picture.rgb[at..at + 3].fill(0));
            hidden += 1;
        }
    }
    // The corners, and not the picture.
    let pixels = width * height;
    assert!(hidden > pixels / 100 && hidden < pixels / 8, "{hidden} of {pixels} pixels are black");
    both
}

/// Everything checked, nothing waited for.
pub fn settings(frames: u64) -> HeadsetSettings {
    HeadsetSettings {
        platform: swell::xr::Platform,
        look: Look::Water,
        validation: Validation::On,
        threads: 0,
        cache: None,
        wait: false,
        frames: Some(frames),
        scale: 1.0,
        refresh_rate: None,
        foveation: FoveationLevel::High,
        sustained: true,
        thread_hints: true,
        space_warp: false,
        fallback: None,
        authoring: None,
    }
}

impl Guest for Watcher {
    fn goes_on(&mut self) -> bool {
        true
    }

    fn looks(&self) -> bool {
        self.every > 0
    }

    fn opened(&mut self, device: &Arc<Device>) -> Result<(), HostError> {
        self.reader = Some((Arc::clone(device), Commands::new(device, "look")?));
        Ok(())
    }

    fn closing(&mut self) {
        self.reader = None;
    }

    fn state(&mut self, name: &'static str) {
        self.states.push(name);
    }

    fn frame(&mut self, frame: &HeadsetFrame<'_>) -> Result<(), HostError> {
        let Some(drawn) = &frame.drawn else {
            self.empty.push(frame.state);
            return Ok(());
        };
        let wanted = self.every > 0 && self.seen.len().is_multiple_of(self.every);
        let pictures = match (drawn.picture, &self.reader, wanted) {
            (Some(image), Some((device, commands)), true) => {
                let [width, height] = image.info.extent;
                let bytes = 4 * u64::from(width) * u64::from(height) * VIEWS as u64;
                let usage = ash::vk::BufferUsageFlags::TRANSFER_DST;
                let buffer = Buffer::new(device, "look", bytes, usage, MemoryLocation::GpuToCpu)?;
                commands.begin()?.copy_from_image(image, &buffer);
                commands.submit()?;
                commands.wait()?;
                let mut bytes = buffer.bytes()[..bytes as usize].to_vec();
                if image.info.format == ash::vk::Format::B8G8R8A8_SRGB {
                    bytes.chunks_exact_mut(4).for_each(|pixel| pixel.swap(0, 2));
                }
                let both = Picture::from_frame([width, height], VIEWS as u32, &bytes);
                Some([both.part(0, 2), both.part(1, 2)])
            }
            _ => None,
        };
        self.seen.push(Seen {
            time: frame.time,
            state: frame.state,
            eyes: *drawn.eyes,
            hands: *drawn.hands,
            solids: if wanted { drawn.solids.to_vec() } else { Vec::new() },
            vignette: drawn.vignette,
            counts: drawn.counts,
            uploaded: drawn.uploaded,
            pictures,
        });
        Ok(())
    }
}
