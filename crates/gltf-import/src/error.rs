//! Import errors: the diagnostic that stopped loading, and constructors for the common kinds.

use files::visible_path;
use model::Diagnostic;
use std::path::PathBuf;

/// The error for a file that could not be loaded.
///
/// Displayed as `cube.gltf: /buffers/0/uri: the file "cube0.bin" does not exist; put it next to the
/// glTF file`.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{}: {}", visible_path(file), diagnostic.sentence())]
#[non_exhaustive]
pub struct ImportError {
    /// The path of the file.
    pub file: PathBuf,
    /// The error that stopped loading; its [`code`](Diagnostic::code) is one of
    /// [`codes`](model::codes).
    ///
    /// Boxed, so that a `Result` with this error stays small.
    pub diagnostic: Box<Diagnostic>,
}

impl ImportError {
    /// Creates the error for a file whose loading was stopped by a diagnostic.
    #[must_use]
    pub fn new(file: impl Into<PathBuf>, diagnostic: Diagnostic) -> Self {
        Self { file: file.into(), diagnostic: Box::new(diagnostic) }
    }
}
