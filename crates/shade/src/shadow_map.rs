//! Shadow maps with percentage-closer soft shadows (PCSS), receiver planes and exact depth planes.
//!
//! ```text
//!      light ── depth ──►   texel: depth and slope of the nearest triangle's plane
//!        ╲        ▟▛  caster
//!         ╲      ▟▛
//!   ───────●────▟▛──── receiver: its own plane, by the normal
//! ```
//!
//! A texel holds the plane of the nearest surface and not only its depth, and the receiver is a
//! plane too. They are compared both at the texel's center and at the receiver's own position, and
//! shade only if they do at both: a surface then never shadows itself (no acne), however flatly
//! light falls on it, with a bias of a hundredth of a texel and no gap where a thing stands on
//! another (no peter-panning).
//!
//! The penumbra grows with the distance of the caster (Fernando, *Percentage-closer soft shadows*,
//! 2005): a search for blockers gives its radius, a percentage-closer filter of that radius the
//! shadow. Both use a fixed pattern of positions, so that pictures have no noise and always the
//! same bytes.
//!
//! Percentage-closer filtering (Reeves, Salesin and Cook, *Rendering antialiased shadows with depth
//! maps*, 1987) averages the results of depth comparisons, not depths: a mean of depths would be
//! the depth of no surface. Here the comparison is one of planes, and the average one over a disc.

mod blocker_search;

use super::approximations::floor_to_int;
use super::vector::{dot, subtract};
use blocker_search::{Blockers, CountBlockers, DiscLanes, FILTER_DISC, SEARCH_DISC};
use glam::{DMat4, DVec3, DVec4};
use raster::{SimdLevel, SurfaceDepth};
use std::sync::LazyLock;

/// The shadows of a light.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Shadow {
    /// The texels of the longer side of the shadow map.
    pub resolution: u32,
    /// The angular diameter of the light, seen from where its light falls, in radians; 0 for sharp
    /// borders.
    pub softness: f32,
}

/// The greatest radius in texels of blocker search and filter.
///
/// A wider penumbra is cut off: the 48 positions of the filter would be too far apart in it.
const MAX_FILTER_RADIUS: f32 = 64.0;
/// The side in texels of the blocks whose nearest depths are known.
const BLOCK_SIDE: u32 = 32;
/// The bias for a step of depth per texel: vertices are snapped to a grid of 1/256 texel.
const SLOPE_BIAS: f32 = 1.0 / 96.0;
/// The bias for rounding, relative to the depth of the whole scene.
const DEPTH_BIAS: f32 = 2e-6;
/// The steepest receiver plane in depth per texel: light that falls more flatly has no weight.
const MAX_PLANE_SLOPE: f32 = 4.0;

/// Positions in a disc of radius 1, evenly spread: Vogel's spiral (1979), with the golden angle.
pub(super) static VOGEL_DISC: LazyLock<[[f32; 2]; 48]> = LazyLock::new(|| {
    std::array::from_fn(|index| {
        let radius = ((index as f64 + 0.5) / 48.0).sqrt();
        let angle = index as f64 * 2.399_963_229_728_653;
        [(radius * libm::cos(angle)) as f32, (radius * libm::sin(angle)) as f32]
    })
});

/// The transform from the world to the texels of a shadow map.
#[derive(Clone, Copy, Debug, Default)]
struct WorldToShadowMap {
    /// The position that others are relative to, for precision: the middle of the scene.
    origin: [f32; 3],
    /// The rows of the matrix from positions to (x·w, y·w, depth·w, w), with x and y in texels.
    rows: [[f32; 4]; 4],
    /// The first three rows of the matrix of planes, the inverse transpose.
    plane_rows: [[f32; 4]; 3],
}

/// The depths of a scene from a light.
///
/// Larger depth is nearer to the light, as in the rasterizer that draws the map.
#[derive(Clone, Debug, Default)]
pub struct ShadowMap {
    /// Texels of a row, and rows.
    size: [u32; 2],
    world_to_map: WorldToShadowMap,
    /// In perspective the depth at infinite distance, relative to which depth is a multiple of 1/w;
    /// `None` in parallel light.
    depth_at_infinity: Option<f32>,
    /// The radius of the penumbra in texels: per difference of depth in parallel light, otherwise
    /// per difference of distances over the nearer distance.
    penumbra_scale: f32,
    /// The nearest surface of each texel, rows from the top.
    pub texels: Vec<SurfaceDepth>,
    /// The nearest depth of each block of texels, rows from the top; empty if it is not known.
    block_depths: Vec<f32>,
}

