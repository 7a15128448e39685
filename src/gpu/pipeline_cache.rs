//! Compiled pipelines, kept on disk between runs so that a second start need not compile.

use super::error::{Doing, GpuError};
use super::physical::PhysicalDevice;
use ash::vk;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Vulkan's pipeline cache and the file behind it.
pub(super) struct PipelineCache {
    pub(super) raw: vk::PipelineCache,
    file: Option<PathBuf>,
    loaded: usize,
}

impl PipelineCache {
    /// Reads the file that fits this driver, if there is one. A damaged or foreign file is ignored: drivers check the
    /// header, and a cache is only ever a gain of time.
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
        let data = file.as_deref().and_then(|file| std::fs::read(file).ok()).unwrap_or_default();
        let info = vk::PipelineCacheCreateInfo::default().initial_data(&data);
        // SAFETY: the device lives and the data is whole; drivers reject what is not theirs.
        let raw =
            unsafe { device.create_pipeline_cache(&info, None) }.doing("creating the pipeline cache")?;
        Ok(Self { raw, file, loaded: data.len() })
    }

    /// Writes what was compiled since, then destroys the cache.
    ///
    /// # Safety
    /// `device` is the one it was made on, and the cache is not used afterwards.
    pub(super) unsafe fn close(&self, device: &ash::Device) {
        // SAFETY: the caller's promise.
        let data = unsafe { device.get_pipeline_cache_data(self.raw) };
        if let (Some(file), Ok(data)) = (&self.file, data)
            && data.len() != self.loaded
        {
            // Losing the cache costs a compilation next time and nothing else.
            let _lost = store(file, &data);
        }
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
    std::fs::write(&partial, data)?;
    std::fs::rename(partial, file)
}
