//! Drawing a frame: visibility tile by tile, then each visible surface shaded once per pixel.
//!
//! Tiles know nothing of each other, so threads may take them in any order: the picture is the same for any number.

use crate::bins::Bins;
use crate::fragment::FragmentRow;
use crate::grid::{Part, TILE, TileRect};
use crate::plane::{LANES, NOTHING, index_of};
use crate::tile::{Layer, Tile};
use crate::{Fragment, Frame};
use fearless_simd::dispatch;
use std::sync::Mutex;

/// What the primitives of a frame look like.
pub trait Surface: Sync {
    /// Whether a masked primitive is there at all in this fragment.
    fn keeps(&self, fragment: &Fragment<'_>) -> bool;

    /// The colour of a fragment: linear red, green and blue, each multiplied by alpha, and alpha.
    /// Solid primitives are taken to be opaque, whatever alpha they report.
    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4];
}

impl Frame {
    /// Draws the frame over `background` (linear, multiplied by alpha) and hands each pixel to `encode`, whose result
    /// goes to `target`: rows from the top, `width` × `height` of them. Uses up to `threads` threads.
    ///
    /// The mean of a pixel's samples is taken in linear light. A `target` of another length gets the rows that fit.
    pub fn draw<S: Surface, P: Send>(
        &self,
        surface: &S,
        background: [f32; 4],
        threads: usize,
        target: &mut [P],
        encode: impl Fn([f32; 4]) -> P + Sync,
    ) {
        let bins = Bins::sort(&self.pieces, self.part);
        let level = self.instructions.level();
        let bands = Mutex::new(self.bands(target).into_iter());
        let work = || {
            let mut tile = Tile::default();
            loop {
                let next = bands.lock().unwrap_or_else(std::sync::PoisonError::into_inner).next();
                let Some((row, pixels)) = next else { return };
                let (left, right) = self.part.columns();
                for column in left..right {
                    let rect = self.part.tile(column, row);
                    tile.fill(self, rect, bins.of(column, row), surface);
                    let shading = Shading { frame: self, surface, background, tile: &tile, rect };
                    dispatch!(level, _simd => shading.write(pixels, &encode));
                }
            }
        };
        let (top, bottom) = self.part.rows();
        std::thread::scope(|scope| {
            for _ in 1..threads.min((bottom - top) as usize) {
                scope.spawn(work);
            }
            work();
        });
    }

    /// The rows of tiles, each with its pixels.
    fn bands<'a, P>(&self, mut target: &'a mut [P]) -> Vec<(u32, &'a mut [P])> {
        let (top, bottom) = self.part.rows();
        let band = |row: u32| {
            let length = self.part.rows_of(row) * self.part.width as usize;
            let all = std::mem::take(&mut target);
            let (band, rest) = all.split_at_mut(length.min(all.len()));
            target = rest;
            (row, band)
        };
        (top..bottom).map(band).collect()
    }
}

/// A filled tile on its way to colours.
struct Shading<'a, S> {
    frame: &'a Frame,
    surface: &'a S,
    background: [f32; 4],
    tile: &'a Tile,
    rect: TileRect,
}

/// A pixel of a tile: where it is there, and where its samples are in the tile's planes.
#[derive(Clone, Copy)]
struct Pixel {
    x: u32,
    y: u32,
    at: usize,
}

/// Neighbouring pixels of a row, all in one block, with the layers over them.
struct Run<'a> {
    y: u32,
    lanes: std::ops::Range<u32>,
    over: &'a [Layer],
}

/// The pixels of a block's row.
const WIDE: u32 = LANES as u32;

