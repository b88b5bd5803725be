//! The visibility buffer: the primitive visible in each pixel, and its depth.

use crate::buffer_pool::{DrawBuffers, ThreadBuffers};
use crate::primitive::ScreenTriangle;
use crate::sample_plane::pixel_index;
use crate::tile_grid::{tile_columns, tile_rect, tile_rows};
use crate::{Fragment, Frame, Surface};
use homog::PixelRect;

/// Depths and ids at the first sample of each pixel (at its center, with one sample), rows from the
/// top.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub struct VisibilityBuffer {
    /// Depth: 1 at the near plane, 0 at the far plane and for the background.
    pub depth: Vec<f32>,
    /// The ids with which the primitives were submitted; `None` for the background.
    pub ids: Vec<Option<u32>>,
}

/// A surface that passes every alpha test. Its color is never read.
struct OpaqueSurface;

impl Surface for OpaqueSurface {
    fn passes_alpha_test(&self, _: &Fragment<'_>) -> bool {
        true
    }
    fn shade(&self, _: &Fragment<'_>) -> [f32; 4] {
        [0.0; 4]
    }
}

impl Frame {
    /// Renders the visibility buffer: the nearest primitive of each pixel.
    ///
    /// Masked primitives count as opaque, and translucent primitives are ignored. Runs on the
    /// calling thread.
    #[must_use]
    pub fn visibility_buffer(&self) -> VisibilityBuffer {
        let PixelRect { x: left, y: top, width, .. } = self.region;
        let size = self.region.area();
        let mut buffer = VisibilityBuffer { depth: vec![0.0; size], ids: vec![None; size] };
        self.for_each_visible_pixel(|x, y, depth, triangle| {
            let at = (y - top) as usize * width as usize + (x - left) as usize;
            buffer.depth[at] = depth;
            buffer.ids[at] = Some(triangle.id);
        });
        buffer
    }

    /// Calls `each` with the fragment of the nearest primitive in each pixel that has one, tile by
    /// tile. These are the fragments of the [`visibility_buffer`](Self::visibility_buffer).
    pub fn for_each_fragment(&self, mut each: impl FnMut(Fragment<'_>)) {
        self.for_each_visible_pixel(|x, y, _, triangle| {
            each(Fragment::new(triangle, &self.source_weights, x, y));
        });
    }

    /// Calls `each(x, y, depth, triangle)` with every pixel that is not background.
    fn for_each_visible_pixel(&self, mut each: impl FnMut(u32, u32, f32, &ScreenTriangle)) {
        let DrawBuffers { mut bins, mut workers } = self.buffers.take_buffers();
        bins.bin_triangles(&self.triangles, self.region, 1);
        workers.resize_with(workers.len().max(1), ThreadBuffers::default);
        let ThreadBuffers { bin, tile, .. } = &mut workers[0];
        let ((left, right), (top, bottom)) = (tile_columns(self.region), tile_rows(self.region));
        for (column, row) in (top..bottom).flat_map(|row| (left..right).map(move |c| (c, row))) {
            let rect = tile_rect(self.region, column, row);
            bin.clear();
            bins.append_tile_bin(column, row, bin);
            if bin.is_empty() {
                continue;
            }
            // Remove the hidden surfaces of the tile, then read back its visible samples.
            tile.rasterize_bin(self, rect, bin, &OpaqueSurface);
            for (x, y) in
                (rect.top..rect.bottom).flat_map(|y| (rect.left..rect.right).map(move |x| (x, y)))
            {
                let at = pixel_index(x as usize, y as usize);
                if let Some(triangle) = self.triangles.get(tile.triangle(0, at)) {
                    let depth = self.compare.to_internal(tile.sample_depth(0, at));
                    each(rect.x + x, rect.y + y, depth, triangle);
                }
            }
        }
        self.buffers.recycle_buffers(DrawBuffers { bins, workers });
    }
}
