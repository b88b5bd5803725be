//! From a filled tile to colours: each visible piece is shaded once per pixel, eight fragments at a time.
//!
//! Most rows of eight neighbouring pixels show one piece in each pixel: they are shaded as they lie. Of pixels on edges only the
//! pieces that others than the first sample see are left over ([`Edges`]). What lies under layers is gathered fragment by
//! fragment, shaded eight at a time and put together sample by sample.

use crate::edges::Edges;
use crate::fragments::{Eight, WIDE};
use crate::grid::{Part, TILE, TileRect};
use crate::layered::Layered;
use crate::plane::{NOTHING, index_of};
use crate::primitive::Piece;
use crate::tile::{Layer, Tile};
use crate::{Encode, Fragments, Frame, Surface};

/// A filled tile on its way to colours.
pub(crate) struct Resolve<'a, S> {
    pub(crate) frame: &'a Frame,
    pub(crate) surface: &'a S,
    pub(crate) background: [f32; 4],
    pub(crate) tile: &'a Tile,
    pub(crate) rect: TileRect,
}

/// What a piece adds to a pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Share {
    /// The pixel's column within the tile.
    pub(crate) x: u32,
    pub(crate) piece: u32,
    /// The samples it is seen by, bit by bit.
    pub(crate) mask: u16,
    /// Whether it lets through what is behind it.
    pub(crate) translucent: bool,
}

/// What a row of the tile shows that cannot be written at once; kept so that its memory is used again.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    edges: Edges,
    layered: Layered,
}

/// Neighbouring pixels of a row, all in one block, with the layers over them.
pub(crate) struct Run<'a> {
    pub(crate) y: u32,
    /// The columns within the tile.
    pub(crate) lanes: std::ops::Range<u32>,
    pub(crate) over: &'a [Layer],
}

impl Run<'_> {
    /// The first column of the block.
    pub(crate) fn block(&self) -> u32 {
        self.lanes.start / WIDE as u32 * WIDE as u32
    }
}