impl<S: Surface> Shading<'_, S> {
    /// Writes the tile into its band: the rows of the frame that the tile's row shows.
    #[inline(always)]
    fn write<P>(&self, band: &mut [P], encode: &impl Fn([f32; 4]) -> P) {
        let TileRect { x, left, top, right, bottom, .. } = self.rect;
        let Part { x: from, width, .. } = self.frame.part;
        let mut layers = self.tile.layers.as_slice();
        for y in top..bottom {
            let start = (y - top) as usize * width as usize + (x + left - from) as usize;
            let Some(row) = band.get_mut(start..start + (right - left) as usize) else { return };
            let mut rest = row;
            for block in left / WIDE..right.div_ceil(WIDE) {
                let lanes = left.max(block * WIDE)..right.min((block + 1) * WIDE);
                let targets;
                (targets, rest) = rest.split_at_mut(lanes.len());
                let over;
                (over, layers) = split_before(layers, (y * TILE + lanes.end) as usize);
                self.write_lanes(&Run { y, lanes, over }, targets, encode);
            }
        }
    }

    #[inline(always)]
    fn write_lanes<P>(&self, run: &Run<'_>, targets: &mut [P], encode: &impl Fn([f32; 4]) -> P) {
        let block = run.lanes.start / WIDE * WIDE;
        match self.uniform_row(index_of(block as usize, run.y as usize)) {
            Some(pieces) if run.over.is_empty() => {
                self.write_row(block, run, pieces, targets, encode);
            }
            _ => self.write_mixed(run, targets, encode),
        }
    }

    /// The pieces that eight neighbouring pixels see, if each pixel sees just one.
    #[inline(always)]
    fn uniform_row(&self, at: usize) -> Option<[u32; LANES]> {
        let mut planes = (0..self.frame.samples.count()).map(|n| self.tile.pieces(n, at));
        let first = planes.next()?;
        planes.all(|pieces| pieces == first).then_some(first)
    }

    /// Writes neighbouring pixels with one piece each, of the row of the block that begins at column `block`.
    #[inline(always)]
    fn write_row<P>(
        &self,
        block: u32,
        run: &Run<'_>,
        pieces: [u32; LANES],
        targets: &mut [P],
        encode: &impl Fn([f32; 4]) -> P,
    ) {
        let Some(&any) = pieces.iter().find(|piece| **piece != NOTHING) else {
            targets.iter_mut().for_each(|target| *target = encode(self.background));
            return;
        };
        let mut seen = [&self.frame.pieces[any as usize]; LANES];
        for (seen, piece) in seen.iter_mut().zip(pieces) {
            if piece != NOTHING {
                *seen = &self.frame.pieces[piece as usize];
            }
        }
        let (x, y) = (self.rect.x + block, self.rect.y + run.y);
        let row = FragmentRow::new(seen, &self.frame.source_weights, x, y);
        for (lane, target) in ((run.lanes.start - block) as usize..).zip(targets) {
            let color = match pieces[lane] {
                NOTHING => self.background,
                _ => opaque(self.surface.shade(&row.lane(lane))),
            };
            *target = encode(color);
        }
    }

    /// Writes neighbouring pixels some of which see several pieces or layers.
    fn write_mixed<P>(&self, run: &Run<'_>, targets: &mut [P], encode: &impl Fn([f32; 4]) -> P) {
        let mut layers = run.over;
        for (x, target) in run.lanes.clone().zip(targets) {
            let pixel = Pixel { x, y: run.y, at: index_of(x as usize, run.y as usize) };
            let over;
            (over, layers) = split_before(layers, (run.y * TILE + x + 1) as usize);
            *target = encode(self.color(pixel, over));
        }
    }

    #[inline]
    fn color(&self, pixel: Pixel, over: &[Layer]) -> [f32; 4] {
        if over.is_empty() && self.tile.is_uniform(pixel.at) {
            return self.piece_color(self.tile.piece(0, pixel.at), pixel);
        }
        self.mixed_color(pixel, over)
    }

    /// The colour of a pixel in which there is more than one piece to be seen.
    fn mixed_color(&self, pixel: Pixel, over: &[Layer]) -> [f32; 4] {
        let mut colors = [[0.0; 4]; 16];
        let colors = &mut colors[..self.frame.samples.count()];
        self.solid_colors(pixel, colors);
        for layer in over {
            let color = self.shade(layer.piece, pixel);
            blend(layer.mask, color, colors);
        }
        mean(colors)
    }

    /// The colour of each sample's nearest solid piece, each piece shaded once.
    fn solid_colors(&self, pixel: Pixel, colors: &mut [[f32; 4]]) {
        let piece_at = |sample: usize| self.tile.piece(sample, pixel.at);
        for sample in 0..colors.len() {
            let seen = (0..sample).find(|&earlier| piece_at(earlier) == piece_at(sample));
            colors[sample] = match seen {
                Some(earlier) => colors[earlier],
                None => self.piece_color(piece_at(sample), pixel),
            };
        }
    }

    #[inline]
    fn piece_color(&self, piece: u32, pixel: Pixel) -> [f32; 4] {
        if piece == NOTHING {
            return self.background;
        }
        opaque(self.shade(piece, pixel))
    }

    #[inline]
    fn shade(&self, piece: u32, pixel: Pixel) -> [f32; 4] {
        let (x, y) = (self.rect.x + pixel.x, self.rect.y + pixel.y);
        let piece = &self.frame.pieces[piece as usize];
        self.surface.shade(&Fragment::new(piece, &self.frame.source_weights, x, y))
    }
}

/// Splits layers, which are sorted by pixel, into those of pixels before `end` and the rest.
#[inline]
fn split_before(layers: &[Layer], end: usize) -> (&[Layer], &[Layer]) {
    let count = layers.iter().take_while(|layer| usize::from(layer.pixel) < end).count();
    layers.split_at(count)
}

/// A solid surface is opaque, whatever alpha its shading reports.
#[inline]
fn opaque([r, g, b, _]: [f32; 4]) -> [f32; 4] {
    [r, g, b, 1.0]
}

/// Lays a colour (multiplied by alpha) over those samples whose bit is set.
fn blend(mask: u16, over: [f32; 4], colors: &mut [[f32; 4]]) {
    for (sample, color) in colors.iter_mut().enumerate() {
        if mask & (1 << sample) != 0 {
            *color = [0, 1, 2, 3].map(|k| over[k] + color[k] * (1.0 - over[3]));
        }
    }
}

fn mean(colors: &[[f32; 4]]) -> [f32; 4] {
    let mut sum = [0.0_f32; 4];
    for color in colors {
        sum = [0, 1, 2, 3].map(|k| sum[k] + color[k]);
    }
    sum.map(|channel| channel / colors.len() as f32)
}
