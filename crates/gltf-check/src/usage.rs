//! Uses of accessors and buffer views: each may have only one purpose (glTF 2.0 §3.6.2.1, §5.11.5).
//!
//! Graphics APIs upload a buffer view as a whole, for one purpose: in WebGL a vertex buffer cannot
//! also be an index buffer. Every use that conflicts with the first is reported.

use super::codes;
use super::document::{CheckedDocument, index_member, integer_member};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

/// The purpose of an accessor.
///
/// Each purpose has different rules for bounds, strides and formats.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum AccessorUse {
    /// A vertex attribute, or its displacement in a morph target.
    Attribute,
    Indices,
    InverseBind,
    /// Keyframe times.
    Input,
    /// Keyframe values.
    Output,
}

/// The purpose of a buffer view.
///
/// It is determined by the declared `target`, or else by the first use.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum ViewUse {
    Vertices,
    Indices,
    InverseBind,
    Image,
    /// Data that is never uploaded, such as keyframes or sparse values.
    Other,
}

impl AccessorUse {
    /// Returns the purpose as written in messages.
    const fn name(self) -> &'static str {
        match self {
            Self::Attribute => "a vertex attribute",
            Self::Indices => "primitive indices",
            Self::InverseBind => "inverse bind matrices",
            Self::Input => "an animation input",
            Self::Output => "an animation output",
        }
    }
}

impl ViewUse {
    /// Returns the purpose as written in messages.
    const fn name(self) -> &'static str {
        match self {
            Self::Vertices => "vertex attributes",
            Self::Indices => "primitive indices",
            Self::InverseBind => "inverse bind matrices",
            Self::Image => "an image",
            Self::Other => "other data",
        }
    }
}

/// The uses of all accessors and buffer views found so far.
///
/// Interior mutability lets all checks share a reference. The maps are ordered, so that nothing
/// depends on a hash seed.
pub(super) struct UsageMap<'a> {
    document: &'a CheckedDocument<'a>,
    /// The first use of each accessor.
    accessors: RefCell<BTreeMap<usize, AccessorUse>>,
    /// The first use of each buffer view, or the use that its `target` declares.
    views: RefCell<BTreeMap<usize, ViewUse>>,
    /// The accessors of vertex attributes in each buffer view that has no `byteStride`.
    unstrided: RefCell<BTreeMap<usize, BTreeSet<usize>>>,
}

impl<'a> UsageMap<'a> {
    /// Records the uses that the `target` members of buffer views declare.
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

    /// Records the use of an accessor and its buffer view; `pointer` is the member that refers to
    /// the accessor.
    ///
    /// The first use wins. A later use for another purpose is reported as `ACCESSOR_USAGE_OVERRIDE`
    /// at its pointer, in a message that names both purposes.
    pub(super) fn note_accessor(&self, accessor: usize, new: AccessorUse, pointer: &str) {
        let old = *self.accessors.borrow_mut().entry(accessor).or_insert(new);
        if old != new {
            let (old, new) = (old.name(), new.name());
            let message =
                format_args!("accessor {accessor} is used as {new} here, but as {old} elsewhere");
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

    /// Records the use of a buffer view.
    ///
    /// An out-of-range index is ignored, because the schema walk has reported it.
    pub(super) fn note_view(&self, view: usize, new: ViewUse, pointer: &str) {
        if view >= self.document.root_array("bufferViews").len() {
            return;
        }
        let old = *self.views.borrow_mut().entry(view).or_insert(new);
        if old != new {
            let (old, new) = (old.name(), new.name());
            let message =
                format_args!("buffer view {view} is used for {new} here, but for {old} elsewhere");
            self.document.diagnostics.add(&codes::BUFFER_VIEW_TARGET_OVERRIDE, pointer, message);
        }
    }

    /// Records an accessor of a vertex attribute. A buffer view with several such accessors needs a
    /// `byteStride`.
    ///
    /// Without a stride, interleaved attributes cannot be distinguished from consecutive
    /// attributes, so the specification requires a stride for two or more accessors (glTF 2.0
    /// §5.11.4). One accessor may be used any number of times.
    pub(super) fn note_vertex_accessor(&self, accessor: usize, pointer: &str) {
        let Some(view) = self.accessor_view(accessor) else { return };
        let json = self.document.root_array("bufferViews").get(view);
        if json.is_none_or(|json| json.get("byteStride").is_some()) {
            return;
        }
        let mut tight = self.unstrided.borrow_mut();
        let known = tight.entry(view).or_default();
        if known.insert(accessor) && known.len() > 1 {
            let message =
                format_args!("buffer view {view} has several attributes but no byteStride");
            let code = &codes::MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE;
            self.document.diagnostics.add(code, pointer, message);
        }
    }

    /// Returns the buffer view of an accessor.
    fn accessor_view(&self, accessor: usize) -> Option<usize> {
        index_member(self.document.root_array("accessors").get(accessor)?, "bufferView")
    }

    /// Returns whether the buffer view of an accessor has a `byteStride`, which only vertex
    /// attributes may have.
    pub(super) fn has_stride(&self, accessor: usize) -> bool {
        let view = self.accessor_view(accessor);
        let json = view.and_then(|view| self.document.root_array("bufferViews").get(view));
        json.is_some_and(|json| json.get("byteStride").is_some())
    }
}
