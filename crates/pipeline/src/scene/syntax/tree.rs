//! Syntax tree of a scene file, and paths through it.

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
}

/// A step from a value to one inside of it. Names of variants are no steps.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum PathStep<'a> {
    /// The field of a struct or of an enum's variant.
    Field(&'a str),
    /// The element of a list or tuple, from 0.
    Index(usize),
}
