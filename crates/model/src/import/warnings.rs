//! The list of soft faults, kept short even if a file has millions.

use crate::diagnostic::{Diagnostic, Severity, codes};

/// So many warnings are kept; a reader has lost patience long before.
const MAX_WARNINGS: usize = 500;

/// Collects warnings while a file is read.
#[derive(Default)]
pub(super) struct ImportWarnings {
    /// Whether faults that stop loading are only warnings, where something is left to load.
    lenient: bool,
    list: Vec<Diagnostic>,
    omitted: usize,
}

impl ImportWarnings {
    /// An empty list of a reader who is lenient, or is not; see [`Self::forgive`].
    pub(super) fn new(lenient: bool) -> Self {
        Self { lenient, ..Self::default() }
    }

    pub(super) fn is_lenient(&self) -> bool {
        self.lenient
    }

    pub(super) fn push_warning(&mut self, pointer: &str, message: impl Into<String>) {
        self.push(warning(codes::LEFT_OUT, pointer, message.into()));
    }

    fn push(&mut self, warning: Diagnostic) {
        if self.list.len() < MAX_WARNINGS {
            self.list.push(warning);
        } else {
            self.omitted += 1;
        }
    }

    /// A fault that costs no more than what `consequence` says.
    pub(super) fn downgrade(&mut self, fault: &Diagnostic, consequence: &str) {
        self.push(warning(
            fault.code,
            &fault.location,
            format!("{}; {consequence}", fault.message),
        ));
    }

    /// A fault that stops loading; of a reader who is lenient it costs no more than what `consequence` says. Limits hold
    /// for everybody, and what was asked for must be there.
    pub(super) fn downgrade_if_lenient(
        &mut self,
        fault: Diagnostic,
        consequence: &str,
    ) -> Result<(), Diagnostic> {
        if !self.lenient || matches!(fault.code, codes::LIMIT_EXCEEDED | codes::NO_SUCH_ITEM) {
            return Err(fault);
        }
        self.downgrade(&fault, consequence);
        Ok(())
    }

    /// Adds the warnings of another list.
    pub(super) fn append_warnings(&mut self, other: Self) {
        let Self { list, omitted: left_out, .. } = other;
        list.into_iter().for_each(|warning| self.push(warning));
        self.omitted += left_out;
    }

    pub(super) fn into_list(mut self) -> Vec<Diagnostic> {
        if self.omitted > 0 {
            let message = format!("{} more warnings are not listed", self.omitted);
            self.list.push(warning(codes::LEFT_OUT, "", message));
        }
        self.list
    }
}

fn warning(code: &'static str, location: &str, message: String) -> Diagnostic {
    let severity = Severity::Warning;
    Diagnostic { severity, code, location: location.to_owned(), message, help: None }
}
