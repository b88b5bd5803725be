//! Collects a limited number of diagnostics without duplicates, even for millions of defects.

use super::codes::DiagnosticCode;
use model::{Diagnostic, Severity};
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::fmt::Display;

/// The maximum number of listed diagnostics of each severity; any more are only counted.
///
/// Nobody reads a longer report, but it would cost every consumer memory and time.
const MAX_PER_SEVERITY: usize = 400;
/// The maximum length of a message or pointer in bytes, because names in a file may be megabytes
/// long.
const MAX_TEXT_LENGTH: usize = 500;

/// Collects diagnostics while a file is validated.
///
/// Interior mutability lets every check borrow the document and report through it.
#[derive(Default, Debug)]
pub(super) struct Diagnostics {
    /// One list for each severity, in the order of [`Severity::ALL`].
    lists: RefCell<[SeverityList; Severity::ALL.len()]>,
}

/// The diagnostics of one severity.
///
/// Duplicates are recognized by code and pointer: two messages with the same code and location are
/// equivalent.
#[derive(Default, Debug)]
struct SeverityList {
    /// The listed diagnostics, in the order in which they were added.
    retained: Vec<Diagnostic>,
    /// The code and pointer of each diagnostic, to drop duplicates.
    known_keys: BTreeSet<(&'static str, String)>,
    /// The number of all diagnostics, listed or not.
    count: usize,
}

impl Diagnostics {
    /// Adds a diagnostic with the help text of its code. If the list is full, the diagnostic is
    /// only counted.
    pub(super) fn add(&self, code: &DiagnosticCode, pointer: impl Display, message: impl Display) {
        self.add_with_help(code, pointer, message, code.remedy);
    }

    /// Adds a diagnostic with a specific help text. A second diagnostic with the same code and
    /// pointer is dropped.
    pub(super) fn add_with_help(
        &self,
        code: &DiagnosticCode,
        pointer: impl Display,
        message: impl Display,
        remedy: &str,
    ) {
        let list = &mut self.lists.borrow_mut()[code.severity as usize];
        if list.retained.len() >= MAX_PER_SEVERITY {
            list.count += 1;
            return;
        }
        let pointer = truncate_text(pointer.to_string());
        if list.known_keys.insert((code.name, pointer.clone())) {
            list.count += 1;
            let message = truncate_text(message.to_string());
            let found = Diagnostic::error(code.name, &pointer, message, remedy);
            list.retained.push(found.with_severity(code.severity));
        }
    }

    /// Returns whether there is a diagnostic of severity `worst` or worse at this pointer or below
    /// it.
    pub(super) fn has_at_or_below(&self, worst: Severity, pointer: &str) -> bool {
        let lists = self.lists.borrow();
        let concerns = |problem: &Diagnostic| {
            let rest = problem.location.strip_prefix(pointer);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
        };
        let worse = &lists[..=worst as usize];
        !pointer.is_empty() && worse.iter().any(|list| list.retained.iter().any(concerns))
    }

    /// Returns whether there is an error.
    pub(super) fn has_errors(&self) -> bool {
        self.lists.borrow()[Severity::Error as usize].count > 0
    }

    /// Returns whether there is a diagnostic with this code.
    pub(super) fn has_code(&self, code: &DiagnosticCode) -> bool {
        let list = &self.lists.borrow()[code.severity as usize];
        list.retained.iter().any(|problem| problem.code == code.name)
    }

    /// Returns the listed diagnostics, worst first, and the error, warning and note counts.
    pub(super) fn into_parts(self) -> (Vec<Diagnostic>, [usize; 3]) {
        let lists = self.lists.into_inner();
        let [errors, warnings, info, hints] = Severity::ALL.map(|s| lists[s as usize].count);
        let counts = [errors, warnings, info + hints];
        (lists.into_iter().flat_map(|list| list.retained).collect(), counts)
    }
}

/// Truncates a string at a character boundary.
fn truncate_text(mut text: String) -> String {
    if text.len() > MAX_TEXT_LENGTH {
        let end = (0..=MAX_TEXT_LENGTH).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0);
        text.truncate(end);
        text.push('…');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::codes;
    use super::*;

    #[test]
    fn diagnostics_are_limited_sorted_and_deduplicated() {
        let diagnostics = Diagnostics::default();
        diagnostics.add(&codes::NODE_EMPTY, "/nodes/0", "empty");
        for at in [1, 1, 2] {
            diagnostics.add(&codes::ACCESSOR_TOO_LONG, format_args!("/accessors/{at}"), "too long");
        }
        for at in 0..1_000_000 {
            diagnostics.add(&codes::NON_RELATIVE_URI, format_args!("/images/{at}/uri"), "absolute");
        }
        diagnostics.add(&codes::EMPTY_ENTITY, "é".repeat(10_000), "empty");
        let knows = |pointer| diagnostics.has_at_or_below(Severity::Warning, pointer);
        assert!(knows("/accessors/1") && knows("/accessors") && knows("/images/7"));
        assert!(!knows("/accessors/11") && !knows("/nodes/0") && !knows(""));
        assert!(!diagnostics.has_at_or_below(Severity::Error, "/images/7"));
        let (problems, counts) = diagnostics.into_parts();
        assert_eq!(counts, [3, 1_000_000, 1]);
        assert_eq!(problems.len(), 3 + MAX_PER_SEVERITY + 1);
        assert!(problems.windows(2).all(|pair| pair[0].severity <= pair[1].severity));
        assert!(problems[2].location.len() < MAX_TEXT_LENGTH + 5);
    }
}
