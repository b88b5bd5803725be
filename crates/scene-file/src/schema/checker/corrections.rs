//! Rewrites values in other forms as the structs they represent.

use crate::color::Color;
use crate::file::MaterialFile;
use crate::schema::{Declared, FieldEntry, Shape, TypeEntry, ValueType};
use crate::syntax::{Node, NodeKind, SyntaxItem};

/// Rewrites a string as a struct with one field: its only required one, as in `(path: "a.glb")`. If
/// no field is required, a color becomes the first color field, as in `(base_color: "red")`.
/// `Color("red")` is treated as the string `"red"`.
pub(super) fn bracket_string(node: &Node<'_>, entry: &TypeEntry) -> Option<String> {
    let color = node.group().filter(|group| {
        group.name.as_ref().is_some_and(|name| name.name == "Color") && group.items.len() == 1
    });
    let node = color.map_or(node, |group| &group.items[0].value);
    let (NodeKind::String(text), Shape::Fields(fields)) = (&node.kind, entry.shape) else {
        return None;
    };
    let mut required = fields.iter().filter(|field| !field.is_optional);
    let field = match (required.next(), required.next()) {
        (Some(field), None) => {
            matches!((field.value_type)(), ValueType::Plain("string", _)).then_some(field)?
        }
        (None, _) if Color::parse(text.trim_matches('"')).is_some() => {
            let is_color = |field: &&FieldEntry| (field.value_type)().words() == "Color";
            fields.iter().find(is_color)?
        }
        _ => return None,
    };
    Some(format!("({}: {text})", field.name))
}

/// Rewrites a map from material names to fields or colors as the elements of a list: `(of:
/// Name("wood"), base_color: "red")`. `source` is the text of the file.
pub(super) fn bracket_map(node: &Node<'_>, entry: &TypeEntry, source: &str) -> Option<String> {
    let group = node.group().filter(|group| group.open == '{' && !group.items.is_empty())?;
    if entry.name != MaterialFile::ENTRY.name {
        return None;
    }
    let element = |item: &SyntaxItem<'_>| {
        let name = item.key.as_ref()?.name.trim_matches('"');
        let fields = match bracket_string(&item.value, entry) {
            Some(fields) => fields,
            None => source[item.value.span.clone()].to_owned(),
        };
        let fields = fields.strip_prefix('(')?.strip_suffix(')')?;
        Some(format!("(of: Name(\"{name}\"), {fields})"))
    };
    let elements: Option<Vec<String>> = group.items.iter().map(element).collect();
    elements.map(|elements| elements.join(", "))
}
