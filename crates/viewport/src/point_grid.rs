//! The map from grid indices to the square [−1, 1]² (WV-4), for the points of a height field.
//!
//! ```text
//!   columns ► z          4 by 3 points: the last index is count − 1,
//!   ·───·───·  x = −1    so indices are divided by count − 1
//!   ·───·───·
//!   ·───·───·
//!   ·───·───·  x = +1
//!   rows ▼
//! ```

use crate::ViewportError;

/// A grid of points over [−1, 1]².
///
/// ```
/// use viewport::PointGrid;
/// let grid = PointGrid::new(5, 3)?;
/// assert_eq!(grid.xz(0, 0), Some([-1.0, -1.0]));
/// assert_eq!(grid.xz(4, 2), Some([1.0, 1.0]));
/// assert_eq!(grid.xz(5, 0), None); // the last row has index 4
/// # Ok::<(), viewport::ViewportError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct PointGrid {
    rows: usize,
    columns: usize,
}

impl PointGrid {
    /// Creates a grid with this many rows and columns.
    ///
    /// # Errors
    /// Returns an error if there are fewer than two rows or columns.
    pub fn new(rows: usize, columns: usize) -> Result<Self, ViewportError> {
        const LEAST: usize = 2;
        for (name, count) in [("rows", rows), ("columns", columns)] {
            if count < LEAST {
                return Err(ViewportError::TooFew { name, count, least: LEAST });
            }
        }
        Ok(Self { rows, columns })
    }

    /// Returns the number of rows, at least 2.
    #[must_use]
    pub const fn rows(&self) -> usize {
        self.rows
    }

    /// Returns the number of columns, at least 2.
    #[must_use]
    pub const fn columns(&self) -> usize {
        self.columns
    }

    /// Returns the point at a row and a column: x = 2·row/(rows − 1) − 1, z = 2·column/(columns −
    /// 1) − 1. Returns `None` beyond the last index.
    #[must_use]
    pub fn xz(&self, row: usize, column: usize) -> Option<[f64; 2]> {
        let inside = row < self.rows && column < self.columns;
        inside.then(|| [grid_coordinate(row, self.rows), grid_coordinate(column, self.columns)])
    }

    /// Returns all points, row by row.
    pub fn points(&self) -> impl Iterator<Item = [f64; 2]> + use<> {
        let Self { rows, columns } = *self;
        (0..rows).flat_map(move |row| {
            (0..columns)
                .map(move |column| [grid_coordinate(row, rows), grid_coordinate(column, columns)])
        })
    }
}

fn grid_coordinate(index: usize, count: usize) -> f64 {
    2.0 * index as f64 / (count - 1) as f64 - 1.0
}
