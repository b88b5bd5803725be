//! Counts with singular or plural nouns, for messages.

use std::fmt::Display;

/// Returns a count and its noun: the singular for 1, otherwise the plural.
///
/// ```
/// assert_eq!(files::counted(1, "vertex", "vertices"), "1 vertex");
/// assert_eq!(files::counted(0, "vertex", "vertices"), "0 vertices");
/// ```
pub fn counted(count: impl Display, singular: &str, plural: &str) -> String {
    let count = count.to_string();
    let noun = if count == "1" { singular } else { plural };
    format!("{count} {noun}")
}
