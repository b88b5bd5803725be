//! What a check has found, for people and for programs.

use crate::import::Diagnostic;
use std::fmt;
use std::path::PathBuf;

/// What is wrong with a file, and whether it can be drawn all the same.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct CheckReport {
    /// The file that was checked.
    pub file: PathBuf,
    /// The problems, the worst first, and those of one severity in the order of the subjects. Of each severity only the
    /// first few hundred are kept; the counts below count all.
    pub diagnostics: Vec<Problem>,
    /// How many errors there are: rules of the specification that are broken, or data that is not there.
    pub errors: usize,
    /// How many warnings there are: what may look different elsewhere, and what is left out here.
    pub warnings: usize,
    /// How many notes there are: nothing is wrong, but something could be better.
    pub notes: usize,
    /// Why the file cannot be drawn; `None` if it can, with whatever is left out. Many a file with errors can.
    pub load_error: Option<Diagnostic>,
}

/// One thing that is wrong with a file.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct Problem {
    /// How bad it is.
    pub severity: Severity,
    /// What it is, for programs: the name that the Khronos validator has for it, where it has one.
    pub code: &'static str,
    /// Where, as a JSON pointer (RFC 6901); empty where the file as a whole is meant.
    pub pointer: String,
    /// What is wrong, for people.
    pub message: String,
    /// What to do about it.
    pub remedy: String,
}

/// How bad a problem is; the worst is the least, so that it comes first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Severity {
    /// The file is not as the specification demands, or data is not there.
    Error,
    /// It may look different elsewhere, or something is left out here.
    Warning,
    /// Nothing is wrong, but something could be better.
    Note,
}

impl Severity {
    /// All severities, the worst first.
    pub const ALL: [Self; 3] = [Self::Error, Self::Warning, Self::Note];

    /// The word for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
            Self::Note => "note",
        }
    }
}

impl fmt::Display for Problem {
    /// `error[ACCESSOR_INDEX_OOB] /meshes/0/primitives/0/indices: 3 of 36 indices have no vertex; export the file again`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}[{}] ", self.severity.name(), self.code)?;
        if !self.pointer.is_empty() {
            write!(f, "{}: ", self.pointer)?;
        }
        write!(f, "{}", self.message)?;
        if self.remedy.is_empty() { Ok(()) } else { write!(f, "; {}", self.remedy) }
    }
}

impl CheckReport {
    /// How many problems are counted but not listed.
    #[must_use]
    pub fn omitted_count(&self) -> usize {
        (self.errors + self.warnings + self.notes).saturating_sub(self.diagnostics.len())
    }

    /// The counts in words: `2 errors, 1 warning, no notes; it can be drawn`.
    #[must_use]
    pub fn summary(&self) -> String {
        let count = |number: usize, severity: Severity| match number {
            0 => format!("no {}s", severity.name()),
            1 => format!("1 {}", severity.name()),
            _ => format!("{number} {}s", severity.name()),
        };
        let counts = [
            count(self.errors, Severity::Error),
            count(self.warnings, Severity::Warning),
            count(self.notes, Severity::Note),
        ];
        let outcome = match &self.load_error {
            None => "it can be drawn".to_owned(),
            Some(fault) if fault.location.is_empty() => "it cannot be drawn".to_owned(),
            Some(fault) => format!("it cannot be drawn because of {}", fault.location),
        };
        format!("{}; {outcome}", counts.join(", "))
    }
}
