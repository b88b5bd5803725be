//! The registry: names for use in checks, and the public functions they refer to.
//!
//! No entry repeats its formula. If the crates have no function for a formula, the value comes from
//! the most closely related function, usually by applying its matrix to a point.

mod camera;
mod classical;
mod clipping;
mod conventions;
mod depth;
mod inputs;
mod normalization;
mod pipeline;
mod points;
mod screen;

pub use inputs::{Answer, Inputs};

use crate::book_formulas::value::Value;

/// Names that a formula may use without a value in the check line.
pub type Extras = Result<Vec<(&'static str, Value)>, Box<dyn std::error::Error>>;

/// A name for check lines, and the function that computes its value.
#[derive(Debug)]
pub struct Entry {
    pub name: &'static str,
    /// The variable names, separated by spaces.
    pub variables: &'static str,
    pub build: fn(&Inputs<'_>) -> Answer,
    pub extras: Option<fn(&Inputs<'_>) -> Extras>,
}

impl Entry {
    const fn new(
        name: &'static str,
        variables: &'static str,
        build: fn(&Inputs<'_>) -> Answer,
    ) -> Self {
        Self { name, variables, build, extras: None }
    }

    const fn with_extras(self, extras: fn(&Inputs<'_>) -> Extras) -> Self {
        Self { extras: Some(extras), ..self }
    }
}

const TABLES: [&[Entry]; 9] = [
    points::ENTRIES,
    camera::ENTRIES,
    normalization::ENTRIES,
    conventions::ENTRIES,
    classical::ENTRIES,
    depth::ENTRIES,
    clipping::ENTRIES,
    screen::ENTRIES,
    pipeline::ENTRIES,
];

pub fn all_entries() -> impl Iterator<Item = &'static Entry> {
    TABLES.into_iter().flatten()
}

pub fn find_entry(name: &str) -> Result<&'static Entry, String> {
    let found = all_entries().find(|entry| entry.name == name);
    found.ok_or_else(|| format!("unknown name `{name}`"))
}

#[cfg(test)]
mod tests {
    use super::all_entries;

    #[test]
    fn names_are_unique() {
        let mut names: Vec<&str> = all_entries().map(|entry| entry.name).collect();
        names.sort_unstable();
        let twice = names.windows(2).find(|pair| pair[0] == pair[1]);
        assert_eq!(twice, None);
    }
}
