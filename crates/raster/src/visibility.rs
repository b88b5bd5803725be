//! Visibility without shading: which primitive is seen in each pixel, and how near it is.

use crate::grid::Part;
use crate::memory::{Memory, Worker};
use crate::plane::index_of;
use crate::primitive::Piece;
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
        let Part { x: left, y: top, width, height } = self.part;
        let size = width as usize * height as usize;
        let mut seen = Visibility { depth: vec![0.0; size], ids: vec![None; size] };
        self.each_seen(|x, y, depth, piece| {
            let at = (y - top) as usize * width as usize + (x - left) as usize;
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
        let Memory { mut bins, mut workers } = self.kept.take();
        bins.sort(&self.pieces, self.part, 1);
        workers.resize_with(workers.len().max(1), Worker::default);
        let Worker { list, tile, .. } = &mut workers[0];
        let ((left, right), (top, bottom)) = (self.part.columns(), self.part.rows());
        for (column, row) in (top..bottom).flat_map(|row| (left..right).map(move |c| (c, row))) {
            let rect = self.part.tile(column, row);
            list.clear();
            bins.list(column, row, list);
            if list.is_empty() {
                continue;
            }
            tile.fill(self, rect, list, &Whole);
            for (x, y) in
                (rect.top..rect.bottom).flat_map(|y| (rect.left..rect.right).map(move |x| (x, y)))
            {
                let at = index_of(x as usize, y as usize);
                if let Some(piece) = self.pieces.get(tile.piece(0, at)) {
                    each(rect.x + x, rect.y + y, tile.depth(0, at), piece);
                }
            }
        }
        self.kept.put(Memory { bins, workers });
    }
}
