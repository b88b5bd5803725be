//! Request errors, with the problem and a remedy.

use crate::words::{Language, Sentence};
use pipeline::{RenderError, ResolveError};
use scene_file::file::InvalidNumber;

/// The error for a request that cannot be answered. The explorer is unchanged and stays usable.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{message}; {help}")]
pub struct ExplorerError {
    /// A stable identifier for programs, such as `unknown_key`.
    pub code: &'static str,
    /// The problem in one sentence.
    pub message: String,
    /// The remedy.
    pub help: String,
}

/// The remedy for an invalid scene.
const RESET: &str = "change a value or reset the lesson";
/// The remedy for a model that cannot be loaded.
const OTHER_FILE: &str = "check the file or choose another file";

impl ExplorerError {
    pub(crate) fn new(
        code: &'static str,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Self {
        Self { code, message: message.into(), help: help.into() }
    }

    /// Creates the error for an invalid scene from the message of the scene error.
    pub(crate) fn invalid_scene(error: &impl ToString) -> Self {
        Self::new("invalid_scene", error.to_string(), RESET)
    }

    /// Makes this an error about the user's model if the message begins with the name of its file.
    pub(crate) fn about_model(self, name: &str) -> Self {
        let is_of_model = !name.is_empty() && self.message.starts_with(&format!("{name}: "));
        match is_of_model {
            true if self.help == RESET => {
                Self { code: "broken_model", help: OTHER_FILE.into(), ..self }
            }
            true => Self { code: "broken_model", ..self },
            false => self,
        }
    }

    /// Returns an error with a message in the language of the request.
    pub(crate) fn in_language(
        code: &'static str,
        language: Language,
        message: Sentence,
        help: Sentence,
    ) -> Self {
        match language {
            Language::English => Self::new(code, message.en, help.en),
            Language::Chinese => Self::new(code, message.zh, help.zh),
        }
    }
}

impl From<ResolveError> for ExplorerError {
    fn from(error: ResolveError) -> Self {
        match error {
            ResolveError::Scene(errors) => {
                let first = errors.first();
                let help = first.help.clone();
                let help = help.unwrap_or_else(|| RESET.to_owned());
                Self::new("invalid_scene", first.message.clone(), help)
            }
            other => Self::new("broken_model", other.to_string(), OTHER_FILE),
        }
    }
}

impl From<InvalidNumber> for ExplorerError {
    fn from(error: InvalidNumber) -> Self {
        Self::invalid_scene(&error)
    }
}

impl From<RenderError> for ExplorerError {
    fn from(error: RenderError) -> Self {
        Self::new("cannot_render", error.to_string(), RESET)
    }
}
