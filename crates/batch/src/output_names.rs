//! The outputs of a list: no two of its lines may write one file.

use std::collections::BTreeMap;

/// The line of each output, by a hash of its name: a list may be longer than the memory has room
/// for names.
#[derive(Debug, Default)]
pub(super) struct OutputNames {
    lines: BTreeMap<u64, u64>,
}

impl OutputNames {
    /// Notes the output of a line.
    ///
    /// # Errors
    /// If an earlier line has it: the number of that line.
    pub(super) fn claim(&mut self, output: &str, line: u64) -> Result<(), u64> {
        // Of the key of a record: two outputs of one hash are as unlikely as there.
        let hash = super::earlier_records::record_hash(&same_file_name(output), "");
        match self.lines.insert(hash, line) {
            Some(earlier) if earlier != line => Err(earlier),
            _ => Ok(()),
        }
    }
}

/// The name by which a file system knows an output: those of these systems ignore case.
fn same_file_name(output: &str) -> String {
    if cfg!(any(windows, target_os = "macos")) { output.to_lowercase() } else { output.to_owned() }
}

/// What is wrong with two lines of one output.
pub(super) fn same_output_fault(lines: [u64; 2], output: &str) -> String {
    let [first, second] = lines;
    let output = files::visible_text(output);
    format!(
        "lines {first} and {second} have the same output {output}\n  = help: give each picture an \
         output of its own"
    )
}
