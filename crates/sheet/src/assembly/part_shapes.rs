//! Shapes of parts along an axis: their extent within a column, and their heights above the cells
//! of a grid.
//!
//! ```text
//!        ┆ column ┆              a column is a box extended without limit along an axis;
//!   ┌────┆───┐    ┆              triangles are clipped to it, so the result is exact
//!   │    ┆   └────┆──┐ ◄ reach
//!   └────┆────────┆──┘
//! ```

use super::part::Part;
use glam::DVec3;
use model::ModelInstance;
use std::cell::Cell;

/// A box, as its minimum and maximum corners.
pub(super) type Corners = [DVec3; 2];

/// A part index, and how far the part has moved from its original position.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlacedPart {
    pub(super) part: usize,
    pub(super) by: DVec3,
}

/// The maximum number of stored triangles, at 72 bytes each. Boxes represent any further parts.
const MAX_TRIANGLES: usize = 4_000_000;

/// The maximum number of triangles compared with columns; after that, parts are compared as boxes.
const MAX_VISITS: u64 = 1 << 30;

/// The number of grid cells along each side of a column.
const CELLS: usize = 16;

/// The boxes and world-space triangles of parts.
#[derive(Debug)]
pub(crate) struct PartShapes {
    pub(super) boxes: Vec<Corners>,
    /// The triangles of each part; empty for parts with lines and for parts beyond
    /// [`MAX_TRIANGLES`], which count as solid boxes.
    triangles: Vec<Vec<[DVec3; 3]>>,
    visits_left: Cell<u64>,
}

impl PartShapes {
    /// Collects the shapes of parts.
    pub(crate) fn new(parts: &[Part], models: &[ModelInstance]) -> Self {
        let mut left = MAX_TRIANGLES;
        let triangles_of = |part: &Part| {
            let mut triangles = Vec::new();
            if !part.has_lines(models) {
                part.for_each_triangle(models, |corners| {
                    if corners.iter().all(|corner| corner.is_finite()) && triangles.len() <= left {
                        triangles.push(corners);
                    }
                });
            }
            if triangles.len() > left {
                return Vec::new();
            }
            left -= triangles.len();
            triangles
        };
        let triangles = parts.iter().map(triangles_of).collect();
        let corners = |part: &Part| [part.bounds.min().raw(), part.bounds.max().raw()];
        Self::from_raw(parts.iter().map(corners).collect(), triangles)
    }

    /// Creates shapes from boxes and triangles.
    pub(super) fn from_raw(boxes: Vec<Corners>, triangles: Vec<Vec<[DVec3; 3]>>) -> Self {
        Self { boxes, triangles, visits_left: Cell::new(MAX_VISITS) }
    }

    /// Deducts visits from the remaining budget, and returns `false` if the budget is too small.
    pub(super) fn take_visits(&self, count: usize) -> bool {
        let left = self.visits_left.get();
        self.visits_left.set(left.saturating_sub(count as u64));
        count as u64 <= left
    }

    /// Returns how far a placed part extends within a column in the direction of `sign`, or `None`
    /// if it is outside the column.
    pub(super) fn reach(&self, placed: PlacedPart, column: &Column, sign: f64) -> Option<f64> {
        let PlacedPart { part, by } = placed;
        let corners = self.boxes[part].map(|corner| corner + by);
        if !column.meets(corners) {
            return None;
        }
        let triangles = &self.triangles[part];
        if triangles.is_empty() || !self.take_visits(triangles.len()) {
            return Some(corners[usize::from(sign > 0.0)][column.axis] * sign);
        }
        let mut reach: Option<f64> = None;
        for triangle in triangles {
            let corners = triangle.map(|corner| corner + by);
            let most = corners.map(|corner| corner[column.axis] * sign).into_iter();
            let is_farther = most.fold(f64::NEG_INFINITY, f64::max) > reach.unwrap_or(-f64::MAX);
            if is_farther && let Some(own) = column.reach_of_triangle(corners, sign) {
                reach = Some(reach.map_or(own, |reach| reach.max(own)));
            }
        }
        reach
    }

    /// Returns the lowest and highest points of a part at the cell centers of a column.
    pub(super) fn heights(&self, part: usize, column: &Column) -> CellHeights {
        let mut heights = CellHeights::default();
        for triangle in &self.triangles[part] {
            heights.add_triangle(triangle, column);
        }
        if self.triangles[part].is_empty() {
            heights.add_box(self.boxes[part], column);
        }
        heights
    }

