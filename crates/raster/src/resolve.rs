//! From a filled tile to colours: each visible piece is shaded once per pixel, eight fragments at a time.
//!
//! Most rows of eight neighbouring pixels show one piece in each pixel: they are shaded as they lie. What is left of a row, the
//! pixels on edges and under layers, is gathered, fragment by fragment, shaded eight at a time and put together by samples.

use crate::fragments::{Eight, WIDE};
use crate::grid::{Part, TILE, TileRect};
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
struct Share {
    /// The pixel's column within the tile.
    x: u32,
    piece: u32,
    /// The samples it is seen by, bit by bit.
    mask: u16,
    /// Whether it lets through what is behind it.
    translucent: bool,
}

/// The fragments of a row of pixels that show several pieces, and their colours; kept so that its memory is used again.
#[derive(Debug, Default)]
pub(crate) struct Scratch {
    shares: Vec<Share>,
    colors: Vec<[f32; 4]>,
    /// What each lets through, in a row with anything translucent.
    through: Vec<[f32; 3]>,
}

/// Neighbouring pixels of a row, all in one block, with the layers over them.
struct Run<'a> {
    y: u32,
    /// The columns within the tile.
    lanes: std::ops::Range<u32>,
    over: &'a [Layer],
}

impl Run<'_> {
    /// The first column of the block.
    fn block(&self) -> u32 {
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
            if !scratch.shares.is_empty() {
                self.write_mixed(y, row, encode, scratch);
            }
        }
    }

    /// Writes those pixels of a row that show one piece each, and gathers the shares of the others.
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
        scratch.shares.clear();
        let mut rest = row;
        let wide = WIDE as u32;
        for block in left / wide..right.div_ceil(wide) {
            let lanes = left.max(block * wide)..right.min((block + 1) * wide);
            let targets;
            (targets, rest) = rest.split_at_mut(lanes.len());
            let over;
            (over, layers) = split_before(layers, (y * TILE + lanes.end) as usize);
            let run = Run { y, lanes, over };
            match self.uniform(index_of((block * wide) as usize, y as usize)) {
                Some(pieces) if run.over.is_empty() => {
                    self.write_uniform(&run, pieces, targets, empty, encode);
                }
                _ => self.gather(&run, &mut scratch.shares),
            }
        }
    }

    /// The pieces that eight neighbouring pixels see, if each pixel sees just one.
    #[inline(always)]
    fn uniform(&self, at: usize) -> Option<[u32; WIDE]> {
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
        let mut differs = 0;
        for piece in pieces {
            differs |= piece ^ pieces[0];
        }
        if differs == 0 && pieces[0] == NOTHING {
            return;
        }
        let (x, y) = (self.rect.x + run.block(), self.rect.y + run.y);
        let [r, g, b, _] = if differs == 0 {
            let piece = self.piece(pieces[0]);
            self.surface.shade_eight(&Fragments::of_one(piece, &self.frame.source_weights, x, y))
        } else {
            self.shade_several(pieces, x, y)
        };
        let mut pixels = encode.eight(&[r, g, b, [1.0; WIDE]]);
        if differs != 0 {
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

    /// Lists what is seen in each pixel of a run: each solid piece once, then the layers, the farthest first. A pixel where
    /// nothing is seen gets a share of nothing, so that it is written.
    #[inline(always)]
    fn gather(&self, run: &Run<'_>, shares: &mut Vec<Share>) {
        let count = self.frame.samples.count();
        let at = index_of(run.block() as usize, run.y as usize);
        let mut planes = [[NOTHING; WIDE]; 16];
        for (sample, pieces) in planes[..count].iter_mut().enumerate() {
            *pieces = self.tile.pieces(sample, at);
        }
        let mut layers = run.over;
        for x in run.lanes.clone() {
            let lane = (x - run.block()) as usize;
            let mut left = self.all_samples();
            while left != 0 {
                let piece = planes[left.trailing_zeros() as usize][lane];
                let mut mask = 0;
                for (sample, pieces) in planes[..count].iter().enumerate() {
                    mask |= u16::from(pieces[lane] == piece) << sample;
                }
                left &= !mask;
                shares.push(Share { x, piece, mask, translucent: false });
            }
            let over;
            (over, layers) = split_before(layers, (run.y * TILE + x + 1) as usize);
            shares.extend(over.iter().map(|layer| {
                let Layer { piece, mask, .. } = *layer;
                Share { x, piece, mask, translucent: true }
            }));
        }
    }

    fn all_samples(&self) -> u16 {
        (u32::MAX >> (32 - self.frame.samples.count())) as u16
    }

    /// Writes the pixels of a row whose shares were gathered.
    #[inline(always)]
    fn write_mixed<P: Copy>(
        &self,
        y: u32,
        row: &mut [P],
        encode: &impl Encode<P>,
        scratch: &mut Scratch,
    ) {
        let Scratch { shares, colors, through } = scratch;
        self.shade_shares(y, shares, colors, through);
        let mut from = 0;
        while let Some(first) = shares.get(from) {
            let same = shares[from..].iter().take_while(|share| share.x == first.x).count();
            let range = from..from + same;
            let last = range.end - 1;
            let color = if shares[last].translucent {
                self.put_together_layers(
                    &shares[range.clone()],
                    &colors[range.clone()],
                    &through[range],
                )
            } else {
                self.put_together(&shares[range.clone()], &colors[range])
            };
            row[(first.x - self.rect.left) as usize] = encode.pixel(color);
            from += same;
        }
    }

    /// The colour of each share, and what it lets through, eight shaded at a time.
    #[inline(always)]
    fn shade_shares(
        &self,
        y: u32,
        shares: &[Share],
        colors: &mut Vec<[f32; 4]>,
        through: &mut Vec<[f32; 3]>,
    ) {
        colors.clear();
        through.clear();
        let is_layered = shares.iter().any(|share| share.translucent);
        let is_there = |share: &&Share| share.piece != NOTHING;
        let Some(any) = shares.iter().find(is_there) else {
            colors.resize(shares.len(), self.background);
            return;
        };
        for eight in shares.chunks(WIDE) {
            let mut seen = [self.piece(any.piece); WIDE];
            let mut columns = [self.rect.x + any.x; WIDE];
            for (lane, share) in eight.iter().enumerate().filter(|(_, s)| s.piece != NOTHING) {
                seen[lane] = self.piece(share.piece);
                columns[lane] = self.rect.x + share.x;
            }
            let weights = &self.frame.source_weights;
            let all = Fragments::of_each(seen, weights, columns, self.rect.y + y);
            let shaded = self.surface.shade_eight(&all);
            for (lane, share) in eight.iter().enumerate() {
                let [r, g, b, alpha] = &shaded;
                let alpha = if share.translucent { alpha[lane] } else { 1.0 };
                let color = [r[lane], g[lane], b[lane], alpha];
                colors.push(if share.piece == NOTHING { self.background } else { color });
            }
            if is_layered {
                let [r, g, b] = self.surface.through_eight(&all, &shaded[3]);
                through.extend((0..eight.len()).map(|lane| [r[lane], g[lane], b[lane]]));
            }
        }
    }

    /// The colour of a pixel, which is the mean of its samples.
    #[inline(always)]
    fn put_together(&self, shares: &[Share], colors: &[[f32; 4]]) -> [f32; 4] {
        let mut sum = [0.0; 4];
        for (share, color) in shares.iter().zip(colors) {
            let samples = share.mask.count_ones() as f32;
            for (sum, channel) in sum.iter_mut().zip(color) {
                *sum += channel * samples;
            }
        }
        self.mean(sum)
    }

    /// With something translucent over it, a pixel is put together sample by sample.
    fn put_together_layers(
        &self,
        shares: &[Share],
        colors: &[[f32; 4]],
        through: &[[f32; 3]],
    ) -> [f32; 4] {
        let mut samples = [[0.0; 4]; 16];
        for ((share, color), [r, g, b]) in shares.iter().zip(colors).zip(through) {
            let mut behind = [0.0; 4];
            if share.translucent {
                behind = [*r, *g, *b, 1.0 - color[3]];
            }
            for (number, sample) in samples.iter_mut().enumerate() {
                if share.mask & (1 << number) != 0 {
                    *sample = [0, 1, 2, 3].map(|k| color[k] + sample[k] * behind[k]);
                }
            }
        }
        let mut sum = [0.0; 4];
        for sample in &samples[..self.frame.samples.count()] {
            sum = [0, 1, 2, 3].map(|k| sum[k] + sample[k]);
        }
        self.mean(sum)
    }

    #[inline(always)]
    fn mean(&self, sum: [f32; 4]) -> [f32; 4] {
        let count = self.frame.samples.count() as f32;
        sum.map(|channel| channel / count)
    }
}

/// Splits layers, which are sorted by pixel, into those of pixels before `end` and the rest.
#[inline]
fn split_before(layers: &[Layer], end: usize) -> (&[Layer], &[Layer]) {
    let count = layers.iter().take_while(|layer| usize::from(layer.pixel) < end).count();
    layers.split_at(count)
}
