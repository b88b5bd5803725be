//! The tiles of a picture, and the part of them that a frame shows.
//!
//! Tiles are counted from the upper left corner of the whole picture, also where a frame is a part of it. A tile then sees
//! the same triangles in the same numbers whichever part is drawn, and parts fit together bit for bit.

use crate::MAX_SIDE;
use crate::screen_vertex::SUBPIXEL_BITS;

/// The side of a tile in pixels: its depth and names stay in the nearest caches while it is filled.
pub(crate) const TILE: u32 = 64;

/// A rectangle of whole pixels: [x, x + width) × [y, y + height), y down.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct FrameRegion {
    pub(crate) x: u32,
    pub(crate) y: u32,
    pub(crate) width: u32,
    pub(crate) height: u32,
}

impl FrameRegion {
    /// The columns of tiles that the part touches: the first, and the one behind the last.
    pub(crate) fn tile_columns(&self) -> (u32, u32) {
        (self.x / TILE, (self.x + self.width).div_ceil(TILE))
    }

    /// The rows of tiles that the part touches.
    pub(crate) fn tile_rows(&self) -> (u32, u32) {
        (self.y / TILE, (self.y + self.height).div_ceil(TILE))
    }

    /// The tile in the given column and row, with what of it the part shows.
    pub(crate) fn tile_rect(&self, column: u32, row: u32) -> TileRect {
        let (x, y) = (column * TILE, row * TILE);
        let within = |from: u32, size: u32, corner: u32| {
            let first = from.saturating_sub(corner).min(TILE);
            (first, (from + size - corner).min(TILE))
        };
        let (left, right) = within(self.x, self.width, x);
        let (top, bottom) = within(self.y, self.height, y);
        TileRect { x, y, left, top, right, bottom }
    }

    /// How many rows of pixels a row of tiles shows.
    pub(crate) fn visible_rows(&self, row: u32) -> usize {
        let TileRect { top, bottom, .. } = self.tile_rect(self.tile_columns().0, row);
        (bottom - top) as usize
    }
}

/// A tile: its corner in the picture, and the pixels of it that are shown, counted from that corner:
/// [left, right) × [top, bottom).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct TileRect {
    pub(crate) x: u32,
    pub(crate) y: u32,
    pub(crate) left: u32,
    pub(crate) top: u32,
    pub(crate) right: u32,
    pub(crate) bottom: u32,
}

impl TileRect {
    /// Whether a pixel of the tile is shown.
    pub(crate) fn is_visible(&self, x: usize, y: usize) -> bool {
        let within = |at: usize, from: u32, to: u32| (from as usize..to as usize).contains(&at);
        within(x, self.left, self.right) && within(y, self.top, self.bottom)
    }
}

/// The tiles that a part touches.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TileGrid {
    /// The first column, and the one behind the last.
    columns: (u32, u32),
    rows: (u32, u32),
}

/// A rectangle of tiles: the first and the last of its columns and of its rows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileRange {
    columns: [u8; 2],
    rows: [u8; 2],
}

const _: () = assert!(MAX_SIDE / TILE == 256, "columns and rows are kept in eight bits");

impl TileGrid {
    pub(crate) fn new(part: FrameRegion) -> Self {
        Self { columns: part.tile_columns(), rows: part.tile_rows() }
    }

    /// How many there are.
    pub(crate) fn count(self) -> usize {
        ((self.columns.1 - self.columns.0) * (self.rows.1 - self.rows.0)) as usize
    }

    /// The place of a tile among all, row by row.
    #[inline(always)]
    pub(crate) fn tile_index(self, column: u32, row: u32) -> usize {
        ((row - self.rows.0) * (self.columns.1 - self.columns.0) + column - self.columns.0) as usize
    }

    /// Those that bounds touch, given by the least and the greatest coordinates in grid steps; `None` if there are none.
    #[inline(always)]
    pub(crate) fn tiles_in_bounds(self, x: [i32; 2], y: [i32; 2]) -> Option<TileRange> {
        const TILE_BITS: u32 = SUBPIXEL_BITS + TILE.ilog2();
        let span = |[low, high]: [i32; 2], (begin, end): (u32, u32)| {
            [(low >> TILE_BITS).max(begin as i32), (high >> TILE_BITS).min(end as i32 - 1)]
        };
        let (columns, rows) = (span(x, self.columns), span(y, self.rows));
        let is_there = (columns[0] <= columns[1]) & (rows[0] <= rows[1]);
        let bytes = |span: [i32; 2]| span.map(|tile| tile as u8);
        is_there.then(|| TileRange { columns: bytes(columns), rows: bytes(rows) })
    }

    /// The places of some tiles among all.
    #[inline(always)]
    pub(crate) fn tile_indices(self, tiles: TileRange) -> impl Iterator<Item = usize> {
        let TileRange { columns: [left, right], rows: [top, bottom] } = tiles;
        let rows = u32::from(top)..u32::from(bottom) + 1;
        rows.flat_map(move |row| {
            let first = self.tile_index(u32::from(left), row);
            first..first + usize::from(right - left) + 1
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_of_a_part_show_each_of_its_pixels_once() {
        for part in [
            FrameRegion { x: 0, y: 0, width: 64, height: 64 },
            FrameRegion { x: 63, y: 1, width: 2, height: 200 },
            FrameRegion { x: 70, y: 130, width: 3, height: 1 },
            FrameRegion { x: 128, y: 64, width: 129, height: 65 },
        ] {
            let mut shown = 0;
            for row in part.tile_rows().0..part.tile_rows().1 {
                for column in part.tile_columns().0..part.tile_columns().1 {
                    let tile = part.tile_rect(column, row);
                    assert!(tile.left < tile.right && tile.top < tile.bottom, "{part:?} {tile:?}");
                    assert!(tile.x + tile.left >= part.x && tile.y + tile.top >= part.y);
                    shown += (tile.right - tile.left) * (tile.bottom - tile.top);
                }
            }
            assert_eq!(shown, part.width * part.height, "{part:?}");
        }
    }
}
