//! Conversions between maps and plain arrays, by rows or by columns as the method names state.
//!
//! Points are columns to the right of the matrix: `v' = M v`. Row-major arrays read like the
//! printed matrix; OpenGL, Vulkan and glTF store column-major arrays. A library with row vectors,
//! `v' = v M`, needs the transposed matrix. The row-major array of that matrix is identical to the
//! column-major array here.

use crate::{Affine, Homography, Projective, Space};
use glam::{DMat3, DMat4};

fn transpose_columns<const N: usize>(columns: [[f64; N]; N]) -> [[f64; N]; N] {
    core::array::from_fn(|i| core::array::from_fn(|j| columns[j][i]))
}

fn flatten4(lines: [[f64; 4]; 4]) -> [f64; 16] {
    core::array::from_fn(|i| lines[i / 4][i % 4])
}

fn flatten3(lines: [[f64; 3]; 3]) -> [f64; 9] {
    core::array::from_fn(|i| lines[i / 3][i % 3])
}

impl<A: Space, B: Space> Projective<A, B> {
    /// Creates a map from its rows, as printed in textbooks. The caller chooses the spaces.
    #[must_use]
    pub fn from_rows(rows: [[f64; 4]; 4]) -> Self {
        Self::tagged(DMat4::from_cols_array_2d(&transpose_columns(rows)))
    }

    /// Returns the rows of the matrix.
    #[must_use]
    pub fn rows(self) -> [[f64; 4]; 4] {
        transpose_columns(self.raw.to_cols_array_2d())
    }

    /// Creates a map from sixteen numbers, row by row.
    #[must_use]
    pub fn from_row_major(entries: [f64; 16]) -> Self {
        Self::tagged(DMat4::from_cols_array(&entries).transpose())
    }

    /// Returns the sixteen numbers, row by row.
    #[must_use]
    pub fn to_row_major(self) -> [f64; 16] {
        flatten4(self.rows())
    }

    /// Creates a map from sixteen numbers, column by column.
    #[must_use]
    pub fn from_column_major(entries: [f64; 16]) -> Self {
        Self::tagged(DMat4::from_cols_array(&entries))
    }

    /// Returns the sixteen numbers, column by column (row by row for row vectors).
    #[must_use]
    pub fn to_column_major(self) -> [f64; 16] {
        self.raw.to_cols_array()
    }

    /// Creates a map from sixteen single-precision numbers, column by column, as GPUs store them.
    #[must_use]
    pub fn from_column_major_f32(entries: [f32; 16]) -> Self {
        Self::from_column_major(entries.map(f64::from))
    }

    /// Returns the sixteen numbers in single precision, column by column.
    #[must_use]
    pub fn to_column_major_f32(self) -> [f32; 16] {
        self.raw.as_mat4().to_cols_array()
    }
}

impl<A: Space, B: Space> Affine<A, B> {
    /// Creates a map from its rows, or returns `None` if the last row is not exactly (0, 0, 0, 1).
    #[must_use]
    pub fn from_rows(rows: [[f64; 4]; 4]) -> Option<Self> {
        Self::from_matrix(DMat4::from_cols_array_2d(&transpose_columns(rows)))
    }

    /// Returns the rows of the matrix; the last is (0, 0, 0, 1).
    #[must_use]
    pub fn rows(self) -> [[f64; 4]; 4] {
        transpose_columns(self.raw.to_cols_array_2d())
    }

    /// Creates a map from sixteen numbers, row by row, or returns `None` if the last four are not
    /// 0, 0, 0, 1.
    #[must_use]
    pub fn from_row_major(entries: [f64; 16]) -> Option<Self> {
        Self::from_matrix(DMat4::from_cols_array(&entries).transpose())
    }

    /// Returns the sixteen numbers, row by row.
    #[must_use]
    pub fn to_row_major(self) -> [f64; 16] {
        flatten4(self.rows())
    }

    /// Creates a map from sixteen numbers, column by column as in glTF, or returns `None` if the
    /// bottom row is not 0, 0, 0, 1.
    #[must_use]
    pub fn from_column_major(entries: [f64; 16]) -> Option<Self> {
        Self::from_matrix(DMat4::from_cols_array(&entries))
    }