/// A surface on a shadow map: its position in texels and depth, and its plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct ReceiverPlane {
    x: f32,
    y: f32,
    pub(super) depth: f32,
    /// The growth of depth per texel, by column and row.
    slope: [f32; 2],
    /// The difference of depth from which on something is a blocker.
    bias: f32,
}

impl ReceiverPlane {
    /// The depth of the plane at a position of the map.
    #[inline(always)]
    fn depth_at(&self, x: f32, y: f32) -> f32 {
        self.depth + self.slope[0] * (x - self.x) + self.slope[1] * (y - self.y)
    }
}

impl ShadowMap {
    /// Empties the map for a light, and takes over its transform.
    ///
    /// `world_to_map` goes to texels and depth, 1 at the near plane; `origin` is a position near
    /// the scene.
    pub fn reset(&mut self, world_to_map: DMat4, size: [u32; 2], origin: DVec3) {
        let relative_to_map = world_to_map * DMat4::from_translation(origin.as_vec3().as_dvec3());
        let to_f32 = |row: DVec4| row.as_vec4().to_array();
        let planes = relative_to_map.inverse().transpose();
        self.world_to_map = WorldToShadowMap {
            origin: origin.as_vec3().to_array(),
            rows: [0, 1, 2, 3].map(|k| to_f32(relative_to_map.row(k))),
            plane_rows: [0, 1, 2].map(|k| to_f32(planes.row(k))),
        };
        self.size = size;
        self.block_depths.clear();
        self.texels.clear();
        self.texels.resize(size[0] as usize * size[1] as usize, SurfaceDepth::EMPTY);
    }

    /// Computes the nearest depth of each block of texels, once these are set: soft shadows then
    /// skip the search for blockers where there are none.
    pub fn find_block_depths(&mut self) {
        let [columns, rows] = self.size.map(|side| side.div_ceil(BLOCK_SIDE) as usize);
        self.block_depths.clear();
        self.block_depths.resize(columns * rows, f32::NEG_INFINITY);
        let width = self.size[0].max(1) as usize;
        for (row, texels) in self.texels.chunks_exact(width).enumerate() {
            let first = row / BLOCK_SIDE as usize * columns;
            for (column, block) in texels.chunks(BLOCK_SIDE as usize).enumerate() {
                let nearest = &mut self.block_depths[first + column];
                *nearest = block.iter().fold(*nearest, |nearest, texel| nearest.max(texel.depth));
            }
        }
    }

    /// Whether a texel within a radius may block the light of a receiver: whether some block there
    /// reaches above the least depth of the receiver's plane.
    fn may_be_blocked(&self, receiver: &ReceiverPlane, radius: f32) -> bool {
        let [columns, rows] = self.size.map(|side| side.div_ceil(BLOCK_SIDE) as i32);
        if self.block_depths.len() != (columns * rows) as usize {
            return true;
        }
        // Texels are compared at their centers, up to a texel beyond the radius.
        let reach = radius + 1.0;
        let least = receiver.depth - (receiver.slope[0].abs() + receiver.slope[1].abs()) * reach;
        let block = |at: f32, count: i32| {
            floor_to_int(at * (1.0 / BLOCK_SIDE as f32)).clamp(0, count - 1) as usize
        };
        let [left, right] = [-reach, reach].map(|offset| block(receiver.x + offset, columns));
        let [top, bottom] = [-reach, reach].map(|offset| block(receiver.y + offset, rows));
        self.block_depths
            .chunks_exact(columns as usize)
            .take(bottom + 1)
            .skip(top)
            .any(|row| row[left..=right].iter().any(|depth| *depth > least))
    }

    /// Sets the softness of the shadows.
    ///
    /// `scale` is the radius of the penumbra in texels: in parallel light per difference of depth,
    /// in perspective per difference of distances over the nearer. `depth_at_infinity` is `None` in
    /// parallel light.
    pub fn set_penumbra(&mut self, scale: f64, depth_at_infinity: Option<f64>) {
        self.penumbra_scale = scale as f32;
        self.depth_at_infinity = depth_at_infinity.map(|depth| depth as f32);
    }

