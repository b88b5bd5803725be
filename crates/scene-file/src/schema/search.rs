//! Search in the declarations: the position in a scene at which a field or a variant belongs.
//!
//! Suggestions are written from the scene's own brackets on, such as `camera: (projection:
//! Perspective(fov_y_degrees: …))`, so that they can be pasted. Positions are found by
//! breadth-first search over the types: the shortest path to each type is its example.

use super::{Shape, TypeEntry, ValueType};
use std::collections::BTreeSet;

/// A pair of brackets in the language: a struct, an enum or a variant, with the text of a scene up
/// to it.
struct Site {
    /// `Model`, or `View::LookAt`.
    owner: String,
    /// The text of a scene up to its brackets, such as `camera: (view: LookAt(`.
    before: String,
    /// The closing brackets that end the scene behind it.
    after: String,
    /// The names of its fields.
    fields: Vec<&'static str>,
    /// The words that are possible here, for an enum.
    variants: Vec<&'static str>,
}

/// The fields that `is_meant` accepts, each with its owner such as `Model` or `View::LookAt`, those
/// nearest to the scene's own brackets first.
///
/// Each call walks the whole language, a few hundred fields: it runs only for messages.
pub(crate) fn fields_where(
    root: &'static TypeEntry,
    is_meant: impl Fn(&str) -> bool,
) -> Vec<(String, &'static str)> {
    let mut found = Vec::new();
    for Site { owner, fields, .. } in sites(root) {
        let fields = fields.into_iter().filter(|field| is_meant(field));
        found.extend(fields.map(|field| (owner.clone(), field)));
    }
    found
}

/// The enums that have a variant of this name, those nearest to the scene's own brackets first.
pub(crate) fn variants_where(root: &'static TypeEntry, name: &str) -> Vec<String> {
    let has_it = sites(root).into_iter().filter(|site| site.variants.contains(&name));
    has_it.map(|site| site.owner).collect()
}

/// How a field or a variant is written in a scene, from the scene's own brackets on: `camera:
/// (view: LookAt(eye: …))`. `None` if the owner has none of this name.
///
/// A variant that has fields or a value is shown with brackets, `Frame(…)`, another one without.
pub(crate) fn example_of(root: &'static TypeEntry, owner: &str, name: &str) -> Option<String> {
    let sites = sites(root);
    let site = sites.iter().find(|site| site.owner == owner)?;
    let Site { before, after, .. } = site;
    if site.fields.contains(&name) {
        return Some(format!("{before}{name}: …{after}"));
    }
    if !site.variants.contains(&name) {
        return None;
    }
    let variant = format!("{owner}::{name}");
    let has_brackets = sites.iter().any(|site| site.owner == variant);
    Some(format!("{before}{name}{}{after}", if has_brackets { "(…)" } else { "" }))
}

/// Every struct and variant with brackets, each at its shortest path from the root.
///
/// Breadth first, one queue for each depth. A type is entered once, at its first and therefore
/// shortest path; this also ends cycles, if types should ever refer to each other.
fn sites(root: &'static TypeEntry) -> Vec<Site> {
    let mut sites: Vec<Site> = Vec::new();
    let mut seen = BTreeSet::new();
    let mut queue = vec![(root, String::new(), String::new())];
    while !queue.is_empty() {
        let mut next = Vec::new();
        for (entry, before, after) in queue {
            if !seen.insert(entry.name) {
                continue;
            }
            add_sites(entry, &before, &after, &mut sites, &mut next);
        }
        queue = next;
    }
    sites
}

/// Adds the struct or enum of an entry with its variants, and queues the types of their fields.
///
/// Variants come before their enum in the list. A variant without brackets has no site of its own,
/// and is found as a word of the enum.
fn add_sites(
    entry: &'static TypeEntry,
    before: &str,
    after: &str,
    sites: &mut Vec<Site>,
    next: &mut Vec<(&'static TypeEntry, String, String)>,
) {
    let site = |owner: String, before: &str, after: &str| Site {
        owner,
        before: before.to_owned(),
        after: after.to_owned(),
        fields: Vec::new(),
        variants: Vec::new(),
    };
    let mut own = site(entry.name.to_owned(), before, after);
    match entry.shape {
        Shape::Plain(_) => return,
        Shape::Fields(fields) => {
            own.fields = fields.iter().map(|field| field.name).collect();
            for field in fields {
                let before = format!("{before}{}: ", field.name);
                next.extend(opened(&(field.value_type)(), &before, after));
            }
        }
        Shape::Variants(variants) => {
            own.variants = variants.iter().map(|variant| variant.name).collect();
            for variant in variants {
                let (before, after) = (format!("{before}{}(", variant.name), format!("){after}"));
                let mut inner = site(format!("{}::{}", entry.name, variant.name), &before, &after);
                inner.fields = variant.fields.iter().map(|field| field.name).collect();
                for field in variant.fields {
                    let before = format!("{before}{}: ", field.name);
                    next.extend(opened(&(field.value_type)(), &before, &after));
                }
                if let Some(value_type) = variant.value_type {
                    // The brackets of the variant are those of the struct inside.
                    let declared = value_type().declared();
                    next.extend(
                        declared.into_iter().map(|entry| (entry, before.clone(), after.clone())),
                    );
                }
                if !inner.fields.is_empty() || variant.value_type.is_some() {
                    sites.push(inner);
                }
            }
        }
    }
    sites.push(own);
}

/// The declared types of a field's value, each with the text around what stands in its brackets.
///
/// A list opens a square bracket, a struct a round one; enums open theirs behind the name of the
/// variant. Types in tuples are not followed: they are numbers.
fn opened(
    value_type: &ValueType,
    before: &str,
    after: &str,
) -> Vec<(&'static TypeEntry, String, String)> {
    match value_type {
        ValueType::Plain(..) | ValueType::Tuple(_) => Vec::new(),
        ValueType::List(element) => opened(element, &format!("{before}["), &format!("]{after}")),
        ValueType::Declared(entry) => match entry.shape {
            Shape::Fields(_) => vec![(*entry, format!("{before}("), format!("){after}"))],
            _ => vec![(*entry, before.to_owned(), after.to_owned())],
        },
    }
}
