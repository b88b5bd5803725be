//! The elements of an accessor, one after the other, without an array of them.

use super::layout::Layout;

/// The elements of one accessor, whose bytes are known to be there.
#[derive(Debug)]
pub(super) struct Elements<'a> {
    pub(super) layout: Layout,
    /// The elements' bytes and stride; `None` for zeros.
    base: Option<(&'a [u8], usize)>,
    /// Which elements are replaced, sorted, and by which value.
    replaced: Vec<(u32, u32)>,
    values: &'a [u8],
}

impl<'a> Elements<'a> {
    /// `indices` says which elements are replaced by the `values`, which lie without gaps.
    pub(super) fn new(
        layout: Layout,
        base: Option<(&'a [u8], usize)>,
        indices: Vec<u32>,
        values: &'a [u8],
    ) -> Self {
        let mut replaced: Vec<(u32, u32)> = indices.into_iter().zip(0..).collect();
        replaced.sort_unstable();
        Self { layout, base, replaced, values }
    }

    /// Whether all elements are zero because nothing says otherwise.
    pub(super) fn is_hollow(&self) -> bool {
        self.base.is_none() && self.replaced.is_empty()
    }

    /// Calls `see` with the number of each element and its numbers.
    pub(super) fn each(&self, mut see: impl FnMut(u64, &[f64])) {
        let mut numbers = [0.0; 16];
        let numbers = &mut numbers[..self.layout.shape.numbers()];
        let mut replaced = self.replaced.iter().peekable();
        for at in 0..self.layout.count {
            let mut value = None;
            while let Some((_, place)) = replaced.next_if(|(index, _)| u64::from(*index) <= at) {
                value = Some(*place as usize * self.layout.tight());
            }
            match (value, self.base) {
                (Some(start), _) => self.read(self.values, start, numbers),
                (None, Some((bytes, stride))) => self.read(bytes, at as usize * stride, numbers),
                (None, None) => numbers.fill(0.0),
            }
            see(at, numbers);
        }
    }

    fn read(&self, bytes: &[u8], start: usize, numbers: &mut [f64]) {
        let Layout { component, shape, .. } = self.layout;
        let bytes = bytes.get(start..).unwrap_or(&[]);
        for (at, number) in numbers.iter_mut().enumerate() {
            let place = at / shape.rows * self.layout.column() + at % shape.rows * component.size();
            *number = component.read(bytes.get(place..).unwrap_or(&[]));
        }
    }

    /// What a number means: normalised integers lie in [0, 1] or [−1, 1] (glTF 2.0 §3.11).
    pub(super) fn meaning(&self, number: f64) -> f64 {
        match self.layout.normalized {
            true => (number / self.layout.component.largest()).max(-1.0),
            false => number,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn seen(elements: &Elements<'_>) -> Vec<Vec<f64>> {
        let mut all = Vec::new();
        elements.each(|at, numbers| {
            assert_eq!(at, all.len() as u64);
            all.push(numbers.to_vec());
        });
        all
    }

    #[test]
    fn strides_replaced_elements_and_zeros() {
        let layout = |kind, count| {
            let accessor = json!({"componentType": 5121, "type": kind, "count": count});
            Layout::of(&accessor).unwrap()
        };
        let bytes: Vec<u8> = (0..12).collect();
        let spread = Elements::new(layout("VEC2", 3), Some((&bytes, 4)), vec![], &[]);
        assert_eq!(seen(&spread), [[0.0, 1.0], [4.0, 5.0], [8.0, 9.0]]);
        let sparse = Elements::new(layout("VEC2", 3), None, vec![2, 0], &[7, 8, 5, 6]);
        assert_eq!(seen(&sparse), [[5.0, 6.0], [0.0, 0.0], [7.0, 8.0]]);
        let matrix = Elements::new(layout("MAT2", 1), Some((&bytes, 8)), vec![], &[]);
        assert_eq!(seen(&matrix), [[0.0, 1.0, 4.0, 5.0]]);
        let zeros = Elements::new(layout("SCALAR", 2), None, vec![], &[]);
        assert!(zeros.is_hollow());
        assert_eq!(seen(&zeros), [[0.0], [0.0]]);
    }
}
