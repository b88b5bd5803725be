//! The grid of tiles of 64 × 64 pixels, and the region of it that a frame shows.
//!
//! Tiles are counted from the upper left corner of the whole picture, even if a frame shows only a
//! region of it. A tile then has the same triangles with the same coordinates whichever region is
//! drawn, and regions fit together bit for bit.

use crate::MAX_SIDE;
use crate::screen_vertex::SUBPIXEL_BITS;
use homog::PixelRect;

/// The side of a tile in pixels.
///
/// The depths and triangle indices of one sample plane then take 32 KiB and stay in the fastest
/// caches while the tile is filled. Each row of a tile has eight blocks of eight pixels, to suit
/// vectors of eight lanes.
pub(crate) const TILE: u32 = 64;

/// Returns the columns of tiles that a region touches: the first, and one past the last.
pub(crate) fn tile_columns(region: PixelRect) -> (u32, u32) {
    (region.x / TILE, (region.x + region.width).div_ceil(TILE))
}

/// Returns the rows of tiles that a region touches: the first, and one past the last.
pub(crate) fn tile_rows(region: PixelRect) -> (u32, u32) {
    (region.y / TILE, (region.y + region.height).div_ceil(TILE))
}

/// Returns the tile in this column and row, with the pixels that the region shows.
pub(crate) fn tile_rect(region: PixelRect, column: u32, row: u32) -> TileRect {
    let (x, y) = (column * TILE, row * TILE);
    let clamp_to_tile = |from: u32, size: u32, corner: u32| {
        let first = from.saturating_sub(corner).min(TILE);
        (first, (from + size - corner).min(TILE))
    };
    let (left, right) = clamp_to_tile(region.x, region.width, x);
    let (top, bottom) = clamp_to_tile(region.y, region.height, y);
    TileRect { x, y, left, top, right, bottom }
}

/// Returns the number of pixel rows that a region shows in a row of tiles.
pub(crate) fn visible_rows(region: PixelRect, row: u32) -> usize {
    let TileRect { top, bottom, .. } = tile_rect(region, tile_columns(region).0, row);
    (bottom - top) as usize
}

/// A tile: the pixel at its upper left corner, and the pixels that the region shows.
///
/// `left` to `bottom` are relative to that corner: [left, right) × [top, bottom), within [0, 64).
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
    /// Returns whether the region shows a pixel of the tile; x and y are relative to the tile's
    /// corner.
    pub(crate) fn is_visible(&self, x: usize, y: usize) -> bool {
        let within = |at: usize, from: u32, to: u32| (from as usize..to as usize).contains(&at);
        within(x, self.left, self.right) && within(y, self.top, self.bottom)
    }
}

/// The rectangle of tiles that a region touches.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TileGrid {
    /// The first column, and one past the last.
    columns: (u32, u32),
    /// The first row, and one past the last.
    rows: (u32, u32),
}

/// The tiles that a triangle's bounds touch: the first and last column and row.
///
/// It takes four bytes per triangle and is stored separately, because binning reads nothing else.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileRange {
    columns: [u8; 2],
    rows: [u8; 2],
}

const _: () = assert!(MAX_SIDE / TILE == 256, "columns and rows are stored in eight bits");

impl TileGrid {
    pub(crate) fn new(region: PixelRect) -> Self {
        Self { columns: tile_columns(region), rows: tile_rows(region) }
    }

    /// Returns the number of tiles.
    pub(crate) fn count(self) -> usize {
        ((self.columns.1 - self.columns.0) * (self.rows.1 - self.rows.0)) as usize
    }

    /// Returns the index of a tile of the grid, row by row.
    #[inline(always)]
    pub(crate) fn tile_index(self, column: u32, row: u32) -> usize {
        ((row - self.rows.0) * (self.columns.1 - self.columns.0) + column - self.columns.0) as usize
    }

    /// Returns the tiles of the grid that a bounding rectangle touches, or `None` if it touches
    /// none.
    ///
    /// The minimum and maximum coordinates are in grid steps of 1/256 pixel.
    #[inline(always)]
    pub(crate) fn tiles_in_bounds(self, x: [i32; 2], y: [i32; 2]) -> Option<TileRange> {
        const TILE_BITS: u32 = SUBPIXEL_BITS + TILE.ilog2();
        let span = |[low, high]: [i32; 2], (begin, end): (u32, u32)| {
            [(low >> TILE_BITS).max(begin as i32), (high >> TILE_BITS).min(end as i32 - 1)]
        };
        let (columns, rows) = (span(x, self.columns), span(y, self.rows));
        let is_inside = (columns[0] <= columns[1]) & (rows[0] <= rows[1]);
        let bytes = |span: [i32; 2]| span.map(|tile| tile as u8);
        is_inside.then(|| TileRange { columns: bytes(columns), rows: bytes(rows) })
    }

    /// Returns the indices of the tiles in a range, row by row.
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
    fn tiles_of_a_region_show_each_pixel_once() {
        for region in [
            PixelRect { x: 0, y: 0, width: 64, height: 64 },
            PixelRect { x: 63, y: 1, width: 2, height: 200 },
            PixelRect { x: 70, y: 130, width: 3, height: 1 },
            PixelRect { x: 128, y: 64, width: 129, height: 65 },
        ] {
            let mut visible = 0;
            let ((left, right), (top, bottom)) = (tile_columns(region), tile_rows(region));
            for (column, row) in (top..bottom).flat_map(|y| (left..right).map(move |x| (x, y))) {
                let tile = tile_rect(region, column, row);
                assert!(tile.left < tile.right && tile.top < tile.bottom, "{region:?} {tile:?}");
                assert!(tile.x + tile.left >= region.x && tile.y + tile.top >= region.y);
                visible += (tile.right - tile.left) * (tile.bottom - tile.top);
            }
            assert_eq!(visible, region.width * region.height, "{region:?}");
        }
    }
}
