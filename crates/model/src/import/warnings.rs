//! The list of soft faults, kept short even if a file has millions.

use super::error::{Fault, FaultKind};
use crate::Warning;

/// So many warnings are kept; a reader has lost patience long before.
const KEPT: usize = 500;

/// Collects warnings while a file is read.
#[derive(Default)]
pub(super) struct Warnings {
    /// Whether faults that stop loading are only warnings, where something is left to load.
    lenient: bool,
    list: Vec<Warning>,
    left_out: usize,
}

impl Warnings {
    /// An empty list of a reader who is lenient, or is not; see [`Self::forgive`].
    pub(super) fn new(lenient: bool) -> Self {
        Self { lenient, ..Self::default() }
    }

    pub(super) fn is_lenient(&self) -> bool {
        self.lenient
    }

    pub(super) fn add(&mut self, pointer: &str, message: impl Into<String>) {
        if self.list.len() < KEPT {
            self.list.push(Warning { pointer: pointer.to_owned(), message: message.into() });
        } else {
            self.left_out += 1;
        }
    }

    /// A fault that costs no more than what `consequence` says.
    pub(super) fn soft(&mut self, fault: &Fault, consequence: &str) {
        self.add(&fault.pointer, format!("{}; {consequence}", fault.problem));
    }

    /// A fault that stops loading; of a reader who is lenient it costs no more than what `consequence` says. Limits hold
    /// for everybody, and what was asked for must be there.
    pub(super) fn forgive(&mut self, fault: Fault, consequence: &str) -> Result<(), Fault> {
        if !self.lenient || matches!(fault.kind, FaultKind::Limit | FaultKind::Choice) {
            return Err(fault);
        }
        self.soft(&fault, consequence);
        Ok(())
    }

    /// Adds the warnings of another list.
    pub(super) fn append(&mut self, other: Self) {
        let Self { list, left_out, .. } = other;
        list.iter().for_each(|warning| self.add(&warning.pointer, &*warning.message));
        self.left_out += left_out;
    }

    pub(super) fn into_list(mut self) -> Vec<Warning> {
        if self.left_out > 0 {
            let message = format!("{} more warnings are not listed", self.left_out);
            self.list.push(Warning { pointer: String::new(), message });
        }
        self.list
    }
}