    /// Returns the number of triangles of a part.
    pub(super) fn triangle_count(&self, part: usize) -> usize {
        self.triangles[part].len()
    }
}

/// A column: the cross-section of a box, extended without limit along an axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Column {
    pub(super) axis: usize,
    across: [usize; 2],
    low: [f64; 2],
    high: [f64; 2],
}

impl Column {
    /// Creates the column of a box along an axis, with a margin around it.
    pub(super) fn new(corners: Corners, axis: usize, margin: f64) -> Self {
        let across = [(axis + 1) % 3, (axis + 2) % 3];
        let low = across.map(|axis| corners[0][axis] - margin);
        let high = across.map(|axis| corners[1][axis] + margin);
        Self { axis, across, low, high }
    }

    /// Whether a box is at least partly in the column.
    pub(super) fn meets(&self, other: Corners) -> bool {
        (0..2).all(|k| {
            let axis = self.across[k];
            other[0][axis] < self.high[k] && self.low[k] < other[1][axis]
        })
    }

    /// Returns how far a triangle extends within the column, after clipping it to one side at a
    /// time (Sutherland–Hodgman).
    fn reach_of_triangle(&self, corners: [DVec3; 3], sign: f64) -> Option<f64> {
        let outside = |k: usize| {
            let along = corners.map(|corner| corner[self.across[k]]);
            along.iter().all(|at| *at < self.low[k]) || along.iter().all(|at| *at > self.high[k])
        };
        if outside(0) || outside(1) {
            return None;
        }
        let mut polygon = corners.to_vec();
        for k in 0..2 {
            let axis = self.across[k];
            clip_polygon(&mut polygon, |corner| corner[axis] - self.low[k]);
            clip_polygon(&mut polygon, |corner| self.high[k] - corner[axis]);
        }
        polygon.into_iter().map(|corner| corner[self.axis] * sign).reduce(f64::max)
    }

    /// Returns the center of a cell.
    fn cell_center(&self, cell: [usize; 2]) -> [f64; 2] {
        [0, 1].map(|k| {
            let part = (cell[k] as f64 + 0.5) / CELLS as f64;
            self.low[k] + (self.high[k] - self.low[k]) * part
        })
    }

    /// Returns the cells whose centers may be between two coordinates across the column.
    fn cells_between(&self, k: usize, low: f64, high: f64) -> std::ops::Range<usize> {
        let size = (self.high[k] - self.low[k]) / CELLS as f64;
        if size <= 0.0 {
            return 0..CELLS;
        }
        let first = ((low - self.low[k]) / size - 0.5).floor().max(0.0) as usize;
        let last = ((high - self.low[k]) / size - 0.5).ceil();
        let end = if last < 0.0 { 0 } else { (last as usize).saturating_add(1) };
        first.min(CELLS)..end.min(CELLS)
    }
}

/// Clips a polygon to the half-space where a linear function is not negative.
fn clip_polygon(polygon: &mut Vec<DVec3>, inside: impl Fn(DVec3) -> f64) {
    let mut clipped = Vec::with_capacity(polygon.len() + 1);
    for (index, &corner) in polygon.iter().enumerate() {
        let last = polygon[(index + polygon.len() - 1) % polygon.len()];
        let (before, here) = (inside(last), inside(corner));
        if (before < 0.0) != (here < 0.0) {
            clipped.push(last.lerp(corner, before / (before - here)));
        }
        if here >= 0.0 {
            clipped.push(corner);
        }
    }
    *polygon = clipped;
}

/// The lowest and highest points at the center of each cell; the interval is empty outside the
/// part.
#[derive(Clone, Debug)]
pub(super) struct CellHeights(pub(super) [[f64; 2]; CELLS * CELLS]);

impl Default for CellHeights {
    fn default() -> Self {
        Self([[f64::INFINITY, f64::NEG_INFINITY]; CELLS * CELLS])
    }
}

impl CellHeights {
    /// Returns the number of occupied cells.
    pub(super) fn count(&self) -> usize {
        self.0.iter().filter(|[low, high]| low <= high).count()
    }

