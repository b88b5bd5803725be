//! Shadow maps with percentage-closer soft shadows (PCSS), receiver planes and exact depth planes.
//!
//! ```text
//!      light ── depth ──►   texel: depth and slope of the nearest triangle's plane
//!        ╲        ▟▛  caster
//!         ╲      ▟▛
//!   ───────●────▟▛──── receiver: its own plane, from the normal
//! ```
//!
//! A texel stores the plane of the nearest surface, not only its depth, and the receiver is also a
//! plane. They are compared both at the texel's center and at the receiver's position, and the
//! texel casts a shadow only if both comparisons agree. A surface then never shadows itself (no
//! acne), even in grazing light, with a bias of only a hundredth of a texel and no gap where one
//! object rests on another (no peter-panning).
//!
//! The penumbra grows with the distance to the caster (Fernando, *Percentage-closer soft shadows*,
//! 2005): a blocker search gives its radius, and a percentage-closer filter with that radius gives
//! the shadow. Both use a fixed pattern of positions, so that pictures have no noise and are always
//! identical.
//!
//! Percentage-closer filtering averages the results of depth comparisons, not depths (Reeves,
//! Salesin and Cook, *Rendering antialiased shadows with depth maps*, 1987). A mean depth would not
//! be the depth of any surface. Here planes are compared, and the average is over a disc.

mod blocker_search;
mod nearest_depths;
mod receiver_planes;
mod visibility;

use super::approximations::floor_to_int;
use super::vector::dot;
pub(super) use blocker_search::VOGEL_DISC;
use glam::{DMat4, DVec3, DVec4};
use nearest_depths::NearestDepths;
use raster::SurfaceDepth;
pub(super) use receiver_planes::ReceiverPlane;

/// The shadow settings of a light.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Shadow {
    /// The number of texels along the longer side of the shadow map.
    pub resolution: u32,
    /// The angular diameter of the light in radians, as seen from the receiver, or 0 for hard
    /// shadow edges.
    pub softness: f32,
}

/// The maximum radius of the blocker search and the filter in texels.
///
/// Wider penumbras are clamped, because the 48 filter positions would be too far apart.
const MAX_FILTER_RADIUS: f32 = 63.0;
/// The bias per unit of slope (depth per texel). It is needed because vertices are snapped to a
/// grid of 1/256 texel.
const SLOPE_BIAS: f32 = 1.0 / 96.0;
/// The transform from the world to the texels of a shadow map.
#[derive(Clone, Copy, Debug, Default)]
struct WorldToShadowMap {
    /// The center of the scene, which positions are relative to for precision.
    origin: [f32; 3],
    /// The rows of the matrix from positions to (x·w, y·w, depth·w, w), with x and y in texels.
    rows: [[f32; 4]; 4],
    /// The first three rows of the matrix for planes, the inverse transpose.
    plane_rows: [[f32; 4]; 3],
}

/// The scene depths as seen from a light.
///
/// Larger depths are nearer to the light, as in the rasterizer that draws the map.
#[derive(Clone, Debug, Default)]
pub struct ShadowMap {
    /// The number of texels per row, and the number of rows.
    size: [u32; 2],
    world_to_map: WorldToShadowMap,
    /// In perspective, the depth at infinite distance; depth minus this value is proportional to
    /// 1/w. `None` in parallel light.
    depth_at_infinity: Option<f32>,
    /// The radius of the penumbra in texels: per unit of depth in parallel light, and otherwise per
    /// difference of distances divided by the nearer distance.
    penumbra_scale: f32,
    /// The nearest surface at each texel, in rows from the top.
    pub texels: Vec<SurfaceDepth>,
    /// The nearest depths around each block of texels.
    nearest_depths: NearestDepths,
}

