//! The outputs of a list: no two of its lines may write the same file.

use std::collections::BTreeMap;

/// The line of each output, by a hash of its name: there may be too many names to keep in memory.
#[derive(Debug, Default)]
pub(super) struct OutputNames {
    lines: BTreeMap<u64, u64>,
}

impl OutputNames {
    /// Records the output of a line.
    ///
    /// # Errors
    /// Returns the number of the earlier line with the same output, if there is such a line.
    pub(super) fn claim(&mut self, output: &str, line: u64) -> Result<(), u64> {
        // This is the hash that records use, so collisions are just as unlikely.
        let hash = super::earlier_records::record_hash(&same_file_name(output), "");
        match self.lines.insert(hash, line) {
            Some(earlier) if earlier != line => Err(earlier),
            _ => Ok(()),
        }
    }
}

/// Returns the name of an output as the file system compares it: Windows and macOS ignore case.
fn same_file_name(output: &str) -> String {
    if cfg!(any(windows, target_os = "macos")) { output.to_lowercase() } else { output.to_owned() }
}

/// Returns the error for two lines with the same output.
pub(super) fn same_output_fault(lines: [u64; 2], output: &str) -> String {
    let [first, second] = lines;
    let output = files::visible_text(output);
    format!(
        "lines {first} and {second} have the same output {output}\n  = help: give each picture its \
         own output"
    )
}