    /// Returns the sixteen numbers, column by column (row by row for row vectors).
    #[must_use]
    pub fn to_column_major(self) -> [f64; 16] {
        self.raw.to_cols_array()
    }
}

impl Homography {
    /// Creates a map from its rows, as printed in textbooks.
    #[must_use]
    pub fn from_rows(rows: [[f64; 3]; 3]) -> Self {
        Self::tagged(DMat3::from_cols_array_2d(&transpose_columns(rows)))
    }

    /// Returns the rows of the matrix.
    #[must_use]
    pub fn rows(self) -> [[f64; 3]; 3] {
        transpose_columns(self.raw.to_cols_array_2d())
    }

    /// Creates a map from nine numbers, row by row.
    #[must_use]
    pub fn from_row_major(entries: [f64; 9]) -> Self {
        Self::tagged(DMat3::from_cols_array(&entries).transpose())
    }

    /// Returns the nine numbers, row by row.
    #[must_use]
    pub fn to_row_major(self) -> [f64; 9] {
        flatten3(self.rows())
    }

    /// Creates a map from nine numbers, column by column.
    #[must_use]
    pub fn from_column_major(entries: [f64; 9]) -> Self {
        Self::tagged(DMat3::from_cols_array(&entries))
    }

    /// Returns the nine numbers, column by column.
    #[must_use]
    pub fn to_column_major(self) -> [f64; 9] {
        self.raw.to_cols_array()
    }
}

#[cfg(test)]
mod tests {
    use crate::{Affine, Homography, Model, Projective, World};

    #[test]
    fn rows_and_columns_are_not_mixed_up() {
        let counted: [f64; 16] = core::array::from_fn(|i| i as f64);
        let map = Projective::<World, World>::from_row_major(counted);
        assert_eq!(map.rows()[1], [4.0, 5.0, 6.0, 7.0]);
        assert_eq!(map.to_column_major()[..4], [0.0, 4.0, 8.0, 12.0]);
        assert_eq!(map.to_row_major(), counted);
        assert_eq!(Projective::from_column_major(map.to_column_major()), map);
        assert_eq!(Projective::from_rows(map.rows()), map);

        let nine: [f64; 9] = core::array::from_fn(|i| i as f64);
        let map = Homography::from_row_major(nine);
        assert_eq!(map.rows()[2], [6.0, 7.0, 8.0]);
        assert_eq!((map.to_row_major(), map.to_column_major()[1]), (nine, 3.0));
        assert_eq!(Homography::from_column_major(map.to_column_major()), map);
    }

    #[test]
    fn c101_row_vectors_use_the_transposed_matrix() {
        let map = Projective::<Model, World>::from_row_major(core::array::from_fn(|i| i as f64));
        let v = [1.0, -2.0, 3.0, 0.5];
        let theirs = map.to_column_major(); // read by rows, this is the matrix of v' = v M
        let image: [f64; 4] =
            core::array::from_fn(|j| (0..4).map(|i| v[i] * theirs[4 * i + j]).sum());
        assert_eq!(<[f64; 4]>::from(map.transform_hpoint(v.into())), image);
    }

    #[test]
    fn affine_maps_require_the_affine_last_row() {
        let rows = [[1.0, 0.0, 0.0, 5.0], [0.0, 1.0, 0.0, 6.0], [0.0, 0.0, 1.0, 7.0]];
        let with =
            |last: [f64; 4]| Affine::<Model, World>::from_rows([rows[0], rows[1], rows[2], last]);
        let map = with([0.0, 0.0, 0.0, 1.0]).expect("affine");
        assert_eq!(Affine::from_row_major(map.to_row_major()), Some(map));
        assert_eq!(Affine::from_column_major(map.to_column_major()), Some(map));
        assert_eq!(with([0.0, 0.0, -1.0, 0.0]), None);
        assert_eq!(Affine::<Model, World>::from_row_major(map.to_column_major()), None);
    }
}
