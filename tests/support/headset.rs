//! Somebody who looks on while the library's headset host draws: states, eyes, and pictures of chosen frames.
use super::picture::Picture;
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
}

/// Everything checked, nothing waited for.
pub fn settings(frames: u64) -> HeadsetSettings {
    HeadsetSettings {
        look: Look::Water,
        validation: Validation::On,
        threads: 0,
        cache: None,
        wait: false,
        frames: Some(frames),
        scale: 1.0,
        refresh_rate: None,
        foveation: FoveationLevel::High,
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
