//! Front fragments, for picking, and overdraw counts. Both take translucent layers and alpha-tested
//! holes into account.

use crate::sample_plane::{NO_TRIANGLE, pixel_index};
use crate::tile_grid::TILE;
use crate::tile_loop::FilledTile;
use crate::tile_visibility::{TileVisibility, TranslucentLayer};
use crate::{Fragment, Frame, Surface};

/// One pixel of a filled tile and its translucent layers, back to front.
struct PixelLayers<'a> {
    tile: &'a TileVisibility,
    layers: &'a [TranslucentLayer],
    /// The column and row in the tile.
    tile_position: [u32; 2],
    /// The column and row in the picture.
    image_position: [u32; 2],
}

impl PixelLayers<'_> {
    /// Returns the index of the nearest triangle that covers the first sample, or [`NO_TRIANGLE`].
    fn front_triangle(&self) -> u32 {
        let layer = self.layers.iter().rev().find(|layer| layer.mask & 1 != 0);
        let [column, row] = self.tile_position.map(|c| c as usize);
        let opaque = || self.tile.triangle(0, pixel_index(column, row));
        layer.map_or_else(opaque, |layer| layer.triangle)
    }
}

impl Frame {
    /// Calls `map` with the front fragment of each pixel that has one and writes the result to
    /// `target`: rows from the top, `width` × `height` values. Uses up to `threads` threads.
    ///
    /// The front fragment is the nearest fragment that covers the first sample of the pixel, which
    /// is at the pixel's center if there is only one sample. Translucent primitives count, and so
    /// do masked primitives where they pass the alpha test. At equal depth, the translucent
    /// primitive submitted last wins, because it is drawn over the others; among opaque primitives,
    /// the one submitted first wins.
    pub fn map_front_fragments<S: Surface, P: Copy + Send>(
        &self,
        surface: &S,
        threads: usize,
        target: &mut [P],
        map: impl Fn(&Fragment<'_>) -> P + Sync,
    ) {
        self.for_each_pixel(surface, threads, target, |pixel, target| {
            let [x, y] = pixel.image_position;
            if let Some(triangle) = self.triangles.get(pixel.front_triangle()) {
                *target = map(&Fragment::new(triangle, &self.source_weights, x, y));
            }
        });
    }

    /// Writes the primitive id of each pixel's front fragment to `target`, like
    /// [`map_front_fragments`](Self::map_front_fragments) with [`Fragment::id`], but faster: no
    /// weights are computed. Other pixels are left unchanged.
    pub fn write_front_ids<S: Surface>(&self, surface: &S, threads: usize, target: &mut [u32]) {
        let nothing = |_: &mut [u32]| {};
        self.for_each_tile(surface, threads, target, nothing, |filled| {
            // Neighbors usually show the same triangle.
            let (mut last, mut last_id) = (NO_TRIANGLE, None);
            let mut write = |front: u32, target: &mut u32| {
                if front != last {
                    (last, last_id) = (front, self.triangles.get(front).map(|found| found.id));
                }
                if let Some(id) = last_id {
                    *target = id;
                }
            };
            if !filled.tile.layers.is_empty() {
                return self.visit_pixels(filled, |pixel, target| {
                    write(pixel.front_triangle(), target);
                });
            }
            let FilledTile { tile, rect, band, .. } = filled;
            let column = (rect.x + rect.left - self.region.x) as usize;
            let columns = rect.left as usize..rect.right as usize;
            let rows = band.chunks_mut(self.region.width as usize);
            for (y, row) in (rect.top as usize..rect.bottom as usize).zip(rows) {
                for (x, target) in columns.clone().zip(&mut row[column..]) {
                    write(tile.triangle(0, pixel_index(x, y)), target);
                }
            }
        });
    }

    /// Counts the translucent fragments that cover the first sample of each pixel and pass the
    /// alpha test.
    ///
    /// In a frame whose primitives are all translucent, this is the overdraw: every fragment
    /// counts, even if it is hidden.
    pub fn count_overdraw<S: Surface>(&self, surface: &S, threads: usize, target: &mut [u32]) {
        self.for_each_pixel(surface, threads, target, |pixel, target| {
            let [x, y] = pixel.image_position;
            let counts = |layer: &&TranslucentLayer| {
                let triangle = self.triangles.triangle(layer.triangle);
                let fragment = || Fragment::new(triangle, &self.source_weights, x, y);
                layer.mask & 1 != 0 && surface.passes_alpha_test(&fragment())
            };
            *target = pixel.layers.iter().filter(counts).count() as u32;
        });
    }

    /// Fills the tiles and calls `each` with every pixel of tiles that have triangles.
    fn for_each_pixel<S: Surface, P: Send>(
        &self,
        surface: &S,
        threads: usize,
        target: &mut [P],
        each: impl Fn(&PixelLayers<'_>, &mut P) + Sync,
    ) {
        let nothing = |_: &mut [P]| {};
        self.for_each_tile(surface, threads, target, nothing, |filled| {
            self.visit_pixels(filled, &each);
        });
    }

    /// Calls `each` with every pixel of a filled tile, row by row.
    #[inline(always)]
    fn visit_pixels<P>(
        &self,
        filled: FilledTile<'_, P>,
        mut each: impl FnMut(&PixelLayers<'_>, &mut P),
    ) {
        let FilledTile { tile, rect, band, .. } = filled;
        for y in rect.top..rect.bottom {
            let column = rect.x + rect.left - self.region.x;
            let first = ((y - rect.top) * self.region.width + column) as usize;
            for x in rect.left..rect.right {
                // Layers are sorted by pixel.
                let pixel = (y * TILE + x) as u16;
                let start = tile.layers.partition_point(|layer| layer.pixel < pixel);
                let layers = &tile.layers[start..];
                let count = layers.iter().take_while(|layer| layer.pixel == pixel).count();
                let pixel = PixelLayers {
                    tile,
                    layers: &layers[..count],
                    tile_position: [x, y],
                    image_position: [rect.x + x, rect.y + y],
                };
                let index = first + (x - rect.left) as usize;
                if let Some(target) = band.get_mut(index) {
                    each(&pixel, target);
                }
            }
        }
    }
}
