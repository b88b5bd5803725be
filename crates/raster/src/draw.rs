//! Drawing a frame: visibility tile by tile, then each visible surface shaded once per pixel.
//!
//! Tiles know nothing of each other, so threads may take them in any order: the picture is the same for any number.

use crate::bins::{Bins, TILE};
use crate::coverage::{TileRect, tile_rect};
use crate::fragment::Weigher;
use crate::tile::{Layer, NOTHING, Tile};
use crate::{Fragment, Frame};
use std::sync::Mutex;

/// What the primitives of a frame look like.
pub trait Surface: Sync {
    /// Whether a masked primitive is there at all in this fragment.
    fn keeps(&self, fragment: &Fragment) -> bool;

    /// The colour of a fragment: linear red, green and blue, each multiplied by alpha, and alpha.
    /// Solid primitives are taken to be opaque, whatever alpha they report.
    fn shade(&self, fragment: &Fragment) -> [f32; 4];
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
                    let rect = tile_rect(column, row as u32, self.width, self.height);
                    tile.fill(self, rect, bins.of(column, row as u32), surface);
                    let shading = Shading { frame: self, surface, background, tile: &tile, rect };
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
}

/// The colours of a pixel's samples, and how many there are.
type SampleColors = [[f32; 4]; 16];

impl<S: Surface> Shading<'_, S> {
    /// Writes the tile into a band of the picture that is as wide as the picture and begins at the tile's top row.
    fn write<P>(&self, band: &mut [P], encode: &impl Fn([f32; 4]) -> P) {
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

    fn color(&self, pixel: usize, over: &[Layer]) -> [f32; 4] {
        let count = self.frame.samples.count();
        if over.is_empty() && self.is_uniform(pixel) {
            return self.piece_color(self.tile.piece[pixel], pixel);
        }
        let mut colors: SampleColors = [[0.0; 4]; 16];
        self.solid_colors(pixel, &mut colors[..count]);
        for layer in over {
            self.blend(layer, &mut colors[..count]);
        }
        mean(&colors[..count])
    }

    fn is_uniform(&self, pixel: usize) -> bool {
        let plane = self.rect.width() * self.rect.height();
        let first = self.tile.piece[pixel];
        (1..self.frame.samples.count()).all(|s| self.tile.piece[s * plane + pixel] == first)
    }

    /// The colour of each sample's nearest solid piece, each piece shaded once.
    fn solid_colors(&self, pixel: usize, colors: &mut [[f32; 4]]) {
        let plane = self.rect.width() * self.rect.height();
        let piece_at = |sample: usize| self.tile.piece[sample * plane + pixel];
        for sample in 0..colors.len() {
            let seen = (0..sample).find(|&earlier| piece_at(earlier) == piece_at(sample));
            colors[sample] = match seen {
                Some(earlier) => colors[earlier],
                None => self.piece_color(piece_at(sample), pixel),
            };
        }
    }

    fn piece_color(&self, piece: u32, pixel: usize) -> [f32; 4] {
        if piece == NOTHING {
            return self.background;
        }
        let [r, g, b, _] = self.surface.shade(&self.fragment(piece, pixel));
        [r, g, b, 1.0]
    }

    fn blend(&self, layer: &Layer, colors: &mut [[f32; 4]]) {
        let over = self.surface.shade(&self.fragment(layer.piece, usize::from(layer.pixel)));
        for (sample, color) in colors.iter_mut().enumerate() {
            if layer.mask & (1 << sample) != 0 {
                *color = [0, 1, 2, 3].map(|k| over[k] + color[k] * (1.0 - over[3]));
            }
        }
    }

    fn fragment(&self, piece: u32, pixel: usize) -> Fragment {
        let weigher = Weigher::new(&self.frame.pieces[piece as usize], &self.frame.source_weights);
        let (x, y) = (pixel % self.rect.width(), pixel / self.rect.width());
        weigher.fragment(self.rect.x0 + x as u32, self.rect.y0 + y as u32)
    }
}

fn mean(colors: &[[f32; 4]]) -> [f32; 4] {
    let mut sum = [0.0_f32; 4];
    for color in colors {
        sum = [0, 1, 2, 3].map(|k| sum[k] + color[k]);
    }
    sum.map(|channel| channel / colors.len() as f32)
}
