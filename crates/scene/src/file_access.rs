//! The source of a scene's environment and backdrop files: read now, or already loaded.

use super::backdrop::resolve_backdrop;
use super::surrounding_light::resolve_environment;
use super::{Origin, Scene};
use model::ModelInstance;
use scene_file::file::EnvironmentFile;
use scene_file::{SceneError, SceneFile};
use shade::{Backdrop, Environment};
use std::path::PathBuf;
use std::sync::Arc;

/// The source of environment and backdrop files.
#[derive(Clone, Copy, Debug)]
pub enum FileAccess<'a> {
    /// Read from the scene's folder or from these folders.
    Read(&'a [PathBuf]),
    /// Taken from a scene with the same description whose models are in a different pose.
    Loaded(&'a Scene),
}

impl FileAccess<'_> {
    /// Returns the access for the inset with this index.
    pub(super) fn for_inset(self, index: usize) -> Self {
        match self {
            Self::Loaded(scene) => {
                Self::Loaded(scene.insets.get(index).map_or(scene, |inset| &inset.scene))
            }
            read @ Self::Read(_) => read,
        }
    }

    /// Returns the environment of a scene. The default one depends on the models' lights.
    pub(super) fn environment(
        self,
        origin: &Origin,
        file: &SceneFile,
        models: &[ModelInstance],
        exposure_ev: f64,
    ) -> Result<Option<Arc<Environment>>, SceneError> {
        match self {
            Self::Read(allowed) => resolve_environment(origin, file, models, allowed, exposure_ev),
            Self::Loaded(scene)
                if matches!(file.environment, Some(EnvironmentFile::File { .. })) =>
            {
                Ok(scene.environment.clone())
            }
            Self::Loaded(_) => resolve_environment(origin, file, models, &[], exposure_ev),
        }
    }

    /// Returns the backdrop behind the models, if it is more than a color.
    pub(super) fn backdrop(
        self,
        origin: &Origin,
        file: &SceneFile,
    ) -> Result<Option<Arc<Backdrop>>, SceneError> {
        match self {
            Self::Read(allowed) => resolve_backdrop(origin, file, allowed),
            Self::Loaded(scene) => Ok(scene.backdrop.clone()),
        }
    }
}
