//! The validation report.

use model::{Diagnostic, Severity};
use std::path::PathBuf;

/// The diagnostics of a file, and whether it can still be drawn.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct CheckReport {
    /// The file that was checked.
    pub file: PathBuf,
    /// The diagnostics, worst severity first and otherwise in the order of the checks. Only the
    /// first few hundred of each severity are listed; the counts below include all of them.
    pub diagnostics: Vec<Diagnostic>,
    /// The number of errors: violations of the specification, or missing data.
    pub errors: usize,
    /// The number of warnings: other viewers may show the file differently, or the loader skips
    /// something.
    pub warnings: usize,
    /// The number of notes: possible improvements to valid content.
    pub notes: usize,
    /// The reason why the file cannot be loaded, or `None` if it can. Many files with errors can be
    /// loaded.
    pub load_error: Option<Diagnostic>,
}

impl CheckReport {
    /// Returns the number of diagnostics that are counted but not listed.
    #[must_use]
    pub fn omitted_count(&self) -> usize {
        (self.errors + self.warnings + self.notes).saturating_sub(self.diagnostics.len())
    }

    /// Formats the counts as a phrase: `2 errors, 1 warning, no notes; it can be drawn`.
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
