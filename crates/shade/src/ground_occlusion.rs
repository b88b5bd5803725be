//! Occlusion of horizontal ground by the models on it: a contact shadow in light from all
//! directions.
//!
//! ```text
//!          ▂▄▆▆▄▂  slab of a cell: from the lowest to the highest surface over it
//!   ╲   ▐▐██████▌▌
//!    ╲  m = h² / (h² + r²): the cosine-weighted fraction of the sky of one azimuth
//!     ╲    ▔▔▔▔     that is lower than height h at distance r
//!  ────●─────┴──────── ground
//! ```
//!
//! Visibility cells are twice as wide as slab cells. From the center of each visibility cell, rays
//! run along 16 azimuths over the slabs. The directions that slabs hide are marked in a bitmask of
//! 64 sectors of equal cosine-weighted solid angle (after Therrien, Levesque and Gilet, *Screen
//! space indirect lighting with visibility bitmask*, 2023). Neighbors in a block of 2 × 2 have
//! interleaved azimuths, and their mean removes the pattern again (interleaved sampling, Keller and
//! Heidrich 2001). The space between the lowest and the highest surface of a cell counts as solid.

use super::approximations::floor_to_int;
use raster::for_each_parallel;

/// The space that models occupy over a ground cell, as heights above the ground.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HeightSlab {
    /// The height of the lowest surface.
    pub low: f32,
    /// The height of the highest surface; not above `low` if the cell is empty.
    pub high: f32,
}

impl HeightSlab {
    /// An empty cell.
    pub const EMPTY: Self = Self { low: 0.0, high: 0.0 };
}

/// A grid of square cells on horizontal ground, with rows along x that follow each other along z.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct GroundGrid {
    /// The minimum x and z in the world.
    pub corner: [f32; 2],
    /// The side length of a cell.
    pub cell: f32,
    /// The number of columns and rows.
    pub size: [usize; 2],
    /// The width of the margin in which the shadow fades out to avoid an edge.
    pub fade: f32,
}

/// The fraction of cosine-weighted light from the upper hemisphere that reaches horizontal ground.
#[derive(Clone, Debug)]
pub struct GroundOcclusion {
    /// The visibility grid, whose cells have twice the side length.
    grid: GroundGrid,
    /// The visibility, 0 to 1, at the center of each cell.
    visibility: Vec<f32>,
}

/// The number of azimuths per cell.
const AZIMUTHS: usize = 16;
/// The side length, in cells, of a block of cells with different azimuths.
const BLOCK: usize = 2;
/// The number of ground cells along the side of a visibility cell. Visibility cells can be larger
/// because visibility is smoother than the occluders.
const COARSENESS: usize = 2;
/// The number of sectors per azimuth.
const SECTORS: f32 = 64.0;
/// The length of a step as a fraction of its distance, about the width of an azimuth's wedge.
const STEP_GROWTH: f32 = 0.08;

impl GroundOcclusion {
    /// Computes the visibility on a grid from the slab of each cell.
    ///
    /// Uses up to `threads` threads, with the same result for any number.
    #[must_use]
    pub fn compute(grid: GroundGrid, slabs: &[HeightSlab], threads: usize) -> Self {
        let rays = RayCaster::new(grid, slabs);
        let grid = grid.coarsen();
        let columns = grid.size[0];
        let mut noisy = vec![1.0; columns * grid.size[1]];
        for_each_parallel(threads, noisy.chunks_mut(columns.max(1)).enumerate(), |(row, cells)| {
            for (column, cell) in cells.iter_mut().enumerate() {
                *cell = rays.visibility_at(column, row);
            }
        });
        let along_x = average_blocks(&noisy, grid.size, [1, 0]);
        let mut visibility = average_blocks(&along_x, grid.size, [0, 1]);
        for (index, visible) in visibility.iter_mut().enumerate() {
            let weight = grid.fade_weight([index % columns, index / columns]);
            *visible = 1.0 - (1.0 - *visible) * weight;
        }
        Self { grid, visibility }
    }

    /// Returns the visibility at a position in the world, interpolated bilinearly between cells, or
    /// 1 outside the grid.
    #[inline(always)]
    pub(super) fn visibility_at(&self, [x, _, z]: [f32; 3]) -> f32 {
        let GroundGrid { corner, cell, .. } = self.grid;
        let (x, z) = ((x - corner[0]) / cell - 0.5, (z - corner[1]) / cell - 0.5);
        let [left, top] = [x, z].map(floor_to_int);
        let (fx, fz) = (x - left as f32, z - top as f32);
        let mut sum = 0.0;
        for (column, column_weight) in [(left, 1.0 - fx), (left + 1, fx)] {
            for (row, row_weight) in [(top, 1.0 - fz), (top + 1, fz)] {
                sum += self.cell_at(column, row) * (column_weight * row_weight);
            }
        }
        sum
    }

    /// Returns the visibility of a cell, or 1 outside the grid.
    #[inline(always)]
    fn cell_at(&self, column: i32, row: i32) -> f32 {
        let [columns, rows] = self.grid.size;
        // Negative indices wrap to values far beyond the last.
        let (column, row) = (column as usize, row as usize);
        let is_inside = column < columns && row < rows;
        if is_inside { self.visibility[row * columns + column] } else { 1.0 }
    }
}

