//! What is wrong with a scene: collected while it is resolved, told in the order of its text.
//!
//! ```text
//!  part ─resolve─► Ok(value)    ─► Some(value)
//!               └► Err(mistake) ─► None, and the mistake is kept: what depends on the part is left
//!                                  out, for its mistakes could follow from that
//! ```

use super::{Origin, ResolveError};
use scene_file::{SceneError, SceneErrors};

/// The mistakes of a scene, as they are found.
#[derive(Debug, Default)]
pub(super) struct Diagnostics {
    errors: Vec<SceneError>,
    /// What keeps the scene from being resolved and is no mistake in its text.
    failure: Option<ResolveError>,
}

impl Diagnostics {
    /// The value, or nothing in place of a mistake, which is kept.
    pub(super) fn take<T>(&mut self, result: Result<T, impl Into<ResolveError>>) -> Option<T> {
        result.map_err(|error| self.report(error)).ok()
    }

    /// Keeps a mistake, or several.
    pub(super) fn report(&mut self, error: impl Into<ResolveError>) {
        match error.into() {
            ResolveError::Scene(errors) => self.errors.extend(Vec::from(errors)),
            other => self.failure = self.failure.take().or(Some(other)),
        }
    }

    /// Whether nothing is wrong so far.
    pub(super) fn is_empty(&self) -> bool {
        self.errors.is_empty() && self.failure.is_none()
    }

    /// Drops the mistakes that are not to be kept.
    pub(super) fn retain(&mut self, is_kept: impl FnMut(&SceneError) -> bool) {
        self.errors.retain(is_kept);
    }

    /// The mistakes in the order of the files and of their texts, each once.
    pub(super) fn into_errors(mut self, origin: &Origin) -> Vec<SceneError> {
        let files: Vec<&str> = origin.included_files().collect();
        let file_order = |error: &SceneError| files.iter().position(|file| *file == error.file);
        self.errors.sort_by_key(|error| (file_order(error), error.span.start, error.span.end));
        self.errors.dedup();
        self.errors
    }

    /// The value, if nothing is wrong.
    ///
    /// # Errors
    /// Everything that is wrong.
    pub(super) fn finish<T>(
        mut self,
        origin: &Origin,
        value: Option<T>,
    ) -> Result<T, ResolveError> {
        if let Some(failure) = self.failure.take() {
            return Err(failure);
        }
        if let Some(errors) = SceneErrors::from_list(self.into_errors(origin)) {
            return Err(errors.into());
        }
        value.ok_or_else(|| origin.error_at(&[], "the scene cannot be resolved", None).into())
    }
}
