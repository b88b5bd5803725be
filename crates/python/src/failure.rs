//! Failures: all errors in the package, as one Python exception.
//!
//! ```text
//!  errors from crates ───┐
//!  wrong arguments ──────┼─► Failure ─► alberti.AlbertiError(message, code, pointer, help)
//!  panics ───────────────┘
//! ```

use hidden_line::DrawError;
use import::ImportError;
use model::codes;
use pipeline::{RenderError, ResolveError, SceneError};
use pyo3::prelude::*;

pyo3::import_exception!(alberti._errors, AlbertiError);

/// The code for invalid arguments.
pub(crate) const INVALID_ARGUMENT: &str = "INVALID_ARGUMENT";
/// The code for errors in scenes and for impossible cameras.
const SCENE_ERROR: &str = "SCENE_ERROR";
/// The code for pictures that cannot be rendered.
const RENDER_ERROR: &str = "RENDER_ERROR";
/// The code for panics.
const INTERNAL_ERROR: &str = "INTERNAL_ERROR";

/// The result of operations that need no Python and can fail.
pub(crate) type Fallible<T> = Result<T, Failure>;

/// The reason why a call failed.
#[derive(Debug)]
pub(crate) struct Failure {
    /// The kind of error, as a code for programs.
    pub(crate) code: &'static str,
    /// The location: the argument, or the position in a file.
    pub(crate) pointer: String,
    /// A description of the problem.
    pub(crate) message: String,
    /// The suggested remedy.
    pub(crate) help: Option<String>,
}

impl Failure {
    /// Creates the failure for an invalid argument; `argument` is its name, if necessary with the
    /// index of an element.
    pub(crate) fn argument(argument: impl Into<String>, message: impl Into<String>) -> Self {
        let (pointer, message) = (argument.into(), message.into());
        Self { code: INVALID_ARGUMENT, pointer, message, help: None }
    }

    /// Creates the failure for an exceeded limit.
    pub(crate) fn limit(argument: &str, message: impl Into<String>, help: &str) -> Self {
        let (pointer, message) = (argument.to_owned(), message.into());
        Self { code: codes::LIMIT_EXCEEDED, pointer, message, help: Some(help.to_owned()) }
    }

    /// Creates the failure for a panic, which is a bug in this package.
    pub(crate) fn internal(panic: &(dyn std::any::Any + Send)) -> Self {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        let text = text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no message");
        Self {
            code: INTERNAL_ERROR,
            pointer: String::new(),
            message: format!("internal error in the renderer: {text}"),
            help: Some("please report this, with the input".to_owned()),
        }
    }

    /// Adds advice to this failure.
    pub(crate) fn with_help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        let Failure { code, pointer, message, help } = failure;
        AlbertiError::new_err((message, code, pointer, help))
    }
}

impl From<ImportError> for Failure {
    fn from(error: ImportError) -> Self {
        let diagnostic = *error.diagnostic;
        Self {
            code: diagnostic.code,
            pointer: diagnostic.location,
            message: format!("{}: {}", error.file.display(), diagnostic.message),
            help: diagnostic.help,
        }
    }
}

impl From<ResolveError> for Failure {
    fn from(error: ResolveError) -> Self {
        match error {
            ResolveError::Model(error) => error.into(),
            ResolveError::Scene(errors) => {
                let mut failure = Self::from(errors.first().clone());
                if errors.iter().count() > 1 {
                    failure.message = errors.to_message(false);
                }
                failure
            }
            other => Self {
                code: codes::IO_ERROR,
                pointer: String::new(),
                message: other.to_string(),
                help: None,
            },
        }
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        if error.source.is_empty() {
            let SceneError { message, help, .. } = error;
            return Self { code: SCENE_ERROR, pointer: String::new(), message, help };
        }
        let (line, column) = error.line_and_column();
        Self {
            code: SCENE_ERROR,
            pointer: format!("line {line}, column {column}"),
            message: error.to_message(false),
            help: error.help,
        }
    }
}

impl From<RenderError> for Failure {
    fn from(error: RenderError) -> Self {
        let (pointer, message) = (String::new(), error.to_string());
        Self { code: RENDER_ERROR, pointer, message, help: None }
    }
}

impl From<DrawError> for Failure {
    fn from(error: DrawError) -> Self {
        RenderError::from(error).into()
    }
}
