//! The table as Rust source: the types that are reached from the whole scene, each behind the one that first needs it.

use super::read::{Described, Field, Holds, Shape, Variant};
use std::fmt::Write as _;

/// The table of the types below `root`, or the name of a type that is used and not described.
pub(crate) fn of(types: &[Described], root: &str) -> Result<String, String> {
    let mut reached = Vec::new();
    reach(types, root, &mut reached)?;
    let mut source = String::from("&[\n");
    for described in reached {
        let shape = shape(types, &described.shape);
        let Described { name, about, .. } = described;
        let _ =
            writeln!(source, "TypeEntry {{ name: {name:?}, about: {about:?}, shape: {shape} }},");
    }
    source.push_str("]\n");
    Ok(source)
}

fn find<'a>(types: &'a [Described], ident: &str) -> Option<&'a Described> {
    types.iter().find(|described| described.ident == ident)
}

fn reach<'a>(
    types: &'a [Described],
    ident: &str,
    reached: &mut Vec<&'a Described>,
) -> Result<(), String> {
    if reached.iter().any(|described| described.ident == ident) {
        return Ok(());
    }
    let described = find(types, ident)
        .ok_or_else(|| format!("the reference of scene files finds no declaration of `{ident}`"))?;
    reached.push(described);
    let fields: Vec<&Holds> = match &described.shape {
        Shape::Fields(fields) => fields.iter().map(|field| &field.holds).collect(),
        Shape::Variants(variants) => variants.iter().flat_map(held).collect(),
        Shape::Number => Vec::new(),
    };
    fields.iter().flat_map(|holds| names(holds)).try_for_each(|ident| reach(types, ident, reached))
}

fn held(variant: &Variant) -> impl Iterator<Item = &Holds> {
    variant.fields.iter().map(|field| &field.holds).chain(&variant.holds)
}

/// The names in Rust of the types that a value is made of.
fn names(holds: &Holds) -> Vec<&str> {
    match holds {
        Holds::Words(_) => Vec::new(),
        Holds::Named(ident) => vec![ident],
        Holds::List(inner) => names(inner),
        Holds::Tuple(parts) => parts.iter().flat_map(names).collect(),
    }
}

fn shape(types: &[Described], shape: &Shape) -> String {
    match shape {
        Shape::Number => "Shape::Number".to_owned(),
        Shape::Fields(fields) => format!("Shape::Fields(&[{}])", fields_of(types, fields)),
        Shape::Variants(variants) => {
            let entry = |variant: &Variant| {
                let Variant { name, about, .. } = variant;
                let fields = fields_of(types, &variant.fields);
                let holds = variant.holds.as_ref().map(|holds| words(types, holds));
                format!(
                    "VariantEntry {{ name: {name:?}, about: {about:?}, fields: &[{fields}], holds: {holds:?} }},"
                )
            };
            format!("Shape::Variants(&[{}])", variants.iter().map(entry).collect::<String>())
        }
    }
}

fn fields_of(types: &[Described], fields: &[Field]) -> String {
    let entry = |field: &Field| {
        let Field { name, optional, about, .. } = field;
        let holds = words(types, &field.holds);
        format!(
            "FieldEntry {{ name: {name:?}, holds: {holds:?}, optional: {optional}, about: {about:?} }},"
        )
    };
    fields.iter().map(entry).collect()
}

/// What kind of value is meant, in words; types by their names in RON.
fn words(types: &[Described], holds: &Holds) -> String {
    match holds {
        Holds::Words(words) => (*words).to_owned(),
        Holds::Named(ident) => {
            find(types, ident).map_or(ident, |described| &described.name).clone()
        }
        Holds::List(inner) => format!("list of {}", words(types, inner)),
        Holds::Tuple(parts) => {
            let parts: Vec<String> = parts.iter().map(|part| words(types, part)).collect();
            format!("({})", parts.join(", "))
        }
    }
}
