//! Screen-space ambient occlusion (GTAO): the fraction of the light from all directions that
//! arrives at a surface, estimated from the occluders visible in the picture.
//!
//! ```text
//!          v  to the viewer
//!    h1 ╲  │  ╱ h2          in several planes through v (slices) the horizon is the
//!        ╲ │ ╱              highest surface on either side within a radius; light
//!   ▟█▙▖  ╲│╱  ▗▟██▙        arrives between the horizons (Jimenez et al., *Practical
//!   ███████●████████        real-time strategies for accurate indirect occlusion*, 2016)
//! ```
//!
//! Three passes over the depth buffer of the whole picture:
//!
//! ```text
//!  depths ─► horizon search ─► denoise ─► visibility of each pixel ─► lookup by fragments
//!            few slices, rotated  4 × 4 mean         from the pixels on their own surface
//!            from pixel to pixel  on one surface
//! ```
//!
//! The slices of a pixel are rotated by a 4 × 4 pattern, and the mean over 4 × 4 pixels of one
//! surface removes the pattern again, so each pixel effectively uses sixteen times as many slices.
//! The pattern is anchored to the whole picture, so that separately rendered parts join seamlessly.
//!
//! Fragments do not search for horizons themselves. A fragment that does not cover the center of
//! its pixel is not on the surface stored there. It would appear to be below other surfaces and
//! become a dark dot. It therefore uses the visibility of surrounding pixels that show its surface.

mod denoise;
mod horizon_search;
mod screen_space;

use super::lanes::{Lanes, Rgb, Vec3Lanes};
use denoise::DenoiseEight;
use horizon_search::{HorizonSearch, Pattern};
use raster::{Kernel, LANES, SimdLevel, SurfaceDepth, for_each_parallel};
use screen_space::PixelGrid;
pub use screen_space::ScreenSpace;

/// The distance from a fragment's plane, in radii, within which a pixel counts as showing the
/// fragment's surface.
const SAME_SURFACE: f32 = 0.02;
/// The weight of full visibility in a lookup, which matters only for fragments without a nearby
/// pixel of their surface.
const OPEN_WEIGHT: f32 = 4.0;

/// The ambient visibility of the pixels of a picture.
#[derive(Clone, Debug)]
pub struct AmbientOcclusion {
    /// The mapping between the screen and the world.
    space: ScreenSpace,
    /// The depth of the nearest surface at the first sample of each pixel.
    depths: PixelGrid,
    /// The fraction of the light from all directions that arrives at each pixel, 0 to 1.
    visibilities: PixelGrid,
    /// The visibilities before denoising, whose memory is reused for the next picture.
    noisy: PixelGrid,
}

impl AmbientOcclusion {
    /// Computes the ambient visibility of the nearest surfaces of a picture, in rows from the top.
    ///
    /// Uses up to `threads` threads, with the same result for any number, and reuses the memory of
    /// the `last` picture.
    pub fn compute(
        nearest: &[SurfaceDepth],
        space: ScreenSpace,
        simd_level: SimdLevel,
        threads: usize,
        last: Option<Self>,
    ) -> Self {
        let [mut depths, mut noisy, mut visibilities] =
            last.map(|last| [last.depths, last.noisy, last.visibilities]).unwrap_or_default();
        for grid in [&mut depths, &mut noisy, &mut visibilities] {
            grid.reset(space.size());
        }
        depths.fill_from(nearest.iter().map(|surface| surface.depth.max(0.0)));
        let pattern = Pattern::new();
        for_each_parallel(threads, noisy.rows_mut(), |(y, row)| {
            for (block, target) in row.as_chunks_mut().0.iter_mut().enumerate() {
                let (space, pattern, depths, x) = (&space, &pattern, &depths, block * LANES);
                let search = HorizonSearch { space, pattern, depths, x, y };
                *target = simd_level
                    .run_wide_kernel(search)
                    .unwrap_or_else(|| search_one_by_one(space, pattern, depths, [x, y]));
            }
        });
        for_each_parallel(threads, visibilities.rows_mut(), |(y, row)| {
            for (block, target) in row.as_chunks_mut().0.iter_mut().enumerate() {
                let (space, depths, noisy, x) = (&space, &depths, &noisy, block * LANES);
                *target = simd_level.run_kernel(DenoiseEight { space, depths, noisy, x, y });
            }
        });
        Self { space, depths, visibilities, noisy }
    }

