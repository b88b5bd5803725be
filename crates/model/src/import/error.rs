//! What can go wrong while a file is read, told so that its reader can mend it.

use std::fmt;
use std::path::PathBuf;

/// A file could not be loaded.
///
/// Reads as `cube.gltf: /buffers/0/uri: the file "cube0.bin" does not exist; put it beside the glTF file`.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error("{}: {fault}", file.display())]
#[non_exhaustive]
pub struct ImportError {
    /// The file that was to be loaded.
    pub file: PathBuf,
    /// What is wrong with it.
    pub fault: Fault,
}

/// What is wrong with a file: where, what, and what to do about it.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Fault {
    /// Where, as a JSON pointer (RFC 6901); empty where the file as a whole is meant.
    pub pointer: String,
    /// What sort of fault it is, for programs.
    pub kind: FaultKind,
    /// What is wrong, for people.
    pub problem: String,
    /// What to do about it.
    pub remedy: String,
}

/// The sorts of fault a file can have.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum FaultKind {
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
    Choice,
}

impl Fault {
    pub(super) fn new(kind: FaultKind, pointer: &str, problem: String, remedy: &str) -> Self {
        Self { pointer: pointer.to_owned(), kind, problem, remedy: remedy.to_owned() }
    }

    /// A rule of the specification is broken.
    pub(super) fn invalid(pointer: &str, problem: impl Into<String>) -> Self {
        Self::new(FaultKind::Invalid, pointer, problem.into(), "export the file again")
    }

    /// An index points to nothing.
    pub(super) fn unresolved(pointer: &str, what: &str, index: usize, count: usize) -> Self {
        let problem = match count {
            0 => format!("there is no {what} {index}: the file has none"),
            1 => format!("there is no {what} {index}: the file has only {what} 0"),
            _ => format!("there is no {what} {index}: the file has {what}s 0 to {}", count - 1),
        };
        Self::invalid(pointer, problem)
    }

    /// The file declares too much of something; `limit` is the name of the field of [`super::Limits`], which says the flag.
    pub(super) fn limit(pointer: &str, what: &str, limit: &str, allowed: u64) -> Self {
        let problem = format!("{what}, more than the limit of {allowed}");
        let remedy = Self::raise(limit);
        Self::new(FaultKind::Limit, pointer, problem, &remedy)
    }

    /// What to do about a limit that is exceeded.
    pub(super) fn raise(limit: &str) -> String {
        let flag = limit.replace('_', "-");
        format!("raise the limit `{limit}` (--max-{flag}) if you trust the file")
    }

    /// Data is not there, or not in a form that is read.
    pub(super) fn no_data(pointer: &str, problem: &str) -> Self {
        Self::new(FaultKind::NoData, pointer, problem.to_owned(), "export the file uncompressed")
    }

    /// Whether the fault lies in the file's content and not in the world around it (a missing file, a limit): only then
    /// a part of the picture may be left out with a warning.
    pub(super) fn is_soft(&self) -> bool {
        matches!(self.kind, FaultKind::Invalid | FaultKind::NoData)
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.pointer.is_empty() {
            write!(f, "{}: ", self.pointer)?;
        }
        write!(f, "{}; {}", self.problem, self.remedy)
    }
}
