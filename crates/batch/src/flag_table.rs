//! The flags of a picture by their names, and which exclude each other: those of a line take the
//! place of those of the command.

use scene_file::is_scene_file;
use std::collections::BTreeMap;

/// Whether a value of `scene` is a scene file.
#[must_use]
pub fn is_scene_name(value: &str) -> bool {
    is_scene_file(value.as_ref())
}

/// A flag as one word of a command line.
#[must_use]
pub fn flag_word(name: &str, value: Option<&str>) -> String {
    value.map_or_else(|| format!("--{name}"), |value| format!("--{name}={value}"))
}

/// The names of the flags, and which exclude each other.
#[derive(Clone, Debug, Default)]
pub struct FlagTable {
    /// For each flag the others that it cannot be combined with.
    conflicts: BTreeMap<String, Vec<String>>,
}

impl FlagTable {
    /// Adds a flag.
    pub fn add_flag(&mut self, name: &str) {
        self.conflicts.entry(name.to_owned()).or_default();
    }

    /// Adds that two flags exclude each other.
    pub fn add_conflict(&mut self, name: &str, other: &str) {
        self.conflicts.entry(name.to_owned()).or_default().push(other.to_owned());
        self.conflicts.entry(other.to_owned()).or_default().push(name.to_owned());
    }

    /// Whether there is such a flag.
    #[must_use]
    pub fn has_flag(&self, name: &str) -> bool {
        self.conflicts.contains_key(name)
    }

    /// The names of all flags.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.conflicts.keys().map(String::as_str)
    }

    /// The words of `over` on top of those of `base`, which lose what `over` gives itself or
    /// excludes.
    #[must_use]
    pub fn merge(&self, base: &[String], over: &[String]) -> Vec<String> {
        let gone: Vec<&str> = over.iter().map(|word| word_name(word)).collect();
        let is_gone = |name: &str| {
            let others = self.conflicts.get(name).into_iter().flatten();
            gone.contains(&name) || others.into_iter().any(|other| gone.contains(&other.as_str()))
        };
        let kept = base.iter().filter(|word| !is_gone(word_name(word)));
        kept.chain(over).cloned().collect()
    }
}

/// The name in a word such as `--size=64x64`.
fn word_name(word: &str) -> &str {
    let name = word.strip_prefix("--").unwrap_or(word);
    name.split_once('=').map_or(name, |(name, _)| name)
}
