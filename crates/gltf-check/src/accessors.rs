//! Validation of accessors, whose layout must fit their buffer views (glTF 2.0 §3.6.2).

use super::codes;
use super::document::{CheckedDocument, array_items, index_member, integer_member};
use super::layout::{AccessorLayout, ComponentType};
use super::store::BufferStore;
use super::usage::{UsageMap, ViewUse};
use serde_json::Value;

/// Validates the layout of all accessors.
///
/// Only the declarations and the sparse indices are checked here; [`data`](super::data) reads the
/// elements.
///
/// An accessor whose layout is incomplete is skipped, because the schema walk has reported it.
pub(super) fn check_accessors(
    document: &CheckedDocument<'_>,
    store: &BufferStore<'_>,
    usage: &UsageMap<'_>,
) {
    for (at, accessor) in document.root_array("accessors").iter().enumerate() {
        let checker =
            AccessorChecker { document, store, usage, pointer: format!("/accessors/{at}") };
        checker.check_bounds(accessor);
        if let Some(layout) = AccessorLayout::from_accessor(accessor) {
            checker.check_layout(accessor, layout);
        }
    }
}

/// The context for validating one accessor.
struct AccessorChecker<'a> {
    document: &'a CheckedDocument<'a>,
    store: &'a BufferStore<'a>,
    usage: &'a UsageMap<'a>,
    /// The JSON pointer of the accessor.
    pointer: String,
}

/// A range of bytes in a buffer view, containing components of `size` bytes.
///
/// For an accessor, it extends from the first byte of the first element to the last byte of the
/// last element, without any padding after that.
struct ByteRange {
    /// The start of the range, in bytes from the start of the buffer view.
    offset: u64,
    /// The length of the range in bytes.
    length: u64,
    /// The component size in bytes; the range must be aligned to it.
    size: usize,
}

