//! Shaders that are being changed: watched, and compiled on a thread.

use crate::draw::compile_shaders;
use crate::gpu::Replacements;
use crate::host::authoring::Watch;
use std::path::{Path, PathBuf};
use std::thread::{self, JoinHandle};

/// A folder of shaders.
pub struct ShaderWatch {
    folder: PathBuf,
    watch: Watch,
    compiling: Option<JoinHandle<Result<Replacements, String>>>,
}

impl ShaderWatch {
    /// Watches `folder`, and compiles what is in it at once: it may be other than what was built in.
    pub fn new(folder: &Path) -> Self {
        let mut own = Self { folder: folder.to_owned(), watch: Watch::new(folder), compiling: None };
        own.compile();
        own
    }

    /// What became of a change, once it is compiled: the modules, or the error.
    pub fn compiled(&mut self) -> Option<Result<Replacements, String>> {
        if self.compiling.is_none() && self.watch.has_changed() {
            self.compile();
        }
        if !self.compiling.as_ref()?.is_finished() {
            return None;
        }
        let joined = self.compiling.take()?.join();
        Some(joined.unwrap_or_else(|_| Err(format!("{}: the compiler panicked", self.folder.display()))))
    }

    fn compile(&mut self) {
        let folder = self.folder.clone();
        self.compiling = Some(thread::spawn(move || compile_shaders(&folder)));
    }
}
