//! Replacement of legacy words: fields and variants that earlier versions of the language named
//! otherwise.
//!
//! ```text
//!  syntax tree + declarations ─► edits (span, new word) ─► applied from the end of the text
//! ```
//! A word is replaced only where its owner is, found by walking the tree along the declared types:
//! `translate` means something else in a model than it would in a camera. The text is edited by
//! spans, so comments and layout survive.

use crate::scene::SceneFile;
use crate::scene::schema::{Declared as _, FieldEntry, Shape, TypeEntry, ValueType};
use crate::scene::syntax::{Group, Key, Node, NodeKind, parse_tree};
use crate::scene::vocabulary::LEGACY_WORDS;
use core::ops::Range;

/// The text with each legacy word replaced by that of today. Words are only replaced where their
/// struct or enum stands; everything else, mistakes included, is left as it is.
///
/// Applying the edits from the last to the first keeps earlier spans valid. A tree that had to be
/// guessed, because brackets do not match, is not touched.
pub(super) fn replace_legacy_words(source: &str) -> String {
    let tree = parse_tree(source);
    let mut edits = Vec::new();
    if let Some(root) = tree.root.filter(|_| !tree.is_unreliable) {
        collect_edits(&root, &ValueType::Declared(SceneFile::ENTRY), &mut edits);
    }
    edits.sort_by_key(|edit: &Edit| edit.span.start);
    let mut text = source.to_owned();
    for Edit { span, new } in edits.into_iter().rev() {
        text.replace_range(span, new);
    }
    text
}

/// The replacement of one word.
struct Edit {
    /// The bytes of the old word in the source.
    span: Range<usize>,
    /// The word that replaces it.
    new: &'static str,
}

/// The current name for `key` in `owner`; records the edit if it is a legacy word.
///
/// Returning the current name lets the walk continue below a renamed field in the same pass.
fn modern_name<'a>(key: &Key<'a>, owner: &str, edits: &mut Vec<Edit>) -> &'a str {
    let is_same = |legacy: &&crate::scene::vocabulary::LegacyWord| {
        legacy.owner == owner && legacy.old == key.name
    };
    match LEGACY_WORDS.iter().find(is_same) {
        Some(legacy) => {
            edits.push(Edit { span: key.span.clone(), new: legacy.new });
            legacy.new
        }
        None => key.name,
    }
}

/// Collects the edits in a value of this type. Values of another form are left to the parser.
fn collect_edits(node: &Node<'_>, value_type: &ValueType, edits: &mut Vec<Edit>) {
    let items = node.group().map_or(&[][..], |group| &group.items);
    match value_type {
        ValueType::Plain(_) => {}
        ValueType::List(element) => {
            items.iter().for_each(|item| collect_edits(&item.value, element, edits));
        }
        ValueType::Tuple(parts) => {
            items
                .iter()
                .zip(parts)
                .for_each(|(item, part)| collect_edits(&item.value, part, edits));
        }
        ValueType::Declared(entry) => collect_declared(node, entry, edits),
    }
}

/// Collects the edits in a value of a declared type: its fields, or the name and content of its
/// variant. Names before the brackets of a struct are not edited.
fn collect_declared(node: &Node<'_>, entry: &'static TypeEntry, edits: &mut Vec<Edit>) {
    match (entry.shape, &node.kind) {
        // An optional value may be written `Some(value)`.
        (_, NodeKind::Group(Group { name: Some(name), items, .. })) if name.name == "Some" => {
            items.iter().for_each(|item| collect_declared(&item.value, entry, edits));
        }
        (Shape::Fields(fields), NodeKind::Group(group)) => {
            collect_fields(group, entry.name, fields, edits);
        }
        (Shape::Variants(_), NodeKind::Word(word)) => {
            modern_name(&Key { name: word, span: node.span.clone() }, entry.name, edits);
        }
        (Shape::Variants(variants), NodeKind::Group(group)) => {
            let Some(name) = &group.name else { return };
            let name = modern_name(name, entry.name, edits);
            let Some(variant) = variants.iter().find(|variant| variant.name == name) else {
                return;
            };
            let owner = format!("{}::{}", entry.name, variant.name);
            collect_fields(group, &owner, variant.fields, edits);
            if let Some(value_type) = variant.value_type.map(|value_type| value_type()) {
                collect_inner(node, group, &value_type, edits);
            }
        }
        _ => {}
    }
}

/// Collects the edits in the value of a variant, whose brackets may also be those of the struct
/// inside.
///
/// Mirrors `Variant::read_inner` of the checker: one item without a name is the value itself,
/// otherwise the brackets are read once more without the variant's name.
fn collect_inner(
    node: &Node<'_>,
    group: &Group<'_>,
    value_type: &ValueType,
    edits: &mut Vec<Edit>,
) {
    if let [item] = group.items.as_slice()
        && item.key.is_none()
    {
        return collect_edits(&item.value, value_type, edits);
    }
    let unnamed = Group { name: None, ..group.clone() };
    let node = Node { span: node.span.clone(), kind: NodeKind::Group(unnamed) };
    collect_edits(&node, value_type, edits);
}

/// Collects the edits in the fields of `owner`, a struct or a variant.
fn collect_fields(
    group: &Group<'_>,
    owner: &str,
    fields: &'static [FieldEntry],
    edits: &mut Vec<Edit>,
) {
    for item in &group.items {
        let Some(key) = &item.key else { continue };
        let name = modern_name(key, owner, edits);
        if let Some(field) = fields.iter().find(|field| field.name == name) {
            collect_edits(&item.value, &(field.value_type)(), edits);
        }
    }
}
