//! How often the two verdicts agree, kind by kind.

use crate::manifest::Row;
use std::collections::{BTreeMap, BTreeSet};

/// For each kind of error, in how many files both find it, only the validator, only the check.
#[derive(Default)]
pub struct CodeTally<'a> {
    kinds: BTreeMap<&'a str, [usize; 3]>,
    files: [usize; 3],
}

impl<'a> CodeTally<'a> {
    pub fn add_file(&mut self, row: &'a Row, actual: &BTreeSet<&'static str>) {
        let listed: BTreeSet<&str> = row.validator_errors.iter().map(String::as_str).collect();
        for &code in &listed {
            let which = usize::from(!actual.contains(code));
            self.kinds.entry(code).or_default()[which] += 1;
        }
        for &code in actual.iter().filter(|code| !listed.contains(*code)) {
            self.kinds.entry(code).or_default()[2] += 1;
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

    pub fn print_table(&self) {
        println!("{:62} both  only listed  only found", "kinds of errors, in so many files");
        for (code, [both, listed, found]) in &self.kinds {
            println!("    {code:56} {both:6} {listed:12} {found:11}");
        }
        let [equal, more, less] = self.files;
        println!("files: {equal} with the same kinds, {more} with more, {less} with some missing");
    }
}
