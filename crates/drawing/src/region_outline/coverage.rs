//! The area enclosed by sides, sampled at the centers of grid cells.
//!
//! ```text
//!     ╱╲             ┌─┐          a cell is part of the area if the winding number
//!    ╱  ╲      ─►  ┌─┘ └─┐        at its center is above zero
//!   ╱____╲         └─────┘
//! ```

use super::{Point, Side};

/// The side length of a cell in micrometers: a tenth of the width of a 0.5 mm pen.
const CELL: i64 = 50;
/// The maximum number of cells in a row or column. Drawings larger than 0.4 m use larger cells.
const MAX_CELLS: i64 = 8192;

/// A grid of square cells that covers the sides.
struct Grid {
    low: Point,
    cell: i64,
    columns: usize,
    rows: i64,
}

impl Grid {
    /// Creates the grid that covers the sides, with a margin of one cell.
    fn over(sides: &[Side]) -> Self {
        let ends = || sides.iter().flat_map(|(ends, _)| *ends);
        let bound = |axis: usize| {
            let low = ends().map(|end| end[axis]).min().unwrap_or(0);
            let high = ends().map(|end| end[axis]).max().unwrap_or(0);
            [low, high]
        };
        let [[left, right], [bottom, top]] = [bound(0), bound(1)];
        let cell = CELL.max((right - left).max(top - bottom) / MAX_CELLS + 1);
        Self {
            low: [left - cell, bottom - cell],
            cell,
            columns: ((right - left) / cell + 3) as usize,
            rows: (top - bottom) / cell + 3,
        }
    }

    /// Returns the y of a row's cell centers, doubled so that it is an integer.
    const fn doubled_center(&self, row: i64) -> i64 {
        2 * (self.low[1] + row * self.cell) + self.cell
    }

    /// Returns the lower left corner of a cell.
    const fn corner(&self, column: usize, row: i64) -> Point {
        [self.low[0] + column as i64 * self.cell, self.low[1] + row * self.cell]
    }

    /// Returns the first column whose cell center in a row is to the right of a side, or `None` if
    /// the side does not cross the height of the centers.
    fn column_after(&self, [a, b]: [Point; 2], row: i64) -> Option<usize> {
        let (low, high) = if a[1] < b[1] { (a, b) } else { (b, a) };
        let y = self.doubled_center(row);
        if y < 2 * low[1] || y >= 2 * high[1] {
            return None;
        }
        let (run, rise) = (i128::from(high[0] - low[0]), i128::from(high[1] - low[1]));
        // Twice the distance of the crossing from the center of the first column, times `rise`.
        let along = run * i128::from(y - 2 * low[1]);
        let first = 2 * self.low[0] + self.cell;
        let ahead = i128::from(2 * low[0] - first) * rise + along;
        let column = ahead.div_euclid(rise * i128::from(2 * self.cell)) + 1;
        Some(column.clamp(0, self.columns as i128) as usize)
    }
}

/// Returns the border of the area in steps of one cell. Each step has the area on its left, like
/// the border sides of the exact outline.
pub(super) fn traced_border(sides: &[Side]) -> Vec<[Point; 2]> {
    let grid = Grid::over(sides);
    let mut waiting: Vec<&Side> =
        sides.iter().filter(|(ends, _)| ends[0][1] != ends[1][1]).collect();
    // The lowest side is last, so it is popped first.
    waiting.sort_by_key(|(ends, _)| std::cmp::Reverse(ends[0][1].min(ends[1][1])));
    let (mut active, mut border) = (Vec::<&Side>::new(), Vec::new());
    let mut below = vec![false; grid.columns];
    for row in 0..grid.rows {
        let center = grid.doubled_center(row);
        while let Some(next) = waiting.pop_if(|(ends, _)| 2 * ends[0][1].min(ends[1][1]) <= center)
        {
            active.push(next);
        }
        active.retain(|(ends, _)| 2 * ends[0][1].max(ends[1][1]) > center);
        let covered = covered_cells(&grid, &active, row);
        add_steps(&grid, row, [&below, &covered], &mut border);
        below = covered;
    }
    border
}

/// Returns, for each cell of a row, whether the winding number at its center is positive.
fn covered_cells(grid: &Grid, active: &[&Side], row: i64) -> Vec<bool> {
    let mut changes = vec![0_i32; grid.columns + 1];
    for (ends, sign) in active {
        if let Some(column) = grid.column_after(*ends, row) {
            // There are `sign` more faces on the left of a rising side.
            changes[column] -= if ends[1][1] > ends[0][1] { *sign } else { -*sign };
        }
    }
    let mut winding = 0;
    let covered = changes[..grid.columns].iter().map(|change| {
        winding += change;
        winding > 0
    });
    covered.collect()
}

/// Adds the steps of the border along the left and lower sides of a row's cells.
fn add_steps(grid: &Grid, row: i64, [below, covered]: [&[bool]; 2], border: &mut Vec<[Point; 2]>) {
    for column in 0..grid.columns {
        let corner = grid.corner(column, row);
        let [right, above] = [grid.corner(column + 1, row), grid.corner(column, row + 1)];
        let left = column > 0 && covered[column - 1];
        match (left, covered[column]) {
            (true, false) => border.push([corner, above]),
            (false, true) => border.push([above, corner]),
            _ => {}
        }
        match (below[column], covered[column]) {
            (true, false) => border.push([right, corner]),
            (false, true) => border.push([corner, right]),
            _ => {}
        }
    }
}