impl AccessorChecker<'_> {
    /// Validates the normalization, alignment, stride and extent of the accessor, and its sparse
    /// part.
    ///
    /// Only 8-bit and 16-bit integers can be normalized, matrices must be aligned to four bytes,
    /// and a stride must be at least the size of an element (glTF 2.0 §3.6.2.4). Graphics APIs need
    /// the alignment to read a component in one access.
    fn check_layout(&self, accessor: &Value, layout: AccessorLayout) {
        let diagnostics = self.document.diagnostics;
        let pointer = &self.pointer;
        if layout.normalized && layout.component_type >= ComponentType::U32 {
            let message = "only 8-bit and 16-bit integers can be normalized";
            diagnostics.add(
                &codes::ACCESSOR_NORMALIZED_INVALID,
                format_args!("{pointer}/normalized"),
                message,
            );
        }
        if layout.element_type.is_matrix() && !layout.byte_offset.is_multiple_of(4) {
            let message = format_args!(
                "the byteOffset of a matrix must be a multiple of 4, not {}",
                layout.byte_offset
            );
            diagnostics.add(
                &codes::ACCESSOR_MATRIX_ALIGNMENT,
                format_args!("{pointer}/byteOffset"),
                message,
            );
        }
        if let Some(view) = layout.buffer_view {
            let stride = self.store.view_stride(view);
            if let Some(stride) = stride.filter(|&stride| stride < layout.element_size()) {
                let size = layout.element_size();
                let message =
                    format_args!("byteStride is {stride}, but an element has {size} bytes");
                diagnostics.add(&codes::ACCESSOR_SMALL_BYTESTRIDE, pointer, message);
            }
            let length = layout.byte_length(stride.unwrap_or(layout.packed_stride()));
            let stretch = ByteRange {
                offset: layout.byte_offset,
                length,
                size: layout.component_type.byte_size(),
            };
            self.check_byte_range(view, &stretch, pointer);
        }
        if let Some(sparse) = accessor.get("sparse") {
            self.check_sparse(sparse, layout);
        }
    }

    /// Validates that `min` and `max` have one number per component.
    fn check_bounds(&self, accessor: &Value) {
        let shape = AccessorLayout::from_accessor(accessor)
            .map(|layout| layout.element_type.component_count());
        for key in ["min", "max"] {
            let (actual, Some(expected)) = (array_items(accessor, key).len(), shape) else {
                continue;
            };
            if actual != 0 && actual != expected {
                let message = format_args!("the length is {actual}, expected {expected}");
                let pointer = format_args!("{}/{key}", self.pointer);
                self.document.diagnostics.add(&codes::ARRAY_LENGTH_NOT_IN_LIST, pointer, message);
            }
        }
    }

    /// Validates a sparse accessor: its count, and the layout of its indices and values.
    ///
    /// Values and indices are tightly packed. The values have the accessor's component type; the
    /// indices have a separate component type (glTF 2.0 §3.6.2.3).
    fn check_sparse(&self, sparse: &Value, layout: AccessorLayout) {
        let Some(count) = integer_member(sparse, "count") else { return };
        let diagnostics = self.document.diagnostics;
        let pointer = format!("{}/sparse", self.pointer);
        if count > layout.count {
            let message = format_args!("{count} exceeds the accessor's count of {}", layout.count);
            let code = &codes::ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE;
            diagnostics.add(code, format_args!("{pointer}/count"), message);
        }
        if let Some(indices) = sparse.get("indices") {
            let size = integer_member(indices, "componentType")
                .and_then(ComponentType::from_gl_constant)
                .map(ComponentType::byte_size);
            let size = size.unwrap_or(1);
            self.check_sparse_part(indices, &format!("{pointer}/indices"), count, size, size);
        }
        if let Some(values) = sparse.get("values") {
            let size = layout.component_type.byte_size();
            self.check_sparse_part(
                values,
                &format!("{pointer}/values"),
                count,
                layout.packed_stride(),
                size,
            );
        }
        self.check_sparse_indices(sparse, layout, &pointer);
    }

    /// Validates the indices or values of a sparse accessor: `count` elements of `length` bytes,
    /// with components of `size` bytes.
    ///
    /// Both are tightly packed: their buffer views must not have a `byteStride`.
    fn check_sparse_part(
        &self,
        part: &Value,
        pointer: &str,
        count: u64,
        length: usize,
        size: usize,
    ) {
        let Some(view) = index_member(part, "bufferView") else { return };
        let offset = integer_member(part, "byteOffset").unwrap_or(0);
        let named = format!("{pointer}/bufferView");
        self.usage.note_view(view, ViewUse::Other, &named);
        if self.store.view_stride(view).is_some() {
            let message = "byteStride must not be set, because the elements are tightly packed";
            self.document.diagnostics.add(&codes::BUFFER_VIEW_INVALID_BYTE_STRIDE, &named, message);
        }
        let length = count.saturating_mul(length as u64);
        self.check_byte_range(view, &ByteRange { offset, length, size }, pointer);
    }

    /// Validates that a range of bytes is aligned to its component size and inside its buffer view.
    ///
    /// Both the offset in the view and the offset in the buffer must be aligned; each violation has
    /// a separate code (glTF 2.0 §3.6.2.4). The sums saturate, so that offsets near the largest
    /// integer cannot wrap around to a small, valid-looking value.
    fn check_byte_range(&self, view: usize, stretch: &ByteRange, pointer: &str) {
        let diagnostics = self.document.diagnostics;
        let Some(json) = self.document.root_array("bufferViews").get(view) else { return };
        let ByteRange { offset, length, size } = *stretch;
        let start = integer_member(json, "byteOffset").unwrap_or(0);
        if !offset.is_multiple_of(size as u64) {
            let message = format_args!("{offset} is not a multiple of the component size {size}");
            let at = format_args!("{pointer}/byteOffset");
            diagnostics.add(&codes::ACCESSOR_OFFSET_ALIGNMENT, at, message);
        } else if !start.saturating_add(offset).is_multiple_of(size as u64) {
            let message =
                format_args!("{start} + {offset} is not a multiple of the component size {size}");
            diagnostics.add(&codes::ACCESSOR_TOTAL_OFFSET_ALIGNMENT, pointer, message);
        }
        if let Some(available) = integer_member(json, "byteLength")
            && offset.saturating_add(length) > available
        {
            let message = format_args!(
                "the {length}-byte range at offset {offset} does not fit in the {available}-byte buffer view {view}"
            );
            diagnostics.add(&codes::ACCESSOR_TOO_LONG, pointer, message);
        }
    }

    /// Validates that the sparse indices are strictly increasing and less than the accessor's
    /// count.
    ///
    /// Other data is read later, because the elements can be read only if these indices are valid.
    fn check_sparse_indices(&self, sparse: &Value, layout: AccessorLayout, pointer: &str) {
        let Some(indices) = self.store.sparse_indices(sparse) else { return };
        let diagnostics = self.document.diagnostics;
        let falls = indices.array_windows().filter(|[a, b]: &&[u32; 2]| a >= b).count();
        if falls > 0 {
            let message = format_args!("indices that do not exceed their predecessors: {falls}");
            diagnostics.add(&codes::ACCESSOR_SPARSE_INDICES_NON_INCREASING, pointer, message);
        }
        let outside = indices.iter().filter(|&&index| u64::from(index) >= layout.count).count();
        if outside > 0 {
            let message = format_args!("indices out of range: {outside} of {}", indices.len());
            diagnostics.add(&codes::ACCESSOR_SPARSE_INDEX_OOB, pointer, message);
        }
    }
}
