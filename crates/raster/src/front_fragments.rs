//! What is nearest in each pixel, layers and holes included: the visibility of a picture without its colours.

use crate::sample_plane::pixel_index;
use crate::tile_grid::TILE;
use crate::tile_loop::FilledTile;
use crate::tile_visibility::{TileVisibility, TranslucentLayer};
use crate::{Fragment, Frame, Surface};

/// The layers of one pixel of a filled tile, the farthest first, and its place.
struct PixelLayers<'a> {
    tile: &'a TileVisibility,
    layers: &'a [TranslucentLayer],
    /// The column and row in the tile.
    tile_position: [u32; 2],
    /// The column and row in the picture.
    image_position: [u32; 2],
}

impl Frame {
    /// Calls `note` with the nearest fragment of each pixel in which there is one, and keeps what it says in `target`: rows from
    /// the top, `width` × `height` of them. Uses up to `threads` threads.
    ///
    /// Nearest is what covers the first sample of the pixel, with one sample its centre. Translucent primitives count as they are, and
    /// masked ones where `surface` keeps them. Of translucent ones at the same depth it is the one given last, which is drawn over
    /// the others; of the others it is the one given first.
    pub fn map_front_fragments<S: Surface, P: Copy + Send>(
        &self,
        surface: &S,
        threads: usize,
        target: &mut [P],
        note: impl Fn(&Fragment<'_>) -> P + Sync,
    ) {
        self.for_each_pixel(surface, threads, target, |pixel, target| {
            let [x, y] = pixel.image_position;
            let layer = pixel.layers.iter().rev().find(|layer| layer.mask & 1 != 0);
            let [column, row] = pixel.tile_position.map(|c| c as usize);
            let solid = || pixel.tile.triangle(0, pixel_index(column, row));
            let piece = self.triangles.get(layer.map_or_else(solid, |layer| layer.triangle));
            if let Some(piece) = piece {
                *target = note(&Fragment::new(piece, &self.source_weights, x, y));
            }
        });
    }

    /// Counts the translucent fragments that cover the first sample of each pixel, those that `surface` does not keep left out.
    /// In a frame with all primitives given as translucent these are all that there are, hidden ones too: its overdraw.
    pub fn count_overdraw<S: Surface>(&self, surface: &S, threads: usize, target: &mut [u32]) {
        self.for_each_pixel(surface, threads, target, |pixel, target| {
            let [x, y] = pixel.image_position;
            let counts = |layer: &&TranslucentLayer| {
                let piece = self.triangles.triangle(layer.triangle);
                let keeps =
                    || surface.passes_alpha_test(&Fragment::new(piece, &self.source_weights, x, y));
                layer.mask & 1 != 0 && keeps()
            };
            *target = pixel.layers.iter().filter(counts).count() as u32;
        });
    }

    /// Fills tile after tile and calls `each` with every pixel of those that show something.
    fn for_each_pixel<S: Surface, P: Send>(
        &self,
        surface: &S,
        threads: usize,
        target: &mut [P],
        each: impl Fn(&PixelLayers<'_>, &mut P) + Sync,
    ) {
        let nothing = |_: &mut [P]| {};
        self.for_each_tile(
            surface,
            threads,
            target,
            nothing,
            |FilledTile { tile, rect, band, .. }| {
                for y in rect.top..rect.bottom {
                    let first = ((y - rect.top) * self.region.width + rect.x + rect.left
                        - self.region.x) as usize;
                    for x in rect.left..rect.right {
                        let number = (y * TILE + x) as u16;
                        let start = tile.layers.partition_point(|layer| layer.pixel < number);
                        let count =
                            tile.layers[start..].iter().take_while(|l| l.pixel == number).count();
                        let pixel = PixelLayers {
                            tile,
                            layers: &tile.layers[start..start + count],
                            tile_position: [x, y],
                            image_position: [rect.x + x, rect.y + y],
                        };
                        let at = first + (x - rect.left) as usize;
                        if let Some(target) = band.get_mut(at) {
                            each(&pixel, target);
                        }
                    }
                }
            },
        );
    }
}