impl GroundGrid {
    /// Returns the coarser grid for the visibility.
    fn coarsen(self) -> Self {
        let size = self.size.map(|count| count.div_ceil(COARSENESS));
        Self { cell: self.cell * COARSENESS as f32, size, ..self }
    }

    /// Returns a weight that rises smoothly from 0 at the border of the grid to 1 at the inner edge
    /// of the margin.
    fn fade_weight(&self, index: [usize; 2]) -> f32 {
        let mut weight = 1.0;
        for axis in 0..2 {
            let (index, count) = (index[axis] as f32 + 0.5, self.size[axis] as f32);
            let distance = index.min(count - index) * self.cell;
            let part = (distance / self.fade).clamp(0.0, 1.0);
            weight *= part * part * (3.0 - 2.0 * part);
        }
        weight
    }
}

/// Casts the rays from the cells of a grid over its slabs.
struct RayCaster<'a> {
    grid: GroundGrid,
    slabs: &'a [HeightSlab],
    /// The first and last occupied columns and rows.
    occupied: [[f32; 2]; 2],
    /// The azimuths of all cells of a block, as unit vectors.
    azimuths: Vec<[f32; 2]>,
}

impl<'a> RayCaster<'a> {
    fn new(grid: GroundGrid, slabs: &'a [HeightSlab]) -> Self {
        let (mut least, mut most) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2]);
        for (index, _) in slabs.iter().enumerate().filter(|(_, slab)| slab.high > slab.low) {
            let cell = [(index % grid.size[0]) as f32, (index / grid.size[0]) as f32];
            for axis in 0..2 {
                least[axis] = least[axis].min(cell[axis] - 0.5);
                most[axis] = most[axis].max(cell[axis] + 0.5);
            }
        }
        let count = AZIMUTHS * BLOCK * BLOCK;
        let azimuths = (0..count).map(|index| {
            let angle = std::f64::consts::TAU * (index as f64 + 0.5) / count as f64;
            [libm::cos(angle) as f32, libm::sin(angle) as f32]
        });
        Self { grid, slabs, occupied: [least, most], azimuths: azimuths.collect() }
    }

    /// Computes the visibility from the center of a visibility cell, along the azimuths for its
    /// position in the block.
    fn visibility_at(&self, column: usize, row: usize) -> f32 {
        // Neighbors are far apart in this order, as in ordered dithering.
        const ORDER: [usize; BLOCK * BLOCK] = [0, 2, 3, 1];
        let place = ORDER[row % BLOCK * BLOCK + column % BLOCK];
        // The center, in slab cells from the center of the first cell.
        let from = [column, row]
            .map(|index| (index * COARSENESS) as f32 + 0.5 * (COARSENESS as f32 - 1.0));
        let mut hidden = 0;
        for azimuth in 0..AZIMUTHS {
            let along = self.azimuths[azimuth * BLOCK * BLOCK + place];
            hidden += self.hidden_sectors(from, along).count_ones();
        }
        1.0 - hidden as f32 / (AZIMUTHS as f32 * SECTORS)
    }

    /// Computes the sectors that slabs hide along an azimuth, with the lowest sector in the lowest
    /// bit.
    fn hidden_sectors(&self, from: [f32; 2], along: [f32; 2]) -> u64 {
        let Some([start, end]) = self.clip_ray(from, along) else { return 0 };
        let (mut hidden, mut near) = (0, start);
        while near < end {
            let step = (STEP_GROWTH * near).max(1.0);
            // Steps start at the border of the ray's first cell.
            let far = if near == 0.0 { 0.5 } else { near + step };
            let middle = if near == 0.0 { 0.0 } else { near + 0.5 * step };
            let [column, row] =
                [0, 1].map(|axis: usize| floor_to_int(from[axis] + along[axis] * middle + 0.5));
            hidden |= self.slab_sectors(column, row, [near, far]);
            near = far;
        }
        hidden
    }

    /// Computes the range of distances, in cells, in which a ray passes over occupied cells.
    fn clip_ray(&self, from: [f32; 2], along: [f32; 2]) -> Option<[f32; 2]> {
        let [least, most] = self.occupied;
        let (mut start, mut end) = (0.0_f32, f32::INFINITY);
        for axis in 0..2 {
            let (a, b) =
                ((least[axis] - from[axis]) / along[axis], (most[axis] - from[axis]) / along[axis]);
            (start, end) = (start.max(a.min(b)), end.min(a.max(b)));
        }
        (start < end).then_some([start, end])
    }

    /// Computes the sectors hidden by the slab of a cell between two distances.
    fn slab_sectors(&self, column: i32, row: i32, [near, far]: [f32; 2]) -> u64 {
        let [columns, rows] = self.grid.size;
        let (column, row) = (column as usize, row as usize);
        // Negative indices wrap to values far beyond the last.
        if column >= columns || row >= rows {
            return 0;
        }
        let HeightSlab { low, high } = self.slabs[row * columns + column];
        if high <= low {
            return 0;
        }
        // From the far end of the lower face to the near end of the upper face.
        let sector = |height: f32, distance: f32| {
            let distance = distance * self.grid.cell;
            let measure = height * height / (height * height + distance * distance);
            (measure * SECTORS + 0.5) as u32
        };
        sectors_below(sector(high, near)) & !sectors_below(sector(low, far))
    }
}

