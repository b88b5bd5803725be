//! Texture filtering: bilinear within a mip level, trilinear between two, anisotropic along a line.
//!
//! ```text
//!    a ──●──── b        ● = lerp(a, b, s)        trilinear:    lerp(level, level + 1, fraction)
//!        │              ○ = lerp(c, d, s)        anisotropic:  mean over the taps of a footprint
//!        ◆ t
//!    c ──○──── d        ◆ = lerp(●, ○, t)
//! ```
//!
//! Colors are decoded from sRGB with a table before they are mixed, as in the `*_SRGB` formats of
//! Vulkan. Alpha is straight, not premultiplied, as in glTF, and is filtered separately. The color
//! of transparent texels bleeds into their neighbors, so exporters add padding.
//!
//! With eight lanes, texels are fetched lane by lane as 32-bit numbers, but arithmetic processes
//! all lanes at once.

use super::addressing::TexelQuads;
use super::footprint::Tap;
use super::{MipChain, TexelLanes, UvLanes};
use crate::lanes::{Lanes, Rgb, map_to_lanes};

impl MipChain<'_> {
    /// Computes the texture's filtered color over the footprints of pixels, linear with straight
    /// alpha.
    ///
    /// At most `anisotropy` taps are read along the longer axis of a footprint. If alpha is not
    /// needed, it is 1.
    #[inline(always)]
    pub(crate) fn sample<const N: usize>(
        &self,
        uvs: &UvLanes<N>,
        needs_alpha: bool,
        anisotropy: u32,
    ) -> TexelLanes<N> {
        // Anisotropic filtering: the weighted mean of the taps.
        let footprint = self.addressing.footprint(uvs, anisotropy);
        let mut sum = TexelLanes::ZERO;
        for index in 0..footprint.max_tap_count() {
            self.accumulate_tap(&footprint.tap(&self.addressing, index), needs_alpha, &mut sum);
        }
        sum
    }

    /// Adds the texel read at one tap of a footprint, times its weight.
    #[cfg_attr(not(any(target_family = "wasm", debug_assertions)), inline(always))]
    #[cfg_attr(any(target_family = "wasm", debug_assertions), inline(never))]
    pub(crate) fn accumulate_tap<const N: usize>(
        &self,
        tap: &Tap<N>,
        needs_alpha: bool,
        sum: &mut TexelLanes<N>,
    ) {
        // Trilinear: interpolate from the first level, which starts with weight 1, toward the
        // second.
        let mut texel = TexelLanes::ZERO;
        for level in 0..tap.level_count {
            let next = self.filter_texels(&tap.quads[level], needs_alpha);
            texel = texel.lerp(next, tap.level_weights[level]);
        }
        sum.color += texel.color * tap.tap_weights;
        sum.alpha += texel.alpha * tap.tap_weights;
    }

    /// Interpolates bilinearly in quads of texels, channel by channel.
    #[inline(always)]
    fn filter_texels<const N: usize>(
        &self,
        quads: &TexelQuads<N>,
        needs_alpha: bool,
    ) -> TexelLanes<N> {
        if let Some(table) = self.srgb_table {
            return self.filter_srgb_texels(quads, table, needs_alpha);
        }
        let texels = self.fetch_texels(quads);
        let r = filter_linear_channel(&texels, 0, quads);
        let g = filter_linear_channel(&texels, 1, quads);
        let b = filter_linear_channel(&texels, 2, quads);
        let mut alpha = Lanes::ONE;
        if needs_alpha {
            alpha = filter_linear_channel(&texels, 3, quads);
        }
        TexelLanes { color: Rgb { r, g, b }, alpha }
    }

    /// Interpolates colors bilinearly, after decoding them from sRGB.
    ///
    /// The codes are looked up in the table byte by byte; if they were packed into vectors, they
    /// would have to be extracted again.
    #[inline(always)]
    fn filter_srgb_texels<const N: usize>(
        &self,
        quads: &TexelQuads<N>,
        table: &[f32; 256],
        needs_alpha: bool,
    ) -> TexelLanes<N> {
        let mut linear = [[Lanes::ZERO; 4]; 3];
        for lane in 0..N {
            let texels: &[[u8; 4]] = &self.levels[quads.levels[lane] as usize].texels;
            for (corner, indices) in quads.texels.iter().enumerate() {
                let texel = &texels[indices[lane] as usize];
                for (channel, corners) in linear.iter_mut().enumerate() {
                    corners[corner][lane] = table[usize::from(texel[channel])];
                }
            }
        }
        let [r, g, b] = linear;
        let color = Rgb { r: bilinear(r, quads), g: bilinear(g, quads), b: bilinear(b, quads) };
        let mut alpha = Lanes::ONE;
        if needs_alpha {
            alpha = filter_linear_channel(&self.fetch_texels(quads), 3, quads);
        }
        TexelLanes { color, alpha }
    }

    /// Fetches the four texels of each quad, packed with red in the lowest byte.
    #[inline(always)]
    fn fetch_texels<const N: usize>(&self, quads: &TexelQuads<N>) -> [[u32; N]; 4] {
        let mut packed = [[0; N]; 4];
        // A gather, because each lane has a separate mip level.
        for lane in 0..N {
            let texels: &[[u8; 4]] = &self.levels[quads.levels[lane] as usize].texels;
            for (packed, indices) in packed.iter_mut().zip(&quads.texels) {
                packed[lane] = u32::from_le_bytes(texels[indices[lane] as usize]);
            }
        }
        packed
    }
}

/// Returns one channel of a packed texel, from 0 to 255.
#[inline(always)]
fn channel_code(texel: u32, channel: usize) -> u32 {
    texel >> (8 * channel) & 255
}

/// Interpolates one linearly encoded channel; the result is from 0 to 1. Dividing by 255 after the
/// interpolation takes one division instead of four.
#[inline(always)]
fn filter_linear_channel<const N: usize>(
    texels: &[[u32; N]; 4],
    channel: usize,
    quads: &TexelQuads<N>,
) -> Lanes<N> {
    // Convert via `i32`, which vector instructions can convert to `f32`, unlike `u32`.
    let codes = map_to_lanes(texels, |texels| {
        Lanes::from_fn(|lane| channel_code(texels[lane], channel) as i32 as f32)
    });
    bilinear(codes, quads) / 255.0
}

/// Interpolates bilinearly between the upper left, upper right, lower left and lower right values.
#[inline(always)]
fn bilinear<const N: usize>([a, b, c, d]: [Lanes<N>; 4], quads: &TexelQuads<N>) -> Lanes<N> {
    if quads.are_nearest {
        return a;
    }
    let upper = a.lerp(b, quads.column_fractions);
    let lower = c.lerp(d, quads.column_fractions);
    upper.lerp(lower, quads.row_fractions)
}
