//! The stored counts: a text file, a line for each.

use crate::workspace::{read, root};
use std::path::PathBuf;

/// A stored count.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Figure {
    pub name: String,
    pub count: u64,
    /// Why it last changed.
    pub reason: String,
}

/// All stored counts, in the order of the file.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Figures {
    /// The compiler whose instructions were counted; empty as long as nothing is stored.
    pub compiler: String,
    figures: Vec<Figure>,
}

/// The name that stands before the compiler, where other lines have theirs.
const COMPILER: &str = "compiler";

const HEADING: &str = "\
# Instructions that small pieces of work take, by callgrind: name, count, why it last changed.
# Written by `cargo xtask bench --instructions --update NAME --reason \"…\"`.
";

impl Figures {
    pub fn read() -> Result<Self, String> {
        let path = path();
        if !path.exists() {
            return Ok(Self::default());
        }
        Self::parse(&read(&path)?)
    }

    fn parse(text: &str) -> Result<Self, String> {
        let mut found = Self::default();
        for (at, line) in text.lines().enumerate() {
            if line.starts_with('#') || line.trim().is_empty() {
                continue;
            }
            let fault = || format!("instructions.txt:{}: expected NAME COUNT REASON", at + 1);
            let (name, rest) = line.split_once(char::is_whitespace).ok_or_else(fault)?;
            if name == COMPILER {
                found.compiler = rest.trim().to_owned();
                continue;
            }
            let (count, reason) = rest.trim().split_once(char::is_whitespace).ok_or_else(fault)?;
            found.set(name, count.parse().map_err(|_| fault())?, reason.trim());
        }
        Ok(found)
    }

    pub fn write(&self) -> Result<(), String> {
        let path = path();
        std::fs::write(&path, self.text()).map_err(|error| format!("{}: {error}", path.display()))
    }

    fn text(&self) -> String {
        let line =
            |Figure { name, count, reason }: &Figure| format!("{name:12} {count:>14}  {reason}\n");
        let lines: String = self.figures.iter().map(line).collect();
        format!("{HEADING}{COMPILER:12} {}\n{lines}", self.compiler)
    }

    pub fn find(&self, name: &str) -> Option<&Figure> {
        self.figures.iter().find(|figure| figure.name == name)
    }

    pub fn set(&mut self, name: &str, count: u64, reason: &str) {
        let new = Figure { name: name.to_owned(), count, reason: reason.to_owned() };
        match self.figures.iter_mut().find(|figure| figure.name == name) {
            Some(figure) => *figure = new,
            None => self.figures.push(new),
        }
    }
}

fn path() -> PathBuf {
    root().join("tests/bench/instructions.txt")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_again() {
        let mut figures = Figures { compiler: "rustc 1.95.0".into(), ..Figures::default() };
        figures.set("floor", 1, "first count");
        figures.set("teapot", 12_345_678_901, "more tea");
        figures.set("floor", 2, "tiles with  gaps");
        assert_eq!(Figures::parse(&figures.text()), Ok(figures.clone()));
        assert_eq!(figures.find("floor").map(|figure| figure.count), Some(2));
        assert_eq!(figures.find("moon"), None);
    }

    #[test]
    fn a_line_that_is_no_figure_is_pointed_at() {
        let error = Figures::parse("# a\nfloor 12\n").unwrap_err();
        assert!(error.starts_with("instructions.txt:2"), "{error}");
        assert!(Figures::parse("floor many reasons\n").is_err());
    }
}
