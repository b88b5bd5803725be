//! The reference of scene files: every type, field and variant, with what their doc comments say.
//!
//! The build makes it from the declarations in `scene/file`; a test holds it against what the reader of scene files accepts.

/// A type of scene files.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct TypeEntry {
    /// Its name, which may be written before the bracket.
    pub name: &'static str,
    /// What it means.
    pub about: &'static str,
    /// What a value of it looks like.
    pub shape: Shape,
}

/// What a value of a type looks like.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Shape {
    /// Named fields in brackets.
    Fields(&'static [FieldEntry]),
    /// One of several words, some with fields or a value in brackets.
    Variants(&'static [VariantEntry]),
    /// A number or a few of them.
    Number,
}

/// A field.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct FieldEntry {
    /// Its name.
    pub name: &'static str,
    /// What kind of value it has; types by their names.
    pub holds: &'static str,
    /// Whether it may be left out.
    pub optional: bool,
    /// What it means, with its unit, its range and its default.
    pub about: &'static str,
}

/// One of several words.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct VariantEntry {
    /// The word.
    pub name: &'static str,
    /// What it means.
    pub about: &'static str,
    /// Its fields.
    pub fields: &'static [FieldEntry],
    /// What kind of value stands in its brackets, if it has no fields.
    pub holds: Option<&'static str>,
}

/// Every type that a scene file is made of, the whole scene first.
pub const TYPES: &[TypeEntry] = include!(concat!(env!("OUT_DIR"), "/reference.rs"));

#[cfg(test)]
mod trace;

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::{BTreeMap, BTreeSet};

    /// The names of fields and variants, by the name of the type, or of type and variant.
    fn listed_names() -> BTreeMap<String, BTreeSet<String>> {
        let mut told = BTreeMap::new();
        let names =
            |fields: &[FieldEntry]| fields.iter().map(|field| field.name.to_owned()).collect();
        for entry in TYPES {
            match entry.shape {
                Shape::Number => {}
                Shape::Fields(fields) => drop(told.insert(entry.name.to_owned(), names(fields))),
                Shape::Variants(variants) => {
                    let words = variants.iter().map(|variant| variant.name.to_owned()).collect();
                    told.insert(entry.name.to_owned(), words);
                    for variant in variants.iter().filter(|variant| !variant.fields.is_empty()) {
                        let key = format!("{}::{}", entry.name, variant.name);
                        told.insert(key, names(variant.fields));
                    }
                }
            }
        }
        told
    }

    #[test]
    fn the_reference_has_each_field_that_is_read_and_no_other() {
        assert_eq!(listed_names(), trace::accepted());
    }

    #[test]
    fn every_entry_says_something_and_what_may_be_left_out_has_its_default_told() {
        let mut silent = Vec::new();
        let mut look = |owner: &str, fields: &[FieldEntry]| {
            for field in fields {
                let tells_default = field.about.contains("Default:");
                if field.about.is_empty() || (field.optional && !tells_default) {
                    silent.push(format!("{owner}.{}", field.name));
                }
            }
        };
        for entry in TYPES {
            assert!(!entry.about.is_empty(), "{}", entry.name);
            match entry.shape {
                Shape::Number => {}
                Shape::Fields(fields) => look(entry.name, fields),
                Shape::Variants(variants) => variants.iter().for_each(|variant| {
                    assert!(!variant.about.is_empty(), "{}::{}", entry.name, variant.name);
                    look(variant.name, variant.fields);
                }),
            }
        }
        assert!(
            silent.is_empty(),
            "no meaning, or no `Default: …`, in the doc comments of {silent:?}"
        );
    }

    #[test]
    fn names_are_unique_and_no_link_is_left() {
        let names: BTreeSet<&str> = TYPES.iter().map(|entry| entry.name).collect();
        assert_eq!((names.len(), TYPES[0].name), (TYPES.len(), "Scene"));
        assert!(!format!("{TYPES:?}").contains("](") && !format!("{TYPES:?}").contains("[`"));
    }
}