    /// The visibility of the light, 0 to 1, from a position in the world with this unit normal.
    ///
    /// Without softness four texels are compared, with softness 24, and within a penumbra 48 more.
    /// Beside the map and behind the light nothing is in shadow.
    #[inline(never)]
    pub(super) fn visibility(&self, position: [f32; 3], normal: [f32; 3]) -> f32 {
        let Some(receiver) = self.project_receiver(position, normal) else { return 1.0 };
        if self.penumbra_scale <= 0.0 {
            return self.filter_bilinear(&receiver);
        }
        // Blocker search: the mean depth of what is before the receiver, within the penumbra that
        // the nearest possible caster would have.
        let search_radius = self.penumbra_radius(receiver.depth, 1.0).clamp(1.5, MAX_FILTER_RADIUS);
        if !self.may_be_blocked(&receiver, search_radius) {
            return self.filter_bilinear(&receiver);
        }
        let found = self.count_blockers(&receiver, search_radius, SEARCH_DISC.as_slice());
        if found.count == 0.0 {
            return self.filter_bilinear(&receiver);
        }
        // Penumbra of the mean blocker, by similar triangles (PCSS, Fernando 2005).
        let mean_depth = found.depth_sum / found.count;
        let radius = self.penumbra_radius(receiver.depth, mean_depth).min(MAX_FILTER_RADIUS);
        if radius <= 1.0 {
            return self.filter_bilinear(&receiver);
        }
        // Percentage-closer filtering over the penumbra.
        let blocked = self.count_blockers(&receiver, radius, FILTER_DISC.as_slice()).count;
        let positions = VOGEL_DISC.len() as f32;
        (positions - blocked) / positions
    }

    /// Counts the blockers at the positions of a disc around a receiver.
    fn count_blockers(&self, receiver: &ReceiverPlane, radius: f32, disc: &DiscLanes) -> Blockers {
        SimdLevel::best().run_kernel(CountBlockers { map: self, receiver, radius, disc })
    }

    /// Projects a surface onto the map, with its plane; `None` beside the map or behind the light.
    ///
    /// Positions and planes transform by a matrix and by its inverse transpose; both are of `f32`
    /// relative to the middle of the scene, where rounding is least.
    #[inline(always)]
    pub(super) fn project_receiver(
        &self,
        position: [f32; 3],
        normal: [f32; 3],
    ) -> Option<ReceiverPlane> {
        let WorldToShadowMap { origin, rows, plane_rows } = &self.world_to_map;
        let p = subtract(position, *origin);
        let transform = |row: &[f32; 4]| row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
        let w = transform(&rows[3]);
        let [x, y, depth] = [0, 1, 2].map(|k: usize| transform(&rows[k]) / w);
        let is_inside = |at: f32, side: u32| at > 0.0 && at < side as f32;
        let is_on_map = is_inside(x, self.size[0]) && is_inside(y, self.size[1]);
        if !(w > 0.0 && is_on_map && depth.is_finite()) {
            return None;
        }
        // The plane (n, −n·p) on the map; its slopes are ratios of the components.
        let n = normal;
        let offset = -dot(n, p);
        let transform_plane =
            |row: &[f32; 4]| row[0] * n[0] + row[1] * n[1] + row[2] * n[2] + row[3] * offset;
        let along_depth = transform_plane(&plane_rows[2]);
        let slope = [0, 1].map(|axis: usize| {
            let slope = -transform_plane(&plane_rows[axis]) / along_depth;
            if slope.is_finite() { slope.clamp(-MAX_PLANE_SLOPE, MAX_PLANE_SLOPE) } else { 0.0 }
        });
        // Rounding moves positions by a fraction of the scene's size; near a spot light that is a
        // larger fraction of its range of depth.
        let bias = DEPTH_BIAS * self.nearness(depth).max(0.1)
            + SLOPE_BIAS * (slope[0].abs() + slope[1].abs());
        Some(ReceiverPlane { x, y, depth, slope, bias })
    }

