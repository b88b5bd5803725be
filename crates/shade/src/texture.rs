//! Textures: mip-mapped images, sampled with bilinear, trilinear and anisotropic filtering.
//!
//! ```text
//!   UvLanes ─► footprint ─► taps ─► addressing ─► filtering ─► TexelLanes
//!   u, v and   ellipse on   along   mip levels,   sRGB decode,  linear color,
//!   d/dx d/dy  the texture  it      texels        lerp          straight alpha
//! ```
//!
//! Where a pixel covers many texels, the texture is read from the mip level in which the pixel
//! covers about one. It then does not shimmer, and a few fetches suffice.

mod addressing;
mod filtering;
mod footprint;
mod mip_chain;

pub(super) use filtering::{GroupedTexture, MAX_GROUP, sample_textures};
pub use mip_chain::{MipChain, TexelEncoding};

use super::lanes::{Lanes, Rgb};

/// Texture coordinates at `N` fragments.
#[derive(Clone, Copy, Debug)]
pub(super) struct UvLanes<const N: usize> {
    /// u and v, from 0 to 1 across the image, starting at its upper left corner.
    pub(super) uv: [Lanes<N>; 2],
    /// The derivatives with respect to the pixel's column.
    pub(super) dx: [Lanes<N>; 2],
    /// The derivatives with respect to the pixel's row, downward.
    pub(super) dy: [Lanes<N>; 2],
}

impl<const N: usize> UvLanes<N> {
    /// The same point of the texture everywhere, for meshes without texture coordinates.
    pub(super) const ZERO: Self =
        Self { uv: [Lanes::ZERO; 2], dx: [Lanes::ZERO; 2], dy: [Lanes::ZERO; 2] };
}

/// Filtered texels at `N` fragments: linear color with straight alpha.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct TexelLanes<const N: usize> {
    /// The linear color, not multiplied by alpha.
    pub(super) color: Rgb<N>,
    /// Alpha, or 1 if it was not requested.
    pub(super) alpha: Lanes<N>,
}

impl<const N: usize> TexelLanes<N> {
    pub(super) const ZERO: Self = Self { color: Rgb::ZERO, alpha: Lanes::ZERO };

    /// Interpolates all four channels linearly.
    #[inline(always)]
    fn lerp(self, to: Self, t: Lanes<N>) -> Self {
        Self {
            color: self.color.zip(to.color, |from, to| from.lerp(to, t)),
            alpha: self.alpha.lerp(to.alpha, t),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use model::{Image, MipmapMode, Sampler, TextureFilter, WrapMode};

    fn checker(size: u32) -> Image {
        let texel = |n: u32| {
            if (n % size + n / size).is_multiple_of(2) { [255; 4] } else { [0, 0, 0, 255] }
        };
        Image { width: size, height: size, rgba: (0..size * size).map(texel).collect() }
    }

    /// Samples the texture, including alpha, at one fragment.
    fn sample(chain: &MipChain<'_>, uvs: [[f32; 2]; 3]) -> [f32; 4] {
        lane(&chain.sample(&uv_lanes(uvs), true, 1), 0)
    }

    /// Returns the coordinates and derivatives of one fragment.
    fn uv_lanes(uvs: [[f32; 2]; 3]) -> UvLanes<1> {
        let [uv, dx, dy] = uvs.map(|uv| uv.map(Lanes::splat));
        UvLanes { uv, dx, dy }
    }

    fn lane<const N: usize>(texels: &TexelLanes<N>, lane: usize) -> [f32; 4] {
        let [r, g, b] = texels.color.lane(lane);
        [r, g, b, texels.alpha[lane]]
    }

    #[test]
    fn a_distant_checkerboard_is_gray_in_linear_light() {
        let image = checker(16);
        let chain = MipChain::new(&image, Sampler::default(), TexelEncoding::Srgb);
        let uvs = [[0.4, 0.4], [1.0, 0.0], [0.0, 1.0]];
        let [r, g, b, a] = sample(&chain, uvs);
        assert!((r - 0.5).abs() < 0.003 && r == g && g == b && a == 1.0, "{r}");
    }

    #[test]
    fn linear_filtering_interpolates_between_texel_centers() {
        let image = Image { width: 2, height: 1, rgba: vec![[0, 0, 0, 0], [255; 4]] };
        let sampler = Sampler { wrap_u: WrapMode::ClampToEdge, ..Sampler::default() };
        let chain = MipChain::new(&image, sampler, TexelEncoding::Srgb);
        let at = |u: f32| sample(&chain, [[u, 0.5], [0.0; 2], [0.0; 2]])[0];
        assert_eq!([at(0.25), at(0.5), at(0.75), at(1.5)], [0.0, 0.5, 1.0, 1.0]);
    }

    #[test]
    fn non_finite_coordinates_still_read_a_texel() {
        let image = checker(4);
        let chain = MipChain::new(&image, Sampler::default(), TexelEncoding::Srgb);
        for u in [f32::NAN, f32::INFINITY, f32::MAX] {
            let texel = sample(&chain, [[u, 0.5]; 3]);
            assert!(texel.iter().all(|c| c.is_nan() || c.is_finite()));
        }
    }

    #[test]
    fn eight_samples_at_once_match_single_samples_bit_for_bit() {
        let texel = |n: u32| [n * 7, n * 31, n * 101, n * 59].map(|code| code as u8);
        let rgba = (0..24 * 16).map(texel).collect();
        let image = Image { width: 24, height: 16, rgba };
        let filters = [TextureFilter::Nearest, TextureFilter::Linear];
        let wraps = [WrapMode::Repeat, WrapMode::MirroredRepeat, WrapMode::ClampToEdge];
        for mipmap_mode in [MipmapMode::None, MipmapMode::Nearest, MipmapMode::Linear] {
            for (mag_filter, min_filter) in
                filters.into_iter().flat_map(|a| filters.map(|b| (a, b)))
            {
                for (wrap_u, wrap_v) in wraps.into_iter().flat_map(|a| wraps.map(|b| (a, b))) {
                    let sampler = Sampler { wrap_u, wrap_v, mag_filter, min_filter, mipmap_mode };
                    eight_are_as_one_by_one(&MipChain::new(&image, sampler, TexelEncoding::Srgb));
                }
            }
        }
    }

    /// Tests pixel sizes from a thirtieth of a texel to the whole image, mixed within each group of
    /// eight.
    fn eight_are_as_one_by_one(chain: &MipChain<'_>) {
        for round in 0..20 {
            let mut uvs = UvLanes::<8>::ZERO;
            for lane in 0..8 {
                let index = (round * 8 + lane) as f32;
                let size = 0.002 * (1 << ((round * 5 + lane * 3) % 10)) as f32;
                uvs.uv[0][lane] = index * 0.37 - 20.0;
                uvs.uv[1][lane] = 9.0 - index * 0.19;
                uvs.dx[0][lane] = size;
                uvs.dy[1][lane] = size * [0.7, 0.05, 3.0][lane % 3];
            }
            let isotropic = chain.sample(&uvs, true, 1);
            let anisotropic = chain.sample(&uvs, true, 8);
            for index in 0..8 {
                let one = [uvs.uv, uvs.dx, uvs.dy].map(|uv| uv.map(|axis| axis[index]));
                assert_eq!(sample(chain, one), lane(&isotropic, index));
                let one = chain.sample(&uv_lanes(one), true, 8);
                assert_eq!(lane(&one, 0), lane(&anisotropic, index));
            }
        }
    }
}
