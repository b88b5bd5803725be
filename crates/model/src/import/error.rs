//! Import errors: the diagnostic that stopped loading, and constructors for the common kinds.

use crate::diagnostic::{Diagnostic, codes};
use crate::visible_text::visible_path;
use std::path::PathBuf;

/// A file could not be loaded.
///
/// Displayed as `cube.gltf: /buffers/0/uri: the file "cube0.bin" does not exist; put it beside the
/// glTF file`.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{}: {}", visible_path(file), diagnostic.sentence())]
#[non_exhaustive]
pub struct ImportError {
    /// The file that was to be loaded.
    pub file: PathBuf,
    /// The error that stopped loading; its [`code`](Diagnostic::code) is one of [`codes`].
    ///
    /// Boxed, so that a `Result` with this error stays small.
    pub diagnostic: Box<Diagnostic>,
}

impl Diagnostic {
    /// The file breaks a rule of the specification.
    pub(super) fn invalid(pointer: &str, message: impl Into<String>) -> Self {
        Self::error(codes::INVALID_DATA, pointer, message.into(), "export the file again")
    }

    /// An index is out of range; `what` names the collection in the singular.
    pub(super) fn unresolved_index(pointer: &str, what: &str, index: usize, count: usize) -> Self {
        let message = match count {
            0 => format!("there is no {what} {index}: the file has none"),
            1 => format!("there is no {what} {index}: the file has only {what} 0"),
            _ => format!("there is no {what} {index}: the file has {what}s 0 to {}", count - 1),
        };
        Self::invalid(pointer, message)
    }

    /// The file declares too much; `limit` is the name of a field of [`Limits`](super::Limits).
    pub(super) fn limit_exceeded(pointer: &str, what: &str, limit: &str, allowed: u64) -> Self {
        let message = format!("{what}, more than the limit of {allowed}");
        let help = Self::raise_limit_help(limit);
        Self::error(codes::LIMIT_EXCEEDED, pointer, message, &help)
    }

    /// The remedy for an exceeded limit: its name and its flag on the command line.
    pub(super) fn raise_limit_help(limit: &str) -> String {
        let flag = limit.replace('_', "-");
        format!("raise the limit `{limit}` (--max-{flag}) if you trust the file")
    }

    /// Data is absent, or in an encoding that is not supported.
    pub(super) fn missing_data(pointer: &str, message: &str) -> Self {
        Self::error(
            codes::MISSING_DATA,
            pointer,
            message.to_owned(),
            "export the file uncompressed",
        )
    }

    /// Whether the fault is in the content of the file and not around it (a missing file, a limit).
    /// Only then may part of the picture be left out with a warning.
    pub(super) fn is_downgradable(&self) -> bool {
        matches!(self.code, codes::INVALID_DATA | codes::MISSING_DATA)
    }
}
