//! Sections of the reference for the types of scene files.

use super::{ReferenceEntry, ReferenceSection};
use pipeline::scene::reference::{FieldEntry, Shape, TYPES, TypeEntry, VariantEntry};

/// A section for each type, in the order of the scene language.
pub(super) fn type_sections() -> Vec<ReferenceSection> {
    TYPES.iter().map(type_section).collect()
}

/// The section of one type.
fn type_section(entry: &TypeEntry) -> ReferenceSection {
    let entries = match entry.shape {
        Shape::Number => Vec::new(),
        Shape::Fields(fields) => fields.iter().map(field_entry).collect(),
        Shape::Variants(variants) => variants.iter().map(variant_entry).collect(),
    };
    ReferenceSection { title: entry.name.to_owned(), about: entry.about.to_owned(), entries }
}

/// The entry of one field.
fn field_entry(field: &FieldEntry) -> ReferenceEntry {
    ReferenceEntry {
        term: field.name.to_owned(),
        value: field.holds.to_owned(),
        note: if field.optional { String::new() } else { "required".to_owned() },
        about: field.about.to_owned(),
        inner: Vec::new(),
    }
}

/// The entry of a variant, written as in a scene: `Word`, `Word(value)` or `Word(field: …)`.
fn variant_entry(variant: &VariantEntry) -> ReferenceEntry {
    let brackets = match variant.holds {
        Some(holds) => format!("({holds})"),
        None if variant.fields.is_empty() => String::new(),
        None => "(…)".to_owned(),
    };
    ReferenceEntry {
        term: format!("{}{brackets}", variant.name),
        about: variant.about.to_owned(),
        inner: variant.fields.iter().map(field_entry).collect(),
        ..ReferenceEntry::default()
    }
}
