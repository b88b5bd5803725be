//! Visibility without shading: which primitive is seen in each pixel, and how near it is.

use crate::bins::{Bins, TILE};
use crate::plane::index_of;
use crate::primitive::Piece;
use crate::setup::TileRect;
use crate::tile::Tile;
use crate::{Fragment, Frame, Surface};

/// What is seen at the first sample of each pixel (its centre, with one sample), rows from the top.
#[derive(Clone, PartialEq, Debug)]
pub struct Visibility {
    /// Depth: 1 at the near plane, 0 at the far plane and where nothing is seen.
    pub depth: Vec<f32>,
    /// The names of the primitives; `None` where nothing is seen.
    pub ids: Vec<Option<u32>>,
}

/// A surface for when nobody looks at colours.
struct Whole;

impl Surface for Whole {
    fn keeps(&self, _: &Fragment<'_>) -> bool {
        true
    }
    fn shade(&self, _: &Fragment<'_>) -> [f32; 4] {
        [0.0; 4]
    }
}

impl Frame {
    /// Finds the nearest primitive of each pixel. Masked primitives count as whole, translucent ones as absent.
    #[must_use]
    pub fn visibility(&self) -> Visibility {
        let size = self.width as usize * self.height as usize;
        let mut seen = Visibility { depth: vec![0.0; size], ids: vec![None; size] };
        self.each_seen(|x, y, depth, piece| {
            let at = y as usize * self.width as usize + x as usize;
            seen.depth[at] = depth;
            seen.ids[at] = Some(piece.id);
        });
        seen
    }

    /// Calls `each` with the fragment of the nearest primitive of each pixel where there is one, as
    /// [`visibility`](Self::visibility) sees it, tile by tile.
    pub fn fragments(&self, mut each: impl FnMut(Fragment<'_>)) {
        self.each_seen(|x, y, _, piece| {
            each(Fragment::new(piece, &self.source_weights, x, y));
        });
    }

    fn each_seen(&self, mut each: impl FnMut(u32, u32, f32, &Piece)) {
        let bins = Bins::sort(&self.pieces, self.width, self.height);
        let mut tile = Tile::default();
        for row in 0..self.height.div_ceil(TILE) {
            for column in 0..self.width.div_ceil(TILE) {
                let rect = TileRect::of(column, row, self.width, self.height);
                tile.fill(self, rect, bins.of(column, row), &Whole);
                for pixel in 0..rect.width() * rect.height() {
                    let (x, y) = (pixel % rect.width(), pixel / rect.width());
                    let at = index_of(x, y);
                    let seen = self.pieces.get(tile.piece(0, at) as usize);
                    let Some(piece) = seen else { continue };
                    each(rect.x0 + x as u32, rect.y0 + y as u32, tile.depth(0, at), piece);
                }
            }
        }
    }
}
