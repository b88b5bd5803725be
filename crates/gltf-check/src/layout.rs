//! The memory layout of accessor elements (glTF 2.0 §3.6.2).
//!
//! ```text
//!  buffer view
//!  ├─ byte_offset ─┼────── stride ──────┼────── stride ──────┼──────────┤
//!                  │ element   padding  │ element   padding  │ element    no padding at the end
//! ```
//!
//! Sizes are in bytes. Sums saturate, because a declared size may exceed any buffer and is compared
//! with the actual size only later.

use super::document::{index_member, integer_member, string_member};
use serde_json::Value;

/// The layout that an accessor declares.
///
/// It copies the accessor's members, once they are known to be valid, and does not refer to the
/// buffer.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct AccessorLayout {
    /// The type of each component (`componentType`).
    pub(super) component_type: ComponentType,
    /// The type of an element (`type`).
    pub(super) element_type: ElementType,
    /// Whether integers represent numbers in [0, 1] or [−1, 1] (`normalized`).
    pub(super) normalized: bool,
    /// The number of elements (`count`).
    pub(super) count: u64,
    /// The offset of the first element in the buffer view (`byteOffset`).
    pub(super) byte_offset: u64,
    /// The index of the buffer view; without it, all elements are zero.
    pub(super) buffer_view: Option<usize>,
}

/// The type of a component (glTF 2.0 §3.6.2.2).
///
/// The order matters: `U32` and above cannot be normalized.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum ComponentType {
    /// Signed byte, OpenGL's `BYTE`.
    I8,
    /// Unsigned byte.
    U8,
    /// Signed short.
    I16,
    /// Unsigned short.
    U16,
    /// Unsigned int, for indices.
    U32,
    /// IEEE 754 single precision.
    F32,
}

/// The type of an element, as row and column counts; vectors have one column.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct ElementType {
    /// The number of components of a vector or a matrix column.
    pub(super) rows: usize,
    /// The number of columns; 1 for scalars and vectors.
    pub(super) columns: usize,
}

/// One component.
pub(super) const SCALAR: ElementType = ElementType { rows: 1, columns: 1 };
/// Two components.
pub(super) const VEC2: ElementType = ElementType { rows: 2, columns: 1 };
/// Three components.
pub(super) const VEC3: ElementType = ElementType { rows: 3, columns: 1 };
/// Four components.
pub(super) const VEC4: ElementType = ElementType { rows: 4, columns: 1 };
/// A 4×4 matrix in column-major order.
pub(super) const MAT4: ElementType = ElementType { rows: 4, columns: 4 };

impl ComponentType {
    /// Returns the type for an OpenGL constant, such as 5126 for `FLOAT`.
    pub(super) fn from_gl_constant(number: u64) -> Option<Self> {
        Some(match number {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    /// Returns the size of a component in bytes.
    pub(super) fn byte_size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// Returns the maximum of the type, which as an index is the primitive restart value.
    ///
    /// Normalized integers are divided by it; for `F32` it is unused.
    pub(super) fn max_value(self) -> f64 {
        match self {
            Self::I8 => f64::from(i8::MAX),
            Self::U8 => f64::from(u8::MAX),
            Self::I16 => f64::from(i16::MAX),
            Self::U16 => f64::from(u16::MAX),
            Self::U32 => f64::from(u32::MAX),
            Self::F32 => f64::from(f32::MAX),
        }
    }

    /// Reads the component at the start of the bytes, or returns 0 if there are too few bytes.
    pub(super) fn read_number(self, bytes: &[u8]) -> f64 {
        let one = || bytes.first().copied().unwrap_or(0);
        let two = || bytes.first_chunk().copied().unwrap_or_default();
        let four = || bytes.first_chunk().copied().unwrap_or_default();
        match self {
            Self::I8 => f64::from(one().cast_signed()),
            Self::U8 => f64::from(one()),
            Self::I16 => f64::from(i16::from_le_bytes(two())),
            Self::U16 => f64::from(u16::from_le_bytes(two())),
            Self::U32 => f64::from(u32::from_le_bytes(four())),
            Self::F32 => f64::from(f32::from_le_bytes(four())),
        }
    }

    /// Returns the name of the OpenGL constant, for messages.
    fn name(self) -> &'static str {
        match self {
            Self::I8 => "BYTE",
            Self::U8 => "UNSIGNED_BYTE",
            Self::I16 => "SHORT",
            Self::U16 => "UNSIGNED_SHORT",
            Self::U32 => "UNSIGNED_INT",
            Self::F32 => "FLOAT",
        }
    }
}

impl ElementType {
    /// Returns the element type for the value of a `type` member.
    fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "SCALAR" => SCALAR,
            "VEC2" => VEC2,
            "VEC3" => VEC3,
            "VEC4" => VEC4,
            "MAT2" => Self { rows: 2, columns: 2 },
            "MAT3" => Self { rows: 3, columns: 3 },
            "MAT4" => MAT4,
            _ => return None,
        })
    }

    /// Returns the number of components of an element.
    pub(super) fn component_count(self) -> usize {
        self.rows * self.columns
    }

    /// Returns whether an element is a matrix, whose columns are aligned.
    pub(super) fn is_matrix(self) -> bool {
        self.columns > 1
    }

    /// Returns the glTF name, for messages.
    fn name(self) -> &'static str {
        match (self.rows, self.columns) {
            (1, _) => "SCALAR",
            (2, 1) => "VEC2",
            (3, 1) => "VEC3",
            (_, 1) => "VEC4",
            (2, _) => "MAT2",
            (3, _) => "MAT3",
            _ => "MAT4",
        }
    }
}

