//! Textures: an image with its mip chain, and how it is read at a fragment.
//!
//! A mip chain (Williams 1983) holds the image at full size, at half, at a quarter and so on. Where a pixel of the
//! picture covers many texels, a level is read in which it covers about one, so that the texture neither shimmers nor
//! costs more than a few fetches.

mod addressing;
mod filtering;
mod footprint;

use crate::color::srgb_to_linear_table;
use addressing::TexelAddressing;
use model::{Image, MipmapMode, Sampler};
use std::borrow::Cow;
use std::sync::OnceLock;

/// An image at all its sizes, with the way to read it.
#[derive(Clone, Debug)]
pub struct MipChain<'a> {
    levels: Vec<MipLevel<'a>>,
    addressing: TexelAddressing,
    /// The light that the codes of colours stand for.
    srgb_table: Option<&'static [f32; 256]>,
}

/// What the codes of texels mean.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TexelEncoding {
    /// Red, green and blue are sRGB, alpha is linear.
    Srgb,
    /// All four are linear, from 0 to 1.
    Linear,
}

/// One size of an image: texels with straight alpha, rows from the top.
#[derive(Clone, Debug)]
struct MipLevel<'a> {
    width: i32,
    height: i32,
    texels: Cow<'a, [[u8; 4]]>,
}

impl<'a> MipChain<'a> {
    /// Builds the chain; only the full image if the sampler asks for no others.
    #[must_use]
    pub fn new(image: &'a Image, sampler: Sampler, texels: TexelEncoding) -> Self {
        let full = MipLevel {
            width: image.width as i32,
            height: image.height as i32,
            texels: Cow::Borrowed(&image.rgba),
        };
        let mut levels = vec![full];
        if sampler.mipmap_mode != MipmapMode::None {
            let half = |level: &MipLevel<'a>| match texels {
                TexelEncoding::Srgb => {
                    level.downsample(|four| SrgbAverager::shared().average(four))
                }
                TexelEncoding::Linear => level.downsample(average_texels),
            };
            while let Some(half) = levels.last().and_then(half) {
                levels.push(half);
            }
        }
        let last = levels.len() as i32 - 1;
        let addressing = TexelAddressing {
            width: levels[0].width,
            height: levels[0].height,
            last_level: last,
            sampler,
        };
        let srgb_table = (texels == TexelEncoding::Srgb).then(srgb_to_linear_table);
        Self { levels, addressing, srgb_table }
    }

    /// What decides where it is read.
    #[inline(always)]
    pub(super) const fn addressing(&self) -> &TexelAddressing {
        &self.addressing
    }
}

impl MipLevel<'_> {
    /// This level at half size: each texel the mean of four; `None` if it is a single texel. Of an odd number of rows or
    /// columns the last one is left out.
    fn downsample<'b>(&self, mean: impl Fn([[u8; 4]; 4]) -> [u8; 4]) -> Option<MipLevel<'b>> {
        if self.width == 1 && self.height == 1 {
            return None;
        }
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let mut texels = Vec::with_capacity(width as usize * height as usize);
        let row = |y: i32| {
            let start = y.min(self.height - 1) as usize * self.width as usize;
            &self.texels[start..start + self.width as usize]
        };
        for y in 0..height {
            let (upper, lower) = (row(2 * y), row(2 * y + 1));
            if let ([a], [b]) = (upper, lower) {
                texels.push(mean([*a, *a, *b, *b]));
                continue;
            }
            let pairs = upper.as_chunks::<2>().0.iter().zip(lower.as_chunks::<2>().0);
            texels.extend(pairs.map(|(&[a, b], &[c, d])| mean([a, b, c, d])));
        }
        Some(MipLevel { width, height, texels: Cow::Owned(texels) })
    }
}

/// The mean of four texels of numbers.
fn average_texels(four: [[u8; 4]; 4]) -> [u8; 4] {
    [0, 1, 2, 3].map(|k: usize| {
        let sum: u16 = four.iter().map(|texel| u16::from(texel[k])).sum();
        ((sum + 2) / 4) as u8
    })
}

/// Tables for means of colours: 16-bit linear light of each code, and back.
#[derive(Debug)]
struct SrgbAverager {
    linear: [u32; 256],
    codes: Vec<u8>,
}

