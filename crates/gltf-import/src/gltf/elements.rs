//! Converts the bytes of accessor elements to arrays of floats, shorts or indices.
//!
//! Tightly packed floats, by far the most common case, are converted in a loop that the compiler
//! turns into a copy. Other types and strides are converted element by element, with the type
//! selected outside the loop.

use gltf::json::accessor::{ComponentType, Type};
use std::ops::Range;

/// The elements of an accessor, or a range of them, whose bytes are known to exist.
///
/// All checks are made on construction, so that conversion cannot fail.
#[derive(Debug)]
pub(super) struct ResolvedAccessor<'a> {
    /// Index of the accessor.
    pub(super) accessor: usize,
    /// The bytes; `None` for zeros.
    pub(super) data: Option<StridedBytes<'a>>,
    /// Sparse elements that replace some of these elements.
    pub(super) sparse: Option<SparseElements<'a>>,
    /// The first element to read.
    pub(super) first: usize,
    /// The number of elements to read.
    pub(super) count: usize,
    /// Type of the components, glTF's `componentType`.
    pub(super) component_type: ComponentType,
    /// Type of the elements, glTF's `type`.
    pub(super) element_type: Type,
    /// Whether integers are normalized to [0, 1] or [−1, 1].
    pub(super) normalized: bool,
}

/// Bytes of elements at a constant stride.
///
/// Every element is complete, but the gap after the last may be missing.
#[derive(Clone, Copy, Debug)]
pub(super) struct StridedBytes<'a> {
    /// The bytes, starting at the first element.
    pub(super) bytes: &'a [u8],
    /// Distance between the starts of consecutive elements in bytes; at least the element size.
    pub(super) stride: usize,
}

/// Elements of a sparse accessor that replace other elements.
#[derive(Debug)]
pub(super) struct SparseElements<'a> {
    /// Indices of the replaced elements, each less than the number of elements.
    pub(super) indices: Vec<u32>,
    /// The new values of these elements.
    pub(super) values: StridedBytes<'a>,
}

impl ResolvedAccessor<'_> {
    /// Returns the elements in a range. Elements that do not exist are skipped.
    pub(super) fn slice_range(mut self, range: Range<usize>) -> Self {
        let end = range.end.min(self.count);
        self.first += range.start.min(end);
        self.count = end.saturating_sub(range.start);
        self
    }

    /// Returns the first `N` components of every element as floats. Normalized integers become
    /// numbers in [0, 1] or [−1, 1] (glTF 2.0 §3.11); other integers are converted by value.
    ///
    /// Signed integers have two codes for −1 (for example −128 and −127), hence the maximum with
    /// −1. Unnormalized 32-bit integers above 2²⁴ are rounded.
    pub(super) fn to_floats<const N: usize>(&self) -> Vec<[f32; N]> {
        use ComponentType::{F32, I8, I16, U8, U16, U32};
        match (self.component_type, self.normalized) {
            (F32, _) => self.convert_components(|x: f32| x),
            (I8, true) => self.convert_components(|x: i8| (f32::from(x) / 127.0).max(-1.0)),
            (U8, true) => self.convert_components(|x: u8| f32::from(x) / 255.0),
            (I16, true) => self.convert_components(|x: i16| (f32::from(x) / 32_767.0).max(-1.0)),
            (U16, true) => self.convert_components(|x: u16| f32::from(x) / 65_535.0),
            (I8, false) => self.convert_components(|x: i8| f32::from(x)),
            (U8, false) => self.convert_components(|x: u8| f32::from(x)),
            (I16, false) => self.convert_components(|x: i16| f32::from(x)),
            (U16, false) => self.convert_components(|x: u16| f32::from(x)),
            (U32, _) => self.convert_components(|x: u32| x as f32),
        }
    }

    /// Returns the first `N` components of every element, from unsigned bytes or shorts. Other
    /// types saturate.
    ///
    /// Joint indices have these types; the table of allowed formats has already rejected all
    /// others.
    pub(super) fn to_u16s<const N: usize>(&self) -> Vec<[u16; N]> {
        match self.component_type {
            ComponentType::U8 => self.convert_components(|x: u8| u16::from(x)),
            ComponentType::U16 => self.convert_components(|x: u16| x),
            _ => self.to_floats::<N>().into_iter().map(|v| v.map(|x| x as u16)).collect(),
        }
    }

    /// Returns the elements as indices. Types other than unsigned integers saturate.
    pub(super) fn to_indices(&self) -> Vec<u32> {
        let words: Vec<[u32; 1]> = match self.component_type {
            ComponentType::U8 => self.convert_components(|x: u8| u32::from(x)),
            ComponentType::U16 => self.convert_components(|x: u16| u32::from(x)),
            ComponentType::U32 => self.convert_components(|x: u32| x),
            _ => self.to_floats::<1>().into_iter().map(|v| v.map(|x| x as u32)).collect(),
        };
        words.into_flattened()
    }

    /// Converts the first `N` components of every element; missing components are 0.
    ///
    /// Elements without data are zeros. Tightly packed components are converted in one loop without
    /// bounds checks, which for floats is a copy. Sparse elements are written last; those outside
    /// the range are skipped.
    fn convert_components<const N: usize, C: Component, T: Copy + Default>(
        &self,
        convert: impl Fn(C) -> T,
    ) -> Vec<[T; N]> {
        let mut elements = vec![[T::default(); N]; self.count];
        if let Some(StridedBytes { bytes, stride }) = self.data {
            let bytes = bytes.get(self.first * stride..).unwrap_or(&[]);
            if stride == N * size_of::<C>() {
                for (to, word) in elements.as_flattened_mut().iter_mut().zip(C::words(bytes)) {
                    *to = convert(C::read(word));
                }
            } else {
                for (to, from) in elements.iter_mut().zip(bytes.chunks(stride)) {
                    convert_element(to, from, &convert);
                }
            }
        }
        if let Some(SparseElements { indices, values }) = &self.sparse {
            for (&index, from) in indices.iter().zip(values.bytes.chunks(values.stride)) {
                let slot = (index as usize).checked_sub(self.first);
                if let Some(to) = slot.and_then(|slot| elements.get_mut(slot)) {
                    convert_element(to, from, &convert);
                }
            }
        }
        elements
    }
}