/// Returns a mask of the lowest sectors, up to 64.
const fn sectors_below(count: u32) -> u64 {
    if count >= 64 { u64::MAX } else { (1 << count) - 1 }
}

/// Averages over a block along one axis: the mean of three cells, with half weight for the outer
/// cells.
fn average_blocks(values: &[f32], [columns, rows]: [usize; 2], step: [usize; 2]) -> Vec<f32> {
    let at = |column: usize, row: usize| values[row * columns + column];
    let mean = |index: usize| {
        let (column, row) = (index % columns, index / columns);
        let before = at(column.saturating_sub(step[0]), row.saturating_sub(step[1]));
        let after = at((column + step[0]).min(columns - 1), (row + step[1]).min(rows - 1));
        0.5 * at(column, row) + 0.25 * (before + after)
    };
    (0..values.len()).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the occlusion on 192 × 192 cells around the origin, with slabs given by `slab`.
    fn grid_of(half: f32, slab: impl Fn(f32, f32) -> HeightSlab) -> GroundOcclusion {
        let cell = half / 96.0;
        let grid = GroundGrid { corner: [-half; 2], cell, size: [192; 2], fade: 0.2 * half };
        let center = |index: usize| (index as f32 + 0.5) * cell - half;
        let slabs: Vec<_> =
            (0..192 * 192).map(|index| slab(center(index % 192), center(index / 192))).collect();
        let one = GroundOcclusion::compute(grid, &slabs, 1);
        let three = GroundOcclusion::compute(grid, &slabs, 3);
        assert_eq!(one.visibility, three.visibility, "the number of threads makes no difference");
        one
    }

    #[test]
    fn a_disc_overhead_hides_its_form_factor() {
        for height in [0.2_f32, 0.5, 1.0, 2.0] {
            let disc = grid_of(4.0, |x, z| {
                let is_over = x * x + z * z < 1.0;
                if is_over {
                    HeightSlab { low: height, high: height + 0.01 }
                } else {
                    HeightSlab::EMPTY
                }
            });
            for distance in [0.0_f32, 0.4, 0.8, 1.3, 2.0] {
                // From a horizontal patch to a parallel disc of radius 1 (Howell, B-13).
                let (h2, a2) = (height * height, distance * distance);
                let z = 1.0 + h2 + a2;
                let expected = 1.0 - 0.5 * (1.0 - (z - 2.0) / (z * z - 4.0 * a2).sqrt());
                let actual = disc.visibility_at([distance, 0.0, 0.0]);
                assert!(
                    (actual - expected).abs() < 0.03,
                    "{height} {distance}: {actual} {expected}"
                );
            }
        }
    }

    #[test]
    fn a_ball_hides_its_form_factor() {
        let (radius, height) = (0.5_f32, 0.8_f32);
        let ball = grid_of(3.0, |x, z| {
            let square = radius * radius - x * x - z * z;
            if square <= 0.0 {
                return HeightSlab::EMPTY;
            }
            HeightSlab { low: height - square.sqrt(), high: height + square.sqrt() }
        });
        for distance in [0.0_f32, 0.3, 0.6, 1.0, 1.6] {
            // Form factor of a ball above the horizon: squared sine of its angular radius, times
            // the cosine.
            let far = (height * height + distance * distance).sqrt();
            let expected = 1.0 - height * radius * radius / (far * far * far);
            for (x, z) in [(distance, 0.0), (0.0, -distance), (0.6 * distance, 0.8 * distance)] {
                let actual = ball.visibility_at([x, 0.0, z]);
                assert!((actual - expected).abs() < 0.03, "{distance}: {actual} {expected}");
            }
        }
        assert!(ball.visibility_at([2.999, 0.0, 0.0]) > 0.9999, "faded at the border");
        assert_eq!(ball.visibility_at([30.0, 0.0, 0.0]), 1.0, "no occlusion outside the grid");
    }

    #[test]
    fn a_long_wall_hides_half_of_the_light_at_its_foot() {
        let wall = grid_of(4.0, |x, _| {
            if x < -2.0 { HeightSlab { low: 0.0, high: 4.0 } } else { HeightSlab::EMPTY }
        });
        for distance in [0.3_f32, 0.6, 1.2] {
            // ½ (1 − d / √(d² + h²)) for an infinite wall; this wall ends after 4 units.
            let expected = 1.0 - 0.5 * (1.0 - distance / (distance * distance + 16.0).sqrt());
            let actual = wall.visibility_at([distance - 2.0, 0.0, 0.0]);
            assert!((actual - expected).abs() < 0.05, "{distance}: {actual} {expected}");
        }
    }
}
