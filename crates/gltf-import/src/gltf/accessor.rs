//! Accessors: typed views into buffers, checked once so that converting elements cannot fail.
//!
//! An accessor declares a byte offset, a number of elements, their type and, through its buffer
//! view, the stride between them (glTF 2.0 §3.6.2). [`AccessorReader::resolve_accessor`] checks the
//! declaration against the available bytes in 64-bit arithmetic. [`AccessorReader::read_floats`]
//! and its siblings create arrays and charge the memory budget. Without the budget, thousands of
//! accessors that share the same bytes could exhaust memory, and so could accessors without bytes,
//! which the specification defines as zeros.

use super::buffers::{Buffers, checked_slice};
use super::elements::{ResolvedAccessor, SparseElements, StridedBytes};
use crate::limits::Limits;
use files::counted;
use gltf::json::Root;
use gltf::json::accessor::{Accessor, ComponentType, IndexComponentType, Type, sparse};
use gltf::json::validation::Checked;
use model::Diagnostic;

/// Reads the accessors of a file.
///
/// All other readers borrow it; its only mutable state is the memory budget and the lazily loaded
/// buffers.
pub(super) struct AccessorReader<'a> {
    /// The parsed document, whose indices have not been checked.
    pub(super) root: &'a Root,
    /// Buffers and buffer views, loaded on first use.
    pub(super) buffers: &'a Buffers<'a>,
    /// Limits on sizes and counts.
    pub(super) limits: &'a Limits,
}

impl<'a> AccessorReader<'a> {
    pub(super) fn new(root: &'a Root, buffers: &'a Buffers<'a>, limits: &'a Limits) -> Self {
        Self { root, buffers, limits }
    }

    /// Resolves an accessor to its bytes. `user` is the pointer to the member that refers to it.
    ///
    /// # Errors
    /// Fails if the accessor does not exist, has an invalid type, or has elements outside its
    /// buffer view.
    ///
    /// Nothing is converted or allocated here, except for sparse indices. An accessor is resolved
    /// again for each user; this costs little, because its bytes are borrowed.
    pub(super) fn resolve_accessor(
        &self,
        accessor: usize,
        user: &str,
    ) -> Result<ResolvedAccessor<'_>, Diagnostic> {
        let Some(json) = self.root.accessors.get(accessor) else {
            return Err(Diagnostic::unresolved_index(
                user,
                "accessor",
                accessor,
                self.root.accessors.len(),
            ));
        };
        let pointer = format!("/accessors/{accessor}");
        let (component, shape) = accessor_format(json, &pointer)?;
        // On 32-bit targets, a count may not fit; `usize::MAX` then exceeds every buffer.
        let count = usize::try_from(json.count.0).unwrap_or(usize::MAX);
        let block =
            ElementLayout { pointer: &pointer, count, size: element_size(component, shape) };
        let offset = json.byte_offset.unwrap_or_default().0;
        let data = json
            .buffer_view
            .map(|view| self.strided_bytes(view.value(), offset, block))
            .transpose()?;
        let sparse = json.sparse.as_ref().map(|json| self.resolve_sparse(json, accessor, block));
        Ok(ResolvedAccessor {
            accessor,
            data,
            sparse: sparse.transpose()?,
            first: 0,
            count,
            component_type: component,
            element_type: shape,
            normalized: json.normalized,
        })
    }

    /// Returns whether an accessor exists but has no bytes: neither a buffer view nor sparse
    /// values.
    ///
    /// Such an accessor represents zeros (glTF 2.0 §3.6.2.3), or data that an extension such as
    /// Draco supplies.
    pub(super) fn has_no_data(&self, accessor: usize) -> bool {
        let json = self.root.accessors.get(accessor);
        json.is_some_and(|json| json.buffer_view.is_none() && json.sparse.is_none())
    }

    /// Reads the first `N` components of every element as floats; normalized integers are
    /// converted.
    ///
    /// # Errors
    /// Fails if the array exceeds the memory budget.
    pub(super) fn read_floats<const N: usize>(
        &self,
        elements: &ResolvedAccessor<'_>,
    ) -> Result<Vec<[f32; N]>, Diagnostic> {
        self.charge_array(elements.accessor, elements.count, 4 * N)?;
        Ok(elements.to_floats())
    }

    /// Reads the first `N` components of every element as unsigned shorts, such as joint indices.
    ///
    /// # Errors
    /// Fails if the array exceeds the memory budget.
    pub(super) fn read_u16s<const N: usize>(
        &self,
        elements: &ResolvedAccessor<'_>,
    ) -> Result<Vec<[u16; N]>, Diagnostic> {
        self.charge_array(elements.accessor, elements.count, 2 * N)?;
        Ok(elements.to_u16s())
    }

    /// Reads the elements as 32-bit indices.
    ///
    /// # Errors
    /// Fails if the array exceeds the memory budget.
    pub(super) fn read_indices(
        &self,
        elements: &ResolvedAccessor<'_>,
    ) -> Result<Vec<u32>, Diagnostic> {
        self.charge_array(elements.accessor, elements.count, 4)?;
        Ok(elements.to_indices())
    }

    /// Charges the memory budget for an array before it is created from an accessor.
    ///
    /// `bytes` is the size of an element in the new array, not in the file.
    ///
    /// # Errors
    /// Returns [`LIMIT_EXCEEDED`](model::codes::LIMIT_EXCEEDED) if the budget is exhausted.
    pub(super) fn charge_array(
        &self,
        accessor: usize,
        count: usize,
        bytes: usize,
    ) -> Result<(), Diagnostic> {
        let bytes = (count as u64).saturating_mul(bytes as u64);
        self.buffers.charge_bytes(&format!("/accessors/{accessor}/count"), bytes)
    }

    /// Returns the bytes of elements that begin at an offset in a buffer view.
    ///
    /// The last element needs only its own size, not a whole stride (glTF 2.0 §3.6.2.4), because
    /// interleaved attributes may end before the last stride does. A length that overflows
    /// saturates, so it exceeds any buffer and is reported as missing bytes. A stride smaller than
    /// an element would make elements overlap, so it is an error unless there is only one element.
    fn strided_bytes(
        &self,
        view: usize,
        offset: u64,
        block: ElementLayout<'_>,
    ) -> Result<StridedBytes<'_>, Diagnostic> {
        let view = self.buffers.buffer_view(view, &format!("{}/bufferView", block.pointer))?;
        let stride = view.stride.unwrap_or(block.size);
        if stride < block.size && block.count > 1 {
            let message = format!(
                "the stride of {stride} bytes is smaller than an element of {} bytes",
                block.size
            );
            return Err(Diagnostic::invalid(&format!("{}/byteStride", view.pointer), message));
        }
        let stride = stride.max(block.size);
        let gaps = (block.count as u64).saturating_sub(1).saturating_mul(stride as u64);
        let length = if block.count == 0 { 0 } else { gaps.saturating_add(block.size as u64) };
        match checked_slice(view.bytes, offset, length) {
            Some(bytes) => Ok(StridedBytes { bytes, stride }),
            None => {
                let (pointer, available) = (view.pointer, view.bytes.len());
                let elements = counted(block.count, "element", "elements");
                let message = format!(
                    "{pointer}, which has {available} bytes, is too small for {elements} ({length} \
                     bytes) at offset {offset}"
                );
                Err(Diagnostic::invalid(block.pointer, message))
            }
        }
    }

    /// Resolves a sparse accessor: the indices and values of elements that replace some of the
    /// `base` elements (glTF 2.0 §3.6.2.3).
    ///
    /// Every index must be less than the number of elements. Only the validator checks that the
    /// indices increase, because reading does not depend on their order. The values have the
    /// accessor's format; both arrays are tightly packed.
    ///
    /// # Errors
    /// Fails if the component type of the indices is invalid, an index is out of range, or bytes
    /// are missing.
    fn resolve_sparse(
        &self,
        json: &sparse::Sparse,
        accessor: usize,
        base: ElementLayout<'_>,
    ) -> Result<SparseElements<'_>, Diagnostic> {
        let count = usize::try_from(json.count.0).unwrap_or(usize::MAX);
        let pointer = format!("{}/sparse/indices", base.pointer);
        let Checked::Valid(IndexComponentType(component)) = json.indices.component_type else {
            let message = "the component type must be 5121, 5123 or 5125";
            return Err(Diagnostic::invalid(&format!("{pointer}/componentType"), message));
        };
        let block = ElementLayout { pointer: &pointer, count, size: component.size() };
        let (view, offset) = (json.indices.buffer_view.value(), json.indices.byte_offset.0);
        let indices = self.read_indices(&ResolvedAccessor {
            accessor,
            data: Some(self.strided_bytes(view, offset, block)?),
            sparse: None,
            first: 0,
            count,
            component_type: component,
            element_type: Type::Scalar,
            normalized: false,
        })?;
        if let Some(&index) = indices.iter().find(|&&index| index as usize >= base.count) {
            let message =
                format!("the sparse index {index} is out of range for a count of {}", base.count);
            return Err(Diagnostic::invalid(&pointer, message));
        }
        let pointer = format!("{}/sparse/values", base.pointer);
        let block = ElementLayout { pointer: &pointer, count, size: base.size };
        let (view, offset) = (json.values.buffer_view.value(), json.values.byte_offset.0);
        Ok(SparseElements { indices, values: self.strided_bytes(view, offset, block)? })
    }
}

