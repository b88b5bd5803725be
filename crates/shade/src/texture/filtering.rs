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
//! Textures with the same addressing are filtered as a group: for each lane, the texels of all of
//! them are fetched with the same four indices. Texels are fetched lane by lane as 32-bit numbers,
//! but arithmetic processes all lanes at once.

use super::addressing::TexelQuads;
use super::footprint::Tap;
use super::{MipChain, TexelLanes, UvLanes};
use crate::lanes::{Lanes, Rgb, map_to_lanes};

/// The maximum number of textures that are sampled as one group.
pub(crate) const MAX_GROUP: usize = 4;

/// A texture of a group that is read at the same texels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GroupedTexture<'a> {
    /// The texels.
    pub(crate) mip_chain: &'a MipChain<'a>,
    /// Whether alpha is read; otherwise it is 1.
    pub(crate) needs_alpha: bool,
}

/// The four texels of each quad, packed with red in the lowest byte.
type PackedQuads<const N: usize> = [[u32; N]; 4];

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
        let [texel, ..] =
            sample_textures(&[GroupedTexture { mip_chain: self, needs_alpha }], uvs, anisotropy);
        texel
    }

    /// Interpolates bilinearly in quads of texels, channel by channel.
    #[inline(always)]
    fn filter_texels<const N: usize>(
        &self,
        texels: &PackedQuads<N>,
        quads: &TexelQuads<N>,
        needs_alpha: bool,
    ) -> TexelLanes<N> {
        let color = match self.srgb_table {
            Some(table) => Rgb {
                r: filter_srgb_channel(texels, 0, table, quads),
                g: filter_srgb_channel(texels, 1, table, quads),
                b: filter_srgb_channel(texels, 2, table, quads),
            },
            None => Rgb {
                r: filter_linear_channel(texels, 0, quads),
                g: filter_linear_channel(texels, 1, quads),
                b: filter_linear_channel(texels, 2, quads),
            },
        };
        let mut alpha = Lanes::ONE;
        if needs_alpha {
            alpha = filter_linear_channel(texels, 3, quads);
        }
        TexelLanes { color, alpha }
    }
}

/// Samples up to [`MAX_GROUP`] textures that have the same addressing; see [`MipChain::sample`].
///
/// The result has one entry for each texture, in order; other entries are zero.
#[inline(always)]
pub(crate) fn sample_textures<const N: usize>(
    textures: &[GroupedTexture<'_>],
    uvs: &UvLanes<N>,
    anisotropy: u32,
) -> [TexelLanes<N>; MAX_GROUP] {
    let mut sums = [TexelLanes::ZERO; MAX_GROUP];
    let Some(first) = textures.first() else { return sums };
    let addressing = first.mip_chain.addressing();
    // Anisotropic filtering: the weighted mean of the taps.
    let footprint = addressing.footprint(uvs, anisotropy);
    for index in 0..footprint.max_tap_count() {
        accumulate_tap(textures, &footprint.tap(addressing, index), &mut sums);
    }
    sums
}

/// Adds the texels that textures have at one tap of a footprint, times the tap's weight.
#[cfg_attr(not(any(target_family = "wasm", debug_assertions)), inline(always))]
#[cfg_attr(any(target_family = "wasm", debug_assertions), inline(never))]
fn accumulate_tap<const N: usize>(
    textures: &[GroupedTexture<'_>],
    tap: &Tap<N>,
    sums: &mut [TexelLanes<N>; MAX_GROUP],
) {
    let mut texels = [TexelLanes::ZERO; MAX_GROUP];
    let mut packed = [[[0; N]; 4]; MAX_GROUP];
    // Trilinear: interpolate from the first level, which starts with weight 1, toward the second.
    for (quads, weights) in tap.quads.iter().zip(&tap.level_weights).take(tap.level_count) {
        fetch_texels(textures, quads, &mut packed);
        for ((texture, packed), texel) in textures.iter().zip(&packed).zip(&mut texels) {
            let next = texture.mip_chain.filter_texels(packed, quads, texture.needs_alpha);
            *texel = texel.lerp(next, *weights);
        }
    }
    for (sum, texel) in sums.iter_mut().zip(&texels).take(textures.len()) {
        sum.color += texel.color * tap.tap_weights;
        sum.alpha += texel.alpha * tap.tap_weights;
    }
}

/// Fetches the four texels of each quad from all textures of a group.
///
/// This is a gather, because each lane has a separate mip level. The texels are written to memory
/// rather than packed into vectors: the registers would not suffice for a group.
#[inline(always)]
fn fetch_texels<const N: usize>(
    textures: &[GroupedTexture<'_>],
    quads: &TexelQuads<N>,
    packed: &mut [PackedQuads<N>; MAX_GROUP],
) {
    for lane in 0..N {
        let level = quads.levels[lane] as usize;
        let [a, b, c, d] = [0, 1, 2, 3].map(|corner: usize| quads.texels[corner][lane] as usize);
        for (texture, packed) in textures.iter().zip(&mut *packed) {
            let texels: &[[u8; 4]] = &texture.mip_chain.levels[level].texels;
            packed[0][lane] = u32::from_le_bytes(texels[a]);
            packed[1][lane] = u32::from_le_bytes(texels[b]);
            packed[2][lane] = u32::from_le_bytes(texels[c]);
            packed[3][lane] = u32::from_le_bytes(texels[d]);
        }
    }
}

/// Returns one channel of a packed texel, from 0 to 255.
#[inline(always)]
fn channel_code(texel: u32, channel: usize) -> u32 {
    texel >> (8 * channel) & 255
}

/// Decodes one channel from sRGB with a table and interpolates it.
#[inline(always)]
fn filter_srgb_channel<const N: usize>(
    texels: &PackedQuads<N>,
    channel: usize,
    table: &[f32; 256],
    quads: &TexelQuads<N>,
) -> Lanes<N> {
    let light = map_to_lanes(texels, |texels| {
        Lanes::from_fn(|lane| table[channel_code(texels[lane], channel) as usize])
    });
    bilinear(light, quads)
}

/// Interpolates one linearly encoded channel; the result is from 0 to 1. Dividing by 255 after the
/// interpolation takes one division instead of four.
#[inline(always)]
fn filter_linear_channel<const N: usize>(
    texels: &PackedQuads<N>,
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
