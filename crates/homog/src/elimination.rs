//! Gauss–Jordan elimination of a small square matrix: its inverse and its rank.
//!
//! Rows and columns are first scaled exactly, by powers of two, so that the largest entry of each
//! is near 1. The rank then does not depend on units, even if they differ wildly (a near plane at
//! 10⁻¹² and a far plane at 10⁶): only a pivot at the level of rounding noise makes a matrix
//! singular.

/// Pivots of the scaled matrix up to this size count as rounding noise.
const ROUNDING_NOISE: f64 = 4.0 * f64::EPSILON;

/// The result of elimination.
pub(crate) struct Elimination<const N: usize> {
    /// The number of pivots above the noise level.
    pub(crate) rank: usize,
    /// The inverse, by rows; `None` if the rank is not full or an entry is not finite.
    pub(crate) inverse: Option<[[f64; N]; N]>,
}

/// Runs Gauss–Jordan elimination with complete pivoting on a matrix stored by rows.
pub(crate) fn eliminate_full_pivoting<const N: usize>(rows: [[f64; N]; N]) -> Elimination<N> {
    if !rows.iter().flatten().all(|entry| entry.is_finite()) {
        return Elimination { rank: 0, inverse: None };
    }
    let (mut left, row_exponents, column_exponents) = equilibrate(rows);
    let mut right = identity_rows::<N>();
    let mut column_of = [0; N];
    for step in 0..N {
        let (row, column) = find_pivot(&left, step, &column_of);
        if left[row][column].abs() <= ROUNDING_NOISE {
            return Elimination { rank: step, inverse: None };
        }
        left.swap(step, row);
        right.swap(step, row);
        column_of[step] = column;
        clear_column(&mut left, &mut right, step, column);
    }
    Elimination {
        rank: N,
        inverse: undo_equilibration(right, column_of, row_exponents, column_exponents),
    }
}

fn identity_rows<const N: usize>() -> [[f64; N]; N] {
    core::array::from_fn(|i| core::array::from_fn(|j| f64::from(u8::from(i == j))))
}

/// Returns the matrix with scaled rows and columns, and the binary exponents of the scale factors.
fn equilibrate<const N: usize>(rows: [[f64; N]; N]) -> ([[f64; N]; N], [i32; N], [i32; N]) {
    let mut a = rows;
    let row_exponents = core::array::from_fn(|i| {
        let exponent = -exponent_of(a[i].iter().copied());
        a[i] = a[i].map(|entry| libm::scalbn(entry, exponent));
        exponent
    });
    let column_exponents = core::array::from_fn(|j| {
        let exponent = -exponent_of(a.iter().map(|row| row[j]));
        a.iter_mut().for_each(|row| row[j] = libm::scalbn(row[j], exponent));
        exponent
    });
    (a, row_exponents, column_exponents)
}

/// Returns the binary exponent of the largest entry, or 0 if all are 0.
fn exponent_of(entries: impl Iterator<Item = f64>) -> i32 {
    let largest = entries.fold(0.0, |largest: f64, entry| largest.max(entry.abs()));
    if largest == 0.0 { 0 } else { libm::ilogb(largest) }
}

/// Returns the row and column of the largest entry whose row and column have no pivot yet.
fn find_pivot<const N: usize>(
    a: &[[f64; N]; N],
    step: usize,
    column_of: &[usize; N],
) -> (usize, usize) {
    let mut best = (step, 0);
    let mut largest = -1.0;
    for (i, row) in a.iter().enumerate().skip(step) {
        for (j, entry) in row.iter().enumerate() {
            if entry.abs() > largest && !column_of[..step].contains(&j) {
                (best, largest) = ((i, j), entry.abs());
            }
        }
    }
    best
}

/// Divides the pivot row by the pivot and subtracts multiples of it from all other rows.
fn clear_column<const N: usize>(
    left: &mut [[f64; N]; N],
    right: &mut [[f64; N]; N],
    step: usize,
    column: usize,
) {
    let by = left[step][column];
    left[step] = left[step].map(|entry| entry / by);
    right[step] = right[step].map(|entry| entry / by);
    let (pivot_left, pivot_right) = (left[step], right[step]);
    for i in (0..N).filter(|&i| i != step) {
        let factor = left[i][column];
        for j in 0..N {
            left[i][j] -= factor * pivot_left[j];
            right[i][j] -= factor * pivot_right[j];
        }
    }
}

/// Moves the rows of the scaled matrix's inverse to their positions and undoes the scaling: the
/// inverse of R A C is C⁻¹ A⁻¹ R⁻¹, hence A⁻¹ = C (R A C)⁻¹ R.
fn undo_equilibration<const N: usize>(
    right: [[f64; N]; N],
    column_of: [usize; N],
    row_exponents: [i32; N],
    column_exponents: [i32; N],
) -> Option<[[f64; N]; N]> {
    let mut inverse = [[0.0; N]; N];
    for (row, &column) in right.iter().zip(&column_of) {
        inverse[column] = core::array::from_fn(|j| {
            libm::scalbn(row[j], column_exponents[column] + row_exponents[j])
        });
    }
    inverse.iter().flatten().all(|entry| entry.is_finite()).then_some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matrices_are_singular_up_to_noise_but_not_for_small_units() {
        let thirds = [[0.1, 0.2], [0.3, 0.6]];
        let flat = eliminate_full_pivoting(thirds);
        assert_eq!((flat.rank, flat.inverse), (1, None), "0.1 · 0.6 − 0.2 · 0.3 is 1e-17, not 0");
        let small = eliminate_full_pivoting([[1e-200, 0.0], [0.0, 1e200]]);
        assert_eq!((small.rank, small.inverse), (2, Some([[1e200, 0.0], [0.0, 1e-200]])));
        assert_eq!(eliminate_full_pivoting([[0.0; 3]; 3]).rank, 0);
        assert!(
            eliminate_full_pivoting([[1e-320, 0.0], [0.0, 1.0]]).inverse.is_none(),
            "1e320 is out of range"
        );
    }

    #[test]
    fn pivots_are_found_in_any_row_and_column() {
        let a = [[0.0, 2.0, 0.0], [0.0, 0.0, 4.0], [8.0, 0.0, 0.0]];
        let want = [[0.0, 0.0, 0.125], [0.5, 0.0, 0.0], [0.0, 0.25, 0.0]];
        assert_eq!(eliminate_full_pivoting(a).inverse, Some(want));
    }
}
