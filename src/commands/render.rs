//! `swell render`: a scene into pictures.

use super::{Clock, CommandError, Frames, Progress};
use crate::draw::Look;
use crate::gpu::Validation;
use crate::host::{Finished, Headless, HeadlessSettings, HostError, cpu_time};
use crate::jobs::{Giver, Taker, handover};
use crate::output::{
    OutputError,
    atomic::{write_bytes, write_whole},
    exr,
    png::PngEncoder,
};
use crate::scene::Scene;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use std::{fs, thread};

/// What `swell render` is asked for.
#[derive(Clone, Debug)]
pub struct RenderOptions {
    /// A folder for `frame_0000.png` and so on, or one picture (`.png`, or `.exr` with `--debug height`).
    pub out: PathBuf,
    /// Which frames.
    pub frames: Frames,
    /// When they are.
    pub clock: Clock,
    /// Pixels of one view.
    pub size: [u32; 2],
    /// Both eyes, side by side.
    pub stereo: bool,
    /// What is drawn on the surface.
    pub look: Look,
    /// Part of the Vulkan device's name.
    pub device: Option<String>,
    /// Fail on anything the validation layers say.
    pub validate: bool,
    /// Worker threads for the sea; 0 for one a core.
    pub threads: usize,
    /// Where compiled pipelines are kept.
    pub cache: Option<PathBuf>,
}

/// Buffers for pictures between the frame loop and the writer.
const PICTURES: usize = 3;

/// Frames that only warm up, where a clip is long enough to spare them.
const WARM_UP: usize = 10;

/// Draws the frames and writes them, then tells on standard error what a frame cost.
///
/// # Errors
/// An output that cannot be written, no usable device, or a validation message where those count.
pub fn render(scene: &Scene, options: &RenderOptions) -> Result<(), CommandError> {
    let format = Format::of(options)?;
    let folder = match format {
        Format::Frames => Some(options.out.as_path()),
        _ => options.out.parent().filter(|parent| !parent.as_os_str().is_empty()),
    };
    if let Some(path) = folder {
        fs::create_dir_all(path).map_err(|source| OutputError::Folder { path: path.to_owned(), source })?;
    }
    let look = if format == Format::Heights { Look::Metres } else { options.look };
    let settings = HeadlessSettings {
        size: options.size,
        stereo: options.stereo,
        look,
        device: options.device.clone(),
        validation: if options.validate { Validation::On } else { Validation::Off },
        threads: options.threads,
        cache: options.cache.clone(),
    };
    let frames = options.frames.indices();
    let mut host = Headless::new(scene, &settings, options.clock.time(frames.start))?;
    let mut cost = Cost::default();
    let mut progress = Progress::new("drawing", options.frames.count());
    let writer = Writer { options, format, encoder: PngEncoder::default(), temporary: PathBuf::new() };
    thread::scope(|scope| -> Result<(), CommandError> {
        // One picture being compressed, one waiting for that, one being filled. Buffers come back to be used again.
        let (mut pictures, queue) = handover(1);
        let (mut give_back, mut spare) = handover(PICTURES);
        for _ in 0..PICTURES {
            let _there_is_room = give_back.give(Vec::with_capacity(writer.bytes()));
        }
        let thread = scope.spawn(move || writer.run(queue, give_back));
        let drawn = host.run(frames.map(|frame| options.clock.time(frame)), |frame| {
            cost.frame(&frame);
            progress.step();
            hand_over(&frame, &mut pictures, &mut spare)
        });
        drop(pictures);
        let written = thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        written?;
        Ok(drawn?)
    })?;
    progress.finish();
    cost.tell(host.uploaded(), &host.device().physical.name);
    let said = host.close();
    if said.is_empty() { Ok(()) } else { Err(CommandError::Validation { count: said.len() }) }
}

fn hand_over(
    frame: &Finished<'_>,
    pictures: &mut Giver<(usize, Vec<u8>)>,
    spare: &mut Taker<Vec<u8>>,
) -> Result<(), HostError> {
    let mut pixels = spare.take().ok_or(HostError::WriterGone)?;
    pixels.clear();
    pixels.extend_from_slice(frame.pixels);
    pictures.give((frame.index, pixels)).map_err(|_| HostError::WriterGone)
}

/// What the output's name asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Frames,
    Picture,
    Heights,
}

