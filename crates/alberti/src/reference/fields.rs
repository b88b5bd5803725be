//! Sections of the reference from the types of scene files.

use super::{Entry, Section};
use pipeline::scene::reference::{FieldEntry, Shape, TYPES, TypeEntry, VariantEntry};

pub(super) fn sections() -> Vec<Section> {
    TYPES.iter().map(section).collect()
}

fn section(entry: &TypeEntry) -> Section {
    let entries = match entry.shape {
        Shape::Number => Vec::new(),
        Shape::Fields(fields) => fields.iter().map(field).collect(),
        Shape::Variants(variants) => variants.iter().map(variant).collect(),
    };
    Section { title: entry.name.to_owned(), about: entry.about.to_owned(), entries }
}

fn field(field: &FieldEntry) -> Entry {
    Entry {
        term: field.name.to_owned(),
        value: field.holds.to_owned(),
        note: if field.optional { String::new() } else { "needed".to_owned() },
        about: field.about.to_owned(),
        inner: Vec::new(),
    }
}

/// A variant, written as in a scene: `Word`, `Word(value)` or `Word(field: …)`.
fn variant(variant: &VariantEntry) -> Entry {
    let brackets = match variant.holds {
        Some(holds) => format!("({holds})"),
        None if variant.fields.is_empty() => String::new(),
        None => "(…)".to_owned(),
    };
    Entry {
        term: format!("{}{brackets}", variant.name),
        about: variant.about.to_owned(),
        inner: variant.fields.iter().map(field).collect(),
        ..Entry::default()
    }
}