impl AccessorLayout {
    /// Returns the layout of an accessor, if its type, component type, count and offset are valid.
    ///
    /// Otherwise returns `None`: the schema walk has reported the member, and there is no layout to
    /// check.
    pub(super) fn from_accessor(accessor: &Value) -> Option<Self> {
        Some(Self {
            component_type: ComponentType::from_gl_constant(integer_member(
                accessor,
                "componentType",
            )?)?,
            element_type: ElementType::from_name(string_member(accessor, "type")?)?,
            normalized: accessor.get("normalized").and_then(Value::as_bool).unwrap_or(false),
            count: integer_member(accessor, "count")?,
            byte_offset: match accessor.get("byteOffset") {
                Some(_) => integer_member(accessor, "byteOffset")?,
                None => 0,
            },
            buffer_view: index_member(accessor, "bufferView"),
        })
    }

    /// Returns the number of bytes from one column to the next; matrix columns are aligned to four
    /// bytes (§3.6.2.4).
    ///
    /// Without the alignment, a column of a small matrix could start at an odd address.
    pub(super) fn column_stride(&self) -> usize {
        let column = self.element_type.rows * self.component_type.byte_size();
        if self.element_type.is_matrix() { column.next_multiple_of(4) } else { column }
    }

    /// Returns the size of an element in bytes, up to the end of its last component.
    pub(super) fn element_size(&self) -> usize {
        (self.element_type.columns - 1) * self.column_stride()
            + self.element_type.rows * self.component_type.byte_size()
    }

    /// Returns the distance between elements in bytes if the buffer view has no `byteStride`.
    ///
    /// For vectors, this is the size of an element; for matrices, it includes the padding of the
    /// last column.
    pub(super) fn packed_stride(&self) -> usize {
        self.element_type.columns * self.column_stride()
    }

    /// Returns the size of all elements in bytes at this stride, up to the end of the last
    /// component.
    pub(super) fn byte_length(&self, stride: usize) -> u64 {
        if self.count == 0 {
            return 0;
        }
        let gaps = self.count.saturating_sub(1).saturating_mul(stride as u64);
        gaps.saturating_add(self.element_size() as u64)
    }

    /// Returns the format as written in messages, such as `VEC3 of FLOAT`.
    pub(super) fn format_name(&self) -> String {
        let normalized = if self.normalized { "normalized " } else { "" };
        format!("{} of {normalized}{}", self.element_type.name(), self.component_type.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn element_sizes_include_column_padding() {
        // Small matrices of small integers have gaps between their columns (§3.6.2.4).
        for (shape, component, size, tight) in [
            ("SCALAR", 5121, 1, 1),
            ("VEC3", 5122, 6, 6),
            ("VEC4", 5126, 16, 16),
            ("MAT2", 5121, 6, 8),
            ("MAT3", 5120, 11, 12),
            ("MAT3", 5123, 22, 24),
            ("MAT4", 5126, 64, 64),
        ] {
            let accessor = json!({"componentType": component, "type": shape, "count": 3});
            let layout = AccessorLayout::from_accessor(&accessor).unwrap();
            assert_eq!(
                (layout.element_size(), layout.packed_stride()),
                (size, tight),
                "{shape} of {component}"
            );
            assert_eq!(layout.byte_length(tight), (2 * tight + size) as u64);
        }
        assert_eq!(
            AccessorLayout::from_accessor(
                &json!({"componentType": 5124, "type": "VEC2", "count": 3})
            ),
            None
        );
    }
}
