//! Errors of the program: those of the libraries, and wrong combinations of flags.

use super::color;
use drawing::SheetError;
use model::import::ImportError;
use pipeline::demonstration::DemonstrationError;
use pipeline::{OutputError, RenderError, ResolveError, SceneError};

/// A failed run. `main` prints the message after `error: ` and exits with code 1.
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
    /// An output file could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The standard output could not be written.
    #[error("cannot write to the standard output: {0}")]
    Stdout(#[from] std::io::Error),
    /// Arguments that make no sense together, or a file that they name is unusable.
    #[error("{0}")]
    Usage(String),
}

impl CliError {
    /// The message for the standard error stream, with colors if it has them.
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
