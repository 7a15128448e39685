//! Files that appear under their final names only when whole.
//!
//! A file is written beside its final place as `.NAME.PROCESS-NUMBER.part` and renamed when complete: on one file system a
//! rename happens at once or not at all, so neither a kill nor a full disk leaves half a file under a final name.
use super::OutputError;
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::{self, BufWriter, Seek, Write};
use std::path::{MAIN_SEPARATOR_STR, Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

const SUFFIX: &str = ".part";

/// Anything a file format may want to write to.
pub trait Sink: Write + Seek {}
impl<T: Write + Seek> Sink for T {}

/// Writes the file at `path` through `write`; on an error nothing of it is left.
///
/// # Errors
/// [`OutputError::Write`] when the folder cannot be written to, the disk is full or `write` fails.
pub fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut dyn Sink) -> io::Result<()>,
) -> Result<(), OutputError> {
    let mut temporary = PathBuf::new();
    temporary_name(path, &mut temporary);
    finish(path, &temporary, |file| {
        let mut sink = BufWriter::new(file);
        write(&mut sink)?;
        sink.flush()
    })
}

/// Writes `bytes` as the file at `path`; on an error nothing of it is left. Allocates nothing once `temporary`, whose
/// content is of no matter, has been used for a path as long.
///
/// # Errors
/// As [`write_whole`].
pub fn write_bytes(path: &Path, bytes: &[u8], temporary: &mut PathBuf) -> Result<(), OutputError> {
    temporary_name(path, temporary);
    finish(path, temporary, |mut file| file.write_all(bytes))
}

fn finish(
    path: &Path,
    temporary: &Path,
    write: impl FnOnce(File) -> io::Result<()>,
) -> Result<(), OutputError> {
    let written = File::create(temporary).and_then(write).and_then(|()| fs::rename(temporary, path));
    written.map_err(|source| {
        // Removing may fail as well; the error worth telling is the first.
        let _ = fs::remove_file(temporary);
        OutputError::Write { path: path.to_owned(), source }
    })
}

/// Removes from `folder` what interrupted runs left of files, where `is_left` says so of the file's final name and of
/// the time since the leftover was last written to.
///
/// Other processes may be writing other files of the same folder: theirs are to be spared.
///
/// # Errors
/// [`OutputError::Read`] when the folder cannot be listed, [`OutputError::Remove`] when a leftover cannot be removed.
pub fn remove_leftovers(folder: &Path, is_left: impl Fn(&str, Duration) -> bool) -> Result<(), OutputError> {
    let unreadable = |source| OutputError::Read { path: folder.to_owned(), source };
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let entry = entry.map_err(unreadable)?;
        let name = entry.file_name();
        let Some(name) = name.to_str().and_then(final_name) else { continue };
        let modified = entry.metadata().and_then(|metadata| metadata.modified());
        // One that vanishes meanwhile, or is newer than the clock, is somebody's work.
        let age = modified.ok().and_then(|time| time.elapsed().ok()).unwrap_or_default();
        if is_left(name, age) {
            let path = entry.path();
            fs::remove_file(&path).map_err(|source| OutputError::Remove { path, source })?;
        }
    }
    Ok(())
}

/// Makes `temporary` the name of a file beside `path`, in the memory that it has.
fn temporary_name(path: &Path, temporary: &mut PathBuf) {
    static NUMBER: AtomicU64 = AtomicU64::new(0);
    let number = NUMBER.fetch_add(1, Ordering::Relaxed);
    let text = temporary.as_mut_os_string();
    text.clear();
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        text.push(folder);
        text.push(MAIN_SEPARATOR_STR);
    }
    text.push(".");
    text.push(path.file_name().unwrap_or_default());
    // Text takes whatever is written to it.
    let _ = write!(text, ".{}-{number}{SUFFIX}", std::process::id());
}

/// The final name a temporary file is for: `a.npy` for `.a.npy.4711-0.part`.
fn final_name(temporary: &str) -> Option<&str> {
    let (name, writer) = temporary.strip_prefix('.')?.strip_suffix(SUFFIX)?.rsplit_once('.')?;
    let (process, number) = writer.split_once('-')?;
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    (digits(process) && digits(number)).then_some(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_leaves_what_was_there_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("map.npy");
        write_whole(&path, |sink| sink.write_all(b"first")).unwrap();
        let failed = write_whole(&path, |sink| {
            sink.write_all(b"half of the sec")?;
            Err(io::Error::from(io::ErrorKind::StorageFull))
        });
        assert!(failed.unwrap_err().to_string().contains("map.npy"));
        assert_eq!(fs::read(&path).unwrap(), b"first");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn nothing_has_its_final_name_before_it_is_whole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("map.npy");
        write_whole(&path, |sink| {
            assert!(!path.exists());
            sink.write_all(b"all")
        })
        .unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"all");
    }

    #[test]
    fn leftovers_of_ones_own_files_go_and_all_else_stays() {
        let folder = tempfile::tempdir().unwrap();
        let names = [
            ".a.npy.12-3.part",
            ".b.npy.12-3.part",
            ".a.npy.12.part",
            "a.npy",
            ".a.npy.part",
            ".a.npy.x.part",
            "c.part",
        ];
        for name in names {
            fs::write(folder.path().join(name), b"").unwrap();
        }
        remove_leftovers(folder.path(), |name, _| name == "a.npy").unwrap();
        let gone: Vec<_> = names.into_iter().filter(|name| !folder.path().join(name).exists()).collect();
        assert_eq!(gone, [".a.npy.12-3.part"]);
    }

    #[test]
    fn a_temporary_name_leads_back_to_its_final_name() {
        let mut temporary = PathBuf::from("what was there before");
        temporary_name(Path::new("out/bake.json"), &mut temporary);
        assert_eq!(temporary.parent(), Some(Path::new("out")));
        assert_eq!(final_name(temporary.file_name().unwrap().to_str().unwrap()), Some("bake.json"));
    }
}
