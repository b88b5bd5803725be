//! Checks lists and values that should be in a list.

use super::{Checker, Segment, bracket_map, bracket_string};
use crate::file::is_dimensions_list;
use crate::schema::{FieldEntry, Shape, TypeEntry, ValueType};
use crate::syntax::{Group, Node, NodeKind, SyntaxItem};

/// Corrections longer than this are not shown.
const LONGEST_EXAMPLE: usize = 120;

impl Checker<'_> {
    /// Reports the mistakes in a list in square brackets.
    ///
    /// If a single element lacks the list's brackets, its mistakes are reported too, so that one
    /// run finds them all.
    pub(super) fn check_list(&mut self, node: &Node<'_>, element: &ValueType) {
        if let Some(group) = node.group().filter(|group| group.open == '[') {
            return self.check_elements(&group.items, element);
        }
        if is_dimensions_list(element) {
            // `true`, `false` and values in round brackets are also valid lists of dimensions.
            match node.group() {
                None if matches!(node.kind, NodeKind::Word("true" | "false")) => return,
                Some(group) if group.items.iter().all(|item| item.key.is_none()) => {
                    return self.check_elements(&group.items, element);
                }
                _ => {}
            }
        }
        let list = self.write_as_list(node, &ValueType::List(Box::new(element.clone())));
        let help = match (list, self.path.last()) {
            (Some(list), Some(Segment::Field(name))) => {
                format!("write lists in square brackets: {name}: {list}")
            }
            _ => "write lists in square brackets, even with one element: [ … ]".to_owned(),
        };
        if !self.told_lists.contains(&node.span.start) {
            self.report_type(node, "a list", Some(help));
        }
        if is_written_as_element(node, element) {
            self.check(node, element);
        }
    }

    /// Reports the mistakes in the elements of a list.
    pub(crate) fn check_elements(&mut self, items: &[SyntaxItem<'_>], element: &ValueType) {
        for (index, item) in items.iter().enumerate() {
            self.check_element(index, item, element);
        }
    }

    /// Reports the mistakes in an element of a list or a tuple.
    ///
    /// The element is a separate scope: a mistake in it does not hide mistakes in its neighbors.
    pub(crate) fn check_element(
        &mut self,
        index: usize,
        item: &SyntaxItem<'_>,
        element: &ValueType,
    ) {
        self.path.push(Segment::Index(index));
        self.scopes.push(item.span());
        if let Some(key) = &item.key {
            let message = format!("list elements have no names, found `{}: …`", key.name);
            let help = "remove the name, or put the field in round brackets".to_owned();
            self.report(key.span.clone(), message, Some(help));
        } else {
            self.check(&item.value, element);
        }
        self.scopes.pop();
        self.path.pop();
    }

    /// Rewrites a list as a struct with one list field: `(write: [Depth])`.
    pub(super) fn bracket_list(&self, node: &Node<'_>, entry: &TypeEntry) -> Option<String> {
        let Shape::Fields(fields) = entry.shape else { return None };
        node.group().filter(|group| group.open == '[')?;
        let is_list = |field: &&FieldEntry| matches!((field.value_type)(), ValueType::List(_));
        let mut lists = fields.iter().filter(is_list);
        let (field, other) = (lists.next()?, lists.next());
        let text = &self.source[node.span.clone()];
        let is_short = text.len() <= LONGEST_EXAMPLE && !text.contains('\n');
        let list = if is_short { text } else { "[…]" };
        other.is_none().then(|| format!("({}: {list})", field.name))
    }

    /// Rewrites a value as a list in square brackets. Strings become the structs they represent.
    /// Returns `None` if the value is already correct or too long to show.
    pub(super) fn write_as_list(&self, node: &Node<'_>, expected: &ValueType) -> Option<String> {
        let ValueType::List(element) = expected else { return None };
        let written = |node: &Node<'_>| match element.as_ref() {
            ValueType::Declared(entry) => {
                bracket_string(node, entry).or_else(|| bracket_map(node, entry, self.source))
            }
            _ => None,
        };
        let text = |node: &Node<'_>| {
            written(node).unwrap_or_else(|| self.source[node.span.clone()].to_owned())
        };
        let list = match node.group().filter(|group| group.open == '[') {
            None if node.kind == NodeKind::Invalid => return None,
            None => text(node),
            Some(group) if group.items.iter().all(|item| written(&item.value).is_none()) => {
                return None;
            }
            Some(group) => {
                let items: Vec<String> = group.items.iter().map(|item| text(&item.value)).collect();
                items.join(", ")
            }
        };
        let is_short = list.len() <= LONGEST_EXAMPLE && !list.contains('\n');
        is_short.then(|| format!("[{list}]"))
    }
}

/// Whether a value looks like an element of a list, with a name or with named fields.
fn is_written_as_element(node: &Node<'_>, element: &ValueType) -> bool {
    let is_named = |group: &Group<'_>| {
        group.name.is_some()
            || (!group.items.is_empty()
                && group.items.iter().all(|SyntaxItem { key, .. }| key.is_some()))
    };
    let has_parts =
        matches!(element, ValueType::Declared(entry) if !matches!(entry.shape, Shape::Plain(_)));
    has_parts && node.group().is_some_and(|group| group.open == '(' && is_named(group))
}
