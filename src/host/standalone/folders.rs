//! Where an app's files are, and which scene is shown.

use crate::scene::{Scene, SceneError};
use std::fs;
use std::path::{Path, PathBuf};

/// The two folders that Android gives an app.
#[derive(Clone, Debug)]
pub struct Folders {
    /// The app's own, that nobody else sees.
    pub internal: PathBuf,
    /// The one that a person reaches with `adb push`, where there is one.
    pub external: Option<PathBuf>,
}

/// Name of a pushed scene.
const SCENE: &str = "scene.toml";
/// Name of a changed scene beside a pushed one that is wrong.
const AUTHORED: &str = "authored.toml";
/// Name of a person's settings.
const SETTINGS: &str = "settings.toml";
/// Name of what the app keeps by itself.
const KEPT: &str = "kept.toml";

/// A scene, where it is from, and why it is not the pushed one if there was one.
pub struct Found {
    /// The scene.
    pub scene: Scene,
    /// The text it was read from.
    pub text: String,
    /// Its file; nothing for the one that is built in.
    pub file: Option<PathBuf>,
    /// A pushed scene is wrong in this way.
    pub wrong: Option<SceneError>,
}

impl Folders {
    /// Where compiled pipelines are kept.
    pub fn cache(&self) -> PathBuf {
        self.internal.join("cache")
    }

    /// What the app keeps from one run to the next.
    pub fn kept(&self) -> PathBuf {
        self.internal.join(KEPT)
    }

    /// What a person has pushed to choose settings.
    pub fn settings(&self) -> Option<PathBuf> {
        self.pushed(SETTINGS)
    }

    /// The scene that was pushed, or the one that is built in where there is none, or a wrong one: in a headset there is to be
    /// something to see, and the log says what is wrong.
    ///
    /// # Errors
    /// None as shipped; a test reads the one that is built in.
    pub fn scene(&self) -> Result<Found, SceneError> {
        let mut wrong = None;
        if let Some(file) = self.pushed(SCENE) {
            let text = |scene| {
                let read = fs::read_to_string(&file);
                read.map(|text| (scene, text))
                    .map_err(|source| SceneError::Read { path: file.clone(), source })
            };
            match Scene::load(&file).and_then(text) {
                Ok((scene, text)) => return Ok(Found { scene, text, file: Some(file), wrong }),
                Err(error) => wrong = Some(error),
            }
        }
        Ok(Found { scene: Scene::flagship()?, text: Scene::FLAGSHIP.to_owned(), file: None, wrong })
    }

    /// Where `found` is saved once it was changed: to its file, or to the one that the next run will find. One that is wrong
    /// stays as it is.
    pub fn authored(&self, found: &Found) -> PathBuf {
        let name = if found.wrong.is_some() { AUTHORED } else { SCENE };
        let folder = self.external.as_ref().unwrap_or(&self.internal);
        found.file.clone().unwrap_or_else(|| folder.join(name))
    }

    /// The file of this name that was pushed, if one was.
    fn pushed(&self, name: &str) -> Option<PathBuf> {
        self.external.as_deref().map(|folder| folder.join(name)).filter(|file| Path::exists(file))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folders() -> (tempfile::TempDir, Folders) {
        let root = tempfile::tempdir().unwrap();
        let (internal, external) = (root.path().join("internal"), root.path().join("external"));
        for folder in [&internal, &external] {
            fs::create_dir(folder).unwrap();
        }
        let folders = Folders { internal, external: Some(external) };
        (root, folders)
    }

    #[test]
    fn without_a_pushed_scene_the_one_that_is_built_in() {
        let (_root, folders) = folders();
        let found = folders.scene().unwrap();
        assert!(found.file.is_none() && found.wrong.is_none());
        assert_eq!(folders.authored(&found), folders.external.as_ref().unwrap().join("scene.toml"));
        assert_eq!(found.scene, Scene::flagship().unwrap());
        let nowhere = Folders { external: None, ..folders };
        assert_eq!(nowhere.scene().unwrap().scene, Scene::flagship().unwrap());
        assert_eq!(nowhere.settings(), None);
    }

    #[test]
    fn a_pushed_scene_comes_first() {
        let (root, folders) = folders();
        let file = root.path().join("external/scene.toml");
        fs::write(&file, "[sea]\nwind_speed = 5.0\n").unwrap();
        let found = folders.scene().unwrap();
        assert_eq!(found.file, Some(file.clone()));
        assert_eq!(found.text, "[sea]\nwind_speed = 5.0\n");
        assert_eq!(folders.authored(&found), file);
        assert_eq!(found.scene, Scene::load(file).unwrap());
    }

    #[test]
    fn a_wrong_one_is_told_and_not_shown() {
        let (root, folders) = folders();
        fs::write(root.path().join("external/scene.toml"), "[sea]\nwind_speed = -5.0\n").unwrap();
        let found = folders.scene().unwrap();
        let wrong = found.wrong.as_ref().unwrap().to_string();
        assert!(wrong.contains("scene.toml:2") && wrong.contains("wind_speed"), "{wrong}");
        assert!(found.file.is_none());
        assert_eq!(folders.authored(&found), root.path().join("external/authored.toml"));
        assert_eq!(found.scene, Scene::flagship().unwrap());
    }

    #[test]
    fn what_the_app_keeps_is_its_own() {
        let (_root, folders) = folders();
        for own in [folders.cache(), folders.kept()] {
            assert!(own.starts_with(&folders.internal), "{}", own.display());
        }
    }
}
