//! Compiled pipelines, kept on disk between runs so that a second start need not compile.
//!
//! Vulkan wants back exactly what it gave: drivers check whose data it is, not that it is whole. So the file begins with a
//! checksum, and one that does not fit is as good as none.

use super::error::{Doing, GpuError};
use super::physical::PhysicalDevice;
use ash::vk;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Vulkan's pipeline cache and the file behind it.
pub(super) struct PipelineCache {
    pub(super) raw: vk::PipelineCache,
    file: Option<PathBuf>,
    /// Bytes that the file holds.
    stored: AtomicUsize,
}

impl PipelineCache {
    /// Reads the file that fits this driver, if there is one. A damaged file is ignored: a cache is only ever a gain of
    /// time.
    pub(super) fn open(
        device: &ash::Device,
        physical: &PhysicalDevice,
        dir: Option<&Path>,
    ) -> Result<Self, GpuError> {
        let mut id = String::new();
        for byte in physical.cache_id {
            let _never = write!(id, "{byte:02x}");
        }
        let file = dir.map(|dir| dir.join(format!("pipelines-{id}.bin")));
        let bytes = file.as_deref().and_then(|file| std::fs::read(file).ok()).unwrap_or_default();
        let data = verified(&bytes).unwrap_or_default();
        let info = vk::PipelineCacheCreateInfo::default().initial_data(data);
        // SAFETY: the device lives and the data is what a driver once gave; drivers reject what is not theirs.
        let raw = unsafe { device.create_pipeline_cache(&info, None) };
        let raw = raw.doing("creating the pipeline cache")?;
        Ok(Self { raw, file, stored: AtomicUsize::new(data.len()) })
    }

    /// Writes what was compiled since it was last written.
    ///
    /// # Safety
    /// `device` is the one it was made on.
    pub(super) unsafe fn keep(&self, device: &ash::Device) {
        let Some(file) = &self.file else { return };
        // SAFETY: the caller's promise.
        let Ok(data) = (unsafe { device.get_pipeline_cache_data(self.raw) }) else { return };
        // Losing the cache costs a compilation next time and nothing else.
        if data.len() != self.stored.load(Ordering::Relaxed) && store(file, &data).is_ok() {
            self.stored.store(data.len(), Ordering::Relaxed);
        }
    }

    /// Writes what was compiled since, then destroys the cache.
    ///
    /// # Safety
    /// `device` is the one it was made on, and the cache is not used afterwards.
    pub(super) unsafe fn close(&self, device: &ash::Device) {
        // SAFETY: the caller's promise.
        unsafe { self.keep(device) };
        // SAFETY: the caller's promise.
        unsafe { device.destroy_pipeline_cache(self.raw, None) };
    }
}

/// Writes beside the file and renames, so that two runs at once leave one whole cache.
fn store(file: &Path, data: &[u8]) -> std::io::Result<()> {
    if let Some(dir) = file.parent() {
        std::fs::create_dir_all(dir)?;
    }
    let partial = file.with_extension(format!("{}.partial", std::process::id()));
    let bytes = [&checksum(data).to_le_bytes(), data].concat();
    let stored = std::fs::write(&partial, bytes).and_then(|()| std::fs::rename(&partial, file));
    if stored.is_err() {
        // It may never have been there; the error worth telling is the first.
        let _gone = std::fs::remove_file(&partial);
    }
    stored
}

/// What follows the checksum, where that is right.
fn verified(bytes: &[u8]) -> Option<&[u8]> {
    let (sum, data) = bytes.split_first_chunk()?;
    (u64::from_le_bytes(*sum) == checksum(data)).then_some(data)
}

/// FNV-1a, 64 bits: against damage, not against malice.
fn checksum(data: &[u8]) -> u64 {
    data.iter()
        .fold(0xcbf2_9ce4_8422_2325, |sum, &byte| (sum ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stored_cache_comes_back_and_a_damaged_one_does_not() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("deeper/pipelines.bin");
        let data: Vec<u8> = (0..=255).collect();
        store(&file, &data).unwrap();
        let bytes = std::fs::read(&file).unwrap();
        assert_eq!(verified(&bytes), Some(&data[..]));
        assert_eq!(std::fs::read_dir(file.parent().unwrap()).unwrap().count(), 1);
        for place in 0..bytes.len() {
            let mut damaged = bytes.clone();
            damaged[place] ^= 1;
            assert_eq!(verified(&damaged), None, "byte {place}");
            assert_eq!(verified(&bytes[..place]), None, "cut to {place}");
        }
    }

    #[test]
    fn a_cache_that_cannot_be_stored_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let taken = folder.path().join("taken");
        std::fs::create_dir(&taken).unwrap();
        assert!(store(&taken, b"data").is_err());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
