//! The stored counts: a text file with one line per count.

use crate::workspace::{project_root, read_text};
use std::path::PathBuf;

/// A stored count.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct InstructionCount {
    /// The workload.
    pub name: String,
    /// The number of instructions in the whole run.
    pub count: u64,
    /// The reason for its last change.
    pub reason: String,
}

/// All stored counts, in file order.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct CountTable {
    /// The compiler that built the counted program; empty if nothing is stored yet.
    pub compiler: String,
    figures: Vec<InstructionCount>,
}

/// The key of the compiler's line, in the column of the workload names.
const COMPILER_KEY: &str = "compiler";

const TABLE_HEADING: &str = "\
# Instruction counts of small workloads, from callgrind: the name, the count, the reason for its last change.
# Written by `cargo xtask bench --instructions --update NAME --reason \"…\"`.
";

impl CountTable {
    /// Reads the table from its file.
    pub fn read_table() -> Result<Self, String> {
        let path = table_path();
        if !path.exists() {
            return Ok(Self::default());
        }
        Self::parse_table(&read_text(&path)?)
    }

    fn parse_table(text: &str) -> Result<Self, String> {
        let mut found = Self::default();
        for (at, line) in text.lines().enumerate() {
            if line.starts_with('#') || line.trim().is_empty() {
                continue;
            }
            let fault = || format!("instructions.txt:{}: expected NAME COUNT REASON", at + 1);
            let (name, rest) = line.split_once(char::is_whitespace).ok_or_else(fault)?;
            if name == COMPILER_KEY {
                found.compiler = rest.trim().to_owned();
                continue;
            }
            let (count, reason) = rest.trim().split_once(char::is_whitespace).ok_or_else(fault)?;
            found.set_count(name, count.parse().map_err(|_| fault())?, reason.trim());
        }
        Ok(found)
    }

    /// Writes the table to its file.
    pub fn write_table(&self) -> Result<(), String> {
        let path = table_path();
        std::fs::write(&path, self.to_text())
            .map_err(|error| format!("{}: {error}", path.display()))
    }

    fn to_text(&self) -> String {
        let line = |InstructionCount { name, count, reason }: &InstructionCount| {
            format!("{name:12} {count:>14}  {reason}\n")
        };
        let lines: String = self.figures.iter().map(line).collect();
        format!("{TABLE_HEADING}{COMPILER_KEY:12} {}\n{lines}", self.compiler)
    }

    /// Returns the row of a workload.
    pub fn count_for(&self, name: &str) -> Option<&InstructionCount> {
        self.figures.iter().find(|figure| figure.name == name)
    }

    /// Replaces or adds a row.
    pub fn set_count(&mut self, name: &str, count: u64, reason: &str) {
        let new = InstructionCount { name: name.to_owned(), count, reason: reason.to_owned() };
        match self.figures.iter_mut().find(|figure| figure.name == name) {
            Some(figure) => *figure = new,
            None => self.figures.push(new),
        }
    }
}

fn table_path() -> PathBuf {
    project_root().join("tests/bench/instructions.txt")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_written_table_is_read_back() {
        let mut figures = CountTable { compiler: "rustc 1.95.0".into(), ..CountTable::default() };
        figures.set_count("floor", 1, "first count");
        figures.set_count("teapot", 12_345_678_901, "more tea");
        figures.set_count("floor", 2, "tiles with  gaps");
        assert_eq!(CountTable::parse_table(&figures.to_text()), Ok(figures.clone()));
        assert_eq!(figures.count_for("floor").map(|figure| figure.count), Some(2));
        assert_eq!(figures.count_for("moon"), None);
    }

    #[test]
    fn an_invalid_count_is_reported_with_its_line() {
        let error = CountTable::parse_table("# a\nfloor 12\n").unwrap_err();
        assert!(error.starts_with("instructions.txt:2"), "{error}");
        assert!(CountTable::parse_table("floor many reasons\n").is_err());
    }
}
