//! Program errors: errors from the libraries, and wrong combinations of flags.
//!
//! Usage errors that clap detects while parsing never become a [`CliError`]: they exit with code 2.
//! An invalid combination that depends on the input or on several flags is a [`CliError::Usage`]
//! and exits with code 1 like any failure.
//!
//! A message may have several lines. Later lines begin with ` = help:` and name a flag or a value
//! that fixes the problem, as in rustc.

use super::color;
use batch::BatchError;
use explorer::demonstration::DemonstrationError;
use import::ImportError;
use pipeline::{OutputError, RenderError, ResolveError, SceneError};
use sheet::SheetError;

/// A failed run. `main` prints the message after `error: ` and exits with code 1.
///
/// No variant adds text to library errors: they already name the file and the field. The exception
/// is the standard output, whose I/O errors do not say where they happened.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CliError {
    /// A scene could not be read or resolved.
    #[error(transparent)]
    Resolve(#[from] ResolveError),
    /// A model could not be loaded.
    #[error(transparent)]
    Import(#[from] ImportError),
    /// A scene could not be rendered.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// A scene file has an error; the message quotes it with a caret.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A sheet could not be laid out.
    #[error(transparent)]
    Sheet(#[from] SheetError),
    /// A page of panels could not be drawn.
    #[error(transparent)]
    Demonstration(#[from] DemonstrationError),
    /// A batch had to stop.
    #[error(transparent)]
    Batch(BatchError),
    /// An output file could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The standard output could not be written.
    #[error("cannot write to the standard output: {0}")]
    Stdout(#[from] std::io::Error),
    /// The arguments contradict each other, or a file they name is unusable.
    #[error("{0}")]
    Usage(String),
}

impl From<BatchError> for CliError {
    fn from(error: BatchError) -> Self {
        match error {
            BatchError::Flush(cause) => cause.into(),
            other => Self::Batch(other),
        }
    }
}

impl CliError {
    /// Returns the message for the standard error stream, in color if the stream is colored.
    ///
    /// Only scene file errors are colored: they quote the line with a caret below the mistake. A
    /// demonstration error may wrap one, since demonstrations resolve scenes themselves.
    pub(crate) fn to_message(&self) -> String {
        match self {
            Self::Resolve(ResolveError::Scene(mistake))
            | Self::Demonstration(DemonstrationError::Resolve(ResolveError::Scene(mistake))) => {
                mistake.to_message(color::stderr_has_color())
            }
            other => other.to_string(),
        }
    }
}
