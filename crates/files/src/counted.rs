//! Counts with singular or plural nouns, and lists, for messages.

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

/// Returns the items separated by commas, with "and" before the last one.
///
/// ```
/// assert_eq!(files::listed(&["left", "near", "top"]), "left, near and top");
/// assert_eq!(files::listed(&["left"]), "left");
/// ```
pub fn listed<T: AsRef<str>>(items: &[T]) -> String {
    let items: Vec<&str> = items.iter().map(AsRef::as_ref).collect();
    match &items[..] {
        [rest @ .., last] if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => items.concat(),
    }
}
