//! The files that a scene's environment and backdrop come from: read, or loaded already.

use super::backdrop::resolve_backdrop;
use super::surrounding_light::resolve_environment;
use super::{Origin, Scene};
use model::ModelInstance;
use scene_file::file::EnvironmentFile;
use scene_file::{SceneError, SceneFile};
use shade::{Backdrop, Environment};
use std::path::PathBuf;
use std::sync::Arc;

/// Where the files of environments and backdrops come from.
#[derive(Clone, Copy, Debug)]
pub enum FileAccess<'a> {
    /// They are read, from the scene's folder or from these.
    Read(&'a [PathBuf]),
    /// A scene of the same description has them, with its models in another pose.
    Loaded(&'a Scene),
}

impl FileAccess<'_> {
    /// The access for the inset of an index.
    pub(super) fn for_inset(self, index: usize) -> Self {
        match self {
            Self::Loaded(scene) => {
                Self::Loaded(scene.insets.get(index).map_or(scene, |inset| &inset.scene))
            }
            read @ Self::Read(_) => read,
        }
    }

    /// The environment of a scene. One without a file depends on the models' lights.
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

    /// What is behind the models, if it is more than a color.
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
