//! What a check has found, for people and for programs.

use crate::diagnostic::{Diagnostic, Severity};
use std::path::PathBuf;

/// What is wrong with a file, and whether it can be drawn all the same.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct CheckReport {
    /// The file that was checked.
    pub file: PathBuf,
    /// The problems, the worst first, and those of one severity in the order of the subjects. Of each severity only the
    /// first few hundred are kept; the counts below count all.
    pub diagnostics: Vec<Diagnostic>,
    /// How many errors there are: rules of the specification that are broken, or data that is not there.
    pub errors: usize,
    /// How many warnings there are: what may look different elsewhere, and what is left out here.
    pub warnings: usize,
    /// How many notes there are: nothing is wrong, but something could be better.
    pub notes: usize,
    /// Why the file cannot be drawn; `None` if it can, with whatever is left out. Many a file with errors can.
    pub load_error: Option<Diagnostic>,
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
            count(self.notes, Severity::Info),
        ];
        let outcome = match &self.load_error {
            None => "it can be drawn".to_owned(),
            Some(fault) if fault.location.is_empty() => "it cannot be drawn".to_owned(),
            Some(fault) => format!("it cannot be drawn because of {}", fault.location),
        };
        format!("{}; {outcome}", counts.join(", "))
    }
}