    /// Adds a height to a cell.
    fn add(&mut self, [column, row]: [usize; 2], height: f64) {
        let cell = &mut self.0[row * CELLS + column];
        *cell = [cell[0].min(height), cell[1].max(height)];
    }

    /// Adds the bottom and the top of a box.
    pub(super) fn add_box(&mut self, [low, high]: Corners, column: &Column) {
        let [across, up] = column.across;
        for row in column.cells_between(1, low[up], high[up]) {
            for at in column.cells_between(0, low[across], high[across]) {
                let [x, y] = column.cell_center([at, row]);
                if low[across] <= x && x <= high[across] && low[up] <= y && y <= high[up] {
                    self.add([at, row], low[column.axis]);
                    self.add([at, row], high[column.axis]);
                }
            }
        }
    }

    /// Adds the heights of a triangle at the cell centers. A triangle seen edge-on adds none.
    fn add_triangle(&mut self, corners: &[DVec3; 3], column: &Column) {
        let flat = corners.map(|corner| column.across.map(|axis| corner[axis]));
        let extent = |k: usize| {
            let along = flat.map(|corner| corner[k]);
            let low = along.into_iter().fold(f64::INFINITY, f64::min);
            column.cells_between(k, low, along.into_iter().fold(f64::NEG_INFINITY, f64::max))
        };
        let twice_area = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        let whole = twice_area(flat[0], flat[1], flat[2]);
        if whole == 0.0 {
            return;
        }
        let (columns, rows) = (extent(0), extent(1));
        for row in rows {
            for at in columns.clone() {
                let center = column.cell_center([at, row]);
                // Dividing by the signed area makes the weights positive inside for both
                // orientations.
                let weight =
                    |k: usize| twice_area(flat[(k + 1) % 3], flat[(k + 2) % 3], center) / whole;
                let weights = [weight(0), weight(1), weight(2)];
                if weights.iter().all(|weight| *weight >= 0.0) {
                    let height: f64 = (0..3).map(|k| weights[k] * corners[k][column.axis]).sum();
                    self.add([at, row], height);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reach_ends_at_the_surface_within_the_column() {
        // A ramp from height 0 at x = 0 to height 10 at x = 10.
        let ramp = [DVec3::ZERO, DVec3::new(10.0, 10.0, -5.0), DVec3::new(10.0, 10.0, 5.0)];
        let corners = [DVec3::new(0.0, 0.0, -5.0), DVec3::new(10.0, 10.0, 5.0)];
        let shapes = PartShapes::from_raw(vec![corners], vec![vec![ramp]]);
        let over = |low: f64, high: f64| {
            let corners = [DVec3::new(low, 50.0, -0.5), DVec3::new(high, 51.0, 0.5)];
            Column::new(corners, 1, 0.0)
        };
        let at = |by: DVec3| PlacedPart { part: 0, by };
        let up = shapes.reach(at(DVec3::ZERO), &over(3.0, 4.0), 1.0).expect("in the column");
        assert!((up - 4.0).abs() < 1e-12, "{up}");
        let down = shapes.reach(at(DVec3::Y), &over(3.0, 4.0), -1.0).expect("in the column");
        assert!((down + 4.0).abs() < 1e-12, "{down}");
        assert_eq!(shapes.reach(at(DVec3::ZERO), &over(11.0, 12.0), 1.0), None);
        let heights = shapes.heights(0, &over(3.0, 4.0));
        assert_eq!(heights.count(), CELLS * CELLS);
        let most = heights.0.iter().map(|cell| cell[1]).fold(0.0, f64::max);
        assert!((most - (3.0 + 15.5 / 16.0)).abs() < 1e-12, "{most}");
    }

    #[test]
    fn a_part_without_triangles_is_treated_as_its_box() {
        let corners = [DVec3::ZERO, DVec3::ONE];
        let shapes = PartShapes::from_raw(vec![corners], vec![Vec::new()]);
        let column = Column::new([DVec3::splat(0.5), DVec3::splat(2.0)], 2, 0.0);
        assert_eq!(shapes.reach(PlacedPart { part: 0, by: DVec3::Z }, &column, 1.0), Some(2.0));
        // The column extends from 0.5 to 2, so a third of its cells in each direction are over the
        // box.
        assert_eq!(shapes.heights(0, &column).count(), 25);
    }
}
