//! What accessors and buffer views are used for: each for one thing only (glTF 2.0 §3.6.2.1 and §5.11.5).

use super::codes;
use super::document::{CheckedDocument, index_member, integer_member};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

/// What an accessor is used for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum AccessorUse {
    Attribute,
    Indices,
    InverseBind,
    Input,
    Output,
}

/// What a buffer view is used for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum ViewUse {
    Vertices,
    Indices,
    InverseBind,
    Image,
    Other,
}

/// All uses that have been seen.
pub(super) struct UsageMap<'a> {
    document: &'a CheckedDocument<'a>,
    accessors: RefCell<BTreeMap<usize, AccessorUse>>,
    views: RefCell<BTreeMap<usize, ViewUse>>,
    /// The accessors of vertices in views without a stride.
    unstrided: RefCell<BTreeMap<usize, BTreeSet<usize>>>,
}

impl<'a> UsageMap<'a> {
    pub(super) fn new(document: &'a CheckedDocument<'a>) -> Self {
        let target = |(at, view): (usize, &serde_json::Value)| match integer_member(view, "target")
        {
            Some(34_962) => Some((at, ViewUse::Vertices)),
            Some(34_963) => Some((at, ViewUse::Indices)),
            _ => None,
        };
        let views =
            document.root_array("bufferViews").iter().enumerate().filter_map(target).collect();
        Self {
            document,
            accessors: RefCell::default(),
            views: RefCell::new(views),
            unstrided: RefCell::default(),
        }
    }

    /// An accessor is used; `pointer` is the member that names it.
    pub(super) fn note_accessor(&self, accessor: usize, new: AccessorUse, pointer: &str) {
        let old = *self.accessors.borrow_mut().entry(accessor).or_insert(new);
        if old != new {
            let message = format_args!("accessor {accessor} is {old:?} already, and {new:?} here");
            self.document.diagnostics.add(&codes::ACCESSOR_USAGE_OVERRIDE, pointer, message);
        }
        if let Some(view) = self.accessor_view(accessor) {
            let new = match new {
                AccessorUse::Attribute => ViewUse::Vertices,
                AccessorUse::Indices => ViewUse::Indices,
                AccessorUse::InverseBind => ViewUse::InverseBind,
                AccessorUse::Input | AccessorUse::Output => ViewUse::Other,
            };
            self.note_view(view, new, pointer);
        }
    }

    /// A buffer view is used.
    pub(super) fn note_view(&self, view: usize, new: ViewUse, pointer: &str) {
        if view >= self.document.root_array("bufferViews").len() {
            return;
        }
        let old = *self.views.borrow_mut().entry(view).or_insert(new);
        if old != new {
            let message =
                format_args!("buffer view {view} is for {old:?} already, and {new:?} here");
            self.document.diagnostics.add(&codes::BUFFER_VIEW_TARGET_OVERRIDE, pointer, message);
        }
    }

    /// An accessor of vertices: with others in one view, the view needs a stride.
    pub(super) fn note_vertex_accessor(&self, accessor: usize, pointer: &str) {
        let Some(view) = self.accessor_view(accessor) else { return };
        let json = self.document.root_array("bufferViews").get(view);
        if json.is_none_or(|json| json.get("byteStride").is_some()) {
            return;
        }
        let mut tight = self.unstrided.borrow_mut();
        let known = tight.entry(view).or_default();
        if known.insert(accessor) && known.len() > 1 {
            let message = format_args!("buffer view {view} has several attributes and no stride");
            let code = &codes::MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE;
            self.document.diagnostics.add(code, pointer, message);
        }
    }

    fn accessor_view(&self, accessor: usize) -> Option<usize> {
        index_member(self.document.root_array("accessors").get(accessor)?, "bufferView")
    }

    /// Whether the view of an accessor declares a stride, as only those of vertices may.
    pub(super) fn has_stride(&self, accessor: usize) -> bool {
        let view = self.accessor_view(accessor);
        let json = view.and_then(|view| self.document.root_array("bufferViews").get(view));
        json.is_some_and(|json| json.get("byteStride").is_some())
    }
}
