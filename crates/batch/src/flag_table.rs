//! The flags of a picture by name, and which of them conflict: flags in a list line replace the
//! command's.

use scene_file::is_scene_file;
use std::collections::BTreeMap;

/// Whether a value of `scene` is a scene file.
#[must_use]
pub fn is_scene_name(value: &str) -> bool {
    is_scene_file(value.as_ref())
}

/// A flag as one word on a command line.
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

    /// Whether a flag with this name exists.
    #[must_use]
    pub fn has_flag(&self, name: &str) -> bool {
        self.conflicts.contains_key(name)
    }

    /// All flag names.
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

/// The flag name in a word such as `--size=64x64`.
fn word_name(word: &str) -> &str {
    let name = word.strip_prefix("--").unwrap_or(word);
    name.split_once('=').map_or(name, |(name, _)| name)
}
