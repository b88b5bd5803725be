//! What can go wrong while a file is read, told so that its reader can mend it.

use crate::diagnostic::{Diagnostic, codes};
use std::path::PathBuf;

/// A file could not be loaded.
///
/// Reads as `cube.gltf: /buffers/0/uri: the file "cube0.bin" does not exist; put it beside the glTF file`.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{}: {}", file.display(), diagnostic.sentence())]
#[non_exhaustive]
pub struct ImportError {
    /// The file that was to be loaded.
    pub file: PathBuf,
    /// What is wrong with it.
    pub diagnostic: Diagnostic,
}

impl Diagnostic {
    /// A rule of the specification is broken.
    pub(super) fn invalid(pointer: &str, problem: impl Into<String>) -> Self {
        Self::error(codes::INVALID_DATA, pointer, problem.into(), "export the file again")
    }

    /// An index points to nothing.
    pub(super) fn unresolved_index(pointer: &str, what: &str, index: usize, count: usize) -> Self {
        let problem = match count {
            0 => format!("there is no {what} {index}: the file has none"),
            1 => format!("there is no {what} {index}: the file has only {what} 0"),
            _ => format!("there is no {what} {index}: the file has {what}s 0 to {}", count - 1),
        };
        Self::invalid(pointer, problem)
    }

    /// The file declares too much of something; `limit` is the name of the field of [`super::Limits`], which says the flag.
    pub(super) fn limit_exceeded(pointer: &str, what: &str, limit: &str, allowed: u64) -> Self {
        let problem = format!("{what}, more than the limit of {allowed}");
        let remedy = Self::raise_limit_help(limit);
        Self::error(codes::LIMIT_EXCEEDED, pointer, problem, &remedy)
    }

    /// What to do about a limit that is exceeded.
    pub(super) fn raise_limit_help(limit: &str) -> String {
        let flag = limit.replace('_', "-");
        format!("raise the limit `{limit}` (--max-{flag}) if you trust the file")
    }

    /// Data is not there, or not in a form that is read.
    pub(super) fn missing_data(pointer: &str, problem: &str) -> Self {
        Self::error(
            codes::MISSING_DATA,
            pointer,
            problem.to_owned(),
            "export the file uncompressed",
        )
    }

    /// Whether the fault lies in the file's content and not in the world around it (a missing file, a limit): only then
    /// a part of the picture may be left out with a warning.
    pub(super) fn is_downgradable(&self) -> bool {
        matches!(self.code, codes::INVALID_DATA | codes::MISSING_DATA)
    }
}
