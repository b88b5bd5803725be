//! Drawing a frame: visibility tile by tile, then each visible surface shaded once per pixel.
//!
//! Tiles know nothing of each other, so threads may take them in any order: the picture is the same for any number.

use crate::bins::Bins;
use crate::fragments::{Eight, WIDE};
use crate::resolve::{Resolve, Scratch};
use crate::tile::Tile;
use crate::{Fragment, Fragments, Frame};
use fearless_simd::dispatch;
use std::sync::Mutex;

/// What the primitives of a frame look like.
pub trait Surface: Sync {
    /// Whether a masked primitive is there at all in this fragment.
    fn keeps(&self, fragment: &Fragment<'_>) -> bool;

    /// The colour of a fragment: linear red, green and blue, each multiplied by alpha, and alpha.
    /// Solid primitives are taken to be opaque, whatever alpha they report.
    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4];

    /// The colours of eight fragments: all reds, all greens, all blues, all alphas. This is what drawing calls; it need not be
    /// written, for one by one is as good. Written as plain loops over the eight and marked `#[inline(always)]`, it is compiled
    /// for the vector instructions of the processor, and is several times as fast.
    #[inline(always)]
    fn shade_eight(&self, fragments: &Fragments<'_>) -> [Eight; 4] {
        let mut colors = [[0.0; WIDE]; 4];
        let weights = fragments.weights();
        for lane in 0..WIDE {
            let color = self.shade(&fragments.lane(lane, &weights));
            for (channel, value) in colors.iter_mut().zip(color) {
                channel[lane] = value;
            }
        }
        colors
    }
}

/// How colours are kept: what becomes of a linear colour (multiplied by alpha) in the target.
///
/// Any function from a colour to a pixel will do.
pub trait Encode<P>: Sync {
    /// The pixel of a colour.
    fn pixel(&self, color: [f32; 4]) -> P;

    /// The pixels of eight colours, given as all reds, all greens, all blues and all alphas. As with
    /// [`Surface::shade_eight`], it need not be written, and is faster if it is.
    #[inline(always)]
    fn eight(&self, colors: &[Eight; 4]) -> [P; WIDE] {
        let [r, g, b, alpha] = colors;
        std::array::from_fn(|lane| self.pixel([r[lane], g[lane], b[lane], alpha[lane]]))
    }
}

impl<P, F: Fn([f32; 4]) -> P + Sync> Encode<P> for F {
    #[inline(always)]
    fn pixel(&self, color: [f32; 4]) -> P {
        self(color)
    }
}

impl Frame {
    /// Draws the frame over `background` (linear, multiplied by alpha) and hands each pixel to `encode`, whose result
    /// goes to `target`: rows from the top, `width` × `height` of them. Uses up to `threads` threads.
    ///
    /// The mean of a pixel's samples is taken in linear light. A `target` of another length gets the rows that fit.
    #[expect(clippy::needless_pass_by_value, reason = "a function is handed over as it is")]
    pub fn draw<S: Surface, P: Copy + Send>(
        &self,
        surface: &S,
        background: [f32; 4],
        threads: usize,
        target: &mut [P],
        encode: impl Encode<P>,
    ) {
        let bins = Bins::sort(&self.pieces, self.part);
        let level = self.instructions.level();
        let bands = Mutex::new(self.bands(target).into_iter());
        let work = || {
            let mut tile = Tile::default();
            let mut scratch = Scratch::default();
            loop {
                let next = bands.lock().unwrap_or_else(std::sync::PoisonError::into_inner).next();
                let Some((row, pixels)) = next else { return };
                // Memory takes whole rows faster than tiles, and what tiles write is then in a cache already.
                pixels.fill(encode.pixel(background));
                let (left, right) = self.part.columns();
                for column in left..right {
                    let rect = self.part.tile(column, row);
                    tile.fill(self, rect, bins.of(column, row), surface);
                    if !tile.is_empty() {
                        let tile = Resolve { frame: self, surface, background, tile: &tile, rect };
                        dispatch!(level, _simd => tile.write(pixels, &mut scratch, &encode));
                    }
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
