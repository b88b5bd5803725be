//! Errors of the program: those of the libraries, and wrong combinations of flags.

use super::color;
use drawing::SheetError;
use model::import::ImportError;
use pipeline::demonstration::DemonstrationError;
use pipeline::{OutputError, RenderError, ResolveError, SceneError};

/// A failed run. `main` prints the message after `error: ` and exits with code 1.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CliError {
    #[error(transparent)]
    Resolve(#[from] ResolveError),
    #[error(transparent)]
    Import(#[from] ImportError),
    #[error(transparent)]
    Render(#[from] RenderError),
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Sheet(#[from] SheetError),
    #[error(transparent)]
    Demonstration(#[from] DemonstrationError),
    #[error(transparent)]
    Output(#[from] OutputError),
    #[error("cannot write to the standard output: {0}")]
    Stdout(#[from] std::io::Error),
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
