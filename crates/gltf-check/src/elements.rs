//! Streaming access to the elements of an accessor, without a decoded copy.
//!
//! Accessors may have millions of elements, so they are decoded one at a time into a buffer of 16
//! numbers, the size of the largest element type.

use super::layout::AccessorLayout;

/// The elements of one accessor, with sparse replacements. Their bytes are known to be present.
///
/// All numbers are read as f64, which represents every component type exactly.
#[derive(Debug)]
pub(super) struct AccessorElements<'a> {
    /// The layout that the accessor declares.
    pub(super) layout: AccessorLayout,
    /// The bytes of the elements and their stride; `None` if all are zero.
    base: Option<(&'a [u8], usize)>,
    /// Pairs of indices: an element and the sparse value that replaces it, sorted by element.
    replaced: Vec<(u32, u32)>,
    /// The bytes of the sparse values, tightly packed.
    values: &'a [u8],
}

impl<'a> AccessorElements<'a> {
    /// Creates the elements, with those at `indices` replaced by the tightly packed `values`.
    pub(super) fn new(
        layout: AccessorLayout,
        base: Option<(&'a [u8], usize)>,
        indices: Vec<u32>,
        values: &'a [u8],
    ) -> Self {
        let mut replaced: Vec<(u32, u32)> = indices.into_iter().zip(0..).collect();
        replaced.sort_unstable();
        Self { layout, base, replaced, values }
    }

    /// Returns whether all elements are zero because there is neither a buffer view nor a sparse
    /// replacement.
    pub(super) fn has_no_data(&self) -> bool {
        self.base.is_none() && self.replaced.is_empty()
    }

    /// Calls `see` with the index and the components of each element.
    ///
    /// Components are passed as stored in the file; [`dequantize`](Self::dequantize) converts
    /// normalized integers. The sorted replacements are merged with the elements in one linear
    /// pass.
    ///
    /// If an element has several sparse values, the last is used; sparse indices that are not
    /// increasing are reported separately.
    pub(super) fn for_each_element(&self, mut see: impl FnMut(u64, &[f64])) {
        let mut numbers = [0.0; 16];
        let numbers = &mut numbers[..self.layout.element_type.component_count()];
        let mut replaced = self.replaced.iter().peekable();
        for at in 0..self.layout.count {
            let mut value = None;
            while let Some((_, slot)) = replaced.next_if(|(index, _)| u64::from(*index) <= at) {
                value = Some(*slot as usize * self.layout.packed_stride());
            }
            match (value, self.base) {
                (Some(start), _) => self.read_element(self.values, start, numbers),
                (None, Some((bytes, stride))) => {
                    self.read_element(bytes, at as usize * stride, numbers);
                }
                (None, None) => numbers.fill(0.0),
            }
            see(at, numbers);
        }
    }

    /// Decodes the components of the element that starts at a byte offset, column by column.
    ///
    /// Matrix columns are padded to four bytes; vectors have one column.
    fn read_element(&self, bytes: &[u8], start: usize, numbers: &mut [f64]) {
        let AccessorLayout { component_type: component, element_type: shape, .. } = self.layout;
        let bytes = bytes.get(start..).unwrap_or(&[]);
        for (at, number) in numbers.iter_mut().enumerate() {
            let offset = at / shape.rows * self.layout.column_stride()
                + at % shape.rows * component.byte_size();
            *number = component.read_number(bytes.get(offset..).unwrap_or(&[]));
        }
    }

    /// Returns the value of a component, with normalized integers mapped to [0, 1] or [−1, 1] (glTF
    /// 2.0 §3.11).
    pub(super) fn dequantize(&self, number: f64) -> f64 {
        match self.layout.normalized {
            true => (number / self.layout.component_type.max_value()).max(-1.0),
            false => number,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn collect_elements(elements: &AccessorElements<'_>) -> Vec<Vec<f64>> {
        let mut all = Vec::new();
        elements.for_each_element(|at, numbers| {
            assert_eq!(at, all.len() as u64);
            all.push(numbers.to_vec());
        });
        all
    }

    #[test]
    fn strides_sparse_values_and_zeros_are_decoded() {
        let layout = |kind, count| {
            let accessor = json!({"componentType": 5121, "type": kind, "count": count});
            AccessorLayout::from_accessor(&accessor).unwrap()
        };
        let bytes: Vec<u8> = (0..12).collect();
        let spread = AccessorElements::new(layout("VEC2", 3), Some((&bytes, 4)), vec![], &[]);
        assert_eq!(collect_elements(&spread), [[0.0, 1.0], [4.0, 5.0], [8.0, 9.0]]);
        let sparse = AccessorElements::new(layout("VEC2", 3), None, vec![2, 0], &[7, 8, 5, 6]);
        assert_eq!(collect_elements(&sparse), [[5.0, 6.0], [0.0, 0.0], [7.0, 8.0]]);
        let matrix = AccessorElements::new(layout("MAT2", 1), Some((&bytes, 8)), vec![], &[]);
        assert_eq!(collect_elements(&matrix), [[0.0, 1.0, 4.0, 5.0]]);
        let zeros = AccessorElements::new(layout("SCALAR", 2), None, vec![], &[]);
        assert!(zeros.has_no_data());
        assert_eq!(collect_elements(&zeros), [[0.0], [0.0]]);
    }
}
