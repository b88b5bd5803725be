//! Diagnostics: one record type for everything that the importer or the validator reports about a
//! file.
//!
//! ```text
//!  severity code        location                        message                   help
//!  error[ACCESSOR_INDEX_OOB] /meshes/0/primitives/0/indices: 3 indices lack a vertex; export again
//! ```
//!
//! Diagnostics are used for the importer's warnings ([`Model::warnings`](crate::Model::warnings)),
//! for the reason why a file could not be loaded ([`ImportError`](import::ImportError)) and for
//! validation results. Severities match the Khronos glTF validator, and so do codes for issues that
//! it defines.
//!
//! Locations in glTF are JSON pointers (RFC 6901): the path of keys and indices from the root of
//! the document, with `~1` for `/` and `~0` for `~` inside a key. In other formats, a location is
//! `line 12, column 5` in a text file and `byte 84` in a binary file. In an archive, the name of
//! the part comes first: `3D/3dmodel.model: line 3, column 7`.

use files::visible_text;
use std::borrow::Cow;
use std::fmt;

/// The importer's codes. Validation also reports the Khronos validator's codes.
pub mod codes {
    /// A file could not be read: it is missing, is a folder, or could not be opened.
    pub const IO_ERROR: &str = "IO_ERROR";
    /// Access to a file is not allowed, because it is outside the asset folders.
    pub const FORBIDDEN_PATH: &str = "FORBIDDEN_PATH";
    /// Neither the content of the file nor its name identifies the format.
    pub const UNKNOWN_FORMAT: &str = "UNKNOWN_FORMAT";
    /// The file name suggests a different format than the content.
    pub const MISLEADING_NAME: &str = "MISLEADING_NAME";
    /// The file is not glTF, or is truncated.
    pub const NOT_GLTF: &str = "NOT_GLTF";
    /// The file has an unsupported glTF version.
    pub const UNSUPPORTED_VERSION: &str = "UNSUPPORTED_VERSION";
    /// The file requires an extension that is not supported.
    pub const UNSUPPORTED_REQUIRED_EXTENSION: &str = "UNSUPPORTED_REQUIRED_EXTENSION";
    /// The file breaks a rule of the specification.
    pub const INVALID_DATA: &str = "INVALID_DATA";
    /// Data that the file refers to is missing, or its encoding is not supported.
    pub const MISSING_DATA: &str = "MISSING_DATA";
    /// The file declares more items or bytes than the limits allow.
    pub const LIMIT_EXCEEDED: &str = "LIMIT_EXCEEDED";
    /// The options select a scene, a variant or a scalar attribute that the file does not have.
    pub const NO_SUCH_ITEM: &str = "NO_SUCH_ITEM";
    /// Part of the file is skipped, replaced or corrected.
    pub const LEFT_OUT: &str = "LEFT_OUT";
}

/// A report about one location in a file, with severity, code, message and remedy.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Diagnostic {
    /// The severity.
    pub severity: Severity,
    /// A machine-readable identifier of the rule: a constant from [`codes`], or the Khronos
    /// validator's name for the issue.
    pub code: &'static str,
    /// The location: in glTF a JSON pointer (RFC 6901) such as
    /// `/meshes/3/primitives/0/attributes/NORMAL`, otherwise `line 12, column 5` or `byte 84`;
    /// empty for the file as a whole.
    pub location: String,
    /// The problem and, for a warning, its consequence: a clause without a final period.
    pub message: String,
    /// The remedy, if any: a clause in the imperative.
    pub help: Option<String>,
}

/// The severity of a diagnostic, with the same order and meaning as in the Khronos glTF validator.
///
/// The worst severity compares as the smallest, so that sorting puts errors first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Severity {
    /// The file breaks a rule of its specification, or data is missing.
    Error,
    /// The file may look different in other viewers, or part of it is skipped here.
    Warning,
    /// Nothing is wrong, but something could be improved (the validator's "information").
    Info,
    /// A suggestion about style or efficiency.
    Hint,
}

impl Severity {
    /// All severities, worst first.
    pub const ALL: [Self; 4] = [Self::Error, Self::Warning, Self::Info, Self::Hint];