impl SrgbAverager {
    fn shared() -> &'static Self {
        static TABLES: OnceLock<SrgbAverager> = OnceLock::new();
        TABLES.get_or_init(|| {
            let linear = srgb_to_linear_table().map(|light| (light * 65535.0 + 0.5) as u32);
            let encoder = crate::color::SrgbEncoder::shared();
            let code = |light: u16| encoder.encode(f32::from(light) / 65535.0);
            Self { linear, codes: (0..=65535).map(code).collect() }
        })
    }

    /// The mean of four colours, in linear light.
    fn average(&self, four: [[u8; 4]; 4]) -> [u8; 4] {
        let color = |k: usize| {
            let sum: u32 = four.iter().map(|texel| self.linear[usize::from(texel[k])]).sum();
            self.codes[((sum + 2) / 4) as usize]
        };
        let [.., alpha] = average_texels(four);
        [color(0), color(1), color(2), alpha]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use model::{TextureFilter, WrapMode};

    fn checker(size: u32) -> Image {
        let texel = |n: u32| {
            if (n % size + n / size).is_multiple_of(2) { [255; 4] } else { [0, 0, 0, 255] }
        };
        Image { width: size, height: size, rgba: (0..size * size).map(texel).collect() }
    }

    /// One fragment, with alpha.
    fn sample(chain: &MipChain<'_>, uvs: [[f32; 2]; 3]) -> [f32; 4] {
        chain.sample(&uvs.map(|[u, v]| [[u], [v]]), true, 1).map(|[channel]| channel)
    }

    #[test]
    fn a_checker_from_afar_is_grey_in_linear_light() {
        let image = checker(16);
        let chain = MipChain::new(&image, Sampler::default(), TexelEncoding::Srgb);
        let uvs = [[0.4, 0.4], [1.0, 0.0], [0.0, 1.0]];
        let [r, g, b, a] = sample(&chain, uvs);
        assert!((r - 0.5).abs() < 0.003 && r == g && g == b && a == 1.0, "{r}");
    }

    #[test]
    fn linear_filtering_passes_through_texel_centres_and_halves_between() {
        let image = Image { width: 2, height: 1, rgba: vec![[0, 0, 0, 0], [255; 4]] };
        let sampler = Sampler { wrap_u: WrapMode::ClampToEdge, ..Sampler::default() };
        let chain = MipChain::new(&image, sampler, TexelEncoding::Srgb);
        let at = |u: f32| sample(&chain, [[u, 0.5], [0.0; 2], [0.0; 2]])[0];
        assert_eq!([at(0.25), at(0.5), at(0.75), at(1.5)], [0.0, 0.5, 1.0, 1.0]);
    }

    #[test]
    fn coordinates_that_are_no_numbers_read_some_texel() {
        let image = checker(4);
        let chain = MipChain::new(&image, Sampler::default(), TexelEncoding::Srgb);
        for u in [f32::NAN, f32::INFINITY, f32::MAX] {
            let texel = sample(&chain, [[u, 0.5]; 3]);
            assert!(texel.iter().all(|c| c.is_nan() || c.is_finite()));
        }
    }

    #[test]
    fn eight_samples_at_once_have_the_bits_of_one_by_one() {
        let texel = |n: u32| [n * 7, n * 31, n * 101, n * 59].map(|code| code as u8);
        let rgba = (0..24 * 16).map(texel).collect();
        let image = Image { width: 24, height: 16, rgba };
        let filters = [TextureFilter::Nearest, TextureFilter::Linear];
        let wraps = [WrapMode::Repeat, WrapMode::MirroredRepeat, WrapMode::ClampToEdge];
        for mipmap in [MipmapMode::None, MipmapMode::Nearest, MipmapMode::Linear] {
            for (magnify, minify) in filters.into_iter().flat_map(|a| filters.map(|b| (a, b))) {
                for (wrap_u, wrap_v) in wraps.into_iter().flat_map(|a| wraps.map(|b| (a, b))) {
                    let sampler = Sampler {
                        wrap_u,
                        wrap_v,
                        mag_filter: magnify,
                        min_filter: minify,
                        mipmap_mode: mipmap,
                    };
                    eight_are_as_one_by_one(&MipChain::new(&image, sampler, TexelEncoding::Srgb));
                }
            }
        }
    }

    /// Sizes of a pixel from a thirtieth of a texel to all of the image, mixed in each eight.
    fn eight_are_as_one_by_one(chain: &MipChain<'_>) {
        for round in 0..20 {
            let mut uvs = [[[0.0_f32; 8]; 2]; 3];
            for lane in 0..8 {
                let number = (round * 8 + lane) as f32;
                let size = 0.002 * (1 << ((round * 5 + lane * 3) % 10)) as f32;
                uvs[0][0][lane] = number * 0.37 - 20.0;
                uvs[0][1][lane] = 9.0 - number * 0.19;
                uvs[1][0][lane] = size;
                uvs[2][1][lane] = size * [0.7, 0.05, 3.0][lane % 3];
            }
            let all = chain.sample(&uvs, true, 1);
            let along = chain.sample(&uvs, true, 8);
            for lane in 0..8 {
                let one = uvs.map(|uv| uv.map(|axis| axis[lane]));
                assert_eq!(sample(chain, one), all.map(|channel| channel[lane]));
                let one = chain.sample(&one.map(|[u, v]| [[u], [v]]), true, 8);
                assert_eq!(one.map(|[channel]| channel), along.map(|channel| channel[lane]));
            }
        }
    }
}
