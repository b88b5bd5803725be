//! Drawing a frame: visibility tile by tile, then shading of each visible surface once per pixel.

use crate::fragment_lanes::{F32x8, LANES};
use crate::simd_level::dispatch;
use crate::tile_loop::FilledTile;
use crate::tile_resolve::TileResolve;
use crate::{Fragment, Fragments, Frame};

/// The appearance of the primitives of a frame: alpha test and shading.
pub trait Surface: Sync {
    /// Runs the alpha test: returns whether a masked primitive is present in this fragment. This
    /// method is called only in frames with masked primitives. The default returns `true`.
    #[inline(always)]
    fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool {
        let _ = fragment;
        true
    }

    /// Runs the alpha test for eight adjacent fragments of one masked primitive.
    ///
    /// Some fragments may be outside the primitive; their results are ignored. Drawing calls this
    /// method; the default calls [`passes_alpha_test`](Self::passes_alpha_test) for each fragment.
    #[inline(always)]
    fn alpha_test_eight(&self, fragments: &Fragments<'_>) -> [bool; LANES] {
        let weights = fragments.weights();
        std::array::from_fn(|lane| self.passes_alpha_test(&fragments.fragment(lane, &weights)))
    }

    /// Returns the color of a fragment as linear RGBA, premultiplied by alpha.
    ///
    /// Opaque and masked primitives replace everything behind them, including alpha. Their alpha is
    /// 1 unless the color includes a background that is itself transparent, as for refracting
    /// glass.
    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4];

    /// Returns the colors of eight fragments: all reds, all greens, all blues and all alphas.
    ///
    /// Drawing calls this method; the default calls [`shade`](Self::shade) for each fragment. An
    /// implementation written as plain loops over the lanes and marked `#[inline(always)]` is
    /// compiled for the processor's vector instructions and is several times as fast.
    #[inline(always)]
    fn shade_eight(&self, fragments: &Fragments<'_>) -> [F32x8; 4] {
        shade_each(fragments, |fragment| self.shade(fragment))
    }

    /// Returns whether two opaque primitives are neighbors in one smooth surface, so that the color
    /// of one can represent both in a pixel that shows both.
    ///
    /// It is called with the submitted ids of two primitives that show the same side in one pixel.
    /// The default returns `false`: each primitive is shaded separately.
    #[inline(always)]
    fn is_continuous(&self, first_id: u32, second_id: u32) -> bool {
        let _ = (first_id, second_id);
        false
    }

    /// Returns the colors and transmittances of eight fragments that may be translucent.
    ///
    /// The default is the "over" operator: [`shade_eight`](Self::shade_eight) with a transmittance
    /// of 1 − alpha. Override it for glass that absorbs by color. Transmittances of opaque
    /// fragments are ignored.
    #[inline(always)]
    fn shade_translucent_eight(&self, fragments: &Fragments<'_>) -> TranslucentColors {
        let color = self.shade_eight(fragments);
        let transmittance = [color[3].map(|alpha| 1.0 - alpha); 3];
        TranslucentColors { color, transmittance }
    }
}

/// Shades eight fragments one by one. Returns all reds, all greens, all blues and all alphas.
#[inline(always)]
pub fn shade_each(
    fragments: &Fragments<'_>,
    shade: impl Fn(&Fragment<'_>) -> [f32; 4],
) -> [F32x8; 4] {
    let mut colors = [[0.0; LANES]; 4];
    let weights = fragments.weights();
    for lane in 0..LANES {
        let color = shade(&fragments.fragment(lane, &weights));
        for (channel, value) in colors.iter_mut().zip(color) {
            channel[lane] = value;
        }
    }
    colors
}

/// The colors and transmittances of eight fragments that may be translucent.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct TranslucentColors {
    /// All reds, all greens, all blues and all alphas; linear and premultiplied.
    pub color: [F32x8; 4],
    /// The factors applied to the red, green and blue of everything behind, from 0 to 1.
    pub transmittance: [F32x8; 3],
}

