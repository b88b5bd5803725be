//! The scenes of a worker: a model, a scene file, or a scene file with the input as its model.
//!
//! Recently loaded models stay in memory, because the next picture often shows them again.

use super::render_flags::RenderFlags;
use crate::CliError;
use crate::memory_limit::import_limits;
use crate::render::open_input;
use files::visible_path;
use model::ModelInstance;
use pipeline::import::ImportOptions;
use pipeline::{Origin, Scene, SceneFile};
use scene_file::is_scene_file;
use std::path::Path;
use std::time::SystemTime;

/// The model path that the input replaces in a scene file.
const INPUT_PATH: &str = "{input}";

/// Loads scenes and keeps the last scene's models.
pub(super) struct SceneLoader {
    /// The worker's memory limit in bytes, from which the importer's limits follow.
    memory: Option<u64>,
    /// The most recently loaded models, with the key of their source.
    loaded: Option<(LoadKey, Vec<ModelInstance>)>,
}

/// The files and options that loaded models depend on.
#[derive(PartialEq)]
struct LoadKey {
    /// The scene file's models with their poses, and the options, as text.
    description: String,
    /// Sizes and modification times of the model files.
    stamps: Vec<Option<(u64, SystemTime)>>,
}

impl LoadKey {
    /// Returns the key of a scene's models.
    fn of(origin: &Origin, file: &SceneFile, import: &ImportOptions) -> Self {
        let stamp = |path: &String| {
            let metadata = origin.folder.join(path).metadata().ok()?;
            Some((metadata.len(), metadata.modified().ok()?))
        };
        Self {
            description: format!("{:?} {:?} {import:?}", origin.folder, file.models),
            stamps: file.models.iter().map(|model| stamp(&model.path)).collect(),
        }
    }
}

impl SceneLoader {
    /// Returns a loader with nothing loaded.
    pub(super) const fn new(memory: Option<u64>) -> Self {
        Self { memory, loaded: None }
    }

    /// Returns the scene of an input, or the scene file `around` with the input as its model.
    ///
    /// # Errors
    /// Returns an error if a file is unreadable or invalid, or the scene lacks the placeholder.
    pub(super) fn load_scene(
        &mut self,
        input: &Path,
        around: Option<&Path>,
        flags: &RenderFlags,
    ) -> Result<Scene, CliError> {
        let mut import = flags.overrides.import_options(&flags.load_options);
        if let Some(memory) = self.memory {
            import.limits = import_limits(&import.limits, memory);
        }
        let (origin, mut file) = match around {
            Some(scene) => open_scene_around(scene, input, &mut import)?,
            None => open_input(input, &import)?,
        };
        flags.overrides.apply_to(&origin, &mut file)?;
        flags.load_options.apply_crease_to(&mut file, false);
        let key = LoadKey::of(&origin, &file, &import);
        let is_loaded = self.loaded.as_ref().is_some_and(|(known, _)| *known == key);
        let mut scene = match self.loaded.take().filter(|_| is_loaded) {
            Some((_, models)) => {
                Scene::from_models_allowing(&origin, &file, &models, &import.allow_outside)?
            }
            // The old models have been dropped, so they use no memory while the new ones load.
            None => Scene::resolve(&origin, &file, &flags.overrides.resolve_options(import))?,
        };
        self.loaded = Some((key, scene.models.clone()));
        flags.overrides.place_camera(&origin, &file, &mut scene)?;
        Ok(scene)
    }
}

/// Opens a scene file and replaces each model whose path is `{input}` with the input.
///
/// The user chose the input, so it may be anywhere. Other models must be below the scene's folder.
fn open_scene_around(
    scene: &Path,
    input: &Path,
    import: &mut ImportOptions,
) -> Result<(Origin, SceneFile), CliError> {
    if is_scene_file(input) {
        return Err(CliError::Usage(format!(
            "{} is a scene, not a model; `--scene {}` takes only models",
            visible_path(input),
            visible_path(scene)
        )));
    }
    let (origin, mut file) = Origin::read_scene_allowing(scene, &import.allow_outside)?;
    // Paths in a scene are relative to its folder; the input is relative to the working directory.
    let input = std::path::absolute(input)?;
    let path = input.to_str().ok_or_else(|| {
        CliError::Usage(format!("the name {} is not UTF-8: rename the file", visible_path(&input)))
    })?;
    let mut is_there = false;
    for model in file.models.iter_mut().filter(|model| model.path == INPUT_PATH) {
        path.clone_into(&mut model.path);
        is_there = true;
    }
    if !is_there {
        return Err(CliError::Usage(format!(
            "the scene {} has no model for the input\n  = help: add `models: [Model(path: \
             \"{INPUT_PATH}\")]`",
            visible_path(scene)
        )));
    }
    import.allow_outside.push(input);
    Ok((origin, file))
}
