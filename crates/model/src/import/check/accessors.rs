//! Accessors: whether what they say of their layout fits the buffer views (glTF 2.0 §3.6.2).

use super::codes;
use super::document::{Document, index, integer, items};
use super::layout::{Component, Layout};
use super::store::Store;
use super::usage::{Usage, ViewUse};
use serde_json::Value;

/// Checks the layout of all accessors.
pub(super) fn check(document: &Document<'_>, store: &Store<'_>, usage: &Usage<'_>) {
    for (at, accessor) in document.all("accessors").iter().enumerate() {
        let checker = Checker { document, store, usage, pointer: format!("/accessors/{at}") };
        checker.check_bounds(accessor);
        if let Some(layout) = Layout::of(accessor) {
            checker.check(accessor, layout);
        }
    }
}

struct Checker<'a> {
    document: &'a Document<'a>,
    store: &'a Store<'a>,
    usage: &'a Usage<'a>,
    pointer: String,
}

/// A stretch of a view: from a byte on, so many bytes, of numbers of a size.
struct Stretch {
    offset: u64,
    length: u64,
    size: usize,
}

impl Checker<'_> {
    fn check(&self, accessor: &Value, layout: Layout) {
        let findings = self.document.findings;
        let pointer = &self.pointer;
        if layout.normalized && layout.component >= Component::U32 {
            let message = "only bytes and shorts can be normalised";
            findings.add(
                &codes::ACCESSOR_NORMALIZED_INVALID,
                format_args!("{pointer}/normalized"),
                message,
            );
        }
        if layout.shape.is_matrix() && !layout.offset.is_multiple_of(4) {
            let message =
                format_args!("matrices begin at multiples of 4, and not at {}", layout.offset);
            findings.add(
                &codes::ACCESSOR_MATRIX_ALIGNMENT,
                format_args!("{pointer}/byteOffset"),
                message,
            );
        }
        if let Some(view) = layout.view {
            let stride = self.store.stride(view);
            if let Some(stride) = stride.filter(|&stride| stride < layout.size()) {
                let size = layout.size();
                let message =
                    format_args!("the stride is {stride}, and an element has {size} bytes");
                findings.add(&codes::ACCESSOR_SMALL_BYTESTRIDE, pointer, message);
            }
            let length = layout.length(stride.unwrap_or(layout.tight()));
            let stretch = Stretch { offset: layout.offset, length, size: layout.component.size() };
            self.fit(view, &stretch, pointer);
        }
        if let Some(sparse) = accessor.get("sparse") {
            self.check_sparse(sparse, layout);
        }
    }

    /// Bounds have as many numbers as an element.
    fn check_bounds(&self, accessor: &Value) {
        let shape = Layout::of(accessor).map(|layout| layout.shape.numbers());
        for key in ["min", "max"] {
            let (found, Some(due)) = (items(accessor, key).len(), shape) else { continue };
            if found != 0 && found != due {
                let message = format_args!("there are {found} numbers, and {due} are due");
                let pointer = format_args!("{}/{key}", self.pointer);
                self.document.findings.add(&codes::ARRAY_LENGTH_NOT_IN_LIST, pointer, message);
            }
        }
    }

    fn check_sparse(&self, sparse: &Value, layout: Layout) {
        let Some(count) = integer(sparse, "count") else { return };
        let findings = self.document.findings;
        let pointer = format!("{}/sparse", self.pointer);
        if count > layout.count {
            let message = format_args!("{count} elements of {} are to be replaced", layout.count);
            let code = &codes::ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE;
            findings.add(code, format_args!("{pointer}/count"), message);
        }
        if let Some(indices) = sparse.get("indices") {
            let size =
                integer(indices, "componentType").and_then(Component::of).map(Component::size);
            let size = size.unwrap_or(1);
            self.check_part(indices, &format!("{pointer}/indices"), count, size, size);
        }
        if let Some(values) = sparse.get("values") {
            let size = layout.component.size();
            self.check_part(values, &format!("{pointer}/values"), count, layout.tight(), size);
        }
        self.check_indices(sparse, layout, &pointer);
    }

    /// One of the two parts of a sparse accessor: so many elements of such a length, of numbers of such a size.
    fn check_part(&self, part: &Value, pointer: &str, count: u64, length: usize, size: usize) {
        let Some(view) = index(part, "bufferView") else { return };
        let offset = integer(part, "byteOffset").unwrap_or(0);
        let named = format!("{pointer}/bufferView");
        self.usage.view(view, ViewUse::Other, &named);
        if self.store.stride(view).is_some() {
            let message = "the view has a stride, and its elements lie without gaps";
            self.document.findings.add(&codes::BUFFER_VIEW_INVALID_BYTE_STRIDE, &named, message);
        }
        let length = count.saturating_mul(length as u64);
        self.fit(view, &Stretch { offset, length, size }, pointer);
    }

    /// Whether a stretch lies in a view, and where it should begin.
    fn fit(&self, view: usize, stretch: &Stretch, pointer: &str) {
        let findings = self.document.findings;
        let Some(json) = self.document.all("bufferViews").get(view) else { return };
        let Stretch { offset, length, size } = *stretch;
        let start = integer(json, "byteOffset").unwrap_or(0);
        if !offset.is_multiple_of(size as u64) {
            let message = format_args!("{offset} is no multiple of the {size} bytes of a number");
            let at = format_args!("{pointer}/byteOffset");
            findings.add(&codes::ACCESSOR_OFFSET_ALIGNMENT, at, message);
        } else if !start.saturating_add(offset).is_multiple_of(size as u64) {
            let message =
                format_args!("{start} + {offset} is no multiple of the {size} bytes of a number");
            findings.add(&codes::ACCESSOR_TOTAL_OFFSET_ALIGNMENT, pointer, message);
        }
        if let Some(there) = integer(json, "byteLength")
            && offset.saturating_add(length) > there
        {
            let message = format_args!(
                "{length} bytes from {offset} on are not all in view {view}, which has {there}"
            );
            findings.add(&codes::ACCESSOR_TOO_LONG, pointer, message);
        }
    }

    /// The indices of replaced elements rise and are below the number of elements.
    fn check_indices(&self, sparse: &Value, layout: Layout, pointer: &str) {
        let Some(indices) = self.store.sparse_indices(sparse) else { return };
        let findings = self.document.findings;
        let falls = indices.array_windows().filter(|[a, b]: &&[u32; 2]| a >= b).count();
        if falls > 0 {
            let message = format_args!("the indices do not rise (places: {falls})");
            findings.add(&codes::ACCESSOR_SPARSE_INDICES_NON_INCREASING, pointer, message);
        }
        let outside = indices.iter().filter(|&&index| u64::from(index) >= layout.count).count();
        if outside > 0 {
            let message =
                format_args!("{outside} of {} indices have no element to replace", indices.len());
            findings.add(&codes::ACCESSOR_SPARSE_INDEX_OOB, pointer, message);
        }
    }
}
