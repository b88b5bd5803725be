//! What can go wrong while a file is read, told so that its reader can mend it.

use std::fmt;
use std::path::PathBuf;

/// A file could not be loaded.
///
/// Reads as `cube.gltf: /buffers/0/uri: the file "cube0.bin" does not exist; put it beside the glTF file`.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{}: {diagnostic}", file.display())]
#[non_exhaustive]
pub struct ImportError {
    /// The file that was to be loaded.
    pub file: PathBuf,
    /// What is wrong with it.
    pub diagnostic: Diagnostic,
}

/// What is wrong with a file: where, what, and what to do about it.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Diagnostic {
    /// Where, as a JSON pointer (RFC 6901); empty where the file as a whole is meant.
    pub location: String,
    /// What sort of fault it is, for programs.
    pub kind: ImportErrorKind,
    /// What is wrong, for people.
    pub message: String,
    /// What to do about it.
    pub help: String,
}

/// The sorts of fault a file can have.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum ImportErrorKind {
    /// A file could not be read: it is missing, is a folder, may not be opened.
    Unreadable,
    /// A file may not be read: it lies outside of the folder that assets must stay in.
    Forbidden,
    /// The file is not glTF, or is cut off.
    Format,
    /// The file is of a version of glTF that is not known here.
    Version,
    /// The file requires an extension that is not known here.
    Extension,
    /// The file breaks a rule of the specification.
    Invalid,
    /// Data that the file speaks of is not in it, or in a form that is not read.
    NoData,
    /// The file declares more of something than the [limits](super::Limits) allow.
    Limit,
    /// A scene or a variant was asked for that the file does not have.
    NotFound,
}

impl Diagnostic {
    pub(super) fn new(kind: ImportErrorKind, pointer: &str, message: String, remedy: &str) -> Self {
        Self { location: pointer.to_owned(), kind, message, help: remedy.to_owned() }
    }

    /// A rule of the specification is broken.
    pub(super) fn invalid(pointer: &str, problem: impl Into<String>) -> Self {
        Self::new(ImportErrorKind::Invalid, pointer, problem.into(), "export the file again")
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
        Self::new(ImportErrorKind::Limit, pointer, problem, &remedy)
    }

    /// What to do about a limit that is exceeded.
    pub(super) fn raise_limit_help(limit: &str) -> String {
        let flag = limit.replace('_', "-");
        format!("raise the limit `{limit}` (--max-{flag}) if you trust the file")
    }

    /// Data is not there, or not in a form that is read.
    pub(super) fn missing_data(pointer: &str, problem: &str) -> Self {
        Self::new(
            ImportErrorKind::NoData,
            pointer,
            problem.to_owned(),
            "export the file uncompressed",
        )
    }

    /// Whether the fault lies in the file's content and not in the world around it (a missing file, a limit): only then
    /// a part of the picture may be left out with a warning.
    pub(super) fn is_downgradable(&self) -> bool {
        matches!(self.kind, ImportErrorKind::Invalid | ImportErrorKind::NoData)
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.location.is_empty() {
            write!(f, "{}: ", self.location)?;
        }
        write!(f, "{}; {}", self.message, self.help)
    }
}
