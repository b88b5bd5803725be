//! The importer's list of warnings, bounded even if a file has millions of errors.
//!
//! Some errors always become warnings, because they affect only the appearance
//! ([`ImportWarnings::downgrade`]); others do so only in lenient mode
//! ([`ImportWarnings::downgrade_if_lenient`]). The message then ends with the consequence: the part
//! that is skipped, or its replacement.

use model::{Diagnostic, Severity, codes};

/// Warnings beyond this number are counted but not stored.
const MAX_WARNINGS: usize = 500;

/// Collects warnings while a file is read.
#[derive(Debug, Default)]
pub struct ImportWarnings {
    /// Whether errors become warnings as long as something remains to load.
    lenient: bool,
    /// The stored warnings, in the order in which they were found.
    list: Vec<Diagnostic>,
    /// The number of warnings that were not stored.
    omitted: usize,
}

impl ImportWarnings {
    /// Creates an empty list; `lenient` controls [`Self::downgrade_if_lenient`].
    pub fn new(lenient: bool) -> Self {
        Self { lenient, ..Self::default() }
    }

    /// Adds a warning about something that was replaced or corrected.
    pub fn push_warning(&mut self, pointer: &str, message: impl Into<String>) {
        self.push(warning(codes::LEFT_OUT, pointer, message.into()));
    }

    /// Stores a warning, or counts it if the list is full.
    fn push(&mut self, warning: Diagnostic) {
        if self.list.len() < MAX_WARNINGS {
            self.list.push(warning);
        } else {
            self.omitted += 1;
        }
    }

    /// Adds an error as a warning. `consequence` names the part that is skipped or replaced because
    /// of the error.
    pub fn downgrade(&mut self, diagnostic: &Diagnostic, consequence: &str) {
        self.push(warning(
            diagnostic.code,
            &diagnostic.location,
            format!("{}; {consequence}", diagnostic.message),
        ));
    }

    /// Adds an error as a warning in lenient mode, and returns it otherwise.
    ///
    /// # Errors
    /// Returns the error in strict mode. Errors about limits, or about the requested scene or
    /// variant, are always returned.
    pub fn downgrade_if_lenient(
        &mut self,
        diagnostic: Diagnostic,
        consequence: &str,
    ) -> Result<(), Diagnostic> {
        if !self.lenient || matches!(diagnostic.code, codes::LIMIT_EXCEEDED | codes::NO_SUCH_ITEM) {
            return Err(diagnostic);
        }
        self.downgrade(&diagnostic, consequence);
        Ok(())
    }

    /// Moves the warnings in another list to the end of this list.
    pub fn append_warnings(&mut self, other: Self) {
        let Self { list, omitted: left_out, .. } = other;
        list.into_iter().for_each(|warning| self.push(warning));
        self.omitted += left_out;
    }

    /// Returns the stored warnings and, if others were omitted, a warning with their number.
    pub fn into_list(mut self) -> Vec<Diagnostic> {
        if self.omitted > 0 {
            let message = format!("number of warnings not listed: {}", self.omitted);
            self.list.push(warning(codes::LEFT_OUT, "", message));
        }
        self.list
    }
}

fn warning(code: &'static str, location: &str, message: String) -> Diagnostic {
    Diagnostic::new(Severity::Warning, code, location, message)
}
