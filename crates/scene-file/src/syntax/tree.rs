//! Syntax tree of a scene file, and paths through it.

use core::ops::Range;

/// A value in the text.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Node<'a> {
    /// The bytes of the value, with its name and brackets.
    pub(crate) span: Range<usize>,
    pub(crate) kind: NodeKind<'a>,
}

/// The syntactic form of a value.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum NodeKind<'a> {
    /// A number, as written.
    Number(&'a str),
    /// A string literal with its quotation marks.
    String(&'a str),
    /// An identifier without brackets: a variant, `true` or `false`, or `None`.
    Word(&'a str),
    /// Items in brackets, perhaps preceded by a name.
    Group(Group<'a>),
    /// No value could be read; the parser has reported why.
    Invalid,
}

/// Items in brackets: `Name(field: value)`, `(1, 2, 3)` or `[value, value]`.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Group<'a> {
    /// The name before the bracket, such as a variant's.
    pub(crate) name: Option<Key<'a>>,
    /// `(`, `[` or `{`.
    pub(crate) open: char,
    pub(crate) items: Vec<SyntaxItem<'a>>,
}

/// An element of a group, with a key if it is a field.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct SyntaxItem<'a> {
    pub(crate) key: Option<Key<'a>>,
    pub(crate) value: Node<'a>,
}

impl SyntaxItem<'_> {
    /// Returns the bytes of the key and the value.
    pub(crate) fn span(&self) -> Range<usize> {
        self.key.as_ref().map_or(self.value.span.start, |key| key.span.start)..self.value.span.end
    }
}

/// The name of a field or a variant.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Key<'a> {
    pub(crate) name: &'a str,
    pub(crate) span: Range<usize>,
}

impl<'a> Node<'a> {
    /// Returns the items in brackets, if the value has any.
    pub(crate) fn group(&self) -> Option<&Group<'a>> {
        match &self.kind {
            NodeKind::Group(group) => Some(group),
            _ => None,
        }
    }
}

/// A step from a value to one inside it. Variant names are not steps.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PathStep<'a> {
    /// A field of a struct or of an enum's variant, by name.
    Field(&'a str),
    /// An element of a list or tuple, counted from 0.
    Index(usize),
}
