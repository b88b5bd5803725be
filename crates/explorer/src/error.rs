//! Errors of requests: what is wrong, and what to do.

use crate::words::{Language, Sentence};
use pipeline::{RenderError, ResolveError};

/// A request that cannot be answered. The explorer is as before; the next request works.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{message}; {help}")]
pub struct ExplorerError {
    /// A stable identifier for programs, such as `unknown_key`.
    pub code: &'static str,
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub help: String,
}

impl ExplorerError {
    pub(crate) fn new(
        code: &'static str,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Self {
        Self { code, message: message.into(), help: help.into() }
    }

    /// An error in the language of the request.
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
                let usual = || "change a value, or reset the lesson".to_owned();
                Self::new("invalid_scene", first.message.clone(), help.unwrap_or_else(usual))
            }
            other => Self::new("broken_model", other.to_string(), "choose another file"),
        }
    }
}

impl From<RenderError> for ExplorerError {
    fn from(error: RenderError) -> Self {
        Self::new("cannot_render", error.to_string(), "change a value, or reset the lesson")
    }
}
