//! Matrices as plain arrays, by rows or by columns, as the names say.
//!
//! Points are columns to the right of the matrix: `v' = M v`. Row-major arrays read as a book
//! prints the matrix; OpenGL, Vulkan and glTF store column-major ones. A library with row vectors,
//! `v' = v M`, needs the transposed matrix: its row-major array is the column-major one here,
//! number for number.

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
    /// The map with the given rows, as a book prints them. The caller chooses the spaces.
    #[must_use]
    pub fn from_rows(rows: [[f64; 4]; 4]) -> Self {
        Self::tagged(DMat4::from_cols_array_2d(&transpose_columns(rows)))
    }

    /// The rows of the matrix.
    #[must_use]
    pub fn rows(self) -> [[f64; 4]; 4] {
        transpose_columns(self.raw.to_cols_array_2d())
    }

    /// The map from sixteen numbers, row by row.
    #[must_use]
    pub fn from_row_major(entries: [f64; 16]) -> Self {
        Self::tagged(DMat4::from_cols_array(&entries).transpose())
    }

    /// The sixteen numbers, row by row.
    #[must_use]
    pub fn to_row_major(self) -> [f64; 16] {
        flatten4(self.rows())
    }

    /// The map from sixteen numbers, column by column.
    #[must_use]
    pub fn from_column_major(entries: [f64; 16]) -> Self {
        Self::tagged(DMat4::from_cols_array(&entries))
    }

    /// The sixteen numbers, column by column; also the row-major array for row vectors.
    #[must_use]
    pub fn to_column_major(self) -> [f64; 16] {
        self.raw.to_cols_array()
    }

    /// The map from sixteen single-precision numbers, column by column, as GPUs store them.
    #[must_use]
    pub fn from_column_major_f32(entries: [f32; 16]) -> Self {
        Self::from_column_major(entries.map(f64::from))
    }

    /// The sixteen numbers in single precision, column by column.
    #[must_use]
    pub fn to_column_major_f32(self) -> [f32; 16] {
        self.raw.as_mat4().to_cols_array()
    }
}

impl<A: Space, B: Space> Affine<A, B> {
    /// The map with the given rows; `None` unless the last is exactly (0, 0, 0, 1).
    #[must_use]
    pub fn from_rows(rows: [[f64; 4]; 4]) -> Option<Self> {
        Self::from_matrix(DMat4::from_cols_array_2d(&transpose_columns(rows)))
    }

    /// The rows of the matrix; the last is (0, 0, 0, 1).
    #[must_use]
    pub fn rows(self) -> [[f64; 4]; 4] {
        transpose_columns(self.raw.to_cols_array_2d())
    }

    /// The map from sixteen numbers, row by row; `None` unless the last four are 0, 0, 0, 1.
    #[must_use]
    pub fn from_row_major(entries: [f64; 16]) -> Option<Self> {
        Self::from_matrix(DMat4::from_cols_array(&entries).transpose())
    }

    /// The sixteen numbers, row by row.
    #[must_use]
    pub fn to_row_major(self) -> [f64; 16] {
        flatten4(self.rows())
    }

    /// The map from sixteen numbers, column by column as in glTF; `None` unless the bottom row is
    /// 0, 0, 0, 1.
    #[must_use]
    pub fn from_column_major(entries: [f64; 16]) -> Option<Self> {
        Self::from_matrix(DMat4::from_cols_array(&entries))
    }

    /// The sixteen numbers, column by column; also the row-major array for row vectors.
    #[must_use]
    pub fn to_column_major(self) -> [f64; 16] {
        self.raw.to_cols_array()
    }
}

impl Homography {
    /// The map with the given rows, as a book prints them.
    #[must_use]
    pub fn from_rows(rows: [[f64; 3]; 3]) -> Self {
        Self::tagged(DMat3::from_cols_array_2d(&transpose_columns(rows)))
    }

    /// The rows of the matrix.
    #[must_use]
    pub fn rows(self) -> [[f64; 3]; 3] {
        transpose_columns(self.raw.to_cols_array_2d())
    }

    /// The map from nine numbers, row by row.
    #[must_use]
    pub fn from_row_major(entries: [f64; 9]) -> Self {
        Self::tagged(DMat3::from_cols_array(&entries).transpose())
    }

    /// The nine numbers, row by row.
    #[must_use]
    pub fn to_row_major(self) -> [f64; 9] {
        flatten3(self.rows())
    }

    /// The map from nine numbers, column by column.
    #[must_use]
    pub fn from_column_major(entries: [f64; 9]) -> Self {
        Self::tagged(DMat3::from_cols_array(&entries))
    }

    /// The nine numbers, column by column.
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
    fn c101_row_vectors_want_the_transposed_matrix() {
        let map = Projective::<Model, World>::from_row_major(core::array::from_fn(|i| i as f64));
        let v = [1.0, -2.0, 3.0, 0.5];
        let theirs = map.to_column_major(); // read by rows: the matrix of v' = v M
        let image: [f64; 4] =
            core::array::from_fn(|j| (0..4).map(|i| v[i] * theirs[4 * i + j]).sum());
        assert_eq!(<[f64; 4]>::from(map.transform_hpoint(v.into())), image);
    }

    #[test]
    fn an_affine_map_needs_its_last_row() {
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