    /// Computes the ambient visibility, 0 to 1, of positions in the world with these unit normals.
    ///
    /// This is a mean over the nine pixels around each position, weighted by how close their
    /// surfaces are to the position's plane (a joint bilateral lookup).
    #[inline(always)]
    pub(super) fn visibility<const N: usize>(
        &self,
        positions: Vec3Lanes<N>,
        normals: Vec3Lanes<N>,
    ) -> Lanes<N> {
        let space = &self.space;
        let positions = space.to_relative(positions);
        let pixels = space.pixels_at(positions);
        let (mut sum, mut weights) = (Lanes::splat(OPEN_WEIGHT), Lanes::splat(OPEN_WEIGHT));
        let inv_distance = 1.0 / (SAME_SURFACE * space.radius());
        for (dy, dx) in [-1, 0, 1].into_iter().flat_map(|dy| [-1, 0, 1].map(|dx| (dy, dx))) {
            let depths = Lanes::from_fn(|lane| self.depths.at(pixels[lane], [dx, dy]));
            let visibilities = Lanes::from_fn(|lane| self.visibilities.at(pixels[lane], [dx, dy]));
            let x = Lanes::from_fn(|lane| (pixels[lane][0] + dx) as f32);
            let y = Lanes::from_fn(|lane| (pixels[lane][1] + dy) as f32);
            let found = space.unproject_pixels([x, y], depths);
            let distances = (found - positions).dot(normals) * inv_distance;
            // The weight is a tent over the pixels, times the similarity of the surfaces.
            let tent = [4096.0, 2048.0, 1024.0][(dx.abs() + dy.abs()) as usize];
            let weight = tent / (1.0 + distances * distances);
            let weight = weight.select(&depths.is_above(0.0), Lanes::ZERO);
            sum += weight * visibilities;
            weights += weight;
        }
        sum / weights
    }
}

/// Computes the visibilities of eight pixels one by one, for SIMD levels without wide kernels.
#[inline(never)]
fn search_one_by_one(
    space: &ScreenSpace,
    pattern: &Pattern,
    depths: &PixelGrid,
    [x, y]: [usize; 2],
) -> [f32; LANES] {
    let mut visibilities = [0.0; LANES];
    for (lane, visibility) in visibilities.iter_mut().enumerate() {
        let search = HorizonSearch { space, pattern, depths, x: x + lane, y };
        [*visibility] = search.run();
    }
    visibilities
}

