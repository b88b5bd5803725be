//! Searches the declarations for the position in a scene where a field or a variant belongs.
//!
//! Suggestions start at the scene's own brackets, such as `camera: (projection:
//! Perspective(fov_y_degrees: …))`, so that they can be pasted. A breadth-first search over the
//! types finds the shortest path to each type, which becomes its example.

use super::{Shape, TypeEntry, ValueType};
use std::collections::BTreeSet;

/// A struct, an enum or a variant, with the text of a scene around it.
struct Site {
    /// The name: `Model`, or `View::LookAt`.
    owner: String,
    /// The text of a scene before its contents, such as `camera: (view: LookAt(`.
    before: String,
    /// The closing brackets after its contents.
    after: String,
    /// Its field names.
    fields: Vec<&'static str>,
    /// The words allowed here, for an enum.
    variants: Vec<&'static str>,
}

/// Returns the fields that `is_meant` accepts, each with its owner such as `Model` or
/// `View::LookAt`, starting with those nearest to the scene's own brackets.
///
/// Each call walks the whole language, a few hundred fields, so it runs only for messages.
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

/// Returns the enums with a variant of this name, starting with those nearest to the scene's own
/// brackets.
pub(crate) fn variants_where(root: &'static TypeEntry, name: &str) -> Vec<String> {
    let has_it = sites(root).into_iter().filter(|site| site.variants.contains(&name));
    has_it.map(|site| site.owner).collect()
}

/// Returns an example of a field or variant in a scene, starting at the scene's own brackets:
/// `camera: (view: LookAt(eye: …))`. Returns `None` if the owner has nothing with this name.
///
/// A variant with fields or a value is shown with brackets, `Frame(…)`; any other variant has none.
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

/// Returns every struct, enum and variant with brackets, each at its shortest path from the root.
///
/// The search is breadth-first, with one queue per depth. A type is entered once, at its first and
/// therefore shortest path; this would also stop cycles if types ever referred to each other.
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
/// Variants come before their enum in the list. A variant without brackets has no separate site; it
/// is found as a word of the enum.
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
                    // The struct inside shares the variant's brackets.
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

/// Returns the declared types of a field's value, each with the text around its brackets.
///
/// A list opens a square bracket and a struct a round one; an enum opens a bracket after the
/// variant's name. Types in tuples are not followed, because they are numbers.
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
