//! Shadow receivers: surfaces projected onto a shadow map, with their planes.

use super::{SLOPE_BIAS, ShadowMap, WorldToShadowMap};
use crate::lanes::{Lanes, Mask, Vec3Lanes, map_to_lanes};

/// The bias for rounding errors, relative to the depth of the whole scene.
const DEPTH_BIAS: f32 = 2e-6;
/// The steepest receiver plane in depth per texel; at more grazing angles the light is negligible.
const MAX_PLANE_SLOPE: f32 = 4.0;

/// Surfaces on a shadow map: their positions in texels and depth, and their planes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ReceiverPlanes<const N: usize> {
    /// The positions: x and y in texels, and depth.
    pub(super) x: Lanes<N>,
    pub(super) y: Lanes<N>,
    pub(super) depth: Lanes<N>,
    /// The change in depth per texel, along columns and rows.
    pub(super) slope: [Lanes<N>; 2],
    /// The minimum difference in depth at which a surface counts as a blocker.
    pub(super) bias: Lanes<N>,
    /// The lanes that are on the map and not behind the light.
    pub(crate) is_on_map: Mask<N>,
}

/// A single receiver.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ReceiverPlane {
    pub(super) x: f32,
    pub(super) y: f32,
    pub(crate) depth: f32,
    /// The change in depth per texel, along columns and rows.
    pub(super) slope: [f32; 2],
    /// The minimum difference in depth at which a surface counts as a blocker.
    pub(super) bias: f32,
}

impl ReceiverPlane {
    /// Returns the depth of the plane at a position on the map.
    #[inline(always)]
    pub(super) fn depth_at(&self, x: f32, y: f32) -> f32 {
        self.depth + self.slope[0] * (x - self.x) + self.slope[1] * (y - self.y)
    }
}

impl<const N: usize> ReceiverPlanes<N> {
    /// Returns the receiver of one lane.
    #[inline(always)]
    pub(crate) fn lane(&self, lane: usize) -> ReceiverPlane {
        let [along_row, along_column] = self.slope;
        ReceiverPlane {
            x: self.x[lane],
            y: self.y[lane],
            depth: self.depth[lane],
            slope: [along_row[lane], along_column[lane]],
            bias: self.bias[lane],
        }
    }
}

impl ShadowMap {
    /// Projects surfaces and their planes onto the map.
    ///
    /// Positions are transformed by a matrix, and planes by its inverse transpose. Both matrices
    /// are in `f32` relative to the center of the scene, which minimizes rounding errors.
    #[inline(always)]
    pub(crate) fn project_receivers<const N: usize>(
        &self,
        positions: Vec3Lanes<N>,
        normals: Vec3Lanes<N>,
    ) -> ReceiverPlanes<N> {
        let WorldToShadowMap { origin, rows, plane_rows } = &self.world_to_map;
        let p = positions - Vec3Lanes::splat(*origin);
        let [x, y, z, w] = map_to_lanes(rows, |[a, b, c, d]| a * p.x + b * p.y + c * p.z + d);
        let (x, y, depth) = (x / w, y / w, z / w);
        // The plane (n, −n·p) on the map, whose slopes are ratios of its components.
        let n = normals;
        let offset = -n.dot(p);
        let [along_row, along_column, along_depth] =
            map_to_lanes(plane_rows, |[a, b, c, d]| a * n.x + b * n.y + c * n.z + d * offset);
        let slope = map_to_lanes(&[along_row, along_column], |along| {
            let slope = -along / along_depth;
            let is_finite = slope.abs().is_below(f32::INFINITY);
            slope.clamp(-MAX_PLANE_SLOPE, MAX_PLANE_SLOPE).select(&is_finite, Lanes::ZERO)
        });
        // Rounding moves positions by a fraction of the scene's size. Near a spot light, this
        // changes depth more than far away.
        let bias = DEPTH_BIAS * self.nearness_lanes(depth).max(0.1)
            + SLOPE_BIAS * (slope[0].abs() + slope[1].abs());
        let [width, height] = self.size.map(|side| side as f32);
        let mut is_on_map = w.is_above(0.0);
        for lane in 0..N {
            is_on_map[lane] &= (x[lane] > 0.0)
                & (x[lane] < width)
                & (y[lane] > 0.0)
                & (y[lane] < height)
                & (depth[lane].abs() < f32::INFINITY);
        }
        ReceiverPlanes { x, y, depth, slope, bias, is_on_map }
    }

    /// Computes the [`nearness`](Self::nearness) of each lane.
    #[inline(always)]
    fn nearness_lanes<const N: usize>(&self, depth: Lanes<N>) -> Lanes<N> {
        match self.depth_at_infinity {
            None => Lanes::ONE,
            Some(infinity) => (depth - infinity).max(0.0),
        }
    }
}