    /// Texel coordinates of a direction from the eye of a perspective map: x·w, y·w and w.
    ///
    /// Linear in the direction; positive w is ahead.
    #[inline(always)]
    pub(super) fn project_direction(&self, direction: [f32; 3]) -> [f32; 3] {
        let rows = &self.world_to_map.rows;
        [0, 1, 3].map(|k: usize| dot([rows[k][0], rows[k][1], rows[k][2]], direction))
    }

    /// A number proportional to 1 / distance along the axis of a perspective map, from a depth; 1
    /// in parallel light.
    #[inline(always)]
    pub(super) fn nearness(&self, depth: f32) -> f32 {
        self.depth_at_infinity.map_or(1.0, |infinity| (depth - infinity).max(0.0))
    }

    /// The radius in texels of the penumbra at one depth of a caster at another.
    ///
    /// By similar triangles: the size of the light times the distance of receiver and caster over
    /// that of caster and light. In parallel light it grows with the difference of depth alone.
    #[inline(always)]
    fn penumbra_radius(&self, receiver: f32, caster: f32) -> f32 {
        let distance = match self.depth_at_infinity {
            None => caster - receiver,
            Some(infinity) => (caster - infinity) / (receiver - infinity).max(1e-12) - 1.0,
        };
        self.penumbra_scale * distance
    }

    /// The depth of the surface that blocks the light of the receiver's plane at a position of the
    /// map.
    ///
    /// The planes of texel and receiver are compared twice: at the center of the texel, where the
    /// depth was sampled, and at the position itself. The caster must be above the receiver at
    /// both. Two facets of one surface that meet within the texel cross there, and one comparison
    /// fails.
    #[inline(always)]
    pub(super) fn find_blocker(&self, receiver: &ReceiverPlane, [x, y]: [f32; 2]) -> Option<f32> {
        let [column, row] = [x, y].map(floor_to_int);
        let texel = self.texel_at(column, row)?;
        let [column, row] = [column, row].map(|index| index as f32);
        let (dx, dy) = (x - column - 0.5, y - row - 0.5);
        let bias = receiver.bias + SLOPE_BIAS * (texel.dx.abs() + texel.dy.abs());
        let at_center = texel.depth - receiver.depth_at(column + 0.5, row + 0.5);
        let here = texel.depth + texel.dx * dx + texel.dy * dy - receiver.depth_at(x, y);
        (at_center > bias && here > bias).then_some(texel.depth)
    }

    /// Percentage-closer filtering over the four nearest texels, with bilinear weights; the plane
    /// of each is continued to the receiver.
    #[inline(always)]
    pub(super) fn filter_bilinear(&self, receiver: &ReceiverPlane) -> f32 {
        let [left, top] = [receiver.x, receiver.y].map(|at| floor_to_int(at - 0.5));
        let (fx, fy) = (receiver.x - 0.5 - left as f32, receiver.y - 0.5 - top as f32);
        let mut visible = 0.0;
        // Four comparisons, each with its bilinear weight.
        for (column, column_weight) in [(0, 1.0 - fx), (1, fx)] {
            for (row, row_weight) in [(0, 1.0 - fy), (1, fy)] {
                let texel = self.texel_at(left + column, top + row);
                let (dx, dy) = (fx - column as f32, fy - row as f32);
                let is_blocked = texel.is_some_and(|texel| {
                    let bias = receiver.bias + SLOPE_BIAS * (texel.dx.abs() + texel.dy.abs());
                    let above = texel.depth - receiver.depth;
                    let at_center = above + receiver.slope[0] * dx + receiver.slope[1] * dy;
                    at_center > bias && above + texel.dx * dx + texel.dy * dy > bias
                });
                visible += if is_blocked { 0.0 } else { column_weight * row_weight };
            }
        }
        visible
    }

