//! Surface depths: the depth plane of the nearest surface at each pixel, for shadow maps and
//! ambient occlusion.
//!
//! The slopes make it possible to compare depths away from the pixel center without a constant bias
//! (receiver-plane depth).

use crate::sample_plane::pixel_index;
use crate::tile_loop::FilledTile;
use crate::triangle_setup::clamped_depth_slopes;
use crate::{Frame, Surface};

/// The depth of the nearest surface in a pixel, and its change from pixel to pixel.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct SurfaceDepth {
    /// Depth: 1 at the near plane, 0 at the far plane; −∞ for the background.
    pub depth: f32,
    /// The change of depth per pixel to the right, on the surface's plane.
    ///
    /// Its magnitude is at most the range of the vertex depths, because the plane of a triangle
    /// smaller than a pixel is meaningless outside the triangle.
    pub dx: f32,
    /// The change of depth per pixel down, limited likewise.
    pub dy: f32,
}

impl SurfaceDepth {
    /// The background: no surface.
    pub const EMPTY: Self = Self { depth: f32::NEG_INFINITY, dx: 0.0, dy: 0.0 };
}

impl Frame {
    /// Finds the nearest opaque surface at the first sample of each pixel and writes its depth to
    /// `target`: `width` × `height` values, rows from the top.
    ///
    /// Pixels without a surface keep the target's value, such as [`SurfaceDepth::EMPTY`].
    ///
    /// The sample is at [`Samples::first_offset`](crate::Samples::first_offset) in each pixel; with
    /// one sample, it is at the center. Depths are not extrapolated to another position: beyond the
    /// edge of a steep surface, the error would be large.
    ///
    /// Masked primitives count where they pass the alpha test; translucent primitives do not count.
    /// Uses up to `threads` threads; the result is the same for any number.
    pub fn surface_depths<S: Surface>(
        &self,
        surface: &S,
        threads: usize,
        target: &mut [SurfaceDepth],
    ) {
        self.for_each_tile(surface, threads, target, |_| (), |filled| self.write_depths(filled));
    }

    /// Writes the depths of a tile to its band.
    fn write_depths(&self, filled: FilledTile<'_, SurfaceDepth>) {
        let FilledTile { tile, rect, band, .. } = filled;
        let left = (rect.x + rect.left - self.region.x) as usize;
        let rows = band.chunks_mut(self.region.width.max(1) as usize);
        // Neighbors usually show the same triangle, so its slopes are computed once.
        let (mut last, mut slopes) = (u32::MAX, None);
        for (y, row) in (rect.top..rect.bottom).zip(rows) {
            for (x, target) in (rect.left..rect.right).zip(row.iter_mut().skip(left)) {
                let at = pixel_index(x as usize, y as usize);
                let index = tile.triangle(0, at);
                if index != last {
                    (last, slopes) = (index, self.triangles.get(index).map(clamped_depth_slopes));
                }
                if let Some(slopes) = slopes {
                    let [dx, dy] = slopes.map(|slope| self.compare.to_internal(slope));
                    let depth = self.compare.to_internal(tile.sample_depth(0, at));
                    *target = SurfaceDepth { depth, dx, dy };
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Fragment, Opacity, Samples, ScreenVertex};
    use homog::Point;

    /// A surface whose alpha test keeps the left half.
    struct Left;

    impl Surface for Left {
        fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool {
            fragment.x < 50
        }
        fn shade(&self, _: &Fragment<'_>) -> [f32; 4] {
            [0.0; 4]
        }
    }

    fn sloped(cover: Opacity) -> Frame {
        let mut frame = Frame::new(100, 70, Samples::One).expect("a frame");
        // The depth is 0.1 + x / 200 + y / 400 everywhere.
        let corner = |x: f64, y: f64| {
            let depth = 0.1 + x / 200.0 + y / 400.0;
            ScreenVertex::snap(Point::new(x, y, depth), 1.0).expect("a corner")
        };
        frame.add_triangle([corner(0.0, 0.0), corner(0.0, 200.0), corner(200.0, 0.0)], 3, cover);
        frame
    }

    #[test]
    fn planes_match_the_triangles_for_any_number_of_threads() {
        let mut target = vec![SurfaceDepth::EMPTY; 7000];
        let mut other = target.clone();
        sloped(Opacity::Opaque).surface_depths(&Left, 1, &mut target);
        sloped(Opacity::Opaque).surface_depths(&Left, 3, &mut other);
        assert!(target == other);
        for (at, nearest) in target.iter().enumerate() {
            let (x, y) = ((at % 100) as f32 + 0.5, (at / 100) as f32 + 0.5);
            assert!((nearest.depth - (0.1 + x / 200.0 + y / 400.0)).abs() < 1e-6);
            assert!((nearest.dx - 0.005).abs() < 1e-7 && (nearest.dy - 0.0025).abs() < 1e-7);
        }
    }

    #[test]
    fn holes_and_translucent_surfaces_are_skipped() {
        let mut target = vec![SurfaceDepth::EMPTY; 7000];
        sloped(Opacity::Masked).surface_depths(&Left, 1, &mut target);
        assert!((0..7000).all(|at| (target[at].depth > 0.0) == (at % 100 < 50)));
        target.fill(SurfaceDepth::EMPTY);
        sloped(Opacity::Translucent).surface_depths(&Left, 1, &mut target);
        assert!(target.iter().all(|nearest| *nearest == SurfaceDepth::EMPTY));
    }
}