/// Creates a surface from a function that returns the color of a fragment as linear RGBA,
/// premultiplied by alpha.
///
/// ```
/// # use raster::{Frame, Samples, surface_fn};
/// # let frame = Frame::new(2, 2, Samples::One)?;
/// let stripes = surface_fn(|fragment| [if fragment.x % 8 < 4 { 1.0 } else { 0.2 }; 4]);
/// let mut pixels = vec![0_u32; 4];
/// frame.draw(&stripes, [0.0; 4], 1, &mut pixels, |color: [f32; 4]| u32::from_le_bytes(color.map(|c| (c * 255.0) as u8)));
/// # Ok::<(), raster::RasterError>(())
/// ```
pub const fn surface_fn<F>(shade: F) -> SurfaceFn<F>
where
    F: Fn(&Fragment<'_>) -> [f32; 4] + Sync,
{
    SurfaceFn(shade)
}

/// A surface defined by a function: see [`surface_fn`].
#[derive(Clone, Copy, Debug)]
pub struct SurfaceFn<F>(F);

impl<F: Fn(&Fragment<'_>) -> [f32; 4] + Sync> Surface for SurfaceFn<F> {
    #[inline(always)]
    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        (self.0)(fragment)
    }
}

/// A reference to a surface is also a surface. With `&dyn Surface`, surfaces of several types share
/// one copy of the drawing code.
impl<S: Surface + ?Sized> Surface for &S {
    fn passes_alpha_test(&self, fragment: &Fragment<'_>) -> bool {
        (**self).passes_alpha_test(fragment)
    }

    fn alpha_test_eight(&self, fragments: &Fragments<'_>) -> [bool; LANES] {
        (**self).alpha_test_eight(fragments)
    }

    fn shade(&self, fragment: &Fragment<'_>) -> [f32; 4] {
        (**self).shade(fragment)
    }

    fn shade_eight(&self, fragments: &Fragments<'_>) -> [F32x8; 4] {
        (**self).shade_eight(fragments)
    }

    fn is_continuous(&self, first_id: u32, second_id: u32) -> bool {
        (**self).is_continuous(first_id, second_id)
    }

    fn shade_translucent_eight(&self, fragments: &Fragments<'_>) -> TranslucentColors {
        (**self).shade_translucent_eight(fragments)
    }
}

/// A pixel encoder: converts a linear color, premultiplied by alpha, to a pixel of the target.
///
/// Any function from a color to a pixel is an encoder.
pub trait Encode<P>: Sync {
    /// Encodes a color as a pixel.
    fn encode_pixel(&self, color: [f32; 4]) -> P;

    /// Encodes eight colors, passed as all reds, all greens, all blues and all alphas.
    ///
    /// The default calls [`encode_pixel`](Self::encode_pixel) for each color; an implementation
    /// with loops over the lanes is faster.
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
    /// Draws the frame over `background` (linear, premultiplied by alpha) and writes the pixels
    /// that `encode` returns to `target`: `width` × `height` pixels, rows from the top.
    ///
    /// The samples of a pixel are averaged in linear light (multisample resolve). Uses up to
    /// `threads` threads; the result is the same for any number. If `target` has a different
    /// length, only the rows that fit are written.
    #[expect(clippy::needless_pass_by_value, reason = "callers pass closures by value")]
    pub fn draw<S: Surface, P: Copy + Send>(
        &self,
        surface: &S,
        background: [f32; 4],
        threads: usize,
        target: &mut [P],
        encode: impl Encode<P>,
    ) {
        // Clearing whole bands is faster than clearing tiles and leaves the rows in the cache for
        // the tiles.
        let begin = |band: &mut [P]| band.fill(encode.encode_pixel(background));
        self.for_each_tile(surface, threads, target, begin, |filled| {
            let FilledTile { tile, rect, band, scratch } = filled;
            let tile = TileResolve { frame: self, surface, background, tile, rect };
            dispatch!(self.simd_level.level(), _simd => tile.write_tile(band, scratch, &encode));
        });
    }
}
