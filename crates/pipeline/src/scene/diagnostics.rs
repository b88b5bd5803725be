//! What is wrong with a scene: collected while it is resolved, told in the order of its text.
//!
//! ```text
//!  part ─resolve─► Ok(value)    ─► Some(value)
//!               └► Err(mistake) ─► None, and the mistake is kept: what depends on the part is left
//!                                  out, for its mistakes could follow from that
//! ```

use super::include::FileMistake;
use super::model_files::check_model_paths;
use super::resolve::check_description;
use super::syntax::PathStep::Field;
use super::{Origin, ResolveError, SceneError, SceneErrors, SceneFile};
use std::path::PathBuf;

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

/// The mistakes in the texts of a scene's files, and those that what could be read has besides, as
/// far as the models need not be loaded for that.
pub(super) fn with_errors_of_description(
    origin: &Origin,
    file: &SceneFile,
    mistakes: Vec<FileMistake>,
    allowed: &[PathBuf],
) -> Vec<SceneError> {
    let mut faults = Diagnostics::default();
    check_description(origin, file, allowed, &mut faults);
    check_model_paths(origin, file, allowed, &mut faults);
    // What contains a mistake, or is part of one, may be wrong because of it.
    let is_independent = |error: &SceneError| {
        mistakes.iter().all(|FileMistake { error: mistake, scope }| {
            let (outer, inner) = (&error.span, scope);
            let contains = outer.start <= inner.start && inner.end <= outer.end;
            let is_part = inner.start <= outer.start && outer.end <= inner.end;
            mistake.file != error.file || !(contains || is_part)
        })
    };
    // A background that shows the environment needs one that could be read.
    let environment = origin.error_at(&[Field("environment")], "", None);
    let is_lost = |FileMistake { error, .. }: &FileMistake| {
        error.file == environment.file
            && environment.span.start <= error.span.start
            && error.span.end <= environment.span.end
    };
    let lost_environment = file.environment.is_none() && mistakes.iter().any(is_lost);
    let background = origin.error_at(&[Field("image"), Field("background")], "", None);
    faults.errors.retain(|error| {
        is_independent(error) && !(lost_environment && error.span == background.span)
    });
    faults.errors.extend(mistakes.into_iter().map(|mistake| mistake.error));
    faults.into_errors(origin)
}
