//! Collects the mistakes in a scene during resolution, and reports them in text order.
//!
//! ```text
//!  part ─resolve─► Ok(value)    ─► Some(value)
//!               └► Err(mistake) ─► None, and the mistake is collected; dependent parts are skipped,
//!                                  because their mistakes could be consequences of this one
//! ```

use super::{Origin, ResolveError};
use scene_file::{SceneError, SceneErrors};

/// The mistakes in a scene, in the order of discovery.
#[derive(Debug, Default)]
pub(super) struct Diagnostics {
    errors: Vec<SceneError>,
    /// The first failure that is not a mistake in the scene's text.
    failure: Option<ResolveError>,
}

impl Diagnostics {
    /// Returns the value, or records the mistake and returns `None`.
    pub(super) fn take<T>(&mut self, result: Result<T, impl Into<ResolveError>>) -> Option<T> {
        result.map_err(|error| self.report(error)).ok()
    }

    /// Records one or more mistakes.
    pub(super) fn report(&mut self, error: impl Into<ResolveError>) {
        match error.into() {
            ResolveError::Scene(errors) => self.errors.extend(Vec::from(errors)),
            other => self.failure = self.failure.take().or(Some(other)),
        }
    }

    /// Whether there are no mistakes so far.
    pub(super) fn is_empty(&self) -> bool {
        self.errors.is_empty() && self.failure.is_none()
    }

    /// Keeps only the mistakes that `is_kept` accepts.
    pub(super) fn retain(&mut self, is_kept: impl FnMut(&SceneError) -> bool) {
        self.errors.retain(is_kept);
    }

    /// Returns the mistakes in order of file and position, without duplicates.
    pub(super) fn into_errors(mut self, origin: &Origin) -> Vec<SceneError> {
        let files: Vec<&str> = origin.included_files().collect();
        let file_order = |error: &SceneError| files.iter().position(|file| *file == error.file);
        self.errors.sort_by_key(|error| (file_order(error), error.span.start, error.span.end));
        self.errors.dedup();
        self.errors
    }

    /// Returns the value if there are no mistakes.
    ///
    /// # Errors
    /// Returns every mistake.
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
