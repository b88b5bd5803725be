//! Drawing a frame: visibility tile by tile, then each visible surface shaded once per pixel.

use crate::fragment_lanes::{F32x8, LANES};
use crate::tile_loop::FilledTile;
use crate::tile_resolve::TileResolve;
use crate::{Fragment, Fragments, Frame};
use fearless_simd::dispatch;

/// What the primitives of a frame look like.
pub trait Surface: Sync {
    /// Whether a masked primitive is there at all in this fragment.
    fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool;

    /// The same for eight fragments of one masked primitive, side by side; some may lie outside of it, and do not count. This is what
    /// drawing calls; as [`shade_eight`](Self::shade_eight), it need not be written, and is faster if it is.
    #[inline(always)]
    fn alpha_test_eight(&self, fragments: &Fragments<'_>) -> [bool; LANES] {
        let weights = fragments.weights();
        std::array::from_fn(|lane| self.passes_alpha_test(&fragments.fragment(lane, &weights)))
    }

    /// The colour of a fragment: linear red, green and blue, each multiplied by alpha, and alpha.
    /// Solid primitives are taken to be opaque, whatever alpha they report.
    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4];

    /// The colours of eight fragments: all reds, all greens, all blues, all alphas. This is what drawing calls; it need not be
    /// written, for one by one is as good. Written as plain loops over the eight and marked `#[inline(always)]`, it is compiled
    /// for the vector instructions of the processor, and is several times as fast.
    #[inline(always)]
    fn shade_eight(&self, fragments: &Fragments<'_>) -> [F32x8; 4] {
        let mut colors = [[0.0; LANES]; 4];
        let weights = fragments.weights();
        for lane in 0..LANES {
            let color = self.shade(&fragments.fragment(lane, &weights));
            for (channel, value) in colors.iter_mut().zip(color) {
                channel[lane] = value;
            }
        }
        colors
    }

    /// The shares of what is behind that eight translucent fragments with these alphas let through: all reds, all greens, all blues.
    /// It need not be written where all colours pass alike: 1 − alpha of each. Some of the fragments may be solid, and do not count.
    #[inline(always)]
    fn transmittance_eight(&self, _: &Fragments<'_>, alphas: &F32x8) -> [F32x8; 3] {
        [alphas.map(|alpha| 1.0 - alpha); 3]
    }
}

/// How colours are kept: what becomes of a linear colour (multiplied by alpha) in the target.
///
/// Any function from a colour to a pixel will do.
pub trait Encode<P>: Sync {
    /// The pixel of a colour.
    fn encode_pixel(&self, color: [f32; 4]) -> P;

    /// The pixels of eight colours, given as all reds, all greens, all blues and all alphas. As with
    /// [`Surface::shade_eight`], it need not be written, and is faster if it is.
    #[inline(always)]
    fn encode_eight(&self, colors: &[F32x8; 4]) -> [P; LANES] {
        let [r, g, b, alpha] = colors;
        std::array::from_fn(|lane| self.encode_pixel([r[lane], g[lane], b[lane], alpha[lane]]))
    }
}

impl<P, F: Fn([f32; 4]) -> P + Sync> Encode<P> for F {
    #[inline(always)]
    fn encode_pixel(&self, color: [f32; 4]) -> P {
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
        // Memory takes whole rows faster than tiles, and what tiles write is then in a cache already.
        let begin = |band: &mut [P]| band.fill(encode.encode_pixel(background));
        self.for_each_tile(surface, threads, target, begin, |FilledTile { tile, rect, band, scratch }| {
            let tile = TileResolve { frame: self, surface, background, tile, rect };
            dispatch!(self.simd_level.level(), _simd => tile.write_tile(band, scratch, &encode));
        });
    }
}
