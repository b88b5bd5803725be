//! The denoising pass: averages over the 4 × 4 pattern of the horizon search, on one surface.

use super::horizon_search::depth_slopes;
use super::screen_space::{PixelGrid, ScreenSpace};
use crate::lanes::Lanes;
use raster::{Kernel, LANES};

/// The weights of a pixel and its neighbors along an axis: a centered box of four pixels, which
/// gives each rotation of the pattern the same weight.
const BOX: [f32; 5] = [0.5, 1.0, 1.0, 1.0, 0.5];
/// The distance from the plane of the surface, in radii, at which the weight of a neighbor reaches
/// zero.
const SURFACE_DISTANCE: f32 = 0.1;

/// The kernel that denoises the visibilities of eight pixels, starting at (x, y) and going right.
pub(super) struct DenoiseEight<'a> {
    pub(super) space: &'a ScreenSpace,
    pub(super) depths: &'a PixelGrid,
    pub(super) noisy: &'a PixelGrid,
    pub(super) x: usize,
    pub(super) y: usize,
}

impl Kernel for DenoiseEight<'_> {
    type Output = [f32; LANES];

    /// Applies a bilateral filter: neighbors are weighted by their distance from the plane of the
    /// pixel's surface, on which depth is linear.
    #[inline(always)]
    fn run(self) -> [f32; LANES] {
        let at = [self.x, self.y];
        let depths = self.depths.lanes_at(at, [0, 0]);
        if depths.0 == [0.0; LANES] {
            return [1.0; LANES];
        }
        let slopes = depth_slopes(self.depths, at, depths);
        let inv_distance = 1.0 / self.depth_distances(depths);
        let (mut sum, mut weights) = (Lanes::ZERO, Lanes::ZERO);
        for (dy, weight_y) in (-2..=2).zip(BOX) {
            for (dx, weight_x) in (-2..=2).zip(BOX) {
                let neighbors = self.depths.lanes_at(at, [dx, dy]);
                let plane = depths + slopes[0] * dx as f32 + slopes[1] * dy as f32;
                let likeness = (1.0 - (neighbors - plane).abs() * inv_distance).max(0.0);
                let likeness = likeness.select(&neighbors.is_above(0.0), Lanes::ZERO);
                let weight = likeness * (weight_x * weight_y);
                sum += weight * self.noisy.lanes_at(at, [dx, dy]);
                weights += weight;
            }
        }
        (sum / weights).select(&weights.is_above(0.0), Lanes::ONE).0
    }
}

impl DenoiseEight<'_> {
    /// Computes the change in depth, toward the viewer, that corresponds to the distance at which
    /// the weight of a neighbor reaches zero.
    #[inline(always)]
    fn depth_distances(&self, depths: Lanes<LANES>) -> Lanes<LANES> {
        let space = self.space;
        let columns = Lanes::from_fn(|lane| (self.x + lane) as f32);
        let positions = space.unproject_pixels([columns, Lanes::splat(self.y as f32)], depths);
        let nearer = positions + space.views(positions) * (SURFACE_DISTANCE * space.radius());
        let distances = (space.project(nearer).z - depths).abs();
        // A viewer within that distance sees only this surface.
        distances.max(f32::MIN_POSITIVE)
    }
}
