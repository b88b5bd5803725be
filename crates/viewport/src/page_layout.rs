//! The layout of several viewports on one page: grids, margins, insets.
//!
//! ```text
//!   ┌─────────────────┐
//!   │ ┌─────┐ ┌─────┐ │   page.shrink(margin)?.split_grid(2, 2, gap)?
//!   │ │  0  │ │  1  │ │
//!   │ └─────┘ └─────┘ │   Cells are ordered by rows, from the minimum y.
//!   │ ┌─────┐ ┌─────┐ │
//!   │ │  2  │ │  3  │ │
//!   │ └─────┘ └─────┘ │
//!   └─────────────────┘
//! ```

use crate::error::{check_finite, check_positive};
use crate::{Rectangle, ViewportError};

impl Rectangle {
    /// Returns the rectangle reduced by a margin on all four sides; a negative margin enlarges it.
    ///
    /// # Errors
    /// Returns an error if the margin is not finite or if nothing remains.
    pub fn shrink(&self, margin: f64) -> Result<Self, ViewportError> {
        check_finite("margin", margin)?;
        let (width, height) = (self.width() - 2.0 * margin, self.height() - 2.0 * margin);
        Self::new(self.x() + margin, self.y() + margin, width, height)
    }

    /// Returns the cells of a grid with a gap between neighbors, row by row from the corner of
    /// minimum coordinates.
    ///
    /// If the gap is 0, neighbors share their borders exactly, so the cells cover the rectangle
    /// without seams.
    ///
    /// # Errors
    /// Returns an error if there are no columns or rows, if the gap is negative or not finite, or
    /// if the gaps leave no space for the cells.
    pub fn split_grid(
        &self,
        columns: u32,
        rows: u32,
        gap: f64,
    ) -> Result<impl Iterator<Item = Self> + use<>, ViewportError> {
        if check_finite("gap", gap)? != 0.0 {
            check_positive("gap", gap)?;
        }
        let across = AxisDivision::new("columns", columns, gap, self.x(), self.width())?;
        let along = AxisDivision::new("rows", rows, gap, self.y(), self.height())?;
        Ok((0..rows).flat_map(move |row| {
            let (y, height) = along.nth_part(row);
            (0..columns).map(move |column| {
                let (x, width) = across.nth_part(column);
                Self::new_unchecked(x, y, width, height)
            })
        }))
    }

    /// Returns a rectangle with a fraction of the width and height, positioned by the fractions
    /// `at` of the remaining space. For example, `inset_rectangle(0.25, [1.0, 1.0])` has a quarter
    /// of the width and height and is in the corner of maximum coordinates.
    ///
    /// # Errors
    /// Returns an error if a number is not finite or if the fraction is not greater than 0.
    pub fn inset_rectangle(&self, fraction: f64, at: [f64; 2]) -> Result<Self, ViewportError> {
        let (width, height) = (self.width() * fraction, self.height() * fraction);
        let x = self.x() + (self.width() - width) * at[0];
        Self::new(x, self.y() + (self.height() - height) * at[1], width, height)
    }

    /// Returns the rectangle with its borders rounded to whole pixels. Rectangles that share a
    /// border still share it afterward.
    ///
    /// # Errors
    /// Returns an error if the rounded rectangle is empty.
    pub fn snap_to_pixels(&self) -> Result<Self, ViewportError> {
        let [x0, y0] = [self.x(), self.y()].map(libm::round);
        let x1 = libm::round(self.x() + self.width());
        let y1 = libm::round(self.y() + self.height());
        Self::new(x0, y0, x1 - x0, y1 - y0)
    }
}

/// The division of a grid along one axis.
#[derive(Clone, Copy)]
struct AxisDivision {
    count: f64,
    gap: f64,
    start: f64,
    length: f64,
}

impl AxisDivision {
    fn new(
        name: &'static str,
        count: u32,
        gap: f64,
        start: f64,
        length: f64,
    ) -> Result<Self, ViewportError> {
        if count == 0 {
            return Err(ViewportError::TooFew { name, count: 0, least: 1 });
        }
        let count = f64::from(count);
        let room = length - gap * (count - 1.0);
        // The borders of a part thinner than this would round to the same number.
        let least = (start.abs() + length) * 1e-13;
        if room / count <= least {
            return Err(ViewportError::NotPositive { name: "size of a cell", value: room / count });
        }
        Ok(Self { count, gap, start, length })
    }

    /// Returns the start and length of part `i`. Computing borders instead of sizes makes neighbors
    /// agree on them.
    fn nth_part(self, i: u32) -> (f64, f64) {
        let border = |i: f64| self.start + (self.length + self.gap) * i / self.count;
        let (start, end) = (border(f64::from(i)), border(f64::from(i) + 1.0) - self.gap);
        (start, end - start)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    fn cells(page: Rectangle, columns: u32, rows: u32, gap: f64) -> Vec<Rectangle> {
        page.split_grid(columns, rows, gap).expect("there is space").collect()
    }

    #[test]
    fn cells_fill_the_page_with_gaps_between_them() {
        let page =
            Rectangle::from_size(130.0, 70.0).and_then(|page| page.shrink(10.0)).expect("room");
        let expected =
            [(10.0, 10.0), (50.0, 10.0), (90.0, 10.0), (10.0, 40.0), (50.0, 40.0), (90.0, 40.0)];
        for (cell, (x, y)) in cells(page, 3, 2, 10.0).into_iter().zip(expected) {
            assert_eq!(Rectangle::new(x, y, 30.0, 20.0), Ok(cell));
        }
    }

    #[test]
    fn snapped_cells_of_any_grid_cover_every_pixel_once() {
        let page = Rectangle::from_size(101.0, 67.0).expect("a page");
        let mut covered = [[0_u8; 101]; 67];
        for cell in cells(page, 7, 5, 0.0) {
            let cell = cell.snap_to_pixels().expect("wide enough");
            let (x, y) = (cell.x() as usize, cell.y() as usize);
            for row in &mut covered[y..y + cell.height() as usize] {
                row[x..x + cell.width() as usize].iter_mut().for_each(|pixel| *pixel += 1);
            }
        }
        assert!(covered.iter().flatten().all(|&times| times == 1));
    }

    #[test]
    fn pages_without_space_are_rejected() {
        let page = Rectangle::from_size(100.0, 100.0).expect("a page");
        assert!(page.split_grid(0, 1, 0.0).is_err());
        assert!(page.split_grid(3, 1, 50.0).is_err());
        assert!(page.split_grid(1, 1, f64::NAN).is_err() && page.split_grid(2, 1, -1.0).is_err());
        assert!(page.split_grid(1, u32::MAX, 0.0).is_ok());
        assert!(page.shrink(50.0).is_err());
        assert!(page.inset_rectangle(0.0, [1.0, 1.0]).is_err());
        assert_eq!(page.inset_rectangle(0.25, [1.0, 0.0]), Rectangle::new(75.0, 0.0, 25.0, 25.0));
        assert!(Rectangle::new(0.1, 0.1, 0.2, 0.2).and_then(|thin| thin.snap_to_pixels()).is_err());
    }
}
