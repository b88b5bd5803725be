//! Reads scene files and reports all mistakes at once: the mistakes in the texts, and the mistakes
//! found by resolving the readable parts.

use super::diagnostics::Diagnostics;
use super::model_files::check_model_paths;
use super::resolve::check_description;
use super::{Origin, ResolveError};
use scene_file::PathStep::Field;
use scene_file::{FileMistake, SceneError, SceneErrors, SceneFile, SceneSource};
use std::path::{Path, PathBuf};

impl Origin {
    /// Reads and parses a scene file and the files it includes, which must be inside its folder.
    /// The returned scene contains everything in these files, and includes nothing itself.
    ///
    /// # Errors
    /// Returns every mistake in their texts, or an error if a file cannot be read, is not UTF-8 or
    /// is too long, or if files include each other.
    pub fn read_scene(path: &Path) -> Result<(Self, SceneFile), ResolveError> {
        Self::read_scene_allowing(path, &[])
    }

    /// Reads and parses a scene file and the files it includes, which must be inside its folder or
    /// an `allowed` folder.
    ///
    /// # Errors
    /// Returns the same errors as [`read_scene`](Self::read_scene).
    pub fn read_scene_allowing(
        path: &Path,
        allowed: &[PathBuf],
    ) -> Result<(Self, SceneFile), ResolveError> {
        Self::from(SceneSource::read(path)?).parse_with_includes(allowed)
    }

    /// Parses a scene's text and the files it includes, which must be inside its folder or an
    /// `allowed` folder.
    ///
    /// If there are mistakes in the texts, the readable parts are resolved without the models, if
    /// possible, so that all mistakes are reported at once.
    ///
    /// # Errors
    /// Returns the same errors as [`read_scene`](Self::read_scene).
    pub fn parse_with_includes(
        mut self,
        allowed: &[PathBuf],
    ) -> Result<(Self, SceneFile), ResolveError> {
        let (file, mistakes) = self.source_mut().parse_recovering(allowed);
        if mistakes.is_empty() {
            return Ok((self, file));
        }
        let errors = with_errors_of_description(&self, &file, mistakes, allowed);
        match SceneErrors::from_list(errors) {
            Some(errors) => Err(ResolveError::Scene(errors)),
            None => Ok((self, file)),
        }
    }
}

/// Returns the mistakes in the texts of a scene's files, and the mistakes in the readable parts
/// that can be found without loading the models.
fn with_errors_of_description(
    origin: &Origin,
    file: &SceneFile,
    mistakes: Vec<FileMistake>,
    allowed: &[PathBuf],
) -> Vec<SceneError> {
    let mut faults = Diagnostics::default();
    check_description(origin, file, allowed, &mut faults);
    check_model_paths(origin, file, allowed, &mut faults);
    // An error whose range contains a mistake, or is inside one, may be caused by it.
    let is_independent = |error: &SceneError| {
        mistakes.iter().all(|FileMistake { error: mistake, scope }| {
            let (outer, inner) = (&error.span, scope);
            let contains = outer.start <= inner.start && inner.end <= outer.end;
            let is_part = inner.start <= outer.start && outer.end <= inner.end;
            mistake.file != error.file || !(contains || is_part)
        })
    };
    // A background that shows the environment needs a readable environment.
    let environment = origin.error_at(&[Field("environment")], "", None);
    let is_lost = |FileMistake { error, .. }: &FileMistake| {
        error.file == environment.file
            && environment.span.start <= error.span.start
            && error.span.end <= environment.span.end
    };
    let lost_environment = file.environment.is_none() && mistakes.iter().any(is_lost);
    let background = origin.error_at(&[Field("image"), Field("background")], "", None);
    faults.retain(|error| {
        is_independent(error) && !(lost_environment && error.span == background.span)
    });
    mistakes.into_iter().for_each(|mistake| faults.report(mistake.error));
    faults.into_errors(origin)
}
