//! The files of a report: known to be writable before the minutes are spent.
use super::BenchOptions;
use crate::commands::CommandError;
use crate::output::atomic::write_whole;
use std::fs::{self, OpenOptions};
use std::path::Path;

/// Makes sure that every file asked for can be written later, and leaves nothing behind.
///
/// # Errors
/// [`CommandError::Usage`] for a plot of a format that is not known, [`CommandError::Place`] for a place that cannot be
/// written to.
pub fn check(options: &BenchOptions) -> Result<(), CommandError> {
    if let Some(plot) = options.plot.as_deref().filter(|plot| plot.extension().is_none_or(|end| end != "svg"))
    {
        return Err(CommandError::Usage(format!("--plot {}: wanted a file ending in .svg", plot.display())));
    }
    for (option, path) in [("--json", &options.json), ("--plot", &options.plot)] {
        if let Some(path) = path {
            try_place(path).map_err(|source| CommandError::Place { option, path: path.clone(), source })?;
        }
    }
    Ok(())
}

/// A file can be made beside `path`, and `path` itself is no folder.
fn try_place(path: &Path) -> std::io::Result<()> {
    if path.is_dir() {
        return Err(std::io::ErrorKind::IsADirectory.into());
    }
    let mut name = std::ffi::OsString::from(".");
    name.push(path.file_name().ok_or(std::io::ErrorKind::InvalidInput)?);
    name.push(format!(".{}.probe", std::process::id()));
    let probe = path.with_file_name(name);
    OpenOptions::new().write(true).create_new(true).open(&probe)?;
    fs::remove_file(&probe)
}

/// Writes one of them.
///
/// # Errors
/// As [`write_whole`].
pub fn write(path: &Path, content: &[u8]) -> Result<(), CommandError> {
    Ok(write_whole(path, |sink| sink.write_all(content))?)
}