/// Converts the components of one element.
#[inline(always)]
fn convert_element<const N: usize, C: Component, T>(
    to: &mut [T; N],
    from: &[u8],
    convert: impl Fn(C) -> T,
) {
    for (to, word) in to.iter_mut().zip(C::words(from)) {
        *to = convert(C::read(word));
    }
}

/// An accessor component type, stored little-endian.
trait Component: Copy {
    /// The bytes of a number.
    type Word: Copy;
    /// Returns the words in a slice of bytes; an incomplete last word is skipped.
    fn words(bytes: &[u8]) -> &[Self::Word];
    /// Decodes a word.
    fn read(word: &Self::Word) -> Self;
}

/// Implements [`Component`] for number types through their `from_le_bytes`.
macro_rules! component {
    ($($number:ty)*) => {$(
        impl Component for $number {
            type Word = [u8; size_of::<$number>()];
            fn words(bytes: &[u8]) -> &[Self::Word] {
                bytes.as_chunks().0
            }
            fn read(word: &Self::Word) -> Self {
                Self::from_le_bytes(*word)
            }
        }
    )*};
}

component!(i8 u8 i16 u16 u32 f32);

#[cfg(test)]
mod tests {
    use super::*;

    fn accessor_over_bytes(
        bytes: &[u8],
        stride: usize,
        count: usize,
        component: ComponentType,
        normalized: bool,
    ) -> ResolvedAccessor<'_> {
        let run = Some(StridedBytes { bytes, stride });
        let shape = Type::Vec2;
        ResolvedAccessor {
            accessor: 0,
            data: run,
            sparse: None,
            first: 0,
            count,
            component_type: component,
            element_type: shape,
            normalized,
        }
    }

    #[test]
    fn every_component_type_is_converted() {
        use ComponentType::{F32, I8, I16, U8, U16, U32};
        // A small and a large value of each type, in most cases the extremes.
        let table: [(ComponentType, bool, &[u8], [f32; 2]); 10] = [
            (I8, false, &[0x80, 0x7F], [-128.0, 127.0]),
            (I8, true, &[0x80, 0x7F], [-1.0, 1.0]),
            (U8, false, &[0x00, 0xFF], [0.0, 255.0]),
            (U8, true, &[0x33, 0xFF], [0.2, 1.0]),
            (I16, false, &[0x00, 0x80, 0xFF, 0x7F], [-32_768.0, 32_767.0]),
            (I16, true, &[0x00, 0x80, 0xFF, 0x7F], [-1.0, 1.0]),
            (U16, false, &[0x01, 0x02, 0xFF, 0xFF], [513.0, 65_535.0]),
            (U16, true, &[0x33, 0x33, 0xFF, 0xFF], [0.2, 1.0]),
            (U32, false, &[1, 0, 0, 0, 0, 0, 0, 1], [1.0, 16_777_216.0]),
            (F32, false, &[0, 0, 0x80, 0x3F, 0, 0, 0, 0xC0], [1.0, -2.0]),
        ];
        for (component, normalized, bytes, values) in table {
            let tight = accessor_over_bytes(bytes, bytes.len(), 1, component, normalized);
            assert_eq!(tight.to_floats::<2>(), [values], "{component:?} {normalized}");
            let spread = [bytes, &[9; 4], bytes].concat();
            let spread = accessor_over_bytes(&spread, bytes.len() + 4, 2, component, normalized);
            assert_eq!(
                spread.to_floats::<2>(),
                [values; 2],
                "{component:?} {normalized}, with gaps"
            );
        }
    }

    #[test]
    fn ranges_and_sparse_elements_are_read() {
        let bytes: Vec<u8> = (0..10).collect();
        let values = StridedBytes { bytes: &[50, 51, 0, 60, 61], stride: 3 };
        let all = |range: Range<usize>| {
            let mut all = accessor_over_bytes(&bytes, 2, 5, ComponentType::U8, false);
            all.sparse = Some(SparseElements { indices: vec![1, 4], values });
            all.slice_range(range).to_u16s::<2>()
        };
        assert_eq!(all(0..5), [[0, 1], [50, 51], [4, 5], [6, 7], [60, 61]]);
        assert_eq!(all(1..3), [[50, 51], [4, 5]]);
        assert_eq!(all(2..9), [[4, 5], [6, 7], [60, 61]]);
        assert!(all(7..9).is_empty());
    }

    #[test]
    fn elements_without_bytes_are_zero() {
        let mut zeros = accessor_over_bytes(&[], 1, 3, ComponentType::U16, false);
        zeros.data = None;
        assert_eq!(zeros.to_indices(), [0; 3]);
        assert_eq!(zeros.slice_range(1..3).to_floats::<3>(), [[0.0; 3]; 2]);
    }
}