/// Computes the ambient visibility of a surface with this albedo, including the light that its
/// surroundings reflect to it: a fit to multiple bounces (Jimenez et al. 2016, eq. 10).
///
/// The surroundings are assumed to have the same albedo, so white corners are brighter than black
/// corners.
#[inline(always)]
pub(super) fn add_bounces<const N: usize>(visibility: Lanes<N>, albedo: Rgb<N>) -> Rgb<N> {
    albedo.map(|albedo| {
        let a = 2.0404 * albedo - 0.3324;
        let b = 0.6417 - 4.7951 * albedo;
        let c = 2.7552 * albedo + 0.6903;
        (((visibility * a + b) * visibility + c) * visibility).max_lanes(visibility).min(1.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat4, DVec3, DVec4};

    /// Returns a camera that looks down at the ground from far away.
    fn distant_view() -> DMat4 {
        let world_to_clip = DMat4::from_cols_array_2d(&[
            [1.681_992, -0.747_552, 1.824_367, -2.0 / 3.0],
            [0.0, 2.990_208, 0.912_184, -1.0 / 3.0],
            [-1.681_992, -0.747_552, 1.824_367, -2.0 / 3.0],
            [10.091_953, 218.012_44, -544.606_4, 1_499.104_128],
        ]);
        let clip_to_screen = DMat4::from_cols_array_2d(&[
            [80.0, 0.0, 0.0, 0.0],
            [0.0, -60.0, 0.0, 0.0],
            [0.0, 0.0, 0.5, 0.0],
            [80.0, 60.0, 0.5, 1.0],
        ]);
        clip_to_screen * world_to_clip
    }

    #[test]
    fn a_plane_is_unoccluded() {
        let world_to_screen = distant_view();
        let plane = world_to_screen.inverse().transpose() * DVec4::Y;
        let nearest = (0..120).flat_map(|y| (0..160).map(move |x| [x, y])).map(|pixel| {
            let [x, y] = pixel.map(|c| f64::from(c) + 0.5);
            let depth = -(plane.x * x + plane.y * y + plane.w) / plane.z;
            let is_visible = depth > 0.0 && depth < 1.0;
            let depth = if is_visible { depth as f32 } else { 0.0 };
            SurfaceDepth { depth, ..SurfaceDepth::EMPTY }
        });
        let nearest: Vec<SurfaceDepth> = nearest.collect();
        let eye = [1012.6047, 434.8936, 1018.6047, 1.0];
        let across = DVec3::new(1.0, 0.0, -1.0).normalize() * 130.0;
        let size = [160, 120];
        let space = ScreenSpace::new(size, [0.5; 2], world_to_screen, DVec3::ZERO, eye, across);
        let occlusion = AmbientOcclusion::compute(&nearest, space, SimdLevel::best(), 1, None);
        assert!(nearest.iter().filter(|nearest| nearest.depth > 0.0).count() > 4000);
        for (y, x) in (0..120).flat_map(|y| (0..160).map(move |x| (y, x))) {
            assert_eq!(occlusion.visibilities.at([x, y], [0, 0]), 1.0, "at {x}, {y}");
        }
    }

    #[test]
    fn single_pixels_match_eight_at_once_bit_for_bit() {
        let size = [24, 8];
        let across = DVec3::new(1.0, 0.0, -1.0).normalize() * 130.0;
        let eye = [1012.6047, 434.8936, 1018.6047, 1.0];
        let space = ScreenSpace::new(size, [0.5; 2], distant_view(), DVec3::ZERO, eye, across);
        let mut depths = PixelGrid::default();
        depths.reset(size);
        // Rough ground with a hole.
        let depth = |at: u32| 0.5 + 0.01 * ((at * 7 + at / 24 * 5) % 11) as f32;
        depths.fill_from((0..24 * 8).map(|at| if at % 17 == 3 { 0.0 } else { depth(at) }));
        let (space, pattern, depths) = (&space, &Pattern::new(), &depths);
        let mut darkest = 1.0_f32;
        for (x, y) in [0, 8, 16].into_iter().flat_map(|x| (0..8).map(move |y| (x, y))) {
            let eight: [f32; LANES] = HorizonSearch { space, pattern, depths, x, y }.run();
            let single = search_one_by_one(space, pattern, depths, [x, y]);
            for lane in 0..LANES {
                // Both ignore background pixels.
                if depths.at([(x + lane) as i32, y as i32], [0, 0]) > 0.0 {
                    assert_eq!(eight[lane].to_bits(), single[lane].to_bits(), "{x} + {lane}, {y}");
                    darkest = darkest.min(eight[lane]);
                }
            }
        }
        assert!(darkest < 0.9, "no occlusion: {darkest}");
    }

    #[test]
    fn bounces_brighten_white_corners_but_not_black_ones() {
        // The paper's fit at visibility ½: a/8 + b/4 + c/2.
        let half = Lanes::<1>::splat(0.5);
        for (albedo, expected) in [(0.0, 0.464), (0.5, 0.681), (0.8, 0.811)] {
            let fit = add_bounces(half, Rgb::splat([albedo; 3])).lane(0)[0];
            assert!((fit - f32::max(expected, 0.5)).abs() < 2e-3, "{albedo}: {fit}");
        }
        let open = add_bounces(Lanes::<1>::ONE, Rgb::splat([0.3; 3])).lane(0)[0];
        assert!((open - 1.0).abs() < 2e-3, "{open}");
    }
}
