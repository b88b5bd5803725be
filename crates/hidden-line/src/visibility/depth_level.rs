//! A grid of depths on the screen: one level of a depth cover.

use glam::{DVec2, DVec3};

/// The depth tolerance: the depth of a point on a surface is at least the sampled depth minus this.
const ROUNDING: f64 = 1e-9;

/// One level of the pyramid.
#[derive(Clone, Debug)]
pub(super) struct Level {
    pub(super) size: [usize; 2],
    /// The depths, row by row, or 0 where no face covers the cell.
    pub(super) depths: Vec<f64>,
}

/// Depth as a linear function of the position on the screen, in cells. It is linear even in
/// perspective, where it is z / w.
pub(super) struct DepthPlane {
    slope: DVec2,
    at_origin: f64,
    least: f64,
}

impl DepthPlane {
    pub(super) fn through([a, b, c]: [DVec3; 3]) -> Option<Self> {
        let (p, q) = (b - a, c - a);
        let area = p.truncate().perp_dot(q.truncate());
        let slope = DVec2::new(p.z * q.y - q.z * p.y, q.z * p.x - p.z * q.x) / area;
        let at_origin = a.z - slope.dot(a.truncate());
        let least = a.z.min(b.z).min(c.z);
        (slope.is_finite() && at_origin.is_finite()).then_some(Self { slope, at_origin, least })
    }

    /// Returns the minimum depth of the plane in a cell, but no less than the minimum depth of the
    /// face.
    fn least_in_cell(&self, cell: DVec2) -> f64 {
        let corner = cell + DVec2::from(self.slope.to_array().map(|s| f64::from(s < 0.0)));
        (self.at_origin + self.slope.dot(corner)).max(self.least)
    }
}

impl Level {
    pub(super) fn empty(size: [usize; 2]) -> Self {
        Self { size, depths: vec![0.0; size[0] * size[1]] }
    }

    /// Returns the next coarser level, with half as many cells along each side, or `None` for a
    /// single cell. Cells beyond the border are ignored, because nothing is drawn there.
    pub(super) fn halved(&self) -> Option<Self> {
        let [width, height] = self.size;
        if width.max(height) <= 1 {
            return None;
        }
        let mut coarser = Self::empty(self.size.map(|side| side.div_ceil(2)));
        for row in 0..coarser.size[1] {
            for column in 0..coarser.size[0] {
                let mut least = f64::INFINITY;
                for y in 2 * row..(2 * row + 2).min(height) {
                    for x in 2 * column..(2 * column + 2).min(width) {
                        least = least.min(self.depths[y * width + x]);
                    }
                }
                coarser.depths[row * coarser.size[0] + column] = least;
            }
        }
        Some(coarser)
    }

    /// Raises the depths of the cells whose centers a triangle covers.
    pub(super) fn sample(&mut self, images: [DVec3; 3]) {
        let Some(plane) = DepthPlane::through(images) else { return };
        let corners = images.map(DVec3::truncate);
        let [low, high] =
            [f64::min, f64::max].map(|pick| pick(pick(corners[0].y, corners[1].y), corners[2].y));
        for row in centers([low, high], self.size[1]) {
            let y = row as f64 + 0.5;
            let columns = centers(span_at(corners, y), self.size[0]);
            let at_row = plane.at_origin + plane.slope.y * y;
            let first = columns.start;
            let cells = &mut self.depths[row * self.size[0]..][columns];
            for (column, depth) in (first..).zip(cells) {
                let sample = at_row + plane.slope.x * (column as f64 + 0.5);
                *depth = if sample > *depth { sample } else { *depth };
            }
        }
    }

    /// Returns the minimum depth of each cell and its neighbors, because surfaces are not sampled
    /// between the centers of cells.
    pub(super) fn eroded(&self) -> Self {
        let [width, height] = self.size;
        // The surface is not sampled between the outermost centers and the border of the screen.
        let inner = |count: usize| 1..count.saturating_sub(1);
        let mut rows = Self::empty(self.size);
        for row in 0..height {
            for column in inner(width) {
                let at = row * width + column;
                rows.depths[at] =
                    self.depths[at - 1..=at + 1].iter().copied().fold(f64::INFINITY, f64::min);
            }
        }
        let mut least = Self::empty(self.size);
        for row in inner(height) {
            for column in 0..width {
                let at = row * width + column;
                let near = [at - width, at, at + width].map(|at| rows.depths[at]);
                least.depths[at] = near.into_iter().fold(f64::INFINITY, f64::min) - ROUNDING;
            }
        }
        least
    }

    /// Raises the depths of the cells that a triangle, reduced by a margin, covers.
    pub(super) fn cover(&mut self, corners: [DVec2; 3], plane: &DepthPlane, margin: f64) {
        let [low, high] =
            [f64::min, f64::max].map(|pick| pick(pick(corners[0].y, corners[1].y), corners[2].y));
        let rows = whole_cells([low + margin, high - margin], self.size[1]);
        for row in rows {
            // A triangle is convex, so it covers the cells that are between its sides at both the
            // top and the bottom of a row.
            let [above, below] = [0, 1].map(|side| span_at(corners, (row + side) as f64));
            let span = [above[0].max(below[0]) + margin, above[1].min(below[1]) - margin];
            let columns = whole_cells(span, self.size[0]);
            let depths = &mut self.depths[row * self.size[0]..];
            for column in columns {
                let depth = plane.least_in_cell(DVec2::new(column as f64, row as f64));
                depths[column] = depths[column].max(depth);
            }
        }
    }
}

/// Returns the cells that an interval covers completely.
fn whole_cells([from, to]: [f64; 2], count: usize) -> std::ops::Range<usize> {
    // Casts saturate beyond the border and where there is no interval.
    let first = from.max(0.0).ceil();
    let last = to.min(count as f64).floor();
    if first < last { first as usize..last as usize } else { 0..0 }
}

/// Returns the cells whose centers are in an interval.
fn centers([from, to]: [f64; 2], count: usize) -> std::ops::Range<usize> {
    // Casts saturate beyond the border and where there is no interval.
    let first = (from - 0.5).max(0.0).ceil();
    let last = (to + 0.5).min(count as f64).floor();
    if first < last { first as usize..last as usize } else { 0..0 }
}

/// Returns the interval of x where a triangle meets a horizontal line. If they do not meet, the
/// interval is reversed.
fn span_at(corners: [DVec2; 3], y: f64) -> [f64; 2] {
    let mut span = [f64::INFINITY, f64::NEG_INFINITY];
    for k in 0..3 {
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        if (a.y > y) == (b.y > y) {
            continue;
        }
        let x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
        span = [span[0].min(x), span[1].max(x)];
    }
    span
}