impl<S: Surface> Resolve<'_, S> {
    /// Writes what the tile shows into its band: the rows of the frame that the tile's row shows, filled with the background.
    #[inline(always)]
    pub(crate) fn write<P: Copy>(
        &self,
        band: &mut [P],
        scratch: &mut Scratch,
        encode: &impl Encode<P>,
    ) {
        let TileRect { x, left, top, right, bottom, .. } = self.rect;
        let Part { x: from, width, .. } = self.frame.part;
        let empty = encode.pixel(self.background);
        let mut layers = self.tile.layers.as_slice();
        for y in top..bottom {
            let start = (y - top) as usize * width as usize + (x + left - from) as usize;
            let Some(row) = band.get_mut(start..start + (right - left) as usize) else { return };
            let over;
            (over, layers) = split_before(layers, ((y + 1) * TILE) as usize);
            self.write_row(y, over, row, empty, encode, scratch);
            self.write_edges(y, row, encode, &mut scratch.edges);
            self.write_layered(y, row, encode, &mut scratch.layered);
        }
    }

    /// Writes those pixels of a row that show one piece each, and gathers what the others show.
    #[inline(always)]
    fn write_row<P: Copy>(
        &self,
        y: u32,
        mut layers: &[Layer],
        row: &mut [P],
        empty: P,
        encode: &impl Encode<P>,
        scratch: &mut Scratch,
    ) {
        let TileRect { left, right, .. } = self.rect;
        let Scratch { edges, layered } = scratch;
        layered.shares.clear();
        edges.clear();
        let mut rest = row;
        let wide = WIDE as u32;
        for block in left / wide..right.div_ceil(wide) {
            let lanes = left.max(block * wide)..right.min((block + 1) * wide);
            let targets;
            (targets, rest) = rest.split_at_mut(lanes.len());
            let over;
            (over, layers) = split_before(layers, (y * TILE + lanes.end) as usize);
            let run = Run { y, lanes, over };
            if !run.over.is_empty() {
                self.gather(&run, &mut layered.shares);
                continue;
            }
            match self.uniform(&run) {
                Some(pieces) => self.write_uniform(&run, pieces, targets, empty, encode),
                None => self.begin_edges(&run, edges),
            }
        }
    }

    /// The pieces that the pixels of a run see, if each pixel sees just one.
    #[inline(always)]
    fn uniform(&self, run: &Run<'_>) -> Option<[u32; WIDE]> {
        let at = index_of(run.block() as usize, run.y as usize);
        let first = self.tile.pieces(0, at);
        let mut differs = 0;
        for sample in 1..self.frame.samples.count() {
            let pieces = self.tile.pieces(sample, at);
            for lane in 0..WIDE {
                differs |= pieces[lane] ^ first[lane];
            }
        }
        (differs == 0).then_some(first)
    }

    /// The pieces that the samples of a run see.
    #[inline(always)]
    pub(crate) fn planes<'p>(
        &self,
        run: &Run<'_>,
        planes: &'p mut [[u32; WIDE]; 16],
    ) -> &'p [[u32; WIDE]] {
        let at = index_of(run.block() as usize, run.y as usize);
        let planes = &mut planes[..self.frame.samples.count()];
        for (sample, pieces) in planes.iter_mut().enumerate() {
            *pieces = self.tile.pieces(sample, at);
        }
        planes
    }

    /// Writes neighbouring pixels with one piece each.
    #[inline(always)]
    fn write_uniform<P: Copy>(
        &self,
        run: &Run<'_>,
        pieces: [u32; WIDE],
        targets: &mut [P],
        empty: P,
        encode: &impl Encode<P>,
    ) {
        let differs = differ(pieces);
        if !differs && pieces[0] == NOTHING {
            return;
        }
        let [r, g, b] = self.shade_neighbours(run, pieces, differs);
        let mut pixels = encode.eight(&[r, g, b, [1.0; WIDE]]);
        if differs {
            for (pixel, piece) in pixels.iter_mut().zip(pieces) {
                *pixel = if piece == NOTHING { empty } else { *pixel };
            }
        }
        if let Ok(targets) = <&mut [P; WIDE]>::try_from(&mut *targets) {
            *targets = pixels;
        } else {
            let first = (run.lanes.start - run.block()) as usize;
            targets.copy_from_slice(&pixels[first..first + targets.len()]);
        }
    }

    /// The colours of a run with one piece for each pixel, and whether they differ. Pixels that show nothing get any colour.
    #[inline(always)]
    fn shade_neighbours(&self, run: &Run<'_>, pieces: [u32; WIDE], differs: bool) -> [Eight; 3] {
        let (x, y) = (self.rect.x + run.block(), self.rect.y + run.y);
        let [r, g, b, _] = if differs {
            self.shade_several(pieces, x, y)
        } else {
            let piece = self.piece(pieces[0]);
            self.surface.shade_eight(&Fragments::of_one(piece, &self.frame.source_weights, x, y))
        };
        [r, g, b]
    }

    /// Shades eight pixels from (x, y) to the right, not all of which show the same; those that show nothing get any colour.
    #[inline(always)]
    fn shade_several(&self, pieces: [u32; WIDE], x: u32, y: u32) -> [Eight; 4] {
        // Nothing is the largest number: the least is a piece. Pixels that show nothing repeat the one that shows it, so that no
        // surface is asked for a place where it is not.
        let (mut any, mut place) = (NOTHING, 0);
        for (lane, &piece) in pieces.iter().enumerate() {
            if piece < any {
                (any, place) = (piece, lane as u32);
            }
        }
        let mut seen = [self.piece(any); WIDE];
        let mut columns = [x + place; WIDE];
        for lane in 0..WIDE {
            if pieces[lane] != NOTHING {
                columns[lane] = x + lane as u32;
                seen[lane] = self.piece(pieces[lane]);
            }
        }
        let fragments = Fragments::of_each(seen, &self.frame.source_weights, columns, y);
        self.surface.shade_eight(&fragments)
    }

    #[inline(always)]
    fn piece(&self, number: u32) -> &Piece {
        self.frame.pieces.at(number)
    }

    /// Shades what the first samples of a run see, and takes note of what the others see.
    #[inline(always)]
    fn begin_edges(&self, run: &Run<'_>, edges: &mut Edges) {
        let mut planes = [[NOTHING; WIDE]; 16];
        let planes = self.planes(run, &mut planes);
        let first = planes[0];
        let differs = differ(first);
        let [r, g, b] = if differs || first[0] != NOTHING {
            self.shade_neighbours(run, first, differs)
        } else {
            [[0.0; WIDE]; 3]
        };
        let mut colors = [r, g, b, [1.0; WIDE]];
        for (color, background) in colors.iter_mut().zip(self.background) {
            for lane in 0..WIDE {
                color[lane] = if first[lane] == NOTHING { background } else { color[lane] };
            }
        }
        let lanes = run.lanes.start - run.block()..run.lanes.end - run.block();
        let lanes = lanes.start as usize..lanes.end as usize;
        edges.add_eight(run.block() as usize / WIDE, lanes, planes, &colors);
    }

    /// Adds what is left of the pixels on the edges of a row, and writes them.
    #[inline(always)]
    fn write_edges<P: Copy>(
        &self,
        y: u32,
        row: &mut [P],
        encode: &impl Encode<P>,
        edges: &mut Edges,
    ) {
        for from in (0..edges.others().len()).step_by(WIDE) {
            let end = edges.others().len().min(from + WIDE);
            let others = &edges.others()[from..end];
            let colors = self.shade_shares(others, self.fragments(y, others).as_ref());
            edges.add_others(from..end, &colors);
        }
        let (left, right) = (self.rect.left as usize, self.rect.right as usize);
        for (block, means) in edges.means(self.frame.samples) {
            let pixels = encode.eight(&means);
            let (first, end) = ((block * WIDE).max(left), ((block + 1) * WIDE).min(right));
            row[first - left..end - left]
                .copy_from_slice(&pixels[first - block * WIDE..end - block * WIDE]);
        }
    }

    /// The fragments of up to eight shares of a row, not all of nothing; those of nothing repeat another.
    #[inline(always)]
    pub(crate) fn fragments(&self, y: u32, shares: &[Share]) -> Option<Fragments<'_>> {
        let any = shares.iter().find(|share| share.piece != NOTHING)?;
        let mut seen = [self.piece(any.piece); WIDE];
        let mut columns = [self.rect.x + any.x; WIDE];
        for (lane, share) in shares.iter().enumerate().filter(|(_, share)| share.piece != NOTHING) {
            seen[lane] = self.piece(share.piece);
            columns[lane] = self.rect.x + share.x;
        }
        Some(Fragments::of_each(seen, &self.frame.source_weights, columns, self.rect.y + y))
    }

    /// The colours of up to eight shares of a row, by their [fragments](Self::fragments); those of nothing have the background's.
    #[inline(always)]
    pub(crate) fn shade_shares(
        &self,
        shares: &[Share],
        fragments: Option<&Fragments<'_>>,
    ) -> [Eight; 4] {
        let mut colors = [[0.0; WIDE]; 4];
        if let Some(fragments) = fragments {
            colors = self.surface.shade_eight(fragments);
        }
        for (lane, share) in shares.iter().enumerate() {
            if share.piece == NOTHING {
                for (color, background) in colors.iter_mut().zip(self.background) {
                    color[lane] = background;
                }
            } else if !share.translucent {
                colors[3][lane] = 1.0;
            }
        }
        colors
    }
}

/// Whether not all are the same.
#[inline(always)]
fn differ(pieces: [u32; WIDE]) -> bool {
    let mut differs = 0;
    for piece in pieces {
        differs |= piece ^ pieces[0];
    }
    differs != 0
}

/// Splits layers, which are sorted by pixel, into those of pixels before `end` and the rest.
#[inline]
pub(crate) fn split_before(layers: &[Layer], end: usize) -> (&[Layer], &[Layer]) {
    let count = layers.iter().take_while(|layer| usize::from(layer.pixel) < end).count();
    layers.split_at(count)
}
