//! The text of a scene file, with the positions of its lines and values.

use super::syntax::{Node, PathStep, parse_tree};
use core::fmt;
use core::ops::{Deref, Range};
use std::sync::{Arc, OnceLock};

/// The text of a scene file. Copies share it, because each mistake quotes it.
///
/// ```
/// use scene_file::SourceText;
///
/// let text = SourceText::from("Scene(\n  models: [],\n)");
/// assert_eq!(text.line_and_column(9), (2, 3));
/// assert!(text.starts_with("Scene"));
/// ```
#[derive(Clone, Default)]
pub struct SourceText(Arc<SharedText>);

#[derive(Default)]
struct SharedText {
    text: String,
    /// The start of each line from the second on, computed on first use.
    line_starts: OnceLock<Vec<usize>>,
    /// The values in the text, computed on first use.
    root: OnceLock<Option<Place>>,
}

/// The byte range of a value and the places of the values inside it, in a text of less than 4 GiB.
struct Place {
    start: u32,
    end: u32,
    items: Vec<PlaceItem>,
}

struct PlaceItem {
    /// The bytes of a field's name.
    key: Option<[u32; 2]>,
    value: Place,
}

impl SourceText {
    /// Returns the text.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0.text
    }

    /// Returns the line and column of a byte, both counted from 1. Columns count characters.
    ///
    /// # Panics
    /// Panics if the byte is not at the start of a character, or is beyond the end.
    #[must_use]
    pub fn line_and_column(&self, byte: usize) -> (usize, usize) {
        let (number, line) = self.line_at(byte);
        (number, self[line.start..byte].chars().count() + 1)
    }

    /// Returns the line number of a byte, counted from 1, and the line's bytes without the line
    /// break.
    pub(super) fn line_at(&self, byte: usize) -> (usize, Range<usize>) {
        let starts = self
            .0
            .line_starts
            .get_or_init(|| self.match_indices('\n').map(|(newline, _)| newline + 1).collect());
        let index = starts.partition_point(|start| *start <= byte);
        let start = index.checked_sub(1).map_or(0, |before| starts[before]);
        let end = starts.get(index).map_or(self.len(), |next| next - 1);
        (index + 1, start..end)
    }

    /// Returns the bytes of the value at the end of a path, or of its last existing ancestor.
    pub(super) fn span_of(&self, path: &[PathStep<'_>]) -> Range<usize> {
        let Some(mut place) = self.root() else { return 0..0 };
        for step in path {
            match place.child(self, *step) {
                Some(child) => place = child,
                None => break,
            }
        }
        place.start as usize..place.end as usize
    }

    /// Whether the text has a value at the end of a path.
    pub(super) fn has_value(&self, path: &[PathStep<'_>]) -> bool {
        path.iter()
            .try_fold(self.root(), |place, step| place?.child(self, *step).map(Some))
            .is_some()
    }

    /// Returns the top-level fields that the text sets.
    pub(super) fn top_level_fields(&self) -> Vec<&str> {
        let items = self.root().map_or(&[][..], |root| &root.items);
        items.iter().filter_map(|item| item.name(self)).collect()
    }

    fn root(&self) -> Option<&Place> {
        let root = || parse_tree(self).root.as_ref().map(Place::from_node);
        self.0.root.get_or_init(root).as_ref()
    }
}

impl Place {
    fn from_node(node: &Node<'_>) -> Self {
        let items = node.group().map_or(&[][..], |group| &group.items);
        let item = |item: &super::syntax::SyntaxItem<'_>| PlaceItem {
            key: item.key.as_ref().map(|key| [key.span.start as u32, key.span.end as u32]),
            value: Self::from_node(&item.value),
        };
        let items = items.iter().map(item).collect();
        Self { start: node.span.start as u32, end: node.span.end as u32, items }
    }

    /// Returns the child that a step leads to. Brackets around a single value, as in `Lines((width:
    /// Px(2)))`, do not count as a level.
    fn child(&self, text: &str, step: PathStep<'_>) -> Option<&Self> {
        let child = match step {
            PathStep::Index(index) => self.items.get(index),
            PathStep::Field(name) => self.items.iter().find(|item| item.name(text) == Some(name)),
        };
        match (child, self.items.as_slice(), step) {
            (Some(item), ..) => Some(&item.value),
            (None, [PlaceItem { key: None, value }], PathStep::Field(_)) => value.child(text, step),
            _ => None,
        }
    }
}

impl PlaceItem {
    fn name<'a>(&self, text: &'a str) -> Option<&'a str> {
        self.key.map(|[start, end]| &text[start as usize..end as usize])
    }
}

impl Deref for SourceText {
    type Target = str;

    fn deref(&self) -> &str {
        self.as_str()
    }
}

impl From<String> for SourceText {
    fn from(text: String) -> Self {
        Self(Arc::new(SharedText { text, ..SharedText::default() }))
    }
}

impl From<&str> for SourceText {
    fn from(text: &str) -> Self {
        text.to_owned().into()
    }
}

impl PartialEq for SourceText {
    fn eq(&self, other: &Self) -> bool {
        self.as_str() == other.as_str()
    }
}

impl Eq for SourceText {}

impl fmt::Debug for SourceText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.as_str().fmt(f)
    }
}