    /// The texel in a column and a row; `None` outside of the map.
    #[inline(always)]
    fn texel_at(&self, column: i32, row: i32) -> Option<&SurfaceDepth> {
        let [width, height] = self.size;
        let (column, row) = (u32::try_from(column).ok()?, u32::try_from(row).ok()?);
        let is_inside = column < width && row < height;
        self.texels.get(row as usize * width as usize + column as usize).filter(|_| is_inside)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A map of 100 × 100 texels of side 0.01 seen from above: x to the right, y is depth, z
    /// downwards. Left of x = 0.6 there is a caster at a height.
    pub(super) fn map(height: f32, spread: f64) -> ShadowMap {
        let mut map = ShadowMap::default();
        let world_to_map = DMat4::from_cols(
            DVec4::new(100.0, 0.0, 0.0, 0.0),
            DVec4::new(0.0, 0.0, 1.0, 0.0),
            DVec4::new(0.0, 100.0, 0.0, 0.0),
            DVec4::new(0.0, 0.0, 0.0, 1.0),
        );
        map.reset(world_to_map, [100, 100], DVec3::new(0.5, 0.0, 0.5));
        map.set_penumbra(spread, None);
        for (at, texel) in map.texels.iter_mut().enumerate() {
            if at % 100 < 60 {
                *texel = SurfaceDepth { depth: height, dx: 0.0, dy: 0.0 };
            }
        }
        map
    }

    const UP: [f32; 3] = [0.0, 1.0, 0.0];

    #[test]
    fn blocks_of_depths_change_no_visibility() {
        for (height, spread) in [(0.5, 30.0), (0.9, 200.0), (0.2, 5.0)] {
            let searched = map(height, spread);
            let mut indexed = searched.clone();
            indexed.find_block_depths();
            let mut skipped = 0;
            for step in 0..2000 {
                let [x, z] = [step * 37 % 1000, step * 91 % 1000].map(|c| c as f32 * 0.001);
                let tilt = (step % 7) as f32 * 0.1;
                let normal = [tilt, (1.0 - tilt * tilt).sqrt(), 0.0];
                let expected = searched.visibility([x, 0.1, z], normal);
                assert_eq!(indexed.visibility([x, 0.1, z], normal), expected, "{x} {z}");
                let receiver = indexed.project_receiver([x, 0.1, z], normal);
                skipped += usize::from(receiver.is_some_and(|r| !indexed.may_be_blocked(&r, 2.0)));
            }
            assert!(skipped > 100, "{skipped}");
        }
    }

    #[test]
    fn what_is_above_shades_and_what_is_below_does_not() {
        let map = map(0.5, 0.0);
        for (x, y, expected) in
            [(0.2, 0.1, 0.0), (0.2, 0.499, 0.0), (0.2, 0.501, 1.0), (0.7, 0.1, 1.0)]
        {
            assert_eq!(map.visibility([x, y, 0.5], UP), expected, "{x} {y}");
        }
        assert_eq!(map.visibility([-0.1, 0.1, 0.5], UP), 1.0, "no shadow beside the map");
        assert!((map.visibility([0.6, 0.1, 0.5], UP) - 0.5).abs() < 0.01, "half at the border");
    }

    #[test]
    fn penumbras_grow_with_the_distance_of_the_caster() {
        // 40 texels per unit of depth: at 0.5 below the caster the penumbra is 40 texels wide, at
        // 0.05 it is 4.
        let map = map(0.5, 40.0);
        for y in [0.0_f32, 0.25, 0.45] {
            let radius = (0.5 - y) * 0.4;
            let at = |part: f32| map.visibility([0.6 + part * radius, y, 0.5], UP);
            assert!((at(0.0) - 0.5).abs() < 0.06, "{y} {}", at(0.0));
            assert_eq!((at(-1.3), at(1.3)), (0.0, 1.0), "{y}");
            // The fraction of a disc beyond a straight border at half of its radius: 0.8045.
            assert!((at(0.5) - 0.8045).abs() < 0.06, "{y} {}", at(0.5));
        }
    }

    #[test]
    fn a_slope_does_not_shade_itself() {
        let mut map = map(0.5, 30.0);
        for slope in [0.001_f32, 0.05, 0.9] {
            for (at, texel) in map.texels.iter_mut().enumerate() {
                let x = (at % 100) as f32 + 0.5;
                *texel = SurfaceDepth { depth: slope * (x - 50.0), dx: slope, dy: 0.0 };
            }
            // Depth grows by `slope` per texel: the plane is y = 100 slope (x − 0.5).
            let length = (1.0 + 1e4 * slope * slope).sqrt();
            let normal = [-100.0 * slope / length, 1.0 / length, 0.0];
            for step in 0..500 {
                let x = 0.25 + step as f32 * 0.001;
                let position = [x, 100.0 * slope * (x - 0.5), 0.5];
                assert_eq!(map.visibility(position, normal), 1.0, "{slope} {x}");
            }
        }
    }
}
