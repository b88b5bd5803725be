//! What accessors and buffer views are used for: each for one thing only (glTF 2.0 §3.6.2.1 and §5.11.5).

use super::codes;
use super::document::{Document, index, integer};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

/// What an accessor is used for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Use {
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
pub(super) struct Usage<'a> {
    document: &'a Document<'a>,
    accessors: RefCell<BTreeMap<usize, Use>>,
    views: RefCell<BTreeMap<usize, ViewUse>>,
    /// The accessors of vertices in views without a stride.
    tight: RefCell<BTreeMap<usize, BTreeSet<usize>>>,
}

impl<'a> Usage<'a> {
    pub(super) fn new(document: &'a Document<'a>) -> Self {
        let target = |(at, view): (usize, &serde_json::Value)| match integer(view, "target") {
            Some(34_962) => Some((at, ViewUse::Vertices)),
            Some(34_963) => Some((at, ViewUse::Indices)),
            _ => None,
        };
        let views = document.all("bufferViews").iter().enumerate().filter_map(target).collect();
        Self {
            document,
            accessors: RefCell::default(),
            views: RefCell::new(views),
            tight: RefCell::default(),
        }
    }

    /// An accessor is used; `pointer` is the member that names it.
    pub(super) fn accessor(&self, accessor: usize, new: Use, pointer: &str) {
        let old = *self.accessors.borrow_mut().entry(accessor).or_insert(new);
        if old != new {
            let message = format_args!("accessor {accessor} is {old:?} already, and {new:?} here");
            self.document.findings.add(&codes::ACCESSOR_USAGE_OVERRIDE, pointer, message);
        }
        if let Some(view) = self.view_of(accessor) {
            let new = match new {
                Use::Attribute => ViewUse::Vertices,
                Use::Indices => ViewUse::Indices,
                Use::InverseBind => ViewUse::InverseBind,
                Use::Input | Use::Output => ViewUse::Other,
            };
            self.view(view, new, pointer);
        }
    }

    /// A buffer view is used.
    pub(super) fn view(&self, view: usize, new: ViewUse, pointer: &str) {
        if view >= self.document.all("bufferViews").len() {
            return;
        }
        let old = *self.views.borrow_mut().entry(view).or_insert(new);
        if old != new {
            let message =
                format_args!("buffer view {view} is for {old:?} already, and {new:?} here");
            self.document.findings.add(&codes::BUFFER_VIEW_TARGET_OVERRIDE, pointer, message);
        }
    }

    /// An accessor of vertices: with others in one view, the view needs a stride.
    pub(super) fn vertices(&self, accessor: usize, pointer: &str) {
        let Some(view) = self.view_of(accessor) else { return };
        let json = self.document.all("bufferViews").get(view);
        if json.is_none_or(|json| json.get("byteStride").is_some()) {
            return;
        }
        let mut tight = self.tight.borrow_mut();
        let known = tight.entry(view).or_default();
        if known.insert(accessor) && known.len() > 1 {
            let message = format_args!("buffer view {view} has several attributes and no stride");
            let code = &codes::MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE;
            self.document.findings.add(code, pointer, message);
        }
    }

    fn view_of(&self, accessor: usize) -> Option<usize> {
        index(self.document.all("accessors").get(accessor)?, "bufferView")
    }

    /// Whether the view of an accessor declares a stride, as only those of vertices may.
    pub(super) fn has_stride(&self, accessor: usize) -> bool {
        let view = self.view_of(accessor);
        let json = view.and_then(|view| self.document.all("bufferViews").get(view));
        json.is_some_and(|json| json.get("byteStride").is_some())
    }
}