impl ShadowMap {
    /// Clears the map for a light and sets its transform.
    ///
    /// `world_to_map` maps the world to texels and depth, which is 1 at the near plane; `origin` is
    /// a position near the scene.
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
        self.nearest_depths.clear();
        self.texels.clear();
        self.texels.resize(size[0] as usize * size[1] as usize, SurfaceDepth::EMPTY);
    }

    /// Computes the nearest depths of blocks of texels, once the texels are set. Soft shadows then
    /// skip the blocker search if there are no blockers.
    pub fn find_nearest_depths(&mut self) {
        self.nearest_depths.find(&self.texels, self.size);
    }

    /// Sets the softness of the shadows.
    ///
    /// `scale` is the radius of the penumbra in texels: per unit of depth in parallel light, and in
    /// perspective per difference of distances divided by the nearer distance. `depth_at_infinity`
    /// is `None` in parallel light.
    pub fn set_penumbra(&mut self, scale: f64, depth_at_infinity: Option<f64>) {
        self.penumbra_scale = scale as f32;
        self.depth_at_infinity = depth_at_infinity.map(|depth| depth as f32);
    }

    /// Computes the homogeneous texel coordinates of a direction from the eye of a perspective map:
    /// x·w, y·w and w.
    ///
    /// They are linear in the direction, and w is positive in front.
    #[inline(always)]
    pub(super) fn project_direction(&self, direction: [f32; 3]) -> [f32; 3] {
        let rows = &self.world_to_map.rows;
        [0, 1, 3].map(|k: usize| dot([rows[k][0], rows[k][1], rows[k][2]], direction))
    }

    /// Converts a depth to a number proportional to 1 / distance along the axis of a perspective
    /// map. Returns 1 in parallel light.
    #[inline(always)]
    pub(super) fn nearness(&self, depth: f32) -> f32 {
        self.depth_at_infinity.map_or(1.0, |infinity| (depth - infinity).max(0.0))
    }

    /// Finds the depth of the surface that blocks light from the receiver's plane at a position on
    /// the map.
    ///
    /// The planes of the texel and the receiver are compared twice: at the center of the texel,
    /// where the depth was sampled, and at the position itself. The caster must be above the
    /// receiver at both. If two facets of one surface meet within the texel, their planes cross
    /// there, and one comparison fails.
    #[inline(always)]
    pub(super) fn find_blocker(&self, receiver: &ReceiverPlane, [x, y]: [f32; 2]) -> Option<f32> {
        let [column, row] = [x, y].map(floor_to_int);
        let texel = self.texels.get(self.texel_index(column, row))?;
        let [column, row] = [column, row].map(|index| index as f32);
        let (dx, dy) = (x - column - 0.5, y - row - 0.5);
        let bias = receiver.bias + SLOPE_BIAS * (texel.dx.abs() + texel.dy.abs());
        let at_center = texel.depth - receiver.depth_at(column + 0.5, row + 0.5);
        let here = texel.depth + texel.dx * dx + texel.dy * dy - receiver.depth_at(x, y);
        (at_center > bias && here > bias).then_some(texel.depth)
    }

    /// Returns the index of the texel at a column and row, or an index beyond the last texel if
    /// they are outside the map.
    #[inline(always)]
    fn texel_index(&self, column: i32, row: i32) -> usize {
        let [width, height] = self.size;
        // Negative indices wrap to values far beyond the last.
        let (column, row) = (column as u32, row as u32);
        let is_inside = (column < width) & (row < height);
        let index = row.wrapping_mul(width).wrapping_add(column);
        (if is_inside { index } else { u32::MAX }) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Vec3Lanes;
    use crate::shadow_receiver::ShadowReceiver;

    /// Returns a map with 100 × 100 texels of side 0.01, seen from above: x points right, y is
    /// depth, and z points down. Left of x = 0.6 there is a caster at this height.
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

    /// Computes the visibility from one position.
    fn visibility(map: &ShadowMap, position: [f32; 3], normal: [f32; 3]) -> f32 {
        let (positions, normals) = (Vec3Lanes::splat(position), Vec3Lanes::splat(normal));
        map.visibility::<1>(&ShadowReceiver { positions, normals }, [true])[0]
    }

    /// Returns the position and normal of a receiver at height `y`; both vary with the step.
    fn scattered_receiver(step: usize, y: f32) -> ([f32; 3], [f32; 3]) {
        let [x, z] = [step * 37 % 1000, step * 91 % 1000].map(|c| c as f32 * 0.001);
        let tilt = (step % 7) as f32 * 0.1;
        ([x, y, z], [tilt, (1.0 - tilt * tilt).sqrt(), 0.0])
    }

    #[test]
    fn eight_receivers_match_single_receivers() {
        let mut map = map(0.5, 30.0);
        map.find_nearest_depths();
        for first in (0..2000).step_by(8) {
            let receivers: [_; 8] =
                std::array::from_fn(|lane| scattered_receiver(first + lane, 0.1));
            let positions = Vec3Lanes::from_fn(|lane| receivers[lane].0);
            let normals = Vec3Lanes::from_fn(|lane| receivers[lane].1);
            let eight = map.visibility::<8>(&ShadowReceiver { positions, normals }, [true; 8]);
            for (lane, (position, normal)) in receivers.into_iter().enumerate() {
                assert_eq!(eight[lane], visibility(&map, position, normal), "{position:?}");
            }
        }
    }

    #[test]
    fn nearest_depths_hardly_change_the_result() {
        for (height, spread) in [(0.5, 30.0), (0.9, 200.0), (0.2, 5.0)] {
            let searched = map(height, spread);
            let mut bounded = searched.clone();
            bounded.find_nearest_depths();
            for step in 0..2000 {
                let (position, normal) = scattered_receiver(step, 0.1);
                let expected = visibility(&searched, position, normal);
                let actual = visibility(&bounded, position, normal);
                // With known depths, the search is narrower and finds more of the blockers.
                assert!((actual - expected).abs() < 0.25, "{position:?} {actual} {expected}");
            }
        }
    }

    #[test]
    fn only_casters_above_the_receiver_cast_shadows() {
        let map = map(0.5, 0.0);
        for (x, y, expected) in
            [(0.2, 0.1, 0.0), (0.2, 0.499, 0.0), (0.2, 0.501, 1.0), (0.7, 0.1, 1.0)]
        {
            assert_eq!(visibility(&map, [x, y, 0.5], UP), expected, "{x} {y}");
        }
        assert_eq!(visibility(&map, [-0.1, 0.1, 0.5], UP), 1.0, "no shadow outside the map");
        assert!((visibility(&map, [0.6, 0.1, 0.5], UP) - 0.5).abs() < 0.01, "half at the border");
    }

    #[test]
    fn penumbras_grow_with_the_distance_to_the_caster() {
        // With 40 texels per unit of depth, the penumbra is 40 texels wide at 0.5 below the caster,
        // and 4 at 0.05.
        let map = map(0.5, 40.0);
        for y in [0.0_f32, 0.25, 0.45] {
            let radius = (0.5 - y) * 0.4;
            let at = |part: f32| visibility(&map, [0.6 + part * radius, y, 0.5], UP);
            assert!((at(0.0) - 0.5).abs() < 0.06, "{y} {}", at(0.0));
            assert_eq!((at(-1.3), at(1.3)), (0.0, 1.0), "{y}");
            // The fraction of a disc on one side of a straight border at half the radius: 0.8045.
            assert!((at(0.5) - 0.8045).abs() < 0.06, "{y} {}", at(0.5));
        }
    }

    #[test]
    fn a_slope_does_not_shadow_itself() {
        let mut map = map(0.5, 30.0);
        for slope in [0.001_f32, 0.05, 0.9] {
            for (at, texel) in map.texels.iter_mut().enumerate() {
                let x = (at % 100) as f32 + 0.5;
                *texel = SurfaceDepth { depth: slope * (x - 50.0), dx: slope, dy: 0.0 };
            }
            // Depth grows by `slope` per texel, so the plane is y = 100 slope (x − 0.5).
            let length = (1.0 + 1e4 * slope * slope).sqrt();
            let normal = [-100.0 * slope / length, 1.0 / length, 0.0];
            for step in 0..500 {
                let x = 0.25 + step as f32 * 0.001;
                let position = [x, 100.0 * slope * (x - 0.5), 0.5];
                assert_eq!(visibility(&map, position, normal), 1.0, "{slope} {x}");
            }
        }
    }
}
