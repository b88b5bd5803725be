//! The scene file reference: every type, field and variant, with its documentation.
//!
//! The entries are the declarations used to read scene files, so the reference lists exactly the
//! fields that can be read.

pub use super::schema::{FieldEntry, Shape, TypeEntry, ValueType, VariantEntry};

use super::SceneFile;
use super::schema::Declared as _;

/// Returns every type used in scene files: first the scene, then each type at its first use.
#[must_use]
pub fn all_types() -> Vec<&'static TypeEntry> {
    let mut types = Vec::new();
    collect_types(SceneFile::ENTRY, &mut types);
    types
}

/// Returns the fields and variants that a word from another program means, as paths such as
/// `Perspective.near`, most likely first.
#[must_use]
pub fn meanings_of(word: &str) -> Vec<String> {
    super::vocabulary::meanings_of(word)
}

/// Adds a type and the types it needs, unless they are already present.
fn collect_types(entry: &'static TypeEntry, types: &mut Vec<&'static TypeEntry>) {
    if types.iter().any(|known| known.name == entry.name) {
        return;
    }
    types.push(entry);
    let value_types: Vec<fn() -> ValueType> = match entry.shape {
        Shape::Plain(_) => Vec::new(),
        Shape::Fields(fields) => fields.iter().map(|field| field.value_type).collect(),
        Shape::Variants(variants) => {
            let of_variant = |variant: &VariantEntry| {
                let fields = variant.fields.iter().map(|field| field.value_type);
                fields.chain(variant.value_type).collect::<Vec<_>>()
            };
            variants.iter().flat_map(of_variant).collect()
        }
    };
    for value_type in value_types {
        value_type().declared().into_iter().for_each(|entry| collect_types(entry, types));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_entry_is_documented_and_optional_fields_state_their_default() {
        let mut undocumented = Vec::new();
        let mut inspect = |owner: &str, fields: &[FieldEntry]| {
            for field in fields {
                let has_default = field.doc.contains("Default:");
                if field.doc.is_empty() || (field.is_optional && !has_default) {
                    undocumented.push(format!("{owner}.{}", field.name));
                }
            }
        };
        for entry in all_types() {
            assert!(!entry.doc.is_empty(), "{}", entry.name);
            match entry.shape {
                Shape::Plain(_) => {}
                Shape::Fields(fields) => inspect(entry.name, fields),
                Shape::Variants(variants) => variants.iter().for_each(|variant| {
                    assert!(!variant.doc.is_empty(), "{}::{}", entry.name, variant.name);
                    inspect(variant.name, variant.fields);
                }),
            }
        }
        assert!(undocumented.is_empty(), "no description or no `Default: …`: {undocumented:?}");
    }

    #[test]
    fn names_are_unique_and_links_are_removed() {
        let types = all_types();
        let names: BTreeSet<&str> = types.iter().map(|entry| entry.name).collect();
        assert_eq!((names.len(), types[0].name), (types.len(), "Scene"));
        for entry in types {
            assert!(!entry.about().contains("]("), "{}", entry.about());
        }
    }
}
