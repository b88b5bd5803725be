//! Answers as numbers, and comparison of answers.

use glam::{DMat3, DMat4};

/// The entries of an answer, row by row, for one set of values of the symbols.
pub(super) type Entries = Vec<Vec<f64>>;

/// The multiples of the correct answer that are also correct.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Multiples {
    /// No multiple: every entry must match.
    None,
    /// All except 0, because the answer is a point or a map in homogeneous coordinates.
    All,
    /// Positive multiples, which keep the sign of w.
    Positive,
}

/// The allowed rounding error, relative to the entry.
pub(super) const EXACT: f64 = 1e-9;
/// The relative error up to which an answer counts as rounded by hand.
pub(super) const ROUNDED: f64 = 2e-3;

/// Whether two answers have the same number of rows with the same lengths.
pub(super) fn same_shape(a: &Entries, b: &Entries) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.len() == b.len())
}

/// Returns the positions (row and column, from 0) where an answer differs from the expected answer,
/// or from its allowed multiple with the fewest differences.
///
/// Both answers must have the same shape.
pub(super) fn differing_places(
    given: &Entries,
    expected: &Entries,
    multiples: Multiples,
    tolerance: f64,
) -> Vec<(usize, usize)> {
    let pairs = || given.iter().flatten().zip(expected.iter().flatten());
    let ratios = pairs().filter(|(_, expected)| **expected != 0.0).map(|(a, b)| a / b);
    let factors: Vec<f64> = match multiples {
        Multiples::None => vec![1.0],
        Multiples::All => ratios.filter(|ratio| *ratio != 0.0).collect(),
        Multiples::Positive => ratios.filter(|ratio| *ratio > 0.0).collect(),
    };
    let largest = pairs().fold(0.0_f64, |largest, (_, entry)| largest.max(entry.abs()));
    let differences = |factor: f64| {
        let allowed = |entry: f64| tolerance * entry.abs() + 1e-12 * (factor * largest).abs();
        let differs = |(i, j): &(usize, usize)| {
            let entry = factor * expected[*i][*j];
            (given[*i][*j] - entry).abs() > allowed(entry)
        };
        all_places(expected).filter(differs).collect::<Vec<_>>()
    };
    let fewest = factors.into_iter().map(differences).min_by_key(Vec::len);
    fewest.unwrap_or_else(|| all_places(expected).collect())
}

/// Whether only the sign of an entry is wrong.
pub(super) fn is_negated(given: f64, expected: f64) -> bool {
    expected != 0.0 && (given + expected).abs() <= EXACT * expected.abs()
}

fn all_places(entries: &Entries) -> impl Iterator<Item = (usize, usize)> {
    entries.iter().enumerate().flat_map(|(i, row)| (0..row.len()).map(move |j| (i, j)))
}

/// Swaps rows and columns.
pub(super) fn transposed(entries: &Entries) -> Entries {
    let columns = entries.iter().map(Vec::len).min().unwrap_or(0);
    (0..columns).map(|j| entries.iter().map(|row| row[j]).collect()).collect()
}

/// Returns the rows of a matrix.
pub(super) fn rows_of(matrix: DMat4) -> Entries {
    matrix.transpose().to_cols_array_2d().map(Vec::from).to_vec()
}

/// Returns the rows of a matrix of the plane.
pub(super) fn planar_rows_of(matrix: DMat3) -> Entries {
    matrix.transpose().to_cols_array_2d().map(Vec::from).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(given: [f64; 3], multiples: Multiples) -> Vec<(usize, usize)> {
        let expected = vec![vec![1.0, 0.0, -4.0]];
        differing_places(&vec![given.to_vec()], &expected, multiples, EXACT)
    }

    #[test]
    fn entries_are_compared_up_to_allowed_multiples() {
        assert_eq!(places([1.0, 0.0, -4.0], Multiples::None), []);
        assert_eq!(places([1.0, 1e-13, -4.0 + 1e-9], Multiples::None), []);
        assert_eq!(places([1.0, 1e-6, -4.0], Multiples::None), [(0, 1)]);
        assert_eq!(places([2.0, 0.0, -8.0], Multiples::None), [(0, 0), (0, 2)]);
        assert_eq!(places([-2.0, 0.0, 8.0], Multiples::All), []);
        assert_eq!(places([2.0, 0.0, -8.0], Multiples::Positive), []);
        assert_eq!(places([-2.0, 0.0, 8.0], Multiples::Positive).len(), 3);
        assert_eq!(
            places([0.0, 0.0, 0.0], Multiples::All).len(),
            3,
            "the zero vector is not a point"
        );
        assert_eq!(places([3.0, 0.0, -8.0], Multiples::All).len(), 1);
    }

    #[test]
    fn transposing_swaps_rows_and_columns() {
        let wide = vec![vec![1.0, 2.0, 3.0], vec![4.0, 5.0, 6.0]];
        assert_eq!(transposed(&wide), [[1.0, 4.0], [2.0, 5.0], [3.0, 6.0]]);
        assert!(!same_shape(&wide, &transposed(&wide)));
    }
}
