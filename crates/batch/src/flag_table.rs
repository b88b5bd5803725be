//! The picture flags by name, with their conflicts. Flags in a list line replace the command's.

use scene_file::is_scene_file;
use std::collections::BTreeMap;

/// Returns whether a value of `scene` names a scene file.
#[must_use]
pub fn is_scene_name(value: &str) -> bool {
    is_scene_file(value.as_ref())
}

/// Returns a flag as one command-line word.
#[must_use]
pub fn flag_word(name: &str, value: Option<&str>) -> String {
    value.map_or_else(|| format!("--{name}"), |value| format!("--{name}={value}"))
}

/// The flag names, and which flags conflict.
#[derive(Clone, Debug, Default)]
pub struct FlagTable {
    /// For each flag, the flags with which it cannot be combined.
    conflicts: BTreeMap<String, Vec<String>>,
}

impl FlagTable {
    /// Adds a flag.
    pub fn add_flag(&mut self, name: &str) {
        self.conflicts.entry(name.to_owned()).or_default();
    }

    /// Records that two flags conflict.
    pub fn add_conflict(&mut self, name: &str, other: &str) {
        self.conflicts.entry(name.to_owned()).or_default().push(other.to_owned());
        self.conflicts.entry(other.to_owned()).or_default().push(name.to_owned());
    }

    /// Returns whether a flag with this name exists.
    #[must_use]
    pub fn has_flag(&self, name: &str) -> bool {
        self.conflicts.contains_key(name)
    }

    /// Returns all flag names.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.conflicts.keys().map(String::as_str)
    }

    /// Merges the words of `over` into `base`, removing flags from `base` that `over` sets or
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

/// Returns the flag name in a word such as `--size=64x64`.
fn word_name(word: &str) -> &str {
    let name = word.strip_prefix("--").unwrap_or(word);
    name.split_once('=').map_or(name, |(name, _)| name)
}
