//! Drawing a frame: visibility tile by tile, then each visible surface shaded once per pixel.
//!
//! Tiles know nothing of each other, so threads may take them in any order: the picture is the same for any number.

use crate::bins::{Bins, TILE};
use crate::fragment::Weigher;
use crate::plane::NOTHING;
use crate::setup::TileRect;
use crate::tile::{Layer, Tile};
use crate::{Fragment, Frame};
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
        let bins = Bins::sort(&self.pieces, self.width, self.height);
        let band = self.width as usize * TILE as usize;
        let bands = Mutex::new(target.chunks_mut(band).enumerate());
        let work = || {
            let mut tile = Tile::default();
            loop {
                let next = bands.lock().unwrap_or_else(std::sync::PoisonError::into_inner).next();
                let Some((row, pixels)) = next else { return };
                for column in 0..self.width.div_ceil(TILE) {
                    let rect = TileRect::of(column, row as u32, self.width, self.height);
                    tile.fill(self, rect, bins.of(column, row as u32), surface);
                    let mut shading =
                        Shading { frame: self, surface, background, tile: &tile, rect, last: None };
                    shading.write(pixels, &encode);
                }
            }
        };
        std::thread::scope(|scope| {
            for _ in 1..threads.min(self.height.div_ceil(TILE) as usize) {
                scope.spawn(work);
            }
            work();
        });
    }
}

/// A filled tile on its way to colours.
struct Shading<'a, S> {
    frame: &'a Frame,
    surface: &'a S,
    background: [f32; 4],
    tile: &'a Tile,
    rect: TileRect,
    /// The piece that was shaded last, ready to be shaded again: neighbours mostly show the same.
    last: Option<(u32, Weigher<'a>)>,
}

/// The colours of a pixel's samples, and how many there are.
type SampleColors = [[f32; 4]; 16];

impl<S: Surface> Shading<'_, S> {
    /// Writes the tile into a band of the picture that is as wide as the picture and begins at the tile's top row.
    fn write<P>(&mut self, band: &mut [P], encode: &impl Fn([f32; 4]) -> P) {
        let mut layers = self.tile.layers.as_slice();
        for y in 0..self.rect.height() {
            let start = y * self.frame.width as usize + self.rect.x0 as usize;
            let Some(row) = band.get_mut(start..start + self.rect.width()) else { return };
            for (x, target) in row.iter_mut().enumerate() {
                let pixel = y * self.rect.width() + x;
                let count = layers.iter().take_while(|l| usize::from(l.pixel) == pixel).count();
                let (over, rest) = layers.split_at(count);
                layers = rest;
                *target = encode(self.color(pixel, over));
            }
        }
    }

    fn color(&mut self, pixel: usize, over: &[Layer]) -> [f32; 4] {
        let count = self.frame.samples.count();
        if over.is_empty() && self.is_uniform(pixel) {
            return self.piece_color(self.piece(0, pixel), pixel);
        }
        let mut colors: SampleColors = [[0.0; 4]; 16];
        self.solid_colors(pixel, &mut colors[..count]);
        for layer in over {
            self.blend(layer, &mut colors[..count]);
        }
        mean(&colors[..count])
    }

    fn piece(&self, sample: usize, pixel: usize) -> u32 {
        self.tile.piece(sample, pixel % self.rect.width(), pixel / self.rect.width())
    }

    fn is_uniform(&self, pixel: usize) -> bool {
        let first = self.piece(0, pixel);
        (1..self.frame.samples.count()).all(|sample| self.piece(sample, pixel) == first)
    }

    /// The colour of each sample's nearest solid piece, each piece shaded once.
    fn solid_colors(&mut self, pixel: usize, colors: &mut [[f32; 4]]) {
        for sample in 0..colors.len() {
            let piece = self.piece(sample, pixel);
            let seen = (0..sample).find(|&earlier| self.piece(earlier, pixel) == piece);
            colors[sample] = match seen {
                Some(earlier) => colors[earlier],
                None => self.piece_color(piece, pixel),
            };
        }
    }

    fn piece_color(&mut self, piece: u32, pixel: usize) -> [f32; 4] {
        if piece == NOTHING {
            return self.background;
        }
        let [r, g, b, _] = self.shade(piece, pixel);
        [r, g, b, 1.0]
    }

    fn blend(&mut self, layer: &Layer, colors: &mut [[f32; 4]]) {
        let over = self.shade(layer.piece, usize::from(layer.pixel));
        for (sample, color) in colors.iter_mut().enumerate() {
            if layer.mask & (1 << sample) != 0 {
                *color = [0, 1, 2, 3].map(|k| over[k] + color[k] * (1.0 - over[3]));
            }
        }
    }

    fn shade(&mut self, piece: u32, pixel: usize) -> [f32; 4] {
        if self.last.is_none_or(|(last, _)| last != piece) {
            let weigher =
                Weigher::new(&self.frame.pieces[piece as usize], &self.frame.source_weights);
            self.last = Some((piece, weigher));
        }
        let Some((_, weigher)) = &self.last else { return self.background };
        let (x, y) = (pixel % self.rect.width(), pixel / self.rect.width());
        let fragment = weigher.fragment(self.rect.x0 + x as u32, self.rect.y0 + y as u32);
        self.surface.shade(&fragment)
    }
}

fn mean(colors: &[[f32; 4]]) -> [f32; 4] {
    let mut sum = [0.0_f32; 4];
    for color in colors {
        sum = [0, 1, 2, 3].map(|k| sum[k] + color[k]);
    }
    sum.map(|channel| channel / colors.len() as f32)
}
