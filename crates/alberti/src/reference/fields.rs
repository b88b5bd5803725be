//! Reference sections for the scene file types.
//!
//! The scene language declares its types and their doc comments in a schema.

use super::{ReferenceEntry, ReferenceSection};
use scene_file::reference::{FieldEntry, Shape, TypeEntry, VariantEntry, all_types};

/// Returns a section for each type, in the order of the scene language.
pub(super) fn type_sections() -> Vec<ReferenceSection> {
    all_types().into_iter().map(type_section).collect()
}

/// Returns the section for one type.
fn type_section(entry: &TypeEntry) -> ReferenceSection {
    let entries = match entry.shape {
        Shape::Plain(_) => Vec::new(),
        Shape::Fields(fields) => fields.iter().map(field_entry).collect(),
        Shape::Variants(variants) => variants.iter().map(variant_entry).collect(),
    };
    ReferenceSection { title: entry.name.to_owned(), about: entry.about(), entries }
}

/// Returns the entry for one field.
///
/// Optional fields need no note, because nearly all fields are optional.
fn field_entry(field: &FieldEntry) -> ReferenceEntry {
    ReferenceEntry {
        term: field.name.to_owned(),
        value: (field.value_type)().words(),
        note: if field.is_optional { String::new() } else { "required".to_owned() },
        about: field.about(),
        inner: Vec::new(),
    }
}

/// Returns the entry for a variant, written as in a scene: `Word`, `Word(value)` or `Word(field:
/// …)`.
///
/// The fields of a variant are inner entries, so that a search can find them by name.
fn variant_entry(variant: &VariantEntry) -> ReferenceEntry {
    let brackets = match variant.value_type {
        Some(value_type) => format!("({})", value_type().words()),
        None if variant.fields.is_empty() => String::new(),
        None => "(…)".to_owned(),
    };
    ReferenceEntry {
        term: format!("{}{brackets}", variant.name),
        about: variant.about(),
        inner: variant.fields.iter().map(field_entry).collect(),
        ..ReferenceEntry::default()
    }
}
