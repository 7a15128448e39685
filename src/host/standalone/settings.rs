//! What a person chooses by a file, and what the app keeps from one run to the next.

use crate::host::fallback::Ladder;
use crate::lod::Quality;
use crate::output::{OutputError, atomic::write_whole};
use crate::xr::vendor::FoveationLevel;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// `settings.toml`: each key is optional, and stands in for what the table of headsets says.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Chosen {
    /// Hertz, 30 to 240; the headset's nearest is taken.
    pub refresh_rate: Option<f32>,
    /// Factor on the size that the runtime recommends for a view, 0.1 to 4.
    pub scale: Option<f32>,
    /// Preset of the quadtree: low, medium, high or ultra.
    pub quality: Option<QualityWord>,
    /// Foveation: off, low, medium or high.
    pub foveation: Option<FoveationWord>,
    /// Whether less is drawn while frames run late.
    pub fallback: Option<bool>,
}

/// A preset as files write it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
#[expect(missing_docs, reason = "the presets of `lod`")]
pub enum QualityWord {
    Low,
    Medium,
    High,
    Ultra,
}

impl From<QualityWord> for Quality {
    fn from(word: QualityWord) -> Self {
        match word {
            QualityWord::Low => Self::Low,
            QualityWord::Medium => Self::Medium,
            QualityWord::High => Self::High,
            QualityWord::Ultra => Self::Ultra,
        }
    }
}

/// A level of foveation as files write it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
#[expect(missing_docs, reason = "the levels of `xr`")]
pub enum FoveationWord {
    Off,
    Low,
    Medium,
    High,
}

impl From<FoveationWord> for FoveationLevel {
    fn from(word: FoveationWord) -> Self {
        match word {
            FoveationWord::Off => Self::Off,
            FoveationWord::Low => Self::Low,
            FoveationWord::Medium => Self::Medium,
            FoveationWord::High => Self::High,
        }
    }
}

/// A file of settings that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum SettingsError {
    /// It cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// It is not what it should be.
    #[error("{}: {message}", path.display())]
    Wrong {
        /// The file.
        path: PathBuf,
        /// Line, column, and what is wrong there.
        message: String,
    },
    /// A number is out of range.
    #[error("{}: {key} = {value}: allowed is {allowed}", path.display())]
    Range {
        /// The file.
        path: PathBuf,
        /// The key.
        key: &'static str,
        /// Its value.
        value: f32,
        /// What it may be.
        allowed: &'static str,
    },
}

impl Chosen {
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// It cannot be read, is no TOML, has a key that does not exist or a value that is not allowed.
    pub fn load(path: &Path) -> Result<Self, SettingsError> {
        let chosen: Self = read(path)?;
        let numbers = [
            ("refresh_rate", chosen.refresh_rate, 30.0, 240.0, "30 to 240 Hz"),
            ("scale", chosen.scale, 0.1, 4.0, "0.1 to 4"),
        ];
        for (key, value, low, high, allowed) in numbers {
            if let Some(value) = value.filter(|value| !(low..=high).contains(value)) {
                return Err(SettingsError::Range { path: path.to_owned(), key, value, allowed });
            }
        }
        Ok(chosen)
    }
}

/// What one run leaves to the next.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Kept {
    /// Number of the level of the ladder that frames were in time on.
    pub level: usize,
    /// The scene it was for, by the name of its file.
    pub scene: String,
}

impl Kept {
    /// What the file at `path` says, or nothing kept where there is none, or not one of ours: it is only ever a gain of time.
    pub fn load(path: &Path) -> Self {
        read(path).unwrap_or_default()
    }

    /// Writes it to `path`.
    ///
    /// # Errors
    /// The folder cannot be written to, or the disk is full.
    pub fn store(&self, path: &Path) -> Result<(), OutputError> {
        write_whole(path, |sink| {
            let text = toml::to_string(self).map_err(std::io::Error::other)?;
            sink.write_all(text.as_bytes())
        })
    }

    /// The level to begin on with `scene`: one better than was kept, since a headset that was hot has cooled.
    pub fn level(&self, scene: &str, ladder: &Ladder) -> usize {
        if self.scene == scene { self.level.min(ladder.last()).saturating_sub(1) } else { 0 }
    }
}

fn read<T: for<'a> Deserialize<'a>>(path: &Path) -> Result<T, SettingsError> {
    let text = std::fs::read_to_string(path)
        .map_err(|source| SettingsError::Read { path: path.to_owned(), source })?;
    toml::from_str(&text).map_err(|error| {
        let start = error.span().map_or(0, |span| span.start);
        let line = text[..start].matches('\n').count() + 1;
        let message = format!("line {line}: {}", error.message());
        SettingsError::Wrong { path: path.to_owned(), message }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn chosen(text: &str) -> Result<Chosen, String> {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("settings.toml");
        fs::write(&file, text).unwrap();
        Chosen::load(&file).map_err(|error| error.to_string())
    }

    #[test]
    fn what_is_chosen_is_read() {
        assert_eq!(chosen("").unwrap(), Chosen::default());
        let all =
            "refresh_rate = 120\nscale = 1.2\nquality = \"low\"\nfoveation = \"off\"\nfallback = false\n";
        let wanted = Chosen {
            refresh_rate: Some(120.0),
            scale: Some(1.2),
            quality: Some(QualityWord::Low),
            foveation: Some(FoveationWord::Off),
            fallback: Some(false),
        };
        assert_eq!(chosen(all).unwrap(), wanted);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        for (text, words) in [
            ("scale = 1.0\nrefresh = 90\n", ["settings.toml", "line 2", "refresh"]),
            ("quality = \"best\"\n", ["settings.toml", "line 1", "best"]),
            ("scale = 9.0\n", ["scale = 9", "0.1 to 4", "settings.toml"]),
            ("refresh_rate = nan\n", ["refresh_rate = NaN", "30 to 240", "settings.toml"]),
            ("scale", ["line 1", "settings.toml", ""]),
        ] {
            let said = chosen(text).unwrap_err();
            assert!(words.iter().all(|word| said.contains(word)) && !said.contains('\n'), "{text}: {said}");
        }
        assert!(Chosen::load(Path::new("/nowhere/settings.toml")).is_err());
    }

    #[test]
    fn what_is_kept_comes_back_and_a_damaged_file_is_none() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("kept.toml");
        assert_eq!(Kept::load(&file), Kept::default());
        let kept = Kept { level: 3, scene: "scene.toml".to_owned() };
        kept.store(&file).unwrap();
        assert_eq!(Kept::load(&file), kept);
        fs::write(&file, "level = -1").unwrap();
        assert_eq!(Kept::load(&file), Kept::default());
        assert!(kept.store(&folder.path().join("nowhere/kept.toml")).is_err());
    }

    #[test]
    fn the_next_run_begins_one_level_better_with_the_same_scene() {
        let ladder = Ladder::new(Quality::Medium);
        let kept = |level| Kept { level, scene: "storm".to_owned() };
        assert_eq!(kept(3).level("storm", &ladder), 2);
        assert_eq!(kept(0).level("storm", &ladder), 0);
        assert_eq!(kept(99).level("storm", &ladder), ladder.last() - 1);
        assert_eq!(kept(3).level("calm", &ladder), 0);
    }
}