    /// Returns the word to print: `error`, `warning`, `note` (as in rustc) or `hint`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
            Self::Info => "note",
            Self::Hint => "hint",
        }
    }
}

impl Diagnostic {
    /// Creates a diagnostic without a remedy.
    #[must_use]
    pub fn new(
        severity: Severity,
        code: &'static str,
        location: impl Into<String>,
        message: impl Into<String>,
    ) -> Self {
        Self { severity, code, location: location.into(), message: message.into(), help: None }
    }

    /// Returns the diagnostic with a different severity.
    #[must_use]
    pub fn with_severity(self, severity: Severity) -> Self {
        Self { severity, ..self }
    }

    /// Returns the diagnostic with a different code.
    #[must_use]
    pub fn with_code(self, code: &'static str) -> Self {
        Self { code, ..self }
    }

    /// Creates an error at a location, with `help` as the remedy.
    #[must_use]
    pub fn error(
        code: &'static str,
        location: &str,
        message: impl Into<String>,
        help: &str,
    ) -> Self {
        Self {
            severity: Severity::Error,
            code,
            location: location.to_owned(),
            message: message.into(),
            help: Some(help.to_owned()),
        }
    }

    /// Creates the error for a file that breaks a rule of the specification.
    #[must_use]
    pub fn invalid(pointer: &str, message: impl Into<String>) -> Self {
        Self::error(codes::INVALID_DATA, pointer, message.into(), "export the file again")
    }

    /// Creates the error for an index out of range; `what` is the kind of item in the singular.
    #[must_use]
    pub fn unresolved_index(pointer: &str, what: &str, index: usize, count: usize) -> Self {
        let message = match count {
            0 => format!("there is no {what} {index}: the file has none"),
            1 => format!("there is no {what} {index}: the file has only {what} 0"),
            _ => format!("there is no {what} {index}: the file has {what}s 0 to {}", count - 1),
        };
        Self::invalid(pointer, message)
    }

    /// Creates the error for an exceeded limit; `limit` is a field name of the importer's `Limits`.
    #[must_use]
    pub fn limit_exceeded(pointer: &str, what: &str, limit: &str, allowed: u64) -> Self {
        let message = format!("{what}, more than the limit of {allowed}");
        let help = Self::raise_limit_help(limit);
        Self::error(codes::LIMIT_EXCEEDED, pointer, message, &help)
    }

    /// Returns the remedy for an exceeded limit, with the limit's name and command-line flag.
    #[must_use]
    pub fn raise_limit_help(limit: &str) -> String {
        let flag = limit.replace('_', "-");
        format!("raise the limit `{limit}` (--max-{flag}) if you trust the file")
    }

    /// Creates the error for data that is missing or in an unsupported encoding.
    #[must_use]
    pub fn missing_data(pointer: &str, message: &str) -> Self {
        Self::error(
            codes::MISSING_DATA,
            pointer,
            message.to_owned(),
            "export the file uncompressed",
        )
    }

    /// Returns whether the problem is in the content of the file, and not outside it (such as a
    /// missing file or a limit). Only then may part of the file be skipped with a warning.
    #[must_use]
    pub fn is_downgradable(&self) -> bool {
        matches!(self.code, codes::INVALID_DATA | codes::MISSING_DATA)
    }

    /// Formats the location, message and help in one line, without severity and code, for messages
    /// that begin with the file name. [`visible_text`] escapes names from the file.
    #[must_use]
    pub fn sentence(&self) -> String {
        let mut text = String::new();
        // A requested item that does not exist has no location in the file.
        if !self.location.is_empty() && self.code != codes::NO_SUCH_ITEM {
            text.push_str(&self.location);
            text.push_str(": ");
        }
        text.push_str(&self.message);
        if let Some(help) = &self.help {
            text.push_str("; ");
            text.push_str(help);
        }
        match visible_text(&text) {
            Cow::Borrowed(_) => text,
            Cow::Owned(visible) => visible,
        }
    }
}

impl fmt::Display for Diagnostic {
    /// Formats the diagnostic as `error[ACCESSOR_INDEX_OOB] /meshes/0/primitives/0/indices: 3
    /// indices lack a vertex; export again`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}[{}] {}", self.severity.name(), self.code, self.sentence())
    }
}
