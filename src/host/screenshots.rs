//! Pictures kept while the program runs, written by threads of their own.

use super::HostError;
use crate::gpu::{Buffer, Commands, Device, Image, MemoryLocation};
use crate::output::{OutputError, atomic::write_whole, png};
use ash::vk;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread::{self, JoinHandle};

/// The picture in `image`, in `TRANSFER_SRC_OPTIMAL`, whose drawing has been submitted: sRGB bytes (RGBA), layer after layer.
/// Waits for the device, so that a key is worth it and a frame is not.
///
/// # Errors
/// Out of memory, or the device was lost.
pub fn read_back(device: &Arc<Device>, image: &Image) -> Result<Vec<u8>, HostError> {
    let usage = vk::BufferUsageFlags::TRANSFER_DST;
    let [width, height] = image.info.extent;
    let size = 4 * u64::from(width) * u64::from(height) * u64::from(image.info.layers);
    let buffer = Buffer::new(device, "screenshot", size, usage, MemoryLocation::GpuToCpu)?;
    let commands = Commands::new(device, "screenshot")?;
    commands.begin()?.copy_from_image(image, &buffer);
    commands.submit()?;
    commands.wait()?;
    let length = usize::try_from(size).unwrap_or(usize::MAX);
    let mut pixels = buffer.bytes().get(..length).unwrap_or_default().to_vec();
    if image.info.format == vk::Format::B8G8R8A8_SRGB {
        pixels.chunks_exact_mut(4).for_each(|pixel| pixel.swap(0, 2));
    }
    Ok(pixels)
}

/// Pictures on their way to files.
#[derive(Default)]
pub struct Screenshots {
    writers: Vec<JoinHandle<Result<(), OutputError>>>,
    /// No number below this is free.
    number: u32,
}

impl Screenshots {
    /// Writes `pixels`, `views` pictures of `size` one after the other, side by side to `path`.
    pub fn write(&mut self, path: PathBuf, size: [u32; 2], views: u32, pixels: Vec<u8>) {
        let work =
            move || write_whole(&path, |mut sink| png::write_side_by_side(&mut sink, size, views, &pixels));
        self.writers.push(thread::spawn(work));
    }

    /// The next free name of `swell_0000.png` and so on in `folder`.
    pub fn next_name(&mut self, folder: &Path) -> PathBuf {
        loop {
            let path = folder.join(format!("swell_{:04}.png", self.number));
            self.number += 1;
            if !path.exists() {
                return path;
            }
        }
    }

    /// Waits for all of them.
    ///
    /// # Errors
    /// The first that could not be written.
    pub fn finish(&mut self) -> Result<(), OutputError> {
        let mut all = Ok(());
        // All are waited for, also after an error.
        for writer in self.writers.drain(..) {
            let written = writer.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            all = all.and(written);
        }
        all
    }
}

impl Drop for Screenshots {
    fn drop(&mut self) {
        for writer in self.writers.drain(..) {
            let _untold = writer.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_go_on_after_what_is_there() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("swell_0001.png"), b"").unwrap();
        let mut screenshots = Screenshots::default();
        let names: Vec<_> = (0..3).map(|_| screenshots.next_name(folder.path())).collect();
        let wanted = ["swell_0000.png", "swell_0002.png", "swell_0003.png"];
        assert_eq!(names, wanted.map(|name| folder.path().join(name)));
    }

    #[test]
    fn a_picture_without_a_place_is_an_error() {
        let mut screenshots = Screenshots::default();
        let folder = tempfile::tempdir().unwrap();
        screenshots.write(folder.path().join("none/a.png"), [1, 1], 1, vec![0; 4]);
        assert!(screenshots.finish().unwrap_err().to_string().contains("none/a.png"));
    }
}
