//! Files and models, which are loaded once and shared by all states of a lesson.

use crate::ExplorerError;
use crate::lesson_state::style_flag;
use crate::triangle_survey::WorldTriangles;
use import::MemoryFolder;
use model::ModelInstance;
use pipeline::{Origin, Scene, SceneFile, Textures};
use scene_file::file::{ModelFile, StyleFile};
use std::sync::Arc;

/// The number of cached model sets, enough for the current and the previous lesson.
const KEPT_SETS: usize = 2;
/// The number of cached scenes, enough for a state at several picture sizes and for its defaults.
const KEPT_SCENES: usize = 6;

/// A resolved scene with its models.
#[derive(Clone, Debug)]
pub(crate) struct LoadedScene {
    pub(crate) scene: Arc<Scene>,
    pub(crate) models: Arc<LoadedModels>,
    /// The index of the first viewport that shows the model.
    pub(crate) first_view: usize,
}

impl LoadedScene {
    /// Returns the views of the scene (at least one): the camera's view, or a view for each
    /// viewport or eye.
    pub(crate) fn views(&self) -> Vec<&Scene> {
        match self.scene.insets.get(self.first_view..) {
            None | Some([]) => vec![&self.scene],
            Some(insets) => insets.iter().map(|inset| &inset.scene).collect(),
        }
    }
}

/// A scene's models and the data computed once from them.
#[derive(Debug)]
pub(crate) struct LoadedModels {
    /// The models as written in the scene file.
    files: Vec<ModelFile>,
    instances: Vec<ModelInstance>,
    pub(crate) textures: Textures<'static>,
    pub(crate) triangles: WorldTriangles,
}

/// The added files, and the models and scenes loaded from them, latest last.
#[derive(Clone, Debug, Default)]
pub(crate) struct ModelStore {
    folder: MemoryFolder,
    models: Vec<Arc<LoadedModels>>,
    scenes: Vec<(String, LoadedScene)>,
}

impl ModelStore {
    /// Adds a file, or replaces the file with this name.
    ///
    /// # Errors
    /// Returns an error if the name is not a path below the folder of the files.
    pub(crate) fn add_file(&mut self, name: &str, bytes: Vec<u8>) -> Result<(), ExplorerError> {
        if !self.folder.insert(name, bytes) {
            let message = format!("`{name}` is not a valid file path");
            let help = "use a relative path such as models/house.glb";
            return Err(ExplorerError::new("malformed_value", message, help));
        }
        // Loaded models and scenes may depend on the file.
        self.models.clear();
        self.scenes.clear();
        Ok(())
    }

    /// Whether a file has been added.
    pub(crate) fn has_file(&self, name: &str) -> bool {
        self.folder.file(name).is_some()
    }

    /// Returns the text of an added scene file.
    pub(crate) fn scene_text(&self, name: &str) -> String {
        String::from_utf8_lossy(self.folder.file(name).unwrap_or_default()).into_owned()
    }

    /// Resolves a scene from its text and loads its models unless they are cached. `key` identifies
    /// the scene.
    ///
    /// # Errors
    /// Returns an error if the scene is invalid or a model cannot be loaded.
    pub(crate) fn resolve(
        &mut self,
        key: String,
        text: &str,
        file: &SceneFile,
    ) -> Result<LoadedScene, ExplorerError> {
        let loaded = match self.scenes.iter().position(|(known, _)| *known == key) {
            Some(at) => self.scenes.remove(at).1,
            None => self.resolve_anew(text, file)?,
        };
        if self.scenes.len() == KEPT_SCENES {
            self.scenes.remove(0);
        }
        self.scenes.push((key, loaded.clone()));
        Ok(loaded)
    }

    fn resolve_anew(&mut self, text: &str, file: &SceneFile) -> Result<LoadedScene, ExplorerError> {
        let origin = Origin::from_text_in_memory("scene.ron", text, self.folder.clone());
        if let Some(models) = self.models.iter().find(|models| models.files == file.models) {
            let models = Arc::clone(models);
            let scene = Scene::from_models(&origin, file, &models.instances)?;
            return Ok(LoadedScene { scene: Arc::new(scene), models, first_view: 0 });
        }
        let scene = Scene::resolve(&origin, file, &Default::default())?;
        let instances = scene.models.clone();
        let textures = Textures::for_models(&instances).into_owned();
        let triangles = WorldTriangles::new(&instances);
        let files = file.models.clone();
        let models = Arc::new(LoadedModels { files, instances, textures, triangles });
        if self.models.len() == KEPT_SETS {
            self.models.remove(0);
        }
        self.models.push(Arc::clone(&models));
        Ok(LoadedScene { scene: Arc::new(scene), models, first_view: 0 })
    }
}

/// Returns the style with this name, with default fields.
pub(crate) fn named_style(name: &str) -> Option<StyleFile> {
    let flag = style_flag(name);
    StyleFile::NAMED.into_iter().find(|(known, _)| *known == flag).map(|(_, make)| make())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lesson_state::STYLES;
    use scene_file::parse_scene;

    #[test]
    fn style_names_match_scene_files() {
        for name in STYLES {
            let value = if name == "Lines" { "Lines()" } else { name };
            let text = format!("Scene(models: [], style: {value})");
            let file = parse_scene("style.ron", &text).expect("a scene");
            assert_eq!(named_style(name), Some(file.style), "{name}");
        }
    }
}