/// The number and size of elements that must be present; `pointer` is the location that declares
/// them.
///
/// It describes the base elements of an accessor, or the indices or values of its sparse part.
#[derive(Clone, Copy)]
struct ElementLayout<'a> {
    /// JSON pointer to the declaration, for diagnostics.
    pointer: &'a str,
    /// Number of elements.
    count: usize,
    /// Size of an element in bytes, including the padding between the columns of matrices.
    size: usize,
}

/// Returns the component type and element type of an accessor.
///
/// # Errors
/// Fails if the specification does not allow one of the types (glTF 2.0 §3.6.2.2).
fn accessor_format(json: &Accessor, pointer: &str) -> Result<(ComponentType, Type), Diagnostic> {
    let Checked::Valid(component) = json.component_type else {
        let message = "the component type must be 5120, 5121, 5122, 5123, 5125 or 5126";
        return Err(Diagnostic::invalid(&format!("{pointer}/componentType"), message));
    };
    let Checked::Valid(shape) = json.type_ else {
        let message = "the type must be SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4";
        return Err(Diagnostic::invalid(&format!("{pointer}/type"), message));
    };
    Ok((component.0, shape))
}

/// Returns the size of an element in bytes. Matrix columns begin at multiples of four (glTF 2.0
/// §3.6.2.4), so small matrices of small integers contain padding.
///
/// ```text
///  MAT3 of bytes:  c0 c0 c0 ··  c1 c1 c1 ··  c2 c2 c2 ··     12 bytes, not 9
/// ```
fn element_size(component: ComponentType, shape: Type) -> usize {
    let column = |rows: usize| (rows * component.size()).next_multiple_of(4);
    match shape {
        Type::Scalar => component.size(),
        Type::Vec2 => 2 * component.size(),
        Type::Vec3 => 3 * component.size(),
        Type::Vec4 => 4 * component.size(),
        Type::Mat2 => 2 * column(2),
        Type::Mat3 => 3 * column(3),
        Type::Mat4 => 4 * column(4),
    }
}
