//! Depth buffers: the depths of a frame without colors, for reading or for a second pass.
//!
//! ```text
//!   Frame ─ depth_buffer ─► DepthBuffer ─ with_depth_buffer ─► another Frame
//! ```

use crate::sample_plane::{SamplePlane, pixel_index};
use crate::tile_grid::TileRect;
use crate::tile_loop::FilledTile;
use crate::{DepthCompare, Frame, RasterError, Samples, Surface};
use homog::PixelRect;

/// The depth at each sample of each pixel, rows from the top. Use it for shadow maps and depth
/// pre-passes.
///
/// ```
/// use homog::Point;
/// use raster::{DepthBuffer, Frame, Opacity, Samples, ScreenVertex, surface_fn};
///
/// let corners = [(0.0, 0.0), (8.0, 0.0), (0.0, 8.0)];
/// let triangle = corners.map(|(x, y)| ScreenVertex::snap(Point::new(x, y, 0.5), 1.0).unwrap());
/// let mut frame = Frame::new(8, 4, Samples::One)?;
/// frame.add_triangle(triangle, 0, Opacity::Opaque);
///
/// // Only the depth matters, so the surface has no color.
/// let nothing = surface_fn(|_| [0.0; 4]);
/// let depth: DepthBuffer = frame.depth_buffer(&nothing, 2);
/// assert_eq!(depth.depth(2, 1), 0.5);
/// assert_eq!(depth.depth(7, 3), f32::NEG_INFINITY);
/// # Ok::<(), raster::RasterError>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct DepthBuffer {
    region: PixelRect,
    samples: Samples,
    /// The depths of the first sample in all pixels, row by row, then of each other sample in turn.
    depths: Vec<f32>,
}

impl DepthBuffer {
    /// Creates a buffer with one depth sample per pixel, rows from the top. The depth of an empty
    /// pixel is −∞, or +∞ for [`DepthCompare::Less`].
    ///
    /// # Errors
    /// Returns [`RasterError::DepthCount`] unless there are `width` × `height` depths.
    pub fn from_depths(width: u32, height: u32, depths: Vec<f32>) -> Result<Self, RasterError> {
        let region = PixelRect::from_size(width, height);
        match depths.len() == region.area() {
            true => Ok(Self { region, samples: Samples::One, depths }),
            false => Err(RasterError::DepthCount { expected: region.area(), found: depths.len() }),
        }
    }

    /// Returns the width in pixels.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.region.width
    }

    /// Returns the height in pixels.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.region.height
    }

    /// Returns the depths at the first sample of each pixel, rows from the top. With one sample per
    /// pixel, the sample is at the center.
    #[must_use]
    pub fn depths(&self) -> &[f32] {
        &self.depths[..self.region.area()]
    }

    /// Returns the depth at the first sample of a pixel, or −∞ if the pixel is outside the buffer.
    #[must_use]
    pub fn depth(&self, x: u32, y: u32) -> f32 {
        let is_inside = x < self.region.width && y < self.region.height;
        let index = y as usize * self.region.width as usize + x as usize;
        if is_inside { self.depths[index] } else { f32::NEG_INFINITY }
    }

    /// Returns the number of depths.
    pub(crate) fn sample_count(&self) -> usize {
        self.depths.len()
    }

    /// Returns whether a frame has the same region and samples as this buffer.
    pub(crate) fn fits(&self, region: PixelRect, samples: Samples) -> bool {
        (self.region, self.samples) == (region, samples)
    }

    /// Initializes the sample plane of a tile with these depths.
    pub(crate) fn copy_into_plane(
        &self,
        compare: DepthCompare,
        sample: usize,
        rect: TileRect,
        plane: &mut SamplePlane,
    ) {
        let width = self.region.width as usize;
        let plane_depths = &self.depths[sample * self.region.area()..][..self.region.area()];
        for y in rect.top..rect.bottom {
            let row = (rect.y + y - self.region.y) as usize * width;
            let first = row + (rect.x + rect.left - self.region.x) as usize;
            for (x, &depth) in (rect.left..rect.right).zip(&plane_depths[first..]) {
                plane.depth[pixel_index(x as usize, y as usize)] = compare.to_internal(depth);
            }
        }
        plane.find_block_bounds(rect);
    }
}

impl Frame {
    /// Renders the depth at every sample, without color. Empty samples have −∞, or +∞ for
    /// [`DepthCompare::Less`], unless the frame has other initial depths.
    ///
    /// Masked primitives count where `surface` passes the alpha test; translucent primitives do not
    /// count. Uses up to `threads` threads; the result is the same for any number.
    #[must_use]
    pub fn depth_buffer<S: Surface>(&self, surface: &S, threads: usize) -> DepthBuffer {
        let (area, count) = (self.region.area(), self.samples.count());
        let empty = self.compare.to_internal(f32::NEG_INFINITY);
        // Depths are written to bands pixel by pixel, then rearranged sample by sample.
        let mut depths = match &self.initial_depth {
            Some(initial) => interleave(&initial.depths, count),
            None => vec![empty; area * count],
        };
        let mut pixels: Vec<&mut [f32]> = depths.chunks_exact_mut(count).collect();
        self.for_each_tile(
            surface,
            threads,
            &mut pixels,
            |_| (),
            |filled| {
                let FilledTile { tile, rect, band, .. } = filled;
                let left = (rect.x + rect.left - self.region.x) as usize;
                let rows = band.chunks_mut(self.region.width.max(1) as usize);
                for (y, row) in (rect.top..rect.bottom).zip(rows) {
                    for (x, target) in (rect.left..rect.right).zip(row.iter_mut().skip(left)) {
                        let at = pixel_index(x as usize, y as usize);
                        for (sample, depth) in target.iter_mut().enumerate() {
                            *depth = self.compare.to_internal(tile.sample_depth(sample, at));
                        }
                    }
                }
            },
        );
        let depths = (0..count).flat_map(|sample| depths.iter().skip(sample).step_by(count));
        DepthBuffer {
            region: self.region,
            samples: self.samples,
            depths: depths.copied().collect(),
        }
    }

    /// Draws the frame over the picture in `target`, which consists of linear colors, premultiplied
    /// by alpha, rows from the top. Pixels without a passing fragment keep their color.
    ///
    /// With the [depth buffer](Self::with_depth_buffer) of that picture, this is a second pass over
    /// it. Translucent primitives are blended by their alpha.
    pub fn draw_over<S: Surface>(&self, surface: &S, threads: usize, target: &mut [[f32; 4]]) {
        let mut layer = vec![[0.0; 4]; target.len()];
        self.draw(surface, [0.0; 4], threads, &mut layer, |color: [f32; 4]| color);
        for (below, above) in target.iter_mut().zip(layer) {
            let through = 1.0 - above[3];
            for (channel, color) in below.iter_mut().zip(above) {
                *channel = color + through * *channel;
            }
        }
    }
}

/// Reorders depths from sample by sample to pixel by pixel.
fn interleave(depths: &[f32], count: usize) -> Vec<f32> {
    let area = depths.len() / count.max(1);
    (0..area)
        .flat_map(|pixel| (0..count).map(move |sample| depths[sample * area + pixel]))
        .collect()
}
