//! Visibility without shading: which primitive is seen in each pixel, and how near it is.

use crate::buffer_pool::{DrawBuffers, ThreadBuffers};
use crate::primitive::ScreenTriangle;
use crate::sample_plane::pixel_index;
use crate::tile_grid::FrameRegion;
use crate::{Fragment, Frame, Surface};

/// What is seen at the first sample of each pixel (its centre, with one sample), rows from the top.
#[derive(Clone, PartialEq, Debug)]
pub struct VisibilityBuffer {
    /// Depth: 1 at the near plane, 0 at the far plane and where nothing is seen.
    pub depth: Vec<f32>,
    /// The names of the primitives; `None` where nothing is seen.
    pub ids: Vec<Option<u32>>,
}

/// A surface for when nobody looks at colours.
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
    /// Finds the nearest primitive of each pixel. Masked primitives count as whole, translucent ones as absent.
    #[must_use]
    pub fn visibility_buffer(&self) -> VisibilityBuffer {
        let FrameRegion { x: left, y: top, width, height } = self.region;
        let size = width as usize * height as usize;
        let mut seen = VisibilityBuffer { depth: vec![0.0; size], ids: vec![None; size] };
        self.for_each_visible_pixel(|x, y, depth, piece| {
            let at = (y - top) as usize * width as usize + (x - left) as usize;
            seen.depth[at] = depth;
            seen.ids[at] = Some(piece.id);
        });
        seen
    }

    /// Calls `each` with the fragment of the nearest primitive of each pixel where there is one, as
    /// [`visibility_buffer`](Self::visibility_buffer) sees it, tile by tile.
    pub fn for_each_fragment(&self, mut each: impl FnMut(Fragment<'_>)) {
        self.for_each_visible_pixel(|x, y, _, piece| {
            each(Fragment::new(piece, &self.source_weights, x, y));
        });
    }

    fn for_each_visible_pixel(&self, mut each: impl FnMut(u32, u32, f32, &ScreenTriangle)) {
        let DrawBuffers { mut bins, mut workers } = self.buffers.take_buffers();
        bins.bin_triangles(&self.triangles, self.region, 1);
        workers.resize_with(workers.len().max(1), ThreadBuffers::default);
        let ThreadBuffers { bin: list, tile, .. } = &mut workers[0];
        let ((left, right), (top, bottom)) = (self.region.tile_columns(), self.region.tile_rows());
        for (column, row) in (top..bottom).flat_map(|row| (left..right).map(move |c| (c, row))) {
            let rect = self.region.tile_rect(column, row);
            list.clear();
            bins.append_tile_bin(column, row, list);
            if list.is_empty() {
                continue;
            }
            tile.rasterize_bin(self, rect, list, &OpaqueSurface);
            for (x, y) in
                (rect.top..rect.bottom).flat_map(|y| (rect.left..rect.right).map(move |x| (x, y)))
            {
                let at = pixel_index(x as usize, y as usize);
                if let Some(piece) = self.triangles.get(tile.triangle(0, at)) {
                    each(rect.x + x, rect.y + y, tile.sample_depth(0, at), piece);
                }
            }
        }
        self.buffers.recycle_buffers(DrawBuffers { bins, workers });
    }
}
