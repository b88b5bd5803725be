//! The list of soft faults, kept short even if a file has millions.

use super::error::Fault;
use crate::model::Warning;

/// So many warnings are kept; a reader has lost patience long before.
const KEPT: usize = 500;

/// Collects warnings while a file is read.
#[derive(Default)]
pub(super) struct Warnings {
    list: Vec<Warning>,
    left_out: usize,
}

impl Warnings {
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

    pub(super) fn into_list(mut self) -> Vec<Warning> {
        if self.left_out > 0 {
            let message = format!("{} more warnings are not listed", self.left_out);
            self.list.push(Warning { pointer: String::new(), message });
        }
        self.list
    }
}