impl Format {
    fn of(options: &RenderOptions) -> Result<Self, CommandError> {
        let single = options.frames.count() == 1;
        let usage =
            |problem: &str| Err(CommandError::Usage(format!("--out {}: {problem}", options.out.display())));
        match options.out.extension().and_then(|extension| extension.to_str()) {
            Some("png" | "exr") if !single => usage("one picture takes --frames 1; name a folder for more"),
            Some("png") => Ok(Self::Picture),
            Some("exr") if options.look == Look::Height => Ok(Self::Heights),
            Some("exr") => usage("an EXR holds heights: add --debug height"),
            _ if options.out.is_file() => usage("this is a file; name a folder, or a picture ending in .png"),
            _ => Ok(Self::Frames),
        }
    }
}

/// The thread that compresses and writes.
struct Writer<'a> {
    options: &'a RenderOptions,
    format: Format,
    encoder: PngEncoder,
    /// Memory for the names of files that are not whole yet.
    temporary: PathBuf,
}

impl Writer<'_> {
    fn run(
        mut self,
        mut queue: Taker<(usize, Vec<u8>)>,
        mut give_back: Giver<Vec<u8>>,
    ) -> Result<(), OutputError> {
        let mut path = self.options.out.clone();
        if self.format == Format::Frames {
            path.push("frame");
        }
        let mut name = String::new();
        while let Some((index, pixels)) = queue.take() {
            match self.format {
                Format::Frames => {
                    let number = self.options.frames.indices().start + index as u64;
                    name.clear();
                    // Text takes whatever is written to it.
                    let _ = write!(name, "frame_{number:04}.png");
                    path.set_file_name(&name);
                    self.picture(&path, &pixels)?;
                }
                Format::Picture => self.picture(&path, &pixels)?,
                Format::Heights => self.heights(&path, &pixels)?,
            }
            // Without anyone to take it back the loop is over, and the buffer goes.
            let _over = give_back.give(pixels);
        }
        Ok(())
    }

    const fn views(&self) -> u32 {
        if self.options.stereo { 2 } else { 1 }
    }

    /// Of a frame's pixels.
    fn bytes(&self) -> usize {
        let [width, height] = self.options.size.map(|side| side as usize);
        4 * width * height * self.views() as usize
    }

    fn picture(&mut self, path: &Path, pixels: &[u8]) -> Result<(), OutputError> {
        let views = self.views();
        let file = self.encoder.side_by_side(self.options.size, views, pixels);
        let file = file.map_err(|source| OutputError::Write { path: path.to_owned(), source })?;
        write_bytes(path, file, &mut self.temporary)
    }

    /// Height in R, G and B alike, as most readers want three channels; not a number where no sea was drawn.
    fn heights(&self, path: &Path, pixels: &[u8]) -> Result<(), OutputError> {
        let [width, height] = self.options.size.map(|side| side as usize);
        let views = self.views() as usize;
        let mut rows = Vec::with_capacity(width * height * views);
        for y in 0..height {
            for view in 0..views {
                let start = 4 * (view * height + y) * width;
                let row = pixels.get(start..start + 4 * width).unwrap_or_default();
                rows.extend(row.chunks_exact(4).map(|b| [f32::from_ne_bytes([b[0], b[1], b[2], b[3]]); 3]));
            }
        }
        write_whole(path, |sink| exr::write_rgb(sink, [width * views, height], &rows))
    }
}

/// What frames cost.
#[derive(Default)]
struct Cost {
    frames: usize,
    start: Option<(Instant, [Duration; 2])>,
    from: usize,
    counts: crate::draw::DrawCounts,
}

impl Cost {
    /// Counting starts after the warm-up; a short clip counts from its first frame on.
    fn frame(&mut self, frame: &Finished<'_>) {
        self.frames = frame.index + 1;
        self.counts = frame.counts;
        if self.frames == 1 || self.frames == WARM_UP {
            self.start = cpu_time().map(|cpu| (Instant::now(), cpu));
            self.from = self.frames;
        }
    }

    fn tell(&self, uploaded: u64, device: &str) {
        let counts = self.counts;
        eprintln!(
            "last frame on {device}: {} draws, {} patches, {} triangles a view, {uploaded} bytes uploaded",
            counts.draws, counts.patches, counts.triangles
        );
        let (Some((instant, before)), Some(after)) = (self.start, cpu_time()) else { return };
        let frames = self.frames - self.from;
        if frames == 0 {
            return;
        }
        #[expect(clippy::cast_precision_loss, reason = "frame counts")]
        let each = |time: Duration| 1e3 * time.as_secs_f64() / frames as f64;
        let [user, system] = [0, 1].map(|i| after[i].saturating_sub(before[i]));
        eprintln!(
            "cpu: {:.1} ms a frame (user {:.1}, system {:.1}) and {:.1} ms of time, over {frames} frames after {} of warm-up",
            each(user + system),
            each(user),
            each(system),
            each(instant.elapsed()),
            self.from
        );
    }
}
