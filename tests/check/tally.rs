//! Agreement between the check and the validator, code by code.

use alberti_tests::manifest::Row;
use std::collections::{BTreeMap, BTreeSet};

/// File counts per error code and in total.
#[derive(Default)]
pub struct CodeTally<'a> {
    /// Files in which the code is found by both, only by the validator, or only by the check.
    codes: BTreeMap<&'a str, [usize; 3]>,
    /// Files in which the check finds the same codes, additional codes, or too few.
    files: [usize; 3],
}

impl<'a> CodeTally<'a> {
    /// Counts the codes of a file.
    pub fn add_file(&mut self, row: &'a Row, actual: &BTreeSet<&'static str>) {
        let listed: BTreeSet<&str> = row.validator_errors.iter().map(String::as_str).collect();
        for &code in &listed {
            let which = usize::from(!actual.contains(code));
            self.codes.entry(code).or_default()[which] += 1;
        }
        for &code in actual.iter().filter(|code| !listed.contains(*code)) {
            self.codes.entry(code).or_default()[2] += 1;
        }
        if !listed.is_empty() {
            let equal = listed.iter().eq(actual.iter());
            let which = if equal {
                0
            } else if listed.is_subset(actual) {
                1
            } else {
                2
            };
            self.files[which] += 1;
        }
    }

    /// Prints a row per code, then the file counts.
    pub fn print_table(&self) {
        println!("{:62} both  only listed  only actual", "files per error code");
        for (code, [both, listed, actual]) in &self.codes {
            println!("    {code:56} {both:6} {listed:12} {actual:12}");
        }
        let [equal, more, less] = self.files;
        println!("files: {equal} with equal codes, {more} with more, {less} with some missing");
    }
}
