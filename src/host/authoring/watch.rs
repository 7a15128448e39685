//! Files that somebody else may change: looked at twice a second.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

/// Often enough for a person who saves a file and looks up.
const EVERY: Duration = Duration::from_millis(500);

/// When a file was last written, and its length; nothing where it cannot be seen.
type Stamp = Option<(SystemTime, u64)>;

/// A file, or the shaders of a folder. Looking at a file allocates nothing.
#[derive(Debug)]
pub struct Watch {
    path: PathBuf,
    seen: Seen,
    looked: Instant,
}

/// What was there last.
#[derive(Debug, PartialEq)]
enum Seen {
    File(Stamp),
    Folder(Vec<(PathBuf, Stamp)>),
}

impl Watch {
    /// Watches `path`, a file or a folder of WGSL files, as it is now.
    pub fn new(path: &Path) -> Self {
        let seen = if path.is_dir() { Seen::Folder(shaders(path)) } else { Seen::File(stamp(path)) };
        Self { seen, path: path.to_owned(), looked: Instant::now() }
    }

    /// Whether something there has changed since the last time that it had. A file that is not there now is being written.
    pub fn has_changed(&mut self) -> bool {
        if self.looked.elapsed() < EVERY {
            return false;
        }
        self.looked = Instant::now();
        let (now, whole) = match &self.seen {
            Seen::File(_) => {
                let now = stamp(&self.path);
                (Seen::File(now), now.is_some())
            }
            Seen::Folder(_) => {
                let now = shaders(&self.path);
                let whole = now.iter().all(|(_, stamp)| stamp.is_some());
                (Seen::Folder(now), whole)
            }
        };
        if !whole || now == self.seen {
            return false;
        }
        self.seen = now;
        true
    }
}

fn stamp(path: &Path) -> Stamp {
    let about = fs::metadata(path).ok()?;
    Some((about.modified().ok()?, about.len()))
}

/// WGSL files in `folder`, none where it cannot be read.
fn shaders(folder: &Path) -> Vec<(PathBuf, Stamp)> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut found: Vec<_> = entries
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "wgsl"))
        .map(|path| (path.clone(), stamp(&path)))
        .collect();
    found.sort();
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn later(mut watch: Watch) -> Watch {
        watch.looked = Instant::now().checked_sub(2 * EVERY).unwrap();
        watch
    }

    #[test]
    fn a_change_is_told_once() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("scene.toml");
        fs::write(&file, "a").unwrap();
        let mut watch = Watch::new(&file);
        fs::write(&file, "ab").unwrap();
        assert!(!watch.has_changed(), "not so soon");
        watch = later(watch);
        assert!(watch.has_changed());
        watch = later(watch);
        assert!(!watch.has_changed());
        fs::remove_file(&file).unwrap();
        watch = later(watch);
        assert!(!watch.has_changed(), "it is being written");
        fs::write(&file, "abc").unwrap();
        watch = later(watch);
        assert!(watch.has_changed());
    }

    #[test]
    fn of_a_folder_shaders_count() {
        let folder = tempfile::tempdir().unwrap();
        let mut watch = later(Watch::new(folder.path()));
        fs::write(folder.path().join("notes.txt"), "a").unwrap();
        assert!(!watch.has_changed());
        fs::write(folder.path().join("water.wgsl"), "a").unwrap();
        assert!(later(watch).has_changed());
    }
}
