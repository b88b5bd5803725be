//! Syntax tree of a scene file, and the values at the ends of paths through it.

use super::parse_tree;
use core::ops::Range;

/// A value in the text.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(in crate::scene) struct Node<'a> {
    /// The bytes of the value, with its name and brackets.
    pub(in crate::scene) span: Range<usize>,
    pub(in crate::scene) kind: NodeKind<'a>,
}

/// The syntactic form of a value.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(in crate::scene) enum NodeKind<'a> {
    /// A number, as it is written.
    Number(&'a str),
    /// A string literal with its quotation marks.
    String(&'a str),
    /// An identifier without brackets: a variant, `true` or `false`, or `None`.
    Word(&'a str),
    /// Items in brackets, perhaps with a name before them.
    Group(Group<'a>),
    /// No value could be read; the parser has reported why.
    Invalid,
}

/// Items in brackets: `Name(field: value)`, `(1, 2, 3)` or `[value, value]`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(in crate::scene) struct Group<'a> {
    /// The name before the bracket, such as that of a variant.
    pub(in crate::scene) name: Option<Key<'a>>,
    /// `(`, `[` or `{`.
    pub(in crate::scene) open: char,
    pub(in crate::scene) items: Vec<SyntaxItem<'a>>,
}

/// An element of a group, with a key if it is a field.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(in crate::scene) struct SyntaxItem<'a> {
    pub(in crate::scene) key: Option<Key<'a>>,
    pub(in crate::scene) value: Node<'a>,
}

impl SyntaxItem<'_> {
    /// The bytes of the key and the value.
    pub(in crate::scene) fn span(&self) -> Range<usize> {
        self.key.as_ref().map_or(self.value.span.start, |key| key.span.start)..self.value.span.end
    }
}

/// The name of a field or a variant.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(in crate::scene) struct Key<'a> {
    pub(in crate::scene) name: &'a str,
    pub(in crate::scene) span: Range<usize>,
}

impl<'a> Node<'a> {
    /// The items in brackets, if the value has any.
    pub(in crate::scene) fn group(&self) -> Option<&Group<'a>> {
        match &self.kind {
            NodeKind::Group(group) => Some(group),
            _ => None,
        }
    }

    /// The child that `step` leads to. Brackets around a single value, as in `Lines((width:
    /// Px(2)))`, are no level of their own.
    fn child(&self, step: PathStep<'_>) -> Option<&Self> {
        let items = &self.group()?.items;
        let found = match step {
            PathStep::Index(index) => items.get(index),
            PathStep::Field(name) => {
                items.iter().find(|item| item.key.as_ref().is_some_and(|key| key.name == name))
            }
        };
        match (found, items.as_slice(), step) {
            (Some(item), ..) => Some(&item.value),
            (None, [SyntaxItem { key: None, value }], PathStep::Field(_)) => value.child(step),
            _ => None,
        }
    }
}

/// A step from a value to one inside of it. Names of variants are no steps.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum PathStep<'a> {
    /// The field of a struct or of an enum's variant.
    Field(&'a str),
    /// The element of a list or tuple, from 0.
    Index(usize),
}

/// The bytes of the value at the end of `path`, or of the last value on the path that exists.
pub(in crate::scene) fn span_of(source: &str, path: &[PathStep<'_>]) -> Range<usize> {
    let tree = parse_tree(source);
    let Some(mut node) = tree.root.as_ref() else { return 0..0 };
    for step in path {
        match node.child(*step) {
            Some(child) => node = child,
            None => break,
        }
    }
    node.span.clone()
}

/// Whether the text has a value at the end of `path`.
pub(in crate::scene) fn has_value(source: &str, path: &[PathStep<'_>]) -> bool {
    let tree = parse_tree(source);
    path.iter()
        .try_fold(tree.root.as_ref(), |node, step| node?.child(*step).map(Some))
        .flatten()
        .is_some()
}
