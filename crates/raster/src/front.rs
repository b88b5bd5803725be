//! What is nearest in each pixel, layers and holes included: the visibility of a picture without its colours.

use crate::grid::TILE;
use crate::plane::index_of;
use crate::tile::{Layer, Tile};
use crate::walk::Filled;
use crate::{Fragment, Frame, Surface};

/// The layers of one pixel of a filled tile, the farthest first, and its place.
struct Pixel<'a> {
    tile: &'a Tile,
    layers: &'a [Layer],
    /// The column and row in the tile.
    within: [u32; 2],
    /// The column and row in the picture.
    place: [u32; 2],
}

impl Frame {
    /// Calls `note` with the nearest fragment of each pixel in which there is one, and keeps what it says in `target`: rows from
    /// the top, `width` × `height` of them. Uses up to `threads` threads.
    ///
    /// Nearest is what covers the first sample of the pixel, with one sample its centre. Translucent primitives count as they are, and
    /// masked ones where `surface` keeps them. Of translucent ones at the same depth it is the one given last, which is drawn over
    /// the others; of the others it is the one given first.
    pub fn front<S: Surface, P: Copy + Send>(
        &self,
        surface: &S,
        threads: usize,
        target: &mut [P],
        note: impl Fn(&Fragment<'_>) -> P + Sync,
    ) {
        self.each_pixel(surface, threads, target, |pixel, target| {
            let [x, y] = pixel.place;
            let layer = pixel.layers.iter().rev().find(|layer| layer.mask & 1 != 0);
            let [column, row] = pixel.within.map(|c| c as usize);
            let solid = || pixel.tile.piece(0, index_of(column, row));
            let piece = self.pieces.get(layer.map_or_else(solid, |layer| layer.piece));
            if let Some(piece) = piece {
                *target = note(&Fragment::new(piece, &self.source_weights, x, y));
            }
        });
    }

    /// Counts the translucent fragments that cover the first sample of each pixel, those that `surface` does not keep left out.
    /// In a frame with all primitives given as translucent these are all that there are, hidden ones too: its overdraw.
    pub fn count_layers<S: Surface>(&self, surface: &S, threads: usize, target: &mut [u32]) {
        self.each_pixel(surface, threads, target, |pixel, target| {
            let [x, y] = pixel.place;
            let counts = |layer: &&Layer| {
                let piece = self.pieces.at(layer.piece);
                let keeps = || surface.keeps(&Fragment::new(piece, &self.source_weights, x, y));
                layer.mask & 1 != 0 && keeps()
            };
            *target = pixel.layers.iter().filter(counts).count() as u32;
        });
    }

    /// Fills tile after tile and calls `each` with every pixel of those that show something.
    fn each_pixel<S: Surface, P: Send>(
        &self,
        surface: &S,
        threads: usize,
        target: &mut [P],
        each: impl Fn(&Pixel<'_>, &mut P) + Sync,
    ) {
        let nothing = |_: &mut [P]| {};
        self.each_tile(surface, threads, target, nothing, |Filled { tile, rect, band, .. }| {
            for y in rect.top..rect.bottom {
                let first =
                    ((y - rect.top) * self.part.width + rect.x + rect.left - self.part.x) as usize;
                for x in rect.left..rect.right {
                    let number = (y * TILE + x) as u16;
                    let start = tile.layers.partition_point(|layer| layer.pixel < number);
                    let count =
                        tile.layers[start..].iter().take_while(|l| l.pixel == number).count();
                    let pixel = Pixel {
                        tile,
                        layers: &tile.layers[start..start + count],
                        within: [x, y],
                        place: [rect.x + x, rect.y + y],
                    };
                    let at = first + (x - rect.left) as usize;
                    if let Some(target) = band.get_mut(at) {
                        each(&pixel, target);
                    }
                }
            }
        });
    }
}
