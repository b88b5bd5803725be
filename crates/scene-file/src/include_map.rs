//! The map from the parts of a scene to the included files in which they are written.

use super::source_text::SourceText;
use super::syntax::PathStep::{self, Field, Index};
use std::collections::BTreeMap;

/// The source of each element of each list in the scene, by the name of the list's field.
///
/// A source is the index of the included file, or `None` for the scene file, and the element's
/// index there.
pub(super) type ElementSources = BTreeMap<&'static str, Vec<(Option<usize>, usize)>>;

/// The sources of the parts of a scene. A part without an entry is in the scene file itself.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub(super) struct IncludeMap {
    /// The name and text of each included file, in reading order.
    pub(super) files: Vec<(String, SourceText)>,
    /// For each field that is replaced as a whole, the index of the file it comes from.
    pub(super) fields: BTreeMap<&'static str, Option<usize>>,
    pub(super) lists: ElementSources,
}

impl IncludeMap {
    /// Returns the name and text of the included file in which the value at the end of `path` is
    /// written, and the value's path there.
    ///
    /// The `path` belongs to the merged scene: `models[3]` may be the first model of an included
    /// file. `None` means the scene file itself.
    pub(super) fn resolve_source<'a>(
        &self,
        path: &[PathStep<'a>],
    ) -> (Option<(&str, &SourceText)>, Vec<PathStep<'a>>) {
        let (file, path) = match *path {
            [Field(list), Index(at), ref rest @ ..] if self.lists.contains_key(list) => {
                let place = self.lists.get(list).and_then(|list| list.get(at));
                let (file, at) = place.copied().unwrap_or((None, at));
                (file, [&[Field(list), Index(at)], rest].concat())
            }
            [Field(field), ..] => (self.fields.get(field).copied().flatten(), path.to_vec()),
            _ => (None, path.to_vec()),
        };
        let source = file.and_then(|file| self.files.get(file));
        (source.map(|(name, text)| (name.as_str(), text)), path)
    }

    /// Returns the included files' names, in reading order.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.files.iter().map(|(name, _)| name.as_str())
    }

    /// Returns the texts of the included files, in reading order.
    pub(super) fn included_texts(&self) -> impl Iterator<Item = &str> {
        self.files.iter().map(|(_, text)| text.as_str())
    }
}
