//! The reasons why a scene cannot be resolved.

use import::ImportError;
use scene_file::{SceneError, SceneErrors, UnreadableScene};

/// The reason why a scene cannot be resolved.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ResolveError {
    /// Mistakes in the scene file.
    #[error(transparent)]
    Scene(#[from] SceneErrors),
    /// A model cannot be loaded.
    #[error(transparent)]
    Model(#[from] ImportError),
    /// The scene file cannot be read.
    #[error(transparent)]
    Unreadable(#[from] UnreadableScene),
}

impl From<SceneError> for ResolveError {
    fn from(error: SceneError) -> Self {
        Self::Scene(error.into())
    }
}
