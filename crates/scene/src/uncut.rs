//! Parts that section planes do not cut, such as shafts and bolts, selected by node name.

use super::Origin;
use super::named_nodes::{node_names, objects_below};
use model::ModelInstance;
use scene_file::PathStep::{Field, Index};
use scene_file::file::SectionFile;
use scene_file::{SceneError, suggest_name};

/// Returns the objects that no section cuts, in ascending order.
///
/// # Errors
/// Returns an error if no node matches a name or pattern.
pub(super) fn resolve_uncut(
    origin: &Origin,
    sections: &[SectionFile],
    models: &[ModelInstance],
) -> Result<Vec<u32>, SceneError> {
    let mut objects = Vec::new();
    for (number, section) in sections.iter().enumerate() {
        for (at, pattern) in section.uncut.iter().enumerate() {
            let found = objects_below(models, |name| matches_pattern(pattern, name));
            if found.is_empty() && !models.is_empty() {
                let path = [Field("sections"), Index(number), Field("uncut"), Index(at)];
                let help = suggest_name(pattern, &node_names(models));
                let message = format!("there is no node `{pattern}`");
                return Err(origin.error_at(&path, message, help));
            }
            objects.extend(found.into_iter().flatten());
        }
    }
    objects.sort_unstable();
    objects.dedup();
    Ok(objects)
}

/// Whether a name matches a pattern, in which `*` matches any characters.
fn matches_pattern(pattern: &str, name: &str) -> bool {
    let mut parts = pattern.split('*');
    let first = parts.next().unwrap_or_default();
    let Some(mut rest) = name.strip_prefix(first) else { return false };
    let mut parts: Vec<&str> = parts.collect();
    let Some(last) = parts.pop() else { return rest.is_empty() };
    for part in parts {
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
    }
    rest.ends_with(last)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_match_any_characters() {
        for (pattern, name, fits) in [
            ("shaft", "shaft", true),
            ("shaft", "shaft 2", false),
            ("bolt*", "bolt 12", true),
            ("bolt*", "bolt", true),
            ("*bolt", "M8 bolt", true),
            ("M*bolt*", "M8 bolts", true),
            ("M*bolt*1", "M8 bolt 12", false),
            ("a*a", "a", false),
            ("*", "", true),
        ] {
            assert_eq!(matches_pattern(pattern, name), fits, "{pattern} {name}");
        }
    }
}
